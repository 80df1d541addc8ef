// Takes the reference that rustdoc wrote into the site.

import { cp, readFile, writeFile } from "node:fs/promises";
import { dirname, join, relative } from "node:path";
import { filesIn } from "./files.mjs";

/** A script of rustdoc that loads fonts early, but in a mode in which browsers cannot use them and say so. */
const PRELOAD = /<script>if\(window\.location\.protocol.*?<\/script>/s;

/** Leads to the only crate. */
const START = `<!doctype html>
<html lang="en">
<head>
<meta charset="utf-8">
<title>muslin</title>
<meta http-equiv="refresh" content="0; url=muslin/index.html">
</head>
<body><p><a href="muslin/index.html">The crate muslin</a></p></body>
</html>
`;

/** Copies the pages. */
export async function copyRustReference(from, to) {
  await cp(from, to, { recursive: true });
  // Some of them lead to the folder itself.
  await writeFile(join(to, "index.html"), START);
  for (const path of (await filesIn(to)).filter((file) => file.endsWith(".html"))) {
    const home = relative(dirname(path), join(to, "../../index.html"));
    const page = (await readFile(path, "utf8")).replace(PRELOAD, "");
    await writeFile(path, page.replace('<nav class="sidebar">', (sidebar) => `${sidebar}<p style="margin: 16px 24px 0"><a href="${home}">Muslin’s site</a></p>`));
  }
}
