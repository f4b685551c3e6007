// The page: the sheet as small pictures, each of which opens large.

import "./base.css";
import "./page.css";
import { readHeader, readThumbnails } from "./data.js";
import { el } from "./elements.js";
import { Viewer } from "./viewer.js";

/** `#row/column`, as words. */
function address(sheet, cell) {
    const word = (heading) => heading.label.toLowerCase().replaceAll(" ", "-");
    return `#${word(sheet.rows[cell.row])}/${word(sheet.columns[cell.column])}`;
}

function picture(thumbnail, name) {
    if (!thumbnail?.picture) return el("span", { class: "empty" }, "no result");
    const [width, height] = thumbnail.size;
    return el("img", { src: thumbnail.picture, alt: name, width, height, loading: "lazy", decoding: "async" });
}

function button(sheet, cell, thumbnail, open) {
    const name = [sheet.rows[cell.row].label, sheet.columns[cell.column].label].join(" on ");
    const figures = cell.figures.map(([figure, value]) => `\n${figure}: ${value}`).join("");
    const made = el("button", { type: "button", "aria-label": name, title: cell.message ?? name + figures });
    made.append(picture(thumbnail, name), el("span", { class: "name" }, sheet.columns[cell.column].label));
    if (cell.caption) made.append(el("span", { class: "caption" }, cell.caption));
    made.addEventListener("click", () => open(cell));
    return made;
}

/** A section a row; its cells are as wide as the pictures, so that all are of one height. */
function grid(sheet, thumbnails, open) {
    const key = ({ column, row }) => `${column} ${row}`;
    const pictures = new Map(thumbnails.map((thumbnail) => [key(thumbnail), thumbnail]));
    const widths = sheet.columns.map((_, column) => thumbnails.find((t) => t.column === column)?.size[0] ?? 100);
    const tracks = widths.map((width) => `minmax(0, ${width}fr)`).join(" ");
    const buttons = new Map();
    const heads = sheet.columns.map(({ label, note }) => {
        return el("div", { class: "column" }, el("strong", {}, label), note ? el("span", {}, note) : "");
    });
    const head = el("div", { class: "row head", "aria-hidden": "true" }, el("h2", {}), el("div", { class: "cells" }, ...heads));
    const rows = sheet.rows.map(({ label, note }, row) => {
        const cells = sheet.columns.map((_, column) => {
            const cell = sheet.cells.find((c) => c.row === row && c.column === column);
            if (!cell) return el("div", { class: "gap" });
            const made = button(sheet, cell, pictures.get(key(cell)), open);
            buttons.set(cell, made);
            return made;
        });
        const title = el("h2", {}, label, note ? el("small", {}, note) : "");
        return el("section", { class: "row", "aria-label": label }, title, el("div", { class: "cells" }, ...cells));
    });
    const made = el("div", { class: "grid" }, head, ...rows);
    made.style.setProperty("--tracks", tracks);
    return { grid: made, buttons };
}

function start() {
    const sheet = readHeader();
    const viewer = new Viewer(sheet, {
        opened: (cell) => history.replaceState(null, "", address(sheet, cell)),
        closed: (cell) => {
            history.replaceState(null, "", "#");
            buttons.get(cell)?.focus();
        },
    });
    const { grid: made, buttons } = grid(sheet, readThumbnails(), (cell) => viewer.open(cell));
    const help = "Click a picture to turn it.";
    document.querySelector("main").append(
        el("header", {}, el("h1", {}, sheet.title), el("p", {}, `${sheet.subtitle} ${help}`)),
        made,
        viewer.element,
    );
    const follow = () => {
        const cell = sheet.cells.find((c) => address(sheet, c) === decodeURIComponent(location.hash));
        if (cell) viewer.open(cell);
    };
    addEventListener("hashchange", follow);
    follow();
}

start();
