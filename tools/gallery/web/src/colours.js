// Numbers as colours.

import { Color, SRGBColorSpace } from "three";

/** From low to high. */
const MAPS = {
    heat: ["#f4efe4", "#f3d08b", "#ea9850", "#cf5540", "#942545", "#4c163f"],
    depth: ["#f2f3e4", "#b9dcb9", "#6fb7ac", "#3a86a0", "#2b5383", "#25254f"],
    diverging: ["#2f5fa5", "#86add4", "#f1eee6", "#dfa183", "#ad3a35"],
};

function stops(map) {
    const colours = MAPS[map];
    if (!colours) throw new Error(`there is no colour map ${map}; there are ${Object.keys(MAPS).join(", ")}`);
    return colours;
}

/** Where `value` lies on a scale, from 0 to 1. */
export function place(scale, value) {
    const of = (x) => (scale.logarithmic ? Math.log(Math.max(x, 1e-30)) : x);
    const part = (of(value) - of(scale.minimum)) / (of(scale.maximum) - of(scale.minimum));
    return Math.min(Math.max(part, 0), 1) || 0;
}

/** A function from values to colours. */
export function colouring(scale) {
    const colours = stops(scale.map).map((stop) => new Color(stop).getRGB({}, SRGBColorSpace));
    return (value) => {
        const at = place(scale, value) * (colours.length - 1);
        const k = Math.min(Math.floor(at), colours.length - 2);
        const mix = (channel) => colours[k][channel] + (at - k) * (colours[k + 1][channel] - colours[k][channel]);
        return new Color().setRGB(mix("r"), mix("g"), mix("b"), SRGBColorSpace);
    };
}

/** Round numbers of a scale. */
function ticks(scale) {
    if (!scale.logarithmic) return [0, 0.25, 0.5, 0.75, 1].map((p) => scale.minimum + p * (scale.maximum - scale.minimum));
    const values = [];
    const last = Math.floor(Math.log10(scale.maximum) + 1e-9);
    for (let k = Math.ceil(Math.log10(scale.minimum) - 1e-9); k <= last; k++) values.push(10 ** k);
    return values;
}

/** An element that explains a scale. */
export function legend(scale) {
    const figure = document.createElement("figure");
    figure.className = "legend";
    const caption = document.createElement("figcaption");
    caption.textContent = scale.label;
    const bar = document.createElement("div");
    bar.style.background = `linear-gradient(to right, ${stops(scale.map).join(", ")})`;
    const labels = document.createElement("ol");
    for (const value of ticks(scale)) {
        const label = document.createElement("li");
        label.textContent = scale.logarithmic ? `${Number(value.toPrecision(1))}` : `${Number(value.toPrecision(3))}`;
        label.style.left = `${100 * place(scale, value)}%`;
        labels.append(label);
    }
    figure.append(caption, bar, labels);
    return figure;
}
