// Loading of the WebAssembly module: once, however often and wherever init() is called.

import { check, isBytes } from "./check.js";
import { IMPORTS, isLoaded, setInstance } from "./memory.js";

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

const SOURCE_RULE = "be a URL, Request, Response, bytes or WebAssembly.Module";

const ADVICE = "give init() the address of raw_bg.wasm, or import muslin/inline, which has it inside";

let loading;

/** Loads the module; see index.d.ts. */
export default async function init(source) {
  if (isLoaded()) return;
  loading ??= load(source).finally(() => (loading = undefined));
  await loading;
}

/** Loads the module synchronously; see index.d.ts. */
export function initSync(source) {
  if (isLoaded()) return;
  if (loading) throw new Error("init() is under way: await it instead of calling initSync()");
  const isModule = source instanceof WebAssembly.Module;
  check(isModule || isBytes(source), "source", "be bytes or a WebAssembly.Module");
  const module = checkModule(isModule ? source : new WebAssembly.Module(source));
  useInstance(new WebAssembly.Instance(module, IMPORTS));
}

async function load(source) {
  const module = checkModule(await compile(await (source ?? defaultUrl())));
  useInstance(await WebAssembly.instantiate(module, IMPORTS));
}

function useInstance({ exports }) {
  setInstance(exports, WebAssembly.RuntimeError);
}

/**
 * Returns the address of the module beside this file that the engine can run. Bundlers look for
 * exactly this form of `new URL`, so both are written out.
 */
function defaultUrl() {
  const hasSimd = WebAssembly.validate(new Uint8Array(SIMD_MODULE));
  const [simd, plain] = [new URL("raw_bg.wasm", import.meta.url), new URL("plain_bg.wasm", import.meta.url)];
  const { href } = hasSimd ? simd : plain;
  return new URL(href.replace(VITE_DEPS, "/node_modules/muslin/"));
}

async function compile(source) {
  if (source instanceof WebAssembly.Module) return source;
  if (isBytes(source)) return WebAssembly.compile(source);
  const isAddress = source instanceof URL || typeof source === "string";
  // Compiled synchronously: in Node 20, WebAssembly.compile() may never settle if V8 collects
  // garbage meanwhile.
  if (isAddress && String(source).startsWith("file:")) return new WebAssembly.Module(await readFileUrl(source));
  if (source instanceof Response) return compileResponse(source);
  check(isAddress || source instanceof Request, "source", SOURCE_RULE);
  return compileResponse(await fetch(source));
}

async function compileResponse(response) {
  const type = response.headers.get("content-type") ?? "";
  // A server without such a file may answer with its front page and status 200.
  const isFound = response.ok && !type.startsWith("text/html");
  const answer = response.ok ? "is a page" : `answered ${response.status}`;
  check(isFound, "source", `be found, but ${response.url || "it"} ${answer}; ${ADVICE}`);
  if (type.startsWith("application/wasm")) return WebAssembly.compileStreaming(response);
  return WebAssembly.compile(await response.arrayBuffer());
}

/**
 * Reads a file URL in Node, whose fetch() does not. The module's name is in a variable so that
 * bundlers for browsers do not look for it.
 */
async function readFileUrl(url) {
  const name = "node:fs/promises";
  const { readFile } = await import(/* @vite-ignore */ /* webpackIgnore: true */ name);
  return readFile(new URL(url));
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
