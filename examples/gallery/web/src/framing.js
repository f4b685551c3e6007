// Where cameras stand: one scale and one place for all cells of a column, so that bodies can be compared.

import * as THREE from "three";

/** A long lens: bodies look as they are built. */
const FIELD = 14;
/** Free space around bodies, of their height. */
const MARGIN = 0.05;

/** Right, up and towards the viewer. */
export function axes({ azimuth, elevation }) {
    const [a, e] = [(azimuth * Math.PI) / 180, (elevation * Math.PI) / 180];
    return {
        right: new THREE.Vector3(Math.cos(a), Math.sin(a), 0),
        up: new THREE.Vector3(-Math.sin(a) * Math.sin(e), Math.cos(a) * Math.sin(e), Math.cos(e)),
        back: new THREE.Vector3(Math.sin(a) * Math.cos(e), -Math.cos(a) * Math.cos(e), Math.sin(e)),
    };
}

/** The box of points along the axes of a view, and the lowest coordinate. */
export function extent(arrays, view) {
    const { right, up, back } = axes(view);
    const directions = [right, up, back];
    const low = [Infinity, Infinity, Infinity];
    const high = [-Infinity, -Infinity, -Infinity];
    let ground = Infinity;
    for (const points of arrays) {
        for (let i = 0; i < points.length; i += 3) {
            directions.forEach((d, k) => {
                const along = d.x * points[i] + d.y * points[i + 1] + d.z * points[i + 2];
                low[k] = Math.min(low[k], along);
                high[k] = Math.max(high[k], along);
            });
            ground = Math.min(ground, points[i + 2]);
        }
    }
    if (ground === Infinity) return { low: [-1, -1, -1], high: [1, 1, 1], ground: 0 };
    return { low, high, ground };
}

/** A camera that sees `height` metres around `centre`. */
export function camera(view, centre, height, aspect) {
    const { up, back } = axes(view);
    const distance = height / 2 / Math.tan((FIELD * Math.PI) / 360);
    const seen = new THREE.PerspectiveCamera(FIELD, aspect, distance / 10, distance * 4);
    seen.up.set(0, 0, 1);
    seen.position.copy(centre).addScaledVector(back, distance);
    // From straight above, the vertical is no direction of the picture.
    if (Math.abs(back.z) > 0.999) seen.up.copy(up);
    seen.lookAt(centre);
    seen.updateMatrixWorld();
    return seen;
}

/** The point with these coordinates along the axes of a view. */
export function pointAt(view, [x, y, z]) {
    const { right, up, back } = axes(view);
    return new THREE.Vector3().addScaledVector(right, x).addScaledVector(up, y).addScaledVector(back, z);
}

/**
 * For each column of a sheet: its width in pixels where cells are `height` pixels high, how many metres a cell shows, and
 * what is in the middle.
 */
export function columns(sheet, height) {
    const boxes = sheet.columns.map((_, column) => {
        const cells = sheet.cells.filter((cell) => cell.column === column);
        return extent(cells.flatMap((cell) => sheet.points(cell)), sheet.view);
    });
    const [tall, wide] = [1, 0].map((k) => boxes.map(({ low, high }) => (1 + 2 * MARGIN) * (high[k] - low[k])));
    const tallest = Math.max(...tall);
    return boxes.map(({ low, high, ground }, column) => {
        const metres = tallest ** (1 - sheet.evenness) * tall[column] ** sheet.evenness;
        const middle = [
            (low[0] + high[0]) / 2,
            // Feet are at one height in all cells.
            low[1] - (tall[column] - (high[1] - low[1])) / 2 + metres / 2,
            (low[2] + high[2]) / 2,
        ];
        const width = Math.round(Math.max((height * wide[column]) / metres, 0.22 * height));
        return { width, metres, centre: pointAt(sheet.view, middle), ground };
    });
}
