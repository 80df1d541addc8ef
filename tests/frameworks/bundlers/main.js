import init, { Cloth } from "muslin";
import { play, report } from "../shared.mjs";

report(play(init, Cloth).then((hash) => ({ hash })));
