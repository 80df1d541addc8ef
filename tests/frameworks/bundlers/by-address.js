// For bundlers that give the address of a file where it is imported.

import init, { Cloth } from "muslin";
import address from "muslin/raw_bg.wasm";
import { play, report } from "../shared.mjs";

report(play(() => init(new URL(address, document.baseURI)), Cloth).then((hash) => ({ hash })));
