// The sheets that are measured: the hanging sheet of demo/scenes, and the plain reference sheet.

import { readFile } from "node:fs/promises";
import { Cloth } from "../../dist/js/index.js";

/** Width of the sheet [m]. */
const SIZE = 2;

/** Returns the descriptor of the hanging sheet. */
export function hangingSheet(columns, rows, pinMode) {
  const half = SIZE / 2;
  return { columns, rows, spacing: SIZE / (columns - 1), origin: [-half, half, 0], pinMode };
}

/**
 * The wind of the scene at 2 m/s with the same bits as in Rust, so that the cloth moves as it does
 * natively.
 */
const WIND = { velocity: [0.29668093, 0, 1.9778727], gust: 0.6, wander: 0.5, turbulence: 0.25, seed: 1 };

/** Creates the sheet as a grid. */
export function createGrid(desc, isWindy) {
  const cloth = Cloth.grid(desc);
  if (isWindy) cloth.wind = WIND;
  return cloth;
}

/** Creates a mesh with the triangles, pins and wind of `grid`. */
export function createMesh({ material, settings }, grid) {
  const { positions, indices, pinned, wind } = grid;
  // In another order: otherwise the mesh would be recognised as the grid.
  const rotated = [...indices.subarray(3), ...indices.subarray(0, 3)];
  const cloth = Cloth.mesh({ positions, indices: rotated, pinned, material, settings });
  cloth.wind = wind;
  return cloth;
}

/**
 * Loads the module of the plain loop. Returns a function that creates a sheet in a new instance.
 */
export async function loadPlainSheets(file) {
  // Compiled synchronously: in Node 20, WebAssembly.compile() may never settle if V8 collects
  // garbage meanwhile.
  const module = new WebAssembly.Module(await readFile(file));
  return ({ columns, rows, spacing, pinMode }, isByKind = false) => {
    const sheet = new WebAssembly.Instance(module).exports;
    sheet.hang(columns, rows, spacing, pinMode === "top-corners", isByKind);
    return sheet;
  };
}
