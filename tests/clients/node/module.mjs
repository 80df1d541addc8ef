// The script, in a worker of node's; the package is loaded on both sides.

import { Worker, isMainThread, parentPort } from "node:worker_threads";
import init, { Cloth } from "muslin";
import { hexOf, playScript } from "./script.mjs";

await init();
const hash = hexOf(playScript(Cloth).stateHash());
if (isMainThread) {
  const worker = new Worker(new URL(import.meta.url));
  worker.once("message", (theirs) => console.log(theirs === hash ? hash : `${theirs} in a worker, ${hash} outside`));
} else {
  parentPort.postMessage(hash);
}
