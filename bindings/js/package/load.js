// Loading of the WebAssembly module: once, however often and wherever init() is called; and its address
// beside the scripts of the package.

import { check, isBytes } from "./check.js";
import { readFileUrl } from "./file.js";
import { IMPORTS, isLoaded, setInstance } from "./memory.js";

const SOURCE_RULE = "be a URL, Request, Response, bytes or WebAssembly.Module";

/** What to do where the module cannot be loaded. */
const ADVICE = "import muslin/inline, which has the module inside, or pass the address of raw_bg.wasm to init()";

/** A module of one function that returns a v128: it is valid only in engines with SIMD. */
const SIMD_MODULE = [
  0, 97, 115, 109, 1, 0, 0, 0, // magic, version
  1, 5, 1, 96, 0, 1, 123, // type: () -> v128
  3, 2, 1, 0, // function 0 has that type
  10, 8, 1, 6, 0, 65, 0, 253, 15, 11, // i32.const 0, i8x16.splat
];

/**
 * The folder in which Vite's development server puts the bundled scripts of packages, without their
 * wasm modules. The server also serves the package itself, where it is installed.
 */
const VITE_DEPS = /\/node_modules\/\.vite\/deps\/(?=[^/]*$)/;

let loading;

/** Loads the module from `source`, or from what `fallback` returns. */
export async function load(source, fallback) {
  if (isLoaded()) return;
  loading ??= compileAndStart(source, fallback).finally(() => (loading = undefined));
  await loading;
}

/** Loads the module synchronously; see index.d.ts. */
export function loadSync(source) {
  if (isLoaded()) return;
  if (loading) throw new Error("init() is under way: await it instead of calling initSync()");
  const isModule = source instanceof WebAssembly.Module;
  check(isModule || isBytes(source), "source", "be bytes or a WebAssembly.Module");
  const module = checkModule(isModule ? source : new WebAssembly.Module(source));
  useInstance(new WebAssembly.Instance(module, IMPORTS));
}

async function compileAndStart(source, fallback) {
  const module = checkModule(await compile(await (source ?? fallback())));
  useInstance(await WebAssembly.instantiate(module, IMPORTS));
}

function useInstance({ exports }) {
  setInstance(exports, WebAssembly.RuntimeError);
}

async function compile(source) {
  if (source instanceof WebAssembly.Module) return source;
  if (isBytes(source)) return compileBytes(source);
  if (source instanceof Response) return compileResponse(source);
  if (source instanceof Request) return compileResponse(await fetch(source));
  check(source instanceof URL || typeof source === "string", "source", SOURCE_RULE);
  const read = await readAddress(`${source}`);
  return isBytes(read) ? compileBytes(read) : compileResponse(read);
}

/**
 * Compiles bytes, in Node synchronously: there, in version 20, WebAssembly.compile() may never
 * settle if V8 collects garbage meanwhile.
 */
function compileBytes(bytes) {
  return globalThis.process?.versions?.node ? new WebAssembly.Module(bytes) : WebAssembly.compile(bytes);
}

/** Returns the bytes of a file URL, or the response to any other address. */
async function readAddress(address) {
  try {
    return await (address.startsWith("file:") ? readFileUrl(address) : fetch(address));
  } catch (error) {
    throw new Error(`Muslin cannot read ${address} (${error.message}): ${ADVICE}`, { cause: error });
  }
}

async function compileResponse(response) {
  const type = response.headers.get("content-type") ?? "";
  // A server without such a file may answer with its front page and status 200.
  const isFound = response.ok && !type.startsWith("text/html");
  const answer = response.ok ? "is a page" : `answered ${response.status}`;
  check(isFound, "source", `be found, but ${response.url || "it"} ${answer}: ${ADVICE}`);
  if (type.startsWith("application/wasm")) return WebAssembly.compileStreaming(response);
  return compileBytes(await response.arrayBuffer());
}

/**
 * Throws if a module is not this package's; nothing is instantiated then, so that init() can be
 * called again.
 */
function checkModule(module) {
  const exported = WebAssembly.Module.exports(module).map(({ name }) => name);
  const isValid = exported.includes("memory") && exported.includes("rawcloth_grid");
  check(isValid, "source", "be the raw_bg.wasm of this package");
  return module;
}

/** Returns whether the engine has SIMD. */
export function hasSimd() {
  return WebAssembly.validate(new Uint8Array(SIMD_MODULE));
}

/** Returns the address that `make` computes, as a server has it. */
export function addressOf(make) {
  try {
    const url = make();
    const served = url.href.replace(VITE_DEPS, "/node_modules/muslin/");
    return served === url.href ? url : new URL(served);
  } catch (cause) {
    throw new Error(`Muslin cannot find its module: the script has no address here: ${ADVICE}`, { cause });
  }
}
