// Runs one build of the package: `node build.mjs SPECIFIER [no-simd|no-wasm]` prints, as JSON, the
// state hashes of the script and of a small cloth, the sizes of the modules that were compiled, and
// whether views and restore work. The second word makes this engine one without SIMD, or without
// WebAssembly.

import { limitEngine } from "./engine.mjs";
import { hexOf, playScript } from "./script.mjs";

const [specifier, ...missing] = process.argv.slice(2);
const compiled = limitEngine(missing);

const { default: init, Cloth } = await import(specifier);
await init();
const script = playScript(Cloth);
const hash = hexOf(script.stateHash());
script.free();

const cloth = Cloth.grid({ columns: 16, rows: 16, settings: { tearing: true }, material: "silk" });
cloth.wind = { velocity: [0.25, 0, 3], gust: 0.5, turbulence: 0.25, seed: 3 };
cloth.addCollider({ shape: "sphere", position: [0.4, -0.4, 0.1], radius: 0.2 });
cloth.step(20);
cloth.tearEdge(100, 116);
cloth.cut([-1, -0.4, -9], [0.3, -0.5, -9], [0, 0, 18]);
cloth.step(20);
const small = hexOf(cloth.stateHash());
const [x, y, z] = cloth.positions;

// The memory grows and moves; views that are read afterwards have the same contents.
const others = Array.from({ length: 4 }, () => Cloth.grid({ columns: 64, rows: 64 }));
const { positions } = cloth;
const isUnchanged = positions[0] === x && positions[1] === y && positions[2] === z;
const back = Cloth.restore(cloth.save());
const isRestored = back.stateHash() === cloth.stateHash();
for (const one of [...others, back, cloth]) one.free();

let refusal = "none";
try {
  Cloth.grid({ columns: 1 });
} catch (error) {
  refusal = error.message;
}
console.log(JSON.stringify({ hash, small, compiled, isUnchanged, isRestored, refusal }));
