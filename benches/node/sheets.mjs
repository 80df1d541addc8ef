// The sheets that are measured: the hanging sheet of demo/scenes, and the plain one beside it.

import { readFile } from "node:fs/promises";
import { Cloth } from "../../dist/js/index.js";

const SIZE = 2;

/** The descriptor of the scene's sheet with so many particles across. */
export function hangingSheet(columns, rows, pinMode) {
  const half = SIZE / 2;
  return { columns, rows, spacing: SIZE / (columns - 1), origin: [-half, half, 0], pinMode };
}

/** The scene's wind at 2 m/s. */
export function wind() {
  const speed = 2 / Math.hypot(0.15, 1);
  const velocity = [0.15 * speed, 0, speed];
  return { velocity, gust: 0.6, wander: 0.5, turbulence: 0.25, seed: 1 };
}

/** The sheet as a grid. */
export function grid(desc) {
  return Cloth.grid(desc);
}

/** The same sheet as a mesh of the same triangles. */
export function mesh({ material, settings }, like) {
  const { positions, indices, pinned } = like;
  return Cloth.mesh({ positions, indices, pinned, material, settings });
}

/** Reads the module of the plain loop; gives what makes sheets, each in an instance of its own. */
export async function plainSheets(file) {
  const module = await WebAssembly.compile(await readFile(file));
  return ({ columns, rows, spacing, pinMode }, isByKind = false) => {
    const sheet = new WebAssembly.Instance(module).exports;
    sheet.hang(columns, rows, spacing, pinMode === "top-corners", isByKind);
    return sheet;
  };
}
