import init, { Cloth } from "muslin";
import { play } from "../../../shared.mjs";

export default defineEventHandler(async () => ({ hash: await play(init, Cloth) }));
