// An engine without SIMD or WebAssembly, and the sizes of the modules that it compiles.

/**
 * Takes what `missing` names away from this engine, "no-simd" or "no-wasm". Returns a list that gets
 * the size of each module that is compiled [B].
 */
export function limitEngine(missing) {
  const compiled = [];
  if (missing.includes("no-simd")) WebAssembly.validate = () => false;
  if (missing.includes("no-wasm")) {
    delete globalThis.WebAssembly;
    return compiled;
  }
  const { Module } = WebAssembly;
  WebAssembly.Module = class extends Module {
    constructor(bytes) {
      super(bytes);
      compiled.push(bytes.byteLength);
    }
  };
  return compiled;
}
