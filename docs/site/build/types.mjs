// Writes the reference of the npm package from its type declarations, with TypeDoc.

import { readFile, rename, writeFile } from "node:fs/promises";
import { join } from "node:path";
import { Application } from "typedoc";
import { filesIn } from "./files.mjs";

/** The modules that users import. */
const MODULES = ["index", "three", "three-with", "react", "pointers", "inline", "light", "no-wasm"];

/** How TypeScript reads them: by themselves, without the types of any other package. */
const OPTIONS = {
  target: "ES2022",
  module: "ESNext",
  moduleResolution: "Bundler",
  lib: ["ES2022", "DOM", "ESNext.Disposable"],
  types: [],
  strict: true,
};

/** Writes the pages to `api/javascript` in `work`, and returns their sidebar. */
export async function writeTypePages(types, work) {
  const out = join(work, "api/javascript");
  const entryPoints = MODULES.map((module) => join(types, `${module}.d.ts`));
  const tsconfig = join(work, "tsconfig.json");
  await writeFile(tsconfig, JSON.stringify({ compilerOptions: OPTIONS, files: entryPoints }));
  const app = await Application.bootstrapWithPlugins({
    plugin: ["typedoc-plugin-markdown", "typedoc-vitepress-theme"],
    entryPoints,
    tsconfig,
    // The types of React and of react-three-fiber, which a few declarations name, are not installed.
    skipErrorChecking: true,
    readme: "none",
    name: "The npm package",
    disableSources: true,
    excludePrivate: true,
    sort: ["source-order"],
    logLevel: "Error",
    docsRoot: work,
    hideBreadcrumbs: true,
    hidePageHeader: true,
    useCodeBlocks: true,
    parametersFormat: "table",
    expandObjects: true,
    sidebar: { autoConfiguration: true, collapsed: true },
    out,
  });
  const project = await app.convert();
  if (!project) throw new Error("TypeDoc cannot read the type declarations");
  await app.generateOutputs(project);
  if (app.logger.hasErrors()) throw new Error("TypeDoc failed");
  // TypeDoc names the main module after its file; users import it as `muslin`.
  await rename(join(out, "index"), join(out, "muslin"));
  for (const page of (await filesIn(out)).filter((path) => /\.(md|json)$/.test(path))) {
    const text = await readFile(page, "utf8");
    await writeFile(page, text.replace(/\bindex\/(?=[\w-]+\/|index\.md|")/g, "muslin/").replace(/^# index$/m, "# muslin").replace(/\[index\]/g, "[muslin]"));
  }
  const sidebar = JSON.parse(await readFile(join(out, "typedoc-sidebar.json"), "utf8"));
  // Only modules fold: an entry without a page of its own that folds is a button within a button.
  const group = ({ text, items }) => ({ text, items });
  const entry = (one) => ({ ...one, items: one.items?.map(group), text: one.text === "index" ? "muslin" : one.text.startsWith("muslin") ? one.text : `muslin/${one.text}` });
  return sidebar.map(entry);
}
