import init, { Cloth } from "./node_modules/muslin/index.js";
import { hexOf, playScript } from "./script.mjs";

await init();
postMessage(hexOf(playScript(Cloth).stateHash()));
