// As a bundle for pages runs in a server: with the entry point of pages, which reads a second file.

import init, { Cloth } from "../node_modules/muslin/index.js";
import { play } from "../shared.mjs";

play(init, Cloth).then(console.log, (error) => console.log(error.message));
