// The order of bytes in which numbers compress well: first all the first bytes, then all the second ones.

/** The bytes of 32-bit numbers, regrouped. */
export function shuffle(bytes) {
    const count = bytes.length / 4;
    const shuffled = new Uint8Array(bytes.length);
    for (let i = 0; i < count; i++) {
        for (let k = 0; k < 4; k++) shuffled[k * count + i] = bytes[4 * i + k];
    }
    return shuffled;
}

/** Undoes `shuffle`. */
export function unshuffle(shuffled) {
    const count = shuffled.length / 4;
    const bytes = new Uint8Array(shuffled.length);
    for (let i = 0; i < count; i++) {
        for (let k = 0; k < 4; k++) bytes[4 * i + k] = shuffled[k * count + i];
    }
    return bytes;
}
