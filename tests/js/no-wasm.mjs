// `node --import ./no-wasm.mjs …`: what imports "muslin" gets the build without WebAssembly, which is gone.

import { register } from "node:module";

delete globalThis.WebAssembly;
const hooks = `export const resolve = (specifier, context, next) =>
  next(specifier === "muslin" ? "muslin/no-wasm" : specifier, context);`;
register(`data:text/javascript,${encodeURIComponent(hooks)}`);
