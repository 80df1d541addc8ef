// Writes the reference of the C library from `include/muslin.h`, which tree-sitter parses: one page
// for each kind of declaration, in the order of the header.

import { readFile, readdir } from "node:fs/promises";
import { createRequire } from "node:module";
import { join } from "node:path";
import { Language, Parser } from "web-tree-sitter";
import { writePage } from "./files.mjs";

const require = createRequire(import.meta.url);

/** The pages, in the order of the sidebar. */
const PAGES = [
  { name: "functions", title: "Functions" },
  { name: "structs", title: "Structs" },
  { name: "enums", title: "Statuses and callbacks" },
  { name: "constants", title: "Constants" },
];

/** Writes the pages to `api/c` in `work`, and returns the entries of their sidebar. */
export async function writeHeaderPages(root, work) {
  const text = await readFile(join(root, "include/muslin.h"), "utf8");
  const { intro, items } = await parseHeader(text);
  const groups = await groupsOf(join(root, "bindings/c/src/functions"));
  for (const item of items) item.group = item.page === "functions" ? groups.get(item.name) ?? "Initialisers" : "";
  const known = new Map();
  for (const { page, name, members } of items) {
    known.set(name, `./${page}.md#${name}`);
    for (const member of page === "enums" ? members ?? [] : []) known.set(member.name, `./${page}.md#${member.name}`);
  }
  for (const { name: page, title } of PAGES) {
    const own = items.filter((item) => item.page === page);
    if (own.length === 0) throw new Error(`include/muslin.h has no declarations for the page ${title}`);
    await writePage(join(work, "api/c", `${page}.md`), pageText(title, own, known));
  }
  await writePage(join(work, "api/c/index.md"), introText(intro, items, known));
  return [
    { text: "Overview", link: "/api/c/" },
    ...PAGES.map(({ name, title }) => ({ text: title, link: `/api/c/${name}` })),
  ];
}

/** Parses the header into its first comment and its declarations. */
async function parseHeader(text) {
  await Parser.init();
  const parser = new Parser();
  parser.setLanguage(await Language.load(require.resolve("tree-sitter-c/tree-sitter-c.wasm")));
  // `extern "C" {` and its brace are in two conditional parts, which no C parser can pair.
  const plain = text.replace(/^#ifdef __cplusplus\n[^]*?^#endif.*$/gm, (part) => part.replace(/[^\n]/g, ""));
  const tree = parser.parse(plain);
  if (tree.rootNode.hasError) throw new Error("tree-sitter cannot parse include/muslin.h");
  const items = [];
  let doc = "";
  let intro;
  for (const node of tree.rootNode.namedChildren) {
    if (node.type === "comment") {
      intro ??= commentText(node.text);
      doc = node.text.startsWith("/**") ? commentText(node.text) : "";
      continue;
    }
    const item = itemOf(node);
    if (item) items.push({ ...item, doc });
    doc = "";
  }
  return { intro, items };
}

/** The declaration of a node, unless it is an include or the like. */
function itemOf(node) {
  const code = node.text.trim();
  switch (node.type) {
    case "preproc_def":
      return { page: "constants", name: node.childForFieldName("name").text, code };
    case "type_definition": {
      const type = node.childForFieldName("type");
      const declarator = node.childForFieldName("declarator");
      const body = type.childForFieldName("body");
      if (type.type === "struct_specifier") return { page: "structs", name: declarator.text, code, members: membersOf(body) };
      if (type.type === "enum_specifier") return { page: "enums", name: declarator.text, code, members: membersOf(body) };
      return { page: "enums", name: code.match(/\(\*(\w+)\)/)[1], code };
    }
    case "declaration":
    case "function_definition": {
      const signature = node.type === "declaration" ? code : code.slice(0, code.indexOf("{")).trim() + ";";
      return { page: "functions", name: signature.match(/(\w+)\s*\(/)[1], code: signature };
    }
    default:
      return undefined;
  }
}

/** The fields of a struct or the values of an enum, each with its comment. */
function membersOf(body) {
  const members = [];
  let doc = "";
  for (const node of body?.namedChildren ?? []) {
    if (node.type === "comment") {
      doc = commentText(node.text);
      continue;
    }
    const declarator = node.childForFieldName("declarator") ?? node.childForFieldName("name");
    members.push({ name: declarator.text.replace(/^\*+|\[.*\]$/g, ""), code: node.text.replace(/;$/, ""), doc });
    doc = "";
  }
  return members;
}

/** The text of a comment without its stars. */
function commentText(comment) {
  const inner = comment.replace(/^\/\*+/, "").replace(/\*\/$/, "");
  return inner.split("\n").map((line) => line.replace(/^\s*\* ?/, "").trimEnd()).join("\n").trim();
}

/** The group of each function: the title of the source file that defines it. */
async function groupsOf(dir) {
  const groups = new Map();
  for (const file of await readdir(dir)) {
    const source = await readFile(join(dir, file), "utf8");
    const title = file.replace(/\.rs$/, "").replaceAll("_", " ");
    for (const [, name] of source.matchAll(/extern "C" fn (\w+)/g)) {
      groups.set(name, title[0].toUpperCase() + title.slice(1));
    }
  }
  if (groups.size === 0) throw new Error(`${dir} defines no functions`);
  return groups;
}

function pageText(title, items, known) {
  const lines = ["---", "outline: [2, 3]", "---", "", `# C: ${title.toLowerCase()}`, ""];
  // Functions of a group stand together, in the order in which the header first has one of them.
  for (const group of new Set(items.map((item) => item.group))) {
    if (group) lines.push(`## ${group}`, "");
    for (const item of items.filter((one) => one.group === group)) lines.push(...itemLines(item, group ? 3 : 2, known));
  }
  return lines.join("\n");
}

function itemLines({ name, code, doc, members, page }, level, known) {
  const lines = [`${"#".repeat(level)} ${name} {#${name}}`, "", docText(doc, known, name), ""];
  if (!members) return [...lines, "```c", code, "```", ""];
  if (page === "structs") lines.push("| field | type | meaning |", "| --- | --- | --- |");
  else lines.push("| value | number | meaning |", "| --- | --- | --- |");
  for (const member of members) {
    const meaning = docText(member.doc, known, name).replace(/\n\s*- /g, "<br>• ").replace(/\n+/g, " ").replaceAll("|", "\\|");
    if (page === "structs") {
      const type = member.code.replace(new RegExp(`\\b${member.name}\\b`), "").replace(/\s+/g, " ").trim();
      lines.push(`| \`${member.name}\` | ${typeText(type, known)} | ${meaning} |`);
    } else {
      const number = member.code.split("=")[1].trim();
      lines.push(`| <span id="${member.name}">\`${member.name}\`</span> | ${number} | ${meaning} |`);
    }
  }
  return [...lines, ""];
}

function introText(intro, items, known) {
  const [title, ...paragraphs] = intro.split("\n\n");
  const body = paragraphs.filter((text) => !text.startsWith("Generated from")).map((text) =>
    // The first program is indented by two spaces.
    text.split("\n").every((line) => line.startsWith("  "))
      ? ["```c", text.replace(/^ {2}/gm, ""), "```"].join("\n")
      : docText(text.replace(/^(\w+):/, "**$1.**"), known).replaceAll("\\*\\*", "**"));
  const counts = PAGES.map(({ name, title: page }) => {
    const count = items.filter((item) => item.page === name).length;
    return `| [${page}](./${name}.md) | ${count} |`;
  });
  return [
    // Before it is Rust's reference, which the links between pages cannot open.
    "---", "prev: false", "---", "", "# The C library", "", `${docText(title.replace(/^Muslin: (.)/, (_, first) => first.toUpperCase()), known)} The header is`,
    "[include/muslin.h](/source/include/muslin.h.md); C++17 has [muslin.hpp](/source/include/muslin.hpp.md) on top of it.",
    "[Integration](/manual/integration.md#c) shows how to build and link it.", "",
    ...body.flatMap((text) => [text, ""]),
    "| page | declarations |", "| --- | ---: |", ...counts, "",
  ].join("\n");
}

/** A type as code; a link if it is one of the header's own. */
function typeText(type, known) {
  const [name] = type.match(/Muslin\w+/) ?? [];
  return known.has(name) ? `[\`${type}\`](${known.get(name)})` : `\`${type}\``;
}

/** The Markdown of a comment: its names become links, and what Markdown would read as markup stays. */
function docText(doc, known, self) {
  return doc.split(/(`[^`]*`)/).map((part) => {
    if (part.startsWith("`")) return part;
    const escaped = part.replace(/[[\]<*]/g, (sign, at) =>
      sign === "<" ? "&lt;" : sign === "*" && /(^|\n)\s*$/.test(part.slice(0, at)) ? sign : `\\${sign}`);
    return escaped.replace(/\b(?:muslin_\w+|Muslin\w+|MUSLIN_\w+)\b(?:\(\))?/g, (word) => {
      const name = word.replace("()", "");
      return known.has(name) && name !== self ? `[\`${word}\`](${known.get(name)})` : `\`${word}\``;
    });
  }).join("");
}
