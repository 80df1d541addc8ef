// Builds the site: `node build.mjs ROOT OUT BASE`, in a copy of `docs/site` where its packages are
// installed. `cargo xtask site` has built what the site takes from elsewhere.
//
//   docs, README of packages ─▶ manual.mjs ─┐
//   include/muslin.h ─────────▶ header.mjs ─┤
//   dist/js/*.d.ts ───────────▶ types.mjs ──┼▶ VitePress ─▶ OUT ─▶ policy.mjs
//   docs/manual/performance.md ▶ charts.mjs ┘               ▲
//   play/* ───────────────────▶ play.mjs ───────────────────┤
//   dist/web, target/doc ───────────────────────────────────┘

import { cp, writeFile } from "node:fs/promises";
import { dirname, join, resolve } from "node:path";
import { fileURLToPath } from "node:url";
import { build } from "vitepress";
import { writeCharts } from "./charts.mjs";
import { writeHeaderPages } from "./header.mjs";
import { writeManualPages } from "./manual.mjs";
import { buildPlayground } from "./play.mjs";
import { addPolicies } from "./policy.mjs";
import { copyRustReference } from "./rust.mjs";
import { writeTypePages } from "./types.mjs";

const [root, out, base, rustdoc] = process.argv.slice(2);
const work = resolve(dirname(fileURLToPath(import.meta.url)), "..");

const manual = await writeManualPages(root, work);
const c = await writeHeaderPages(root, work);
const js = await writeTypePages(join(root, "dist/js"), work);
await writeCharts(root, work);
// The configuration and the theme read these.
await writeFile(join(work, "generated.json"), JSON.stringify({ root, base, sidebars: { manual, c, js } }));

await build(work, { outDir: out, base });
await buildPlayground(work, join(out, "play"));
// Without the gzip files of the pages, which change here.
const isPlain = (file) => !file.endsWith(".gz");
await cp(join(root, "dist/web"), join(out, "demo"), { recursive: true, filter: isPlain });
await copyRustReference(rustdoc, join(out, "api/rust"));
await addPolicies(out);
console.log(`the site is in ${out}`);
