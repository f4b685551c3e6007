// Draws a sheet: node render.mjs SHEET.json OUT.png [--page PAGE.html] [--scale N]
//
// `--page` also writes a page that opens without a server. `--scale` is the number of pixels that one of the sheet's takes.

import { readFile, writeFile } from "node:fs/promises";
import { parseArgs } from "node:util";
import { withBrowser } from "./lib/browser.mjs";
import { documentOf } from "./lib/document.mjs";

const USAGE = "usage: node render.mjs SHEET.json OUT.png [--page PAGE.html] [--scale N]";

async function main() {
    const { values, positionals } = parseArgs({
        allowPositionals: true,
        options: { page: { type: "string" }, scale: { type: "string", default: "1" } },
    });
    const scale = Number(values.scale);
    if (positionals.length !== 2 || !(scale > 0 && scale <= 4)) throw new Error(USAGE);
    const [input, output] = positionals;
    const sheet = JSON.parse(await readFile(input, "utf8"));
    const data = await readFile(input.replace(/\.json$/, "") + ".bin");
    const thumbnails = await picture(await documentOf("sheet", { sheet, data }), output, scale);
    if (values.page) {
        const page = await documentOf("page", { sheet, data, thumbnails });
        await writeFile(values.page, page);
        console.log(`${values.page}: ${(page.length / 1e6).toFixed(1)} MB`);
    }
}

/** Opens the document of a sheet, writes what it shows and returns the picture of each cell. */
async function picture(html, output, scale) {
    return withBrowser(html, { width: 1200, height: 800, scale }, async (page) => {
        const count = await page.evaluate(() => window.sheet.count);
        for (let cell = 0; cell < count; cell++) {
            await page.evaluate((index) => window.sheet.draw(index), cell);
            if (process.stderr.isTTY) process.stderr.write(`\r${output}: ${cell + 1} of ${count} pictures`);
        }
        if (process.stderr.isTTY) process.stderr.write("\n");
        await page.locator("main").screenshot({ path: output });
        console.log(`${output}: ${count} pictures`);
        return page.evaluate(() => window.sheet.thumbnails());
    });
}

main().catch((error) => {
    console.error(`render: ${error.message}`);
    process.exitCode = 1;
});
