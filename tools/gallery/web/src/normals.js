// Normals of triangle corners: smooth over flat edges, sharp over sharp ones.

/** The triangles around each vertex: those of vertex v are `list[first[v]]` to `list[first[v + 1] - 1]`. */
function around(vertices, triangles) {
    const first = new Uint32Array(vertices + 1);
    for (const v of triangles) first[v + 1]++;
    for (let v = 0; v < vertices; v++) first[v + 1] += first[v];
    const next = first.slice();
    const list = new Uint32Array(triangles.length);
    triangles.forEach((v, corner) => (list[next[v]++] = (corner / 3) | 0));
    return { first, list };
}

/** Normals of all triangles, as long as twice their area, and their lengths. */
function ofTriangles(positions, triangles) {
    const count = triangles.length / 3;
    const normals = new Float32Array(3 * count);
    const lengths = new Float32Array(count);
    for (let t = 0; t < count; t++) {
        const [a, b, c] = [3 * triangles[3 * t], 3 * triangles[3 * t + 1], 3 * triangles[3 * t + 2]];
        const u = [0, 1, 2].map((k) => positions[b + k] - positions[a + k]);
        const w = [0, 1, 2].map((k) => positions[c + k] - positions[a + k]);
        for (let k = 0; k < 3; k++) {
            const [i, j] = [(k + 1) % 3, (k + 2) % 3];
            normals[3 * t + k] = u[i] * w[j] - u[j] * w[i];
        }
        lengths[t] = Math.hypot(normals[3 * t], normals[3 * t + 1], normals[3 * t + 2]);
    }
    return { normals, lengths };
}

/**
 * One normal a corner, triangle after triangle: the sum over those triangles around its vertex that deviate by less than
 * `crease` degrees.
 */
export function cornerNormals(positions, triangles, crease) {
    const { normals, lengths } = ofTriangles(positions, triangles);
    const { first, list } = around(positions.length / 3, triangles);
    const limit = Math.cos((crease * Math.PI) / 180);
    const corners = new Float32Array(3 * triangles.length);
    triangles.forEach((v, corner) => {
        const own = (corner / 3) | 0;
        let [x, y, z] = [0, 0, 0];
        for (let k = first[v]; k < first[v + 1]; k++) {
            const t = list[k];
            const [nx, ny, nz] = [normals[3 * t], normals[3 * t + 1], normals[3 * t + 2]];
            const cosine = nx * normals[3 * own] + ny * normals[3 * own + 1] + nz * normals[3 * own + 2];
            if (t === own || cosine >= limit * lengths[t] * lengths[own]) [x, y, z] = [x + nx, y + ny, z + nz];
        }
        const length = Math.hypot(x, y, z) || 1;
        corners.set([x / length, y / length, z / length], 3 * corner);
    });
    return corners;
}
