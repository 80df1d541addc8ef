import init, { Cloth } from "muslin";
import { play } from "../../shared.mjs";

play(init, Cloth).then((hash) => postMessage(hash));
