// Takes the reference that rustdoc wrote into the site.

import { cp, readFile, writeFile } from "node:fs/promises";
import { filesIn } from "./files.mjs";

/** A script of rustdoc that loads fonts early, but in a mode in which browsers cannot use them and say so. */
const PRELOAD = /<script>if\(window\.location\.protocol.*?<\/script>/s;

/** Copies the pages. */
export async function copyRustReference(from, to) {
  await cp(from, to, { recursive: true });
  for (const path of (await filesIn(to)).filter((file) => file.endsWith(".html"))) {
    await writeFile(path, (await readFile(path, "utf8")).replace(PRELOAD, ""));
  }
}
