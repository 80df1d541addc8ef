import init, { Cloth } from "./node_modules/muslin/no-wasm.js";
import { hexOf, playScript } from "./script.mjs";

await init();
postMessage(hexOf(playScript(Cloth).stateHash()));
