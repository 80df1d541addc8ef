// Writes the figure to a file, for other programs: node write-figure.mjs figure.glb

import { writeFileSync } from "node:fs";
import { makeFigure } from "./glb.mjs";

const [file = "figure.glb"] = process.argv.slice(2);
writeFileSync(file, makeFigure());
