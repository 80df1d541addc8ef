// What a page loads does not grow unnoticed, and no function grows beyond what engines compile well.

import assert from "node:assert/strict";
import { readFile, readdir } from "node:fs/promises";
import { test } from "node:test";
import { gzipSync } from "node:zlib";

const home = new URL(".", import.meta.resolve("muslin"));
const read = (name) => readFile(new URL(name, home));
const zipped = (bytes) => gzipSync(bytes, { level: 9 }).length;

/** What parts of the package weigh with gzip at most [B]. */
const MOST = { "raw_bg.wasm": 391_000, "plain_bg.wasm": 362_000, "code.js": 443_000 };

/** The same of the scripts that every page loads. */
const MOST_SCRIPTS = 14_600;

/** Scripts that only some pages load. */
const EXTRA = /^(bytes|inline|no-wasm|heap|code|three|three-with|pointers)\.js$/;

/** V8 leaves a function of JavaScript as it is that is longer than this [B], and others take long over one. */
const LONGEST = 61_440;

for (const [name, most] of Object.entries(MOST)) {
  test(`${name} takes at most ${most} bytes of a page's way`, async () => {
    const size = zipped(await read(name));
    assert.ok(size <= most, `${name} takes ${size} bytes with gzip, but ${most} are meant`);
  });
}

test("the scripts of a page take no more than they did", async () => {
  const names = (await readdir(home)).filter((name) => name.endsWith(".js") && !EXTRA.test(name));
  const size = zipped(Buffer.concat(await Promise.all(names.map(read))));
  assert.ok(size <= MOST_SCRIPTS, `${names.length} scripts take ${size} bytes with gzip, but ${MOST_SCRIPTS} are meant`);
});

/** The lengths of a module's functions [B]. */
function functionsOf(bytes) {
  let at = 8;
  const number = () => {
    let value = 0;
    for (let shift = 0; ; shift += 7) {
      const byte = bytes[at++];
      value += (byte & 127) * 2 ** shift;
      if (byte < 128) return value;
    }
  };
  while (at < bytes.length) {
    const isCode = bytes[at++] === 10;
    const end = number() + at;
    if (isCode) {
      return Array.from({ length: number() }, () => {
        const length = number();
        at += length;
        return length;
      });
    }
    at = end;
  }
  return [];
}

for (const name of ["raw_bg.wasm", "plain_bg.wasm"]) {
  test(`no function of ${name} is too long to be compiled well`, async () => {
    const lengths = functionsOf(await read(name));
    assert.ok(lengths.length > 300, `only ${lengths.length} functions were found`);
    const longest = Math.max(...lengths);
    assert.ok(longest < LONGEST, `one of ${lengths.length} functions takes ${longest} bytes`);
  });
}

test("loops have become vectors", async () => {
  // f32x4.mul. What compilers make of plain loops is a good third of them, and flags that are meant for size can keep
  // them from it unseen.
  const PRODUCT = Buffer.from([0xfd, 0xe6, 0x01]);
  const bytes = await read("raw_bg.wasm");
  let count = 0;
  for (let at = bytes.indexOf(PRODUCT); at >= 0; at = bytes.indexOf(PRODUCT, at + 3)) count += 1;
  assert.ok(count > 2000, `only ${count} products of four numbers at once`);
});
