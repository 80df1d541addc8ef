// Size budgets: what a page loads must not grow unnoticed, and no function may exceed what engines
// compile well.

import assert from "node:assert/strict";
import { readFile, readdir } from "node:fs/promises";
import { homedir } from "node:os";
import { join } from "node:path";
import { test } from "node:test";
import { fileURLToPath } from "node:url";
import { gzipSync } from "node:zlib";

const home = new URL(".", import.meta.resolve("muslin"));
const read = (name) => readFile(new URL(name, home));
const zipped = (bytes) => gzipSync(bytes, { level: 9 }).length;

/** The largest size of each file with gzip [B]. */
const MAX_SIZES = {
  "raw_bg.wasm": 428_600,
  "plain_bg.wasm": 403_200,
  "light_bg.wasm": 265_900,
  "code.js": 508_300,
};

/** The largest size of all scripts that every page loads, with gzip [B]. */
const MAX_SCRIPT_SIZE = 15_900;

/** Scripts that only some pages load. */
const OPTIONAL = /^(bytes|inline|light|no-wasm|heap|code|three|three-with|pointers|react)\.js$/;

/**
 * V8 does not optimise a JavaScript function longer than this [B], and other engines are slow to
 * compile one.
 */
const MAX_FUNCTION_SIZE = 61_440;

for (const [name, limit] of Object.entries(MAX_SIZES)) {
  test(`${name} is at most ${limit} bytes with gzip`, async () => {
    const size = zipped(await read(name));
    assert.ok(size <= limit, `${name} is ${size} bytes with gzip; the limit is ${limit}`);
  });
}

test("the modules name neither their features nor folders of the machine that built them", async () => {
  const folders = [homedir(), fileURLToPath(new URL("../..", import.meta.url))];
  for (const name of ["raw_bg.wasm", "plain_bg.wasm", "light_bg.wasm"]) {
    const bytes = await read(name);
    for (const folder of folders.map((path) => join(path, "/"))) {
      assert.ok(!bytes.includes(folder), `${name} names ${folder}`);
    }
    const sections = WebAssembly.Module.customSections(await WebAssembly.compile(bytes), "target_features");
    assert.equal(sections.length, 0, name);
  }
});

test("the scripts that every page loads stay within their budget", async () => {
  const names = (await readdir(home)).filter((name) => name.endsWith(".js") && !OPTIONAL.test(name));
  const size = zipped(Buffer.concat(await Promise.all(names.map(read))));
  assert.ok(size <= MAX_SCRIPT_SIZE, `${names.length} scripts are ${size} bytes with gzip; the limit is ${MAX_SCRIPT_SIZE}`);
});

/** Returns the sizes of all functions in the code section of a module [B]. */
function functionSizes(bytes) {
  let offset = 8;
  /** Reads an unsigned LEB128 number. */
  const number = () => {
    let value = 0;
    for (let shift = 0; ; shift += 7) {
      const byte = bytes[offset++];
      value += (byte & 127) * 2 ** shift;
      if (byte < 128) return value;
    }
  };
  while (offset < bytes.length) {
    const isCode = bytes[offset++] === 10;
    const end = number() + offset;
    if (isCode) {
      return Array.from({ length: number() }, () => {
        const length = number();
        offset += length;
        return length;
      });
    }
    offset = end;
  }
  return [];
}

for (const name of ["raw_bg.wasm", "plain_bg.wasm", "light_bg.wasm"]) {
  test(`no function of ${name} is too long for engines to optimise`, async () => {
    const lengths = functionSizes(await read(name));
    assert.ok(lengths.length > 300, `only ${lengths.length} functions were found`);
    const longest = Math.max(...lengths);
    assert.ok(longest < MAX_FUNCTION_SIZE, `one of ${lengths.length} functions has ${longest} bytes`);
  });
}

test("loops are compiled to SIMD", async () => {
  // Counts f32x4.mul. More than a third of them come from plain loops that the compiler vectorised;
  // flags that optimise for size can turn that off silently.
  const F32X4_MUL = Buffer.from([0xfd, 0xe6, 0x01]);
  const bytes = await read("raw_bg.wasm");
  let count = 0;
  for (let at = bytes.indexOf(F32X4_MUL); at >= 0; at = bytes.indexOf(F32X4_MUL, at + 3)) count += 1;
  assert.ok(count > 2000, `only ${count} f32x4.mul instructions`);
});
