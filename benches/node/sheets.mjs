// The sheets that are measured: the hanging sheet of demo/scenes, and the plain one beside it.

import { readFile } from "node:fs/promises";
import { Cloth } from "../../dist/js/index.js";

const SIZE = 2;

/** The descriptor of the scene's sheet with so many particles across. */
export function hangingSheet(columns, rows, pinMode) {
  const half = SIZE / 2;
  return { columns, rows, spacing: SIZE / (columns - 1), origin: [-half, half, 0], pinMode };
}

/** The scene's wind at 2 m/s, to the bit: so the cloth ends up as it does natively. */
const WIND = { velocity: [0.29668093, 0, 1.9778727], gust: 0.6, wander: 0.5, turbulence: 0.25, seed: 1 };

/** The sheet as a grid. */
export function grid(desc, isWindy) {
  const cloth = Cloth.grid(desc);
  if (isWindy) cloth.wind = WIND;
  return cloth;
}

/** The same sheet as a mesh of the same triangles, in the same air. */
export function mesh({ material, settings }, like) {
  const { positions, indices, pinned, wind } = like;
  // In another order, or it would be found to be the grid.
  const turned = [...indices.subarray(3), ...indices.subarray(0, 3)];
  const cloth = Cloth.mesh({ positions, indices: turned, pinned, material, settings });
  cloth.wind = wind;
  return cloth;
}

/** Reads the module of the plain loop; gives what makes sheets, each in an instance of its own. */
export async function plainSheets(file) {
  // At once: what awaits node 20's compiler may wait for ever, when V8 must collect garbage just then.
  const module = new WebAssembly.Module(await readFile(file));
  return ({ columns, rows, spacing, pinMode }, isByKind = false) => {
    const sheet = new WebAssembly.Instance(module).exports;
    sheet.hang(columns, rows, spacing, pinMode === "top-corners", isByKind);
    return sheet;
  };
}
