// A photographer's studio: soft light from all around, one large lamp, a ground that shows shadows only.

import * as THREE from "three";
import { RoomEnvironment } from "three/addons/environments/RoomEnvironment.js";

export class Studio {
    /** Draws to a canvas of its own, on a transparent ground. */
    constructor() {
        this.renderer = new THREE.WebGLRenderer({ antialias: true, alpha: true, preserveDrawingBuffer: true });
        this.renderer.setClearAlpha(0);
        this.renderer.toneMapping = THREE.NeutralToneMapping;
        this.renderer.toneMappingExposure = 1;
        this.renderer.shadowMap.enabled = true;
        this.renderer.shadowMap.type = THREE.VSMShadowMap;
        this.scene = new THREE.Scene();
        this.scene.environment = this.surroundings();
        this.scene.environmentIntensity = 0.42;
        // The room of the reflections has y up.
        this.scene.environmentRotation.set(Math.PI / 2, 0, 0);
        this.scene.add(new THREE.HemisphereLight("#ffffff", "#a89c8d", 0.5));
        this.lamp = this.lampWithShadow();
        this.scene.add(this.lamp, this.lamp.target);
        this.ground = new THREE.Mesh(new THREE.CircleGeometry(1, 64), new THREE.ShadowMaterial({ opacity: 0.17 }));
        this.ground.receiveShadow = true;
        this.scene.add(this.ground);
    }

    get canvas() {
        return this.renderer.domElement;
    }

    surroundings() {
        const generator = new THREE.PMREMGenerator(this.renderer);
        const texture = generator.fromScene(new RoomEnvironment(), 0.04).texture;
        generator.dispose();
        return texture;
    }

    lampWithShadow() {
        const lamp = new THREE.DirectionalLight("#fff6ea", 2.3);
        lamp.castShadow = true;
        lamp.shadow.mapSize.set(1024, 1024);
        lamp.shadow.radius = 9;
        lamp.shadow.blurSamples = 14;
        lamp.shadow.bias = -0.0006;
        return lamp;
    }

    /** Lights a ball around `centre`, from the left of a viewer at `azimuth` degrees; the ground is at height `ground`. */
    light(centre, radius, ground, azimuth) {
        const angle = ((azimuth - 22) * Math.PI) / 180;
        const towards = new THREE.Vector3(Math.sin(angle), -Math.cos(angle), 2).normalize();
        this.lamp.position.copy(centre).addScaledVector(towards, 3 * radius);
        this.lamp.target.position.copy(centre);
        const seen = this.lamp.shadow.camera;
        [seen.left, seen.right, seen.bottom, seen.top] = [-radius, radius, -radius, radius];
        [seen.near, seen.far] = [radius, 5 * radius];
        seen.updateProjectionMatrix();
        this.lamp.shadow.normalBias = 0.006 * radius;
        this.ground.position.set(centre.x, centre.y, ground);
        this.ground.scale.setScalar(4 * radius);
    }

    /** Draws `object` as `camera` sees it, `width` times `height` pixels. */
    draw(object, camera, width, height, ratio = 1) {
        this.renderer.setPixelRatio(ratio);
        this.renderer.setSize(width, height, false);
        this.scene.add(object);
        this.renderer.render(this.scene, camera);
        this.scene.remove(object);
    }
}
