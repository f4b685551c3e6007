// HTML documents that hold all they need: program, style, fonts, meshes.

import { dirname, join } from "node:path";
import { fileURLToPath } from "node:url";
import { deflateSync } from "node:zlib";
import { build } from "esbuild";
import { shuffle } from "../src/bytes.js";

const SOURCES = join(dirname(fileURLToPath(import.meta.url)), "../src");

/** The program and the style of an entry, as text. */
async function bundle(entry) {
    const { outputFiles } = await build({
        entryPoints: [join(SOURCES, `${entry}.js`)],
        outdir: "bundle",
        write: false,
        bundle: true,
        minify: true,
        format: "iife",
        target: ["chrome111", "firefox114", "safari16.4"],
        loader: { ".woff2": "dataurl" },
        legalComments: "eof",
        charset: "utf8",
        logLevel: "error",
    });
    const text = (end) => outputFiles.find((file) => file.path.endsWith(end))?.text ?? "";
    return { script: text(".js").replaceAll("</script", "<\\/script"), style: text(".css") };
}

/** Text that may stand in a script element, whatever it holds. */
function json(value) {
    return JSON.stringify(value).replaceAll("<", "\\u003c");
}

function escape(text) {
    return text.replaceAll("&", "&amp;").replaceAll("<", "&lt;");
}

/** The document that shows `sheet` with the program `entry`. */
export async function documentOf(entry, { sheet, data, thumbnails = [] }) {
    const { script, style } = await bundle(entry);
    const packed = deflateSync(shuffle(data), { level: 9 }).toString("base64");
    return `<!doctype html>
<html lang="en">
<head>
<meta charset="utf-8">
<meta name="viewport" content="width=device-width, initial-scale=1">
<title>${escape(sheet.title)}</title>
<style>${style}</style>
</head>
<body>
<main></main>
<script type="application/json" id="sheet">${json(sheet)}</script>
<script type="application/json" id="thumbnails">${json(thumbnails)}</script>
<script type="application/octet-stream" id="data">${packed}</script>
<script>${script}</script>
</body>
</html>
`;
}
