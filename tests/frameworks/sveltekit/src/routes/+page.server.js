import init, { Cloth } from "muslin";
import { play } from "../../../shared.mjs";

export const load = async () => ({ hash: await play(init, Cloth) });
