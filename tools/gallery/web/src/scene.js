// A picture that is turned by hand.

import * as THREE from "three";
import { OrbitControls } from "three/addons/controls/OrbitControls.js";
import { SLOPE, camera, extent, pointAt } from "./framing.js";
import { cellObject, dispose } from "./layers.js";
import { Studio } from "./studio.js";

export class Scene {
    /** Fills `element`, and stays as large as it is. */
    constructor(element) {
        this.element = element;
        this.studio = new Studio();
        this.object = new THREE.Group();
        element.append(this.studio.canvas);
        new ResizeObserver(() => this.resize()).observe(element);
    }

    /** Shows cells side by side; `fresh` moves the camera so that all is seen, else it stays where it is. */
    show(sheet, cells, options, fresh) {
        dispose(this.object);
        this.object = new THREE.Group();
        const { view } = sheet;
        const shown = cells.map((cell) => ({ cell, box: extent(sheet.points(cell), view) }));
        const widths = shown.map(({ box }) => box.high[0] - box.low[0]);
        const space = 0.12 * Math.max(...widths);
        const width = widths.reduce((sum, own) => sum + own, space * (widths.length - 1));
        const depth = Math.max(...shown.map(({ box }) => box.high[2] - box.low[2]));
        const height = Math.max(...shown.map(({ box }) => box.high[1] - box.low[1]));
        let left = -width / 2;
        shown.forEach(({ cell, box }, k) => {
            const own = cellObject(sheet, cell, options);
            const middle = [left + widths[k] / 2, 0, 0];
            const now = [(box.low[0] + box.high[0]) / 2, 0, (box.low[2] + box.high[2]) / 2];
            const shift = pointAt(view, [0, 1, 2].map((axis) => middle[axis] - now[axis]));
            // On one ground.
            own.position.set(shift.x, shift.y, -box.ground);
            this.object.add(own);
            left += widths[k] + space;
        });
        this.frame = { view, width, height, centre: new THREE.Vector3(0, 0, this.middle(sheet, shown)) };
        this.studio.light(this.frame.centre, 0.5 * Math.hypot(width, height, depth), 0, view.azimuth);
        const beside = shown.length > 1;
        if (fresh || beside !== this.beside || !this.camera) this.look();
        this.beside = beside;
        this.resize();
    }

    /** Half the height of the tallest, above the ground. */
    middle(sheet, shown) {
        const tops = shown.map(({ cell, box }) => {
            let top = -Infinity;
            for (const points of sheet.points(cell)) {
                for (let i = 2; i < points.length; i += 3) top = Math.max(top, points[i]);
            }
            return top - box.ground;
        });
        const top = Math.max(...tops);
        return Number.isFinite(top) ? top / 2 : 0;
    }

    /** Forgets how it was turned. */
    reset() {
        this.controls?.dispose();
        this.controls = this.camera = null;
    }

    /** The camera near enough to fill the place: turned as it was, at first as in the sheet. */
    look() {
        const { view, width, height, centre } = this.frame;
        const aspect = this.aspect();
        const metres = 1.16 * Math.max(height, width / aspect);
        const turned = this.controls && this.camera.position.clone().sub(this.controls.target).normalize();
        this.camera = camera(view, centre, metres, aspect);
        if (turned) this.camera.position.copy(centre).addScaledVector(turned, metres / SLOPE);
        const distance = this.camera.position.distanceTo(centre);
        [this.camera.near, this.camera.far] = [0.05 * distance, 6 * distance];
        this.controls?.dispose();
        this.controls = new OrbitControls(this.camera, this.studio.canvas);
        this.controls.target.copy(centre);
        this.controls.enableDamping = true;
        this.controls.dampingFactor = 0.12;
        [this.controls.minDistance, this.controls.maxDistance] = [0.12 * distance, 3 * distance];
        // Not from below the ground.
        this.controls.maxPolarAngle = 0.53 * Math.PI;
        this.controls.addEventListener("change", () => this.draw());
        this.controls.update();
    }

    aspect() {
        return Math.max(this.element.clientWidth, 1) / Math.max(this.element.clientHeight, 1);
    }

    resize() {
        if (!this.camera) return;
        this.camera.aspect = this.aspect();
        this.camera.updateProjectionMatrix();
        this.draw();
    }

    /** Draws once, as soon as the browser does; while the camera still moves, again. */
    draw() {
        if (this.waiting) return;
        this.waiting = requestAnimationFrame(() => {
            this.waiting = 0;
            const { clientWidth, clientHeight } = this.element;
            if (!this.camera || clientWidth === 0 || clientHeight === 0) return;
            this.studio.draw(this.object, this.camera, clientWidth, clientHeight, Math.min(devicePixelRatio, 2));
            this.controls.update();
        });
    }
}
