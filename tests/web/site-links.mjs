// The links of a built site, read from its files.

import { readFile, readdir } from "node:fs/promises";
import { dirname, join, relative } from "node:path";

/** The paths of all pages below `dir`, relative to it. */
export async function pagesIn(dir) {
  const files = await readdir(dir, { recursive: true });
  return files.filter((file) => file.endsWith(".html")).sort();
}

/**
 * Returns the links that lead nowhere, as text: to a file that the site lacks, or to a place that
 * its page lacks. The pages of rustdoc make some places by script, so only their files count.
 */
export async function brokenLinks(dir) {
  const files = new Set(await readdir(dir, { recursive: true }));
  const texts = new Map();
  for (const page of await pagesIn(dir)) texts.set(page, await readFile(join(dir, page), "utf8"));
  const places = new Map([...texts].map(([page, text]) => [page, new Set([...text.matchAll(/\b(?:id|name)="([^"]+)"/g)].map(([, id]) => id))]));
  const broken = [];
  let count = 0;
  for (const [page, text] of texts) {
    for (const [, raw] of text.replace(/<script\b[^]*?<\/script>/g, "").matchAll(/\b(?:href|src)="([^"]*)"/g)) {
      const link = raw.replaceAll("&amp;", "&");
      if (/^[a-z]+:/.test(link)) continue;
      count++;
      const [path, place] = link.split("#");
      const from = path.startsWith("/") ? path.slice(1) : join(dirname(page), path.split("?")[0]);
      let target = decodeURIComponent(path === "" ? page : relative(".", from || "."));
      if (target === "" || (files.has(target) && !/\.\w+$/.test(target))) target = join(target, "index.html");
      if (!files.has(target)) broken.push(`${page}: ${link}`);
      else if (place && texts.has(target) && !target.startsWith("api/rust/") && !places.get(target).has(decodeURIComponent(place))) {
        broken.push(`${page}: ${link} (no such place)`);
      }
    }
  }
  return { broken, count };
}
