// Where cameras stand: one scale and one place for all cells of a column, so that bodies can be compared.

import * as THREE from "three";

/** A long lens: bodies look as they are built. */
const FIELD = 14;
/** Metres seen at a distance of one. */
export const SLOPE = 2 * Math.tan((FIELD * Math.PI) / 360);
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
    // Of nothing, so that something can be computed with.
    if (ground === Infinity) return { low: [-1, -1, -1], high: [1, 1, 1], ground: 0 };
    return { low, high, ground };
}

/** A camera that sees `height` metres around `centre`. */
export function camera(view, centre, height, aspect) {
    const { up, back } = axes(view);
    const distance = height / SLOPE;
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

/** The middle of a box. */
function middleOf({ low, high }) {
    return [0, 1, 2].map((k) => (low[k] + high[k]) / 2);
}

/** The frames of all cells of a sheet, which are so many pixels high. */
export class Framing {
    constructor(sheet, height) {
        this.sheet = sheet;
        this.height = height;
        // Cells of a column that are seen in one way share a box.
        this.boxes = sheet.columns.map(() => new Map());
        const key = (cell) => JSON.stringify(cell.view ?? sheet.view);
        sheet.columns.forEach((_, column) => {
            const cells = sheet.cells.filter((cell) => cell.column === column && cell.layers.length > 0);
            for (const view of new Set(cells.map(key))) {
                const points = cells.filter((cell) => key(cell) === view).flatMap((cell) => sheet.points(cell));
                this.boxes[column].set(view, extent(points, JSON.parse(view)));
            }
        });
        this.box = (cell) => this.boxes[cell.column].get(key(cell));
        const [wide, tall] = [0, 1].map((k) => this.boxes.map((boxes) => this.largest(boxes, k)));
        const tallest = Math.max(...tall);
        this.metres = tall.map((own) => tallest ** (1 - sheet.evenness) * own ** sheet.evenness);
        this.widths = wide.map((own, c) => Math.round(Math.max((height * own) / this.metres[c], 0.22 * height)));
    }

    /** The largest extent of a column along an axis; cells that say themselves how much they show do not count. */
    largest(boxes, axis) {
        const all = [...boxes].map(([view, { low, high }]) => [JSON.parse(view), high[axis] - low[axis]]);
        const free = all.filter(([view]) => view.height == null);
        return (1 + 2 * MARGIN) * Math.max(...(free.length ? free : all).map(([, extent]) => extent), 1e-6);
    }

    /** How a cell is seen. */
    of(cell) {
        const view = cell.view ?? this.sheet.view;
        const [box, column] = [this.box(cell), cell.column];
        const aspect = this.widths[column] / this.height;
        const metres = view.height ?? this.metres[column];
        const middle = middleOf(box);
        // Feet are at one height in all cells.
        if (view.height == null) middle[1] = box.low[1] + (0.5 - MARGIN / (1 + 2 * MARGIN)) * metres;
        const centre = view.centre ? new THREE.Vector3(...view.centre) : pointAt(view, middle);
        return { view, aspect, metres, centre, ground: box.ground };
    }
}
