// One cell, large: turned by hand, with its figures.

import { el } from "./elements.js";
import { legend } from "./colours.js";
import { readSheet } from "./data.js";
import { Scene } from "./scene.js";

const STEPS = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1] };
const ARROWS = [
    ["ArrowLeft", "‹", "the body before"],
    ["ArrowRight", "›", "the next body"],
    ["ArrowUp", "‹", "the garment above"],
    ["ArrowDown", "›", "the garment below"],
];

export class Viewer {
    /** `events`: `opened` and `closed`, called with the cell. */
    constructor(sheet, events) {
        this.header = sheet;
        this.events = events;
        this.cell = null;
        this.options = { body: true, skeleton: false, wireframe: false, values: false, beside: false };
        this.title = el("h2", { id: "viewer-title" });
        this.figures = el("dl", {});
        this.legend = el("div", {});
        this.message = el("p", { class: "message" });
        this.stage = el("div", { class: "stage" }, this.message);
        this.choices = this.checkboxes();
        const close = el("button", { type: "button", class: "close", "aria-label": "close", title: "Esc" }, "×");
        close.addEventListener("click", () => this.close());
        const panel = el("aside", {}, this.title, this.figures, this.choices.element, this.legend, this.hints());
        this.element = el("dialog", { "aria-labelledby": "viewer-title" }, this.stage, panel, this.arrows(), close);
        this.element.addEventListener("close", () => this.closed());
        this.element.addEventListener("keydown", (event) => {
            const step = STEPS[event.key];
            if (!step) return;
            event.preventDefault();
            this.go(step);
        });
    }

    checkboxes() {
        const element = el("fieldset", {}, el("legend", {}, "show"));
        const boxes = new Map();
        const names = { body: "body", beside: "source garment beside it", skeleton: "skeleton", wireframe: "wireframe" };
        for (const [option, name] of Object.entries({ ...names, values: "distortion" })) {
            const box = el("input", { type: "checkbox" });
            box.checked = this.options[option];
            box.addEventListener("change", () => {
                this.options[option] = box.checked;
                this.show(false);
            });
            const label = el("label", {}, box, el("span", {}, name));
            boxes.set(option, label);
            element.append(label);
        }
        return { element, boxes };
    }

    hints() {
        return el("p", { class: "hints" }, "Drag to turn, scroll or pinch to come nearer. Arrow keys go on, Esc closes.");
    }

    arrows() {
        const buttons = ARROWS.map(([key, sign, name]) => {
            const made = el("button", { type: "button", class: key, "aria-label": name, title: name }, sign);
            made.addEventListener("click", () => this.go(STEPS[key]));
            return made;
        });
        return el("nav", {}, ...buttons);
    }

    /** Opens the dialog with a cell, or goes on to it. */
    async open(cell) {
        this.cell = cell;
        if (!this.element.open) this.element.showModal();
        this.events.opened(cell);
        this.tell();
        // The meshes are unpacked when somebody wants to see one.
        this.loading ??= readSheet();
        this.sheet = await this.loading;
        try {
            this.scene ??= new Scene(this.stage);
        } catch (error) {
            this.message.textContent = `This browser cannot draw it: ${error.message}`;
            return;
        }
        this.show(true);
    }

    /** To the next cell in a direction; over the gaps of the grid. */
    go([dx, dy]) {
        const { columns, rows, cells } = this.header;
        let [column, row] = [this.cell.column + dx, this.cell.row + dy];
        while (column >= 0 && column < columns.length && row >= 0 && row < rows.length) {
            const cell = cells.find((c) => c.column === column && c.row === row);
            if (cell) return void this.open(cell);
            [column, row] = [column + dx, row + dy];
        }
    }

    /** The words about the cell. */
    tell() {
        const { rows, columns, scales } = this.header;
        const { cell } = this;
        const [row, column] = [rows[cell.row], columns[cell.column]];
        this.title.replaceChildren(el("strong", {}, row.label), " ", el("span", {}, column.label.toLowerCase()));
        const figures = cell.figures.flatMap(([name, value]) => [el("dt", {}, name), el("dd", {}, value)]);
        this.figures.replaceChildren(...figures);
        this.message.textContent = cell.message ?? "";
        const has = (test) => cell.layers.some(test);
        const values = cell.layers.map((layer) => layer.values).find(Boolean);
        const offered = {
            body: has((layer) => layer.role === "body") && has((layer) => layer.role !== "body"),
            beside: row.reference != null && row.reference !== cell.column,
            skeleton: has((layer) => layer.role === "skeleton"),
            wireframe: has((layer) => layer.role === "garment"),
            values: Boolean(values && !values.shown),
        };
        for (const [option, label] of this.choices.boxes) label.hidden = !offered[option];
        const legends = values && (values.shown || this.options.values) ? [legend(scales[values.scale])] : [];
        this.legend.replaceChildren(...legends);
    }

    /** Draws the cell; `fresh` makes all of it seen. */
    show(fresh) {
        this.tell();
        const { cell, sheet, options } = this;
        const reference = this.header.rows[cell.row].reference;
        const beside = options.beside && reference != null && reference !== cell.column;
        const cells = beside ? [sheet.cellAt(reference, cell.row), cell].filter(Boolean) : [cell];
        const bare = !cell.layers.some((layer) => layer.role === "garment");
        const roles = { body: options.body || bare, skeleton: options.skeleton };
        this.scene.show(sheet, cells, { roles, wireframe: options.wireframe, values: options.values }, fresh);
    }

    close() {
        this.element.close();
    }

    closed() {
        this.scene?.reset();
        this.events.closed(this.cell);
    }
}
