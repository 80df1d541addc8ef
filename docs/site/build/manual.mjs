// Takes the documents of the repository into the site: their text as it is, their links changed to
// the addresses of the site. A source file that a document names gets a page that shows it.

import { copyFile, readFile, readdir, stat } from "node:fs/promises";
import { dirname, extname, join, normalize } from "node:path";
import { writePage } from "./files.mjs";

const MANUAL = "docs/manual";

/** Documents that are not in the folder of the manual: each with its page. */
const MORE = {
  "docs/glossary.md": "manual/glossary.md",
  "docs/architecture.md": "manual/architecture.md",
  "bindings/c/README.md": "manual/c-library.md",
  "bindings/js/package/README.md": "manual/npm-package.md",
  "CHANGELOG.md": "changelog.md",
};

/** Titles in the sidebar, where that of the document says too little there. */
const TITLES = { "manual/npm-package.md": "The npm package", "manual/c-library.md": "The C library" };

/** Source files that pages of this site name themselves. */
const SOURCES = ["include/muslin.h", "include/muslin.hpp"];

/** The language of a block of code, by the end of the file's name. */
const LANGUAGES = {
  ".rs": "rust", ".c": "c", ".h": "c", ".hpp": "cpp", ".cpp": "cpp", ".cs": "csharp", ".py": "python", ".js": "js", ".mjs": "js",
  ".toml": "toml", ".html": "html", ".css": "css", ".json": "json", ".md": "md", ".txt": "txt", ".cmake": "cmake",
  ".gd": "gdscript",
};

/** The start of a link up to the place in its page. */
const LINK = /\]\(([^)#\s]+)/g;

/** Writes the pages into `work`, and returns the entries of the manual's sidebar. */
export async function writeManualPages(root, work) {
  const pages = new Map(Object.entries(MORE));
  for (const file of await readdir(join(root, MANUAL))) {
    if (file.endsWith(".md")) pages.set(`${MANUAL}/${file}`, `manual/${file === "README.md" ? "index.md" : file}`);
  }
  const sources = new Set(SOURCES);
  const titles = new Map();
  for (const [document, page] of pages) {
    const text = await readFile(join(root, document), "utf8");
    titles.set(page, TITLES[page] ?? text.match(/^# (.*)$/m)[1].replaceAll("`", ""));
    await writePage(join(work, page), withoutHiddenLines(await withLinks(text, document, { root, pages, sources })));
  }
  for (const picture of await readdir(join(root, MANUAL, "pictures"))) {
    await writePage(join(work, "manual/pictures", picture), "");
    await copyFile(join(root, MANUAL, "pictures", picture), join(work, "manual/pictures", picture));
  }
  for (const source of sources) await writeSourcePage(root, work, source);
  return sidebar(await readFile(join(root, MANUAL, "README.md"), "utf8"), titles);
}

/** The pages of the manual in the order of the table on its first page, then the others. */
function sidebar(contents, titles) {
  const order = [...contents.matchAll(/^\| \[[^\]]*\]\(([\w-]+\.md)\)/gm)].map(([, file]) => `manual/${file}`);
  const entry = (page) => ({ text: titles.get(page), link: `/${page.replace(/(index)?\.md$/, "")}` });
  const missing = order.filter((page) => !titles.has(page));
  if (order.length === 0 || missing.length > 0) throw new Error(`docs/manual/README.md lists no page, or lacks ${missing}`);
  const rest = [...titles.keys()].filter((page) => page !== "manual/index.md" && !order.includes(page));
  return [
    { text: "Manual", items: [{ text: "Overview", link: "/manual/" }, ...order.map(entry)] },
    { text: "Reference", items: rest.map(entry) },
  ];
}

/** The text with the targets of its links changed; adds the source files that it names. */
async function withLinks(text, document, { root, pages, sources }) {
  const parts = text.split(/(^```[^]*?^```$)/m);
  for (const [at, part] of parts.entries()) {
    if (part.startsWith("```")) continue;
    const links = new Map();
    for (const [, target] of part.matchAll(LINK)) {
      if (/^\w+:/.test(target) || target.startsWith("pictures/")) continue;
      const path = normalize(join(dirname(document), target)).replace(/\/$/, "");
      if (!pages.has(path)) {
        await stat(join(root, path)).catch(() => {
          throw new Error(`${document} links to ${target}, which does not exist`);
        });
        sources.add(path);
      }
      links.set(target, `/${pages.get(path) ?? `source/${path}.md`}`);
    }
    parts[at] = part.replace(LINK, (whole, target) => (links.has(target) ? `](${links.get(target)}` : whole));
  }
  return parts.join("");
}

/** The text without the lines of Rust blocks that only make them compile. */
function withoutHiddenLines(text) {
  return text.replace(/^```rust[^]*?^```$/gm, (block) => block.replace(/^# .*\n/gm, ""));
}

/** Writes a page that shows a source file, or all files that are directly in a folder. */
async function writeSourcePage(root, work, source) {
  const isFolder = (await stat(join(root, source))).isDirectory();
  const files = isFolder ? await textFilesIn(root, source) : [source];
  // The search finds documents; the code would bury them.
  const lines = ["---", "search: false", "outline: 2", "---", "", `# ${source}`, ""];
  for (const file of files) {
    const text = await readFile(join(root, file), "utf8");
    if (isFolder) lines.push(`## ${file.slice(source.length + 1)}`, "");
    const fence = "`".repeat(Math.max(3, ...[...text.matchAll(/`+/g)].map(([ticks]) => ticks.length + 1)));
    lines.push(`${fence}${LANGUAGES[extname(file)] ?? "txt"}:line-numbers`, text.trimEnd(), fence, "");
  }
  await writePage(join(work, `source/${source}.md`), lines.join("\n"));
}

async function textFilesIn(root, folder) {
  const entries = await readdir(join(root, folder), { withFileTypes: true, recursive: true });
  const files = entries.filter((entry) => entry.isFile() && extname(entry.name) in LANGUAGES);
  const paths = files.map((entry) => `${entry.parentPath ?? entry.path}/${entry.name}`.slice(root.length + 1));
  return paths.filter((path) => !/node_modules|target\//.test(path)).sort();
}
