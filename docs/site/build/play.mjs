// Builds the document that runs the code of the playground: one page, one classic script. The page
// is sandboxed and so has no origin; a host would have to allow it to load modules from there, but
// a classic script needs no permission.

import { readFile } from "node:fs/promises";
import { join } from "node:path";
import { build } from "vite";
import { writePage } from "./files.mjs";
import { policyFor } from "./policy.mjs";

/** The modules that code of the playground may import; the script puts them where the page looks. */
const MODULES = ["muslin", "muslin/three", "three", "playground"];

/**
 * What the page may do: run its script, code from memory and WebAssembly; draw; nothing with the
 * network.
 */
const POLICY = {
  scripts: "blob: data: 'wasm-unsafe-eval'",
  parts: { "img-src": "data: blob:", "font-src": "'none'", "connect-src": "'none'", "worker-src": "'none'", "frame-src": "'none'", "form-action": "'none'", "base-uri": "'none'" },
};

/** Writes the page and its files into `out`. */
export async function buildPlayground(work, out) {
  await build({
    root: join(work, "play"),
    configFile: false,
    logLevel: "warn",
    // The core with its module embedded: the page may load nothing.
    resolve: { alias: [{ find: /^muslin$/, replacement: "muslin/inline" }], dedupe: ["three"] },
    build: {
      outDir: out,
      emptyOutDir: true,
      target: "es2022",
      chunkSizeWarningLimit: 4096,
      lib: { entry: "frame.js", formats: ["iife"], name: "muslinPlayground", fileName: () => "frame.js" },
    },
  });
  const imports = {};
  for (const module of MODULES) imports[module] = await moduleUrl(module, work);
  const page = await readFile(join(work, "play/frame.html"), "utf8");
  const mapped = page.replace("<!-- import map -->", () => `<script type="importmap">${JSON.stringify({ imports })}</script>`);
  if (mapped === page) throw new Error("play/frame.html has no place for the import map");
  const meta = `<meta http-equiv="Content-Security-Policy" content="${policyFor(mapped, POLICY)}">`;
  await writePage(join(out, "frame.html"), mapped.replace("<meta charset=\"utf-8\">", (charset) => charset + meta));
  await writePage(join(out, "frame.css"), await readFile(join(work, "play/frame.css"), "utf8"));
}

/** An address of a module that passes on what the script of the page has loaded. */
async function moduleUrl(module, work) {
  const file = { playground: join(work, "play/api.js"), muslin: "muslin/inline" }[module] ?? module;
  const names = Object.keys(await import(file)).filter((name) => name !== "default");
  const from = `globalThis.playgroundModules[${JSON.stringify(module)}]`;
  const text = `const m=${from};export const{${names}}=m;export default m.default`;
  return `data:text/javascript,${encodeURIComponent(text)}`;
}
