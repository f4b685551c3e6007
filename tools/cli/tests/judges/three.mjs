// Reads files as a viewer does, with three.js and its VRM plugin, and says where the vertices are at times of an animation.
//
// three.mjs FILE ANIMATION TIME... (without an animation, "", where the nodes rest): prints a line of JSON with the VRM version (none: no VRM), the number of humanoid bones,
// and for each time and primitive its node, its index in the mesh, and its positions in the file's space.
import { readFileSync } from "node:fs";
import * as three from "three";
import { GLTFLoader } from "three/addons/loaders/GLTFLoader.js";
import { VRMLoaderPlugin } from "@pixiv/three-vrm";

// What three.js asks of a browser.
globalThis.self = globalThis;
globalThis.ProgressEvent ??= class {};

const [file, animation, ...times] = process.argv.slice(2);
const bytes = readFileSync(file);
const loader = new GLTFLoader();
loader.register((parser) => new VRMLoaderPlugin(parser));
// Pictures are for screens.
loader.register(() => ({ name: "no pictures", loadTexture: async () => new three.Texture() }));
const gltf = await loader.parseAsync(bytes.buffer.slice(bytes.byteOffset, bytes.byteOffset + bytes.byteLength), "");
const { parser, scene } = gltf;

const mixer = new three.AnimationMixer(scene);
if (animation) {
  const clip = gltf.animations.find((clip) => clip.name === animation);
  if (!clip) throw new Error(`there is no animation ${animation}`);
  const action = mixer.clipAction(clip);
  action.setLoop(three.LoopOnce);
  action.clampWhenFinished = true;
  action.play();
}

const moments = [];
for (const time of times.map(Number)) {
  mixer.setTime(time);
  scene.updateMatrixWorld(true);
  const primitives = [];
  scene.traverse((object) => {
    const own = parser.associations.get(object);
    if (!object.isMesh || own?.primitives === undefined) return;
    // A mesh of several primitives is a group at its node.
    const node = own.nodes ?? parser.associations.get(object.parent)?.nodes;
    const at = new three.Vector3();
    const positions = [];
    for (let v = 0; v < object.geometry.attributes.position.count; v++) {
      object.getVertexPosition(v, at).applyMatrix4(object.matrixWorld);
      positions.push([at.x, at.y, at.z]);
    }
    primitives.push({ node, primitive: own.primitives, positions });
  });
  moments.push({ time, primitives });
}
const vrm = gltf.userData.vrm;
const bones = Object.keys(vrm?.humanoid?.humanBones ?? {}).length;
console.log(JSON.stringify({ file, vrm: vrm?.meta.metaVersion ?? null, bones, moments }));
