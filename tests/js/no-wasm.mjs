// `node --import ./no-wasm.mjs …` removes WebAssembly and resolves "muslin" to "muslin/no-wasm".

import { register } from "node:module";

delete globalThis.WebAssembly;
const hooks = `export const resolve = (specifier, context, next) =>
  next(specifier === "muslin" ? "muslin/no-wasm" : specifier, context);`;
register(`data:text/javascript,${encodeURIComponent(hooks)}`);
