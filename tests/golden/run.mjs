// Runs muslin-golden in wasm and prints its output: `node run.mjs MODULE.wasm [--every-tick]`.

import { readFileSync } from 'node:fs';

const [file, option] = process.argv.slice(2);
const { instance } = await WebAssembly.instantiate(readFileSync(file), {});
const { memory, muslin_golden_report: report } = instance.exports;
const start = report(option === '--every-tick' ? 1 : 0);
const bytes = new Uint8Array(memory.buffer, start);
process.stdout.write(new TextDecoder().decode(bytes.subarray(0, bytes.indexOf(0))));
