// What the document holds: the sheet, its numbers, the small pictures.

import { unshuffle } from "./bytes.js";

function json(id) {
    return JSON.parse(document.getElementById(id).textContent);
}

async function inflate(base64) {
    const packed = Uint8Array.from(atob(base64), (letter) => letter.charCodeAt(0));
    const stream = new Blob([packed]).stream().pipeThrough(new DecompressionStream("deflate"));
    return new Uint8Array(await new Response(stream).arrayBuffer());
}

/** A sheet with its numbers. */
export class Sheet {
    constructor(header, buffer) {
        Object.assign(this, header);
        this.buffer = buffer;
    }

    floats({ offset, count }) {
        return new Float32Array(this.buffer, offset, count);
    }

    indices({ offset, count }) {
        return new Uint32Array(this.buffer, offset, count);
    }

    /** The cell at a place, if there is one. */
    cellAt(column, row) {
        return this.cells.find((cell) => cell.column === column && cell.row === row);
    }

    /** All arrays of points that a cell shows of itself. */
    points(cell) {
        return cell.layers.filter((layer) => layer.shown).map((layer) =>
            this.floats(layer.kind === "surface" ? this.meshes[layer.mesh].positions : layer.points),
        );
    }
}

/** The sheet of this document, without its numbers yet. */
export function readHeader() {
    return json("sheet");
}

/** The small pictures, one a cell. */
export function readThumbnails() {
    return json("thumbnails");
}

/** The sheet of this document. */
export async function readSheet() {
    const element = document.getElementById("data");
    const bytes = unshuffle(await inflate(element.textContent));
    element.remove();
    return new Sheet(readHeader(), bytes.buffer);
}
