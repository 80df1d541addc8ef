import init, { Cloth } from "muslin";
import { hexOf, playScript } from "./script.mjs";

init().then(() => postMessage(hexOf(playScript(Cloth).stateHash())));
