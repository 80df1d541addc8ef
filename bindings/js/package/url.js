// The address of the WebAssembly module beside the scripts of the package.

import { ADVICE } from "./load.js";

/** A module of one function that returns a v128: it is valid only in engines with SIMD. */
const SIMD_MODULE = [
  ...[0x00, 0x61, 0x73, 0x6d, 0x01, 0x00, 0x00, 0x00], // magic, version
  ...[0x01, 0x05, 0x01, 0x60, 0x00, 0x01, 0x7b], // type: () -> v128
  ...[0x03, 0x02, 0x01, 0x00], // function 0 has that type
  ...[0x0a, 0x08, 0x01, 0x06, 0x00, 0x41, 0x00, 0xfd, 0x0f, 0x0b], // i32.const 0, i8x16.splat
];

/**
 * The folder in which Vite's development server puts the bundled scripts of packages, without their
 * wasm modules. The server also serves the package itself, where it is installed.
 */
const VITE_DEPS = /\/node_modules\/\.vite\/deps\/(?=[^/]*$)/;

/**
 * Returns the address of the module that the engine can run. Bundlers look for exactly this form of
 * `new URL`, so both are written out. Some put an object there whose address is relative to the
 * page and cannot be parsed again, so it is passed on as it is.
 */
export function moduleUrl() {
  const hasSimd = WebAssembly.validate(new Uint8Array(SIMD_MODULE));
  let urls;
  try {
    urls = [new URL("raw_bg.wasm", import.meta.url), new URL("plain_bg.wasm", import.meta.url)];
  } catch (error) {
    throw new Error(`Muslin cannot find raw_bg.wasm, because its script has no address here: ${ADVICE}`, { cause: error });
  }
  const url = urls[hasSimd ? 0 : 1];
  const { href } = url;
  return VITE_DEPS.test(href) ? new URL(href.replace(VITE_DEPS, "/node_modules/muslin/")) : url;
}
