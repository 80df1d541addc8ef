// What every app does: it loads the package, plays the script and returns the hash of the state.

import { hexOf, playScript } from "./script.mjs";

export async function play(init, Cloth) {
  await init();
  return hexOf(playScript(Cloth).stateHash());
}

/** Returns what a worker posts; the worker plays the script. */
export async function resultOf(worker) {
  const result = await new Promise((resolve, reject) => {
    worker.addEventListener("message", ({ data }) => resolve(data));
    worker.addEventListener("error", ({ message }) => reject(new Error(message)));
  });
  worker.terminate();
  return result;
}

/** Stores what a promise gives in `window.result`; an error goes to the console. */
export function report(promise) {
  promise.then((result) => (window.result = result), (error) => console.error(error));
}
