import init, { Cloth } from "muslin";
import { play } from "../shared.mjs";

console.log(await play(init, Cloth));
