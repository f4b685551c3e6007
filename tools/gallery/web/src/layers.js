// The layers of a cell as objects of a scene.

import * as THREE from "three";
import { colouring } from "./colours.js";
import { cornerNormals } from "./normals.js";

/** Corner by corner what an index has vertex by vertex. */
function unindexed(values, triangles) {
    const corners = new Float32Array(3 * triangles.length);
    triangles.forEach((v, corner) => corners.set(values.subarray(3 * v, 3 * v + 3), 3 * corner));
    return corners;
}

function triangleColours(values, scale) {
    const colour = colouring(scale);
    const colours = new Float32Array(9 * values.length);
    values.forEach((value, t) => {
        const { r, g, b } = colour(value);
        colours.set([r, g, b, r, g, b, r, g, b], 9 * t);
    });
    return colours;
}

/** Each edge of the triangles once, as pairs of vertices. */
function edges(triangles, vertices) {
    const known = new Set();
    const pairs = [];
    for (let t = 0; t < triangles.length; t += 3) {
        for (let k = 0; k < 3; k++) {
            const [a, b] = [triangles[t + k], triangles[t + ((k + 1) % 3)]];
            const key = Math.min(a, b) * vertices + Math.max(a, b);
            if (known.has(key)) continue;
            known.add(key);
            pairs.push(a, b);
        }
    }
    return pairs;
}

/** Whether each edge has two sides: nothing is seen of the inside. */
function isClosed(triangles, vertices) {
    const open = new Set();
    for (let t = 0; t < triangles.length; t += 3) {
        for (let k = 0; k < 3; k++) {
            const [a, b] = [triangles[t + k], triangles[t + ((k + 1) % 3)]];
            if (!open.delete(b * vertices + a)) open.add(a * vertices + b);
        }
    }
    return open.size === 0;
}

function wires(positions, triangles) {
    const geometry = new THREE.BufferGeometry();
    geometry.setAttribute("position", new THREE.BufferAttribute(positions, 3));
    geometry.setIndex(edges(triangles, positions.length / 3));
    const material = new THREE.LineBasicMaterial({ color: "#1d1a16", transparent: true, opacity: 0.45 });
    return new THREE.LineSegments(geometry, material);
}

/** Cloth is matte with a soft rim; bodies are matte. */
function material(layer, coloured, closed) {
    const common = {
        side: closed ? THREE.FrontSide : THREE.DoubleSide,
        shadowSide: THREE.DoubleSide,
        vertexColors: coloured,
        color: coloured ? "#ffffff" : layer.colour,
        transparent: layer.opacity < 1,
        opacity: layer.opacity,
        depthWrite: layer.opacity === 1,
        // Edges are drawn in front.
        polygonOffset: true,
        polygonOffsetFactor: 1,
        polygonOffsetUnits: 1,
    };
    if (layer.role !== "garment" || coloured) return new THREE.MeshStandardMaterial({ ...common, roughness: 0.82 });
    const sheenColor = new THREE.Color(layer.colour).lerp(new THREE.Color("#ffffff"), 0.35);
    return new THREE.MeshPhysicalMaterial({ ...common, roughness: 0.92, sheen: 0.45, sheenRoughness: 0.6, sheenColor });
}

function surface(sheet, layer, { values, wireframe }) {
    const mesh = sheet.meshes[layer.mesh];
    const [positions, triangles] = [sheet.floats(mesh.positions), sheet.indices(mesh.triangles)];
    const geometry = new THREE.BufferGeometry();
    geometry.setAttribute("position", new THREE.BufferAttribute(unindexed(positions, triangles), 3));
    geometry.setAttribute("normal", new THREE.BufferAttribute(cornerNormals(positions, triangles, layer.crease), 3));
    const coloured = layer.values && (values || layer.values.shown);
    if (coloured) {
        const colours = triangleColours(sheet.floats(layer.values.array), sheet.scales[layer.values.scale]);
        geometry.setAttribute("color", new THREE.BufferAttribute(colours, 3));
    }
    const closed = isClosed(triangles, positions.length / 3);
    const solid = new THREE.Mesh(geometry, material(layer, Boolean(coloured), closed));
    solid.castShadow = solid.receiveShadow = layer.opacity === 1;
    const group = new THREE.Group().add(solid);
    if (layer.wireframe || wireframe) group.add(wires(positions, triangles));
    return group;
}

function lines(sheet, layer) {
    const [points, segments] = [sheet.floats(layer.points), sheet.indices(layer.segments)];
    const point = (index) => new THREE.Vector3().fromArray(points, 3 * index);
    const over = layer.over ? { depthTest: false, depthWrite: false, transparent: true } : {};
    const paint = new THREE.MeshStandardMaterial({ color: layer.colour, roughness: 0.7, ...over });
    const tubes = new THREE.InstancedMesh(
        new THREE.CylinderGeometry(layer.radius, layer.radius, 1, 12),
        paint,
        segments.length / 2,
    );
    const up = new THREE.Vector3(0, 1, 0);
    for (let s = 0; s < segments.length; s += 2) {
        const [a, b] = [point(segments[s]), point(segments[s + 1])];
        const along = b.clone().sub(a);
        const length = along.length() || 1e-9;
        const turn = new THREE.Quaternion().setFromUnitVectors(up, along.divideScalar(length));
        const middle = a.add(b).multiplyScalar(0.5);
        tubes.setMatrixAt(s / 2, new THREE.Matrix4().compose(middle, turn, new THREE.Vector3(1, length, 1)));
    }
    const group = new THREE.Group().add(tubes);
    if (layer.balls) {
        const balls = new THREE.InstancedMesh(
            new THREE.SphereGeometry(2 * layer.radius, 20, 14),
            paint,
            points.length / 3,
        );
        for (let p = 0; p < points.length / 3; p++) balls.setMatrixAt(p, new THREE.Matrix4().setPosition(point(p)));
        group.add(balls);
    }
    for (const part of group.children) {
        part.frustumCulled = false;
        part.castShadow = !layer.over;
        // After everything that they are seen through.
        part.renderOrder = layer.over ? 1 : 0;
    }
    return group;
}

/**
 * What a cell shows. `roles`: which roles to show or hide, whatever the layers say; `wireframe`, whether garments show their
 * edges; `values`, whether garments show their values.
 */
export function cellObject(sheet, cell, { roles = {}, wireframe = false, values = false } = {}) {
    const group = new THREE.Group();
    for (const layer of cell.layers) {
        if (!(roles[layer.role] ?? layer.shown)) continue;
        const garment = layer.role === "garment";
        const options = { wireframe: wireframe && garment, values: values && garment };
        group.add(layer.kind === "surface" ? surface(sheet, layer, options) : lines(sheet, layer));
    }
    return group;
}

/** Frees what `cellObject` took on the graphics card. */
export function dispose(group) {
    group.traverse((object) => {
        object.geometry?.dispose();
        object.material?.dispose();
        if (object.isInstancedMesh) object.dispose();
    });
}
