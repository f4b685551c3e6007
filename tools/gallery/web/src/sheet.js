// The whole sheet laid out for a picture. `window.sheet` lets a program draw one cell after the other.

import "./base.css";
import "./sheet.css";
import { legend } from "./colours.js";
import { readSheet } from "./data.js";
import { Framing, camera, extent, pointAt } from "./framing.js";
import { cellObject, dispose } from "./layers.js";
import { Studio } from "./studio.js";

/** Pixels of a cell. */
const HEIGHT = 340;
/** Pixels drawn for one of the picture, each way. */
const OVERSAMPLING = 2;

function element(name, className, text = "") {
    const made = document.createElement(name);
    made.className = className;
    made.textContent = text;
    return made;
}

function heading(className, { label, note }) {
    const made = element("div", className);
    made.append(element("strong", "", label));
    if (note) made.append(element("span", "", note));
    return made;
}

/** Lets shadows that leave the cell end softly. */
function fadeSides(context, { width, height }) {
    const gradient = context.createLinearGradient(0, 0, width, 0);
    const stops = { 0: 0, 0.03: 1, 0.97: 1, 1: 0 };
    for (const [at, alpha] of Object.entries(stops)) gradient.addColorStop(Number(at), `rgb(0 0 0 / ${alpha})`);
    context.globalCompositeOperation = "destination-in";
    context.fillStyle = gradient;
    context.fillRect(0, 0, width, height);
    context.globalCompositeOperation = "source-over";
}

/** The grid with an empty canvas for each cell. */
function layOut(sheet, widths) {
    const main = document.querySelector("main");
    const header = element("header", "");
    header.append(element("h1", "", sheet.title), element("p", "", sheet.subtitle));
    const grid = element("div", "grid");
    const labelled = sheet.rows.some((row) => row.label);
    grid.style.gridTemplateColumns = [labelled ? "7.5rem" : "0", ...widths.map((width) => `${width}px`)].join(" ");
    grid.append(element("div", ""), ...sheet.columns.map((column) => heading("column", column)));
    const canvases = new Map();
    sheet.rows.forEach((row, r) => {
        grid.append(heading("row", row));
        sheet.columns.forEach((_, c) => {
            const place = element("div", "cell");
            grid.append(place);
            const cell = sheet.cellAt(c, r);
            if (!cell) return;
            const canvas = element("canvas", "");
            const ratio = devicePixelRatio;
            [canvas.width, canvas.height] = [widths[c] * ratio, HEIGHT * ratio].map(Math.round);
            [canvas.style.width, canvas.style.height] = [`${widths[c]}px`, `${HEIGHT}px`];
            place.append(canvas);
            if (cell.message) place.append(element("p", "message", cell.message));
            place.append(element("p", "caption", cell.caption));
            canvases.set(cell, canvas);
        });
    });
    const legends = element("footer", "");
    const used = new Set(sheet.cells.flatMap((cell) => cell.layers.map((layer) => layer.values)));
    sheet.scales.forEach((scale, index) => {
        if ([...used].some((values) => values?.shown && values.scale === index)) legends.append(legend(scale));
    });
    main.append(header, grid, legends);
    return canvases;
}

async function start() {
    const sheet = await readSheet();
    const studio = new Studio();
    const framing = new Framing(sheet, HEIGHT);
    const canvases = layOut(sheet, framing.widths);
    await document.fonts.ready;

    const draw = (index) => {
        const cell = sheet.cells[index];
        if (cell.layers.length === 0) return;
        const canvas = canvases.get(cell);
        const { view, aspect, centre, metres, ground } = framing.of(cell);
        const box = extent(sheet.points(cell), view);
        const radius = 0.5 * Math.hypot(...box.high.map((high, k) => high - box.low[k]));
        const middle = pointAt(view, [0, 1, 2].map((k) => (box.low[k] + box.high[k]) / 2));
        const object = cellObject(sheet, cell);
        studio.light(middle, radius, ground, view.azimuth);
        const [width, height] = [canvas.width * OVERSAMPLING, canvas.height * OVERSAMPLING];
        studio.draw(object, camera(view, centre, metres, aspect), width, height);
        dispose(object);
        const context = canvas.getContext("2d");
        context.imageSmoothingQuality = "high";
        context.drawImage(studio.canvas, 0, 0, canvas.width, canvas.height);
        if (!cell.view?.height) fadeSides(context, canvas);
    };
    const thumbnails = () =>
        sheet.cells.map((cell) => ({
            column: cell.column,
            row: cell.row,
            picture: cell.layers.length ? canvases.get(cell).toDataURL("image/webp", 0.88) : null,
            size: [framing.widths[cell.column], HEIGHT],
        }));
    window.sheet = { count: sheet.cells.length, draw, thumbnails };
}

window.ready = start();
