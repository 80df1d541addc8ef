// What the types say is the same however they are found.

import init, { Cloth, version } from "muslin";
import { Pointers } from "muslin/pointers";
import initInline from "muslin/inline";
import initNoWasm, { Cloth as SameCloth } from "muslin/no-wasm";

await init();
await initInline();
await initNoWasm();
const cloth: Cloth = SameCloth.grid({ columns: 8, rows: 8, material: "silk", pinMode: "corners" });
const pointers = new Pointers(cloth, { radius: 0.1 });
const took: boolean = pointers.press("mouse", [0, 0, 1], [0, 0, -1]);
const heights: Float32Array = cloth.positions;
// @ts-expect-error a pin mode that is none
Cloth.grid({ pinMode: "bottom" });
export const told: string = `${version()} ${took} ${heights.length}`;
