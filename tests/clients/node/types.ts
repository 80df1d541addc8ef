// Type-checked with the module resolution of bundlers.

import init, { Cloth, version } from "muslin";
import { Pointers } from "muslin/pointers";
import initInline from "muslin/inline";
import initNoWasm, { Cloth as SameCloth } from "muslin/no-wasm";

await init();
await initInline();
await initNoWasm();
const cloth: Cloth = SameCloth.grid({ columns: 8, rows: 8, material: "silk", pinMode: "corners" });
const pointers = new Pointers(cloth, { radius: 0.1 });
const isHeld: boolean = pointers.press("mouse", [0, 0, 1], [0, 0, -1]);
const positions: Float32Array = cloth.positions;
// @ts-expect-error: no such pin mode
Cloth.grid({ pinMode: "bottom" });
export const summary: string = `${version()} ${isHeld} ${positions.length}`;
