// One build of the package in an engine: `node build.mjs SPECIFIER [no-wasm] [no-vectors]` prints, as JSON, the
// hash that the script ends in, the sizes of the modules that were compiled, and what became of views.

import { hexOf, playScript } from "./script.mjs";

const [specifier, ...lacks] = process.argv.slice(2);
const compiled = [];
if (lacks.includes("no-vectors")) WebAssembly.validate = () => false;
if (lacks.includes("no-wasm")) {
  delete globalThis.WebAssembly;
} else {
  const { Module } = WebAssembly;
  WebAssembly.Module = class extends Module {
    constructor(bytes) {
      super(bytes);
      compiled.push(bytes.byteLength);
    }
  };
}

const { default: init, Cloth } = await import(specifier);
await init();
const cloth = playScript(Cloth);
const hash = hexOf(cloth.stateHash());
const [x, y, z] = cloth.positions;

// Memory grows and moves; what is read then is as it was.
const others = Array.from({ length: 6 }, () => Cloth.grid({ columns: 128, rows: 128 }));
const { positions } = cloth;
const isKept = positions[0] === x && positions[1] === y && positions[2] === z;
const back = Cloth.restore(cloth.save());
const isRestored = back.stateHash() === cloth.stateHash();
for (const one of [...others, back, cloth]) one.free();

let refusal = "none";
try {
  Cloth.grid({ columns: 1 });
} catch (error) {
  refusal = error.message;
}
console.log(JSON.stringify({ hash, compiled, isKept, isRestored, refusal }));
