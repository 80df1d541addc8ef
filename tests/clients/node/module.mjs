// Runs the script in the main thread and in a worker of Node; each loads the package.

import { Worker, isMainThread, parentPort } from "node:worker_threads";
import init, { Cloth } from "muslin";
import { hexOf, playScript } from "./script.mjs";

await init();
const hash = hexOf(playScript(Cloth).stateHash());
if (isMainThread) {
  const worker = new Worker(new URL(import.meta.url));
  worker.once("message", (workerHash) =>
    console.log(workerHash === hash ? hash : `${workerHash} in the worker, ${hash} in the main thread`));
} else {
  parentPort.postMessage(hash);
}
