// Bundles the page: node bundle.mjs PAGE_FOLDER NPM_FOLDER OUTPUT_FOLDER -> OUTPUT_FOLDER/report.js and report.css
import { createRequire } from "node:module";
import path from "node:path";

const [page, npm, output] = process.argv.slice(2).map((folder) => path.resolve(folder));
const esbuild = createRequire(path.join(npm, "package.json"))("esbuild");

await esbuild.build({
  entryPoints: { report: path.join(page, "main.js") },
  outdir: output,
  bundle: true,
  minify: true,
  format: "iife",
  platform: "browser",
  target: "es2020",
  charset: "ascii", // the page may be served or opened with any guess of its encoding
  legalComments: "inline", // Plotly's licence stays in the report
  nodePaths: [path.join(npm, "node_modules")],
  logLevel: "warning",
});
