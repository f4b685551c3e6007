// A headless Chromium that draws in software.

import { access, mkdtemp, rm, writeFile } from "node:fs/promises";
import { tmpdir } from "node:os";
import { delimiter, join } from "node:path";
import { pathToFileURL } from "node:url";
import { chromium } from "playwright-core";

const NAMES = ["chromium", "chromium-browser", "google-chrome"];

const FLAGS = [
    "--use-angle=swiftshader",
    "--enable-unsafe-swiftshader",
    "--ignore-gpu-blocklist",
    "--disable-quic",
    "--no-first-run",
    "--disable-background-networking",
    "--disable-component-update",
    "--disable-sync",
    "--disable-dev-shm-usage",
];

async function executable() {
    const folders = (process.env.PATH ?? "").split(delimiter);
    const places = NAMES.flatMap((name) => folders.map((folder) => join(folder, name)));
    for (const path of [process.env.CHROMIUM, ...places]) {
        if (path && (await access(path).then(() => true, () => false))) return path;
    }
    throw new Error("there is no Chromium; install it (Debian: apt-get install chromium) or set CHROMIUM to its path");
}

/**
 * Opens `html` from a file, waits for its promise `window.ready` and calls `use` with the page. What goes wrong in the page
 * is an error here.
 */
export async function withBrowser(html, { width, height, scale }, use) {
    const folder = await mkdtemp(join(tmpdir(), "sheet-"));
    const browser = await chromium.launch({ executablePath: await executable(), args: FLAGS, chromiumSandbox: false });
    try {
        const file = join(folder, "page.html");
        await writeFile(file, html);
        const page = await browser.newPage({ viewport: { width, height }, deviceScaleFactor: scale });
        page.setDefaultTimeout(300_000);
        const failed = new Promise((_, reject) => page.on("pageerror", reject));
        const used = async () => {
            await page.goto(pathToFileURL(file).href);
            await page.evaluate(() => window.ready);
            return use(page);
        };
        return await Promise.race([used(), failed]);
    } finally {
        await browser.close();
        await rm(folder, { recursive: true, force: true });
    }
}
