// Loading the wasm module: once, whoever asks and however often.

import { check, isBytes } from "./check.js";
import { IMPORTS, hold, isLoaded } from "./memory.js";

/** A module of one function that gives a vector: engines without vectors find it wrong. */
const VECTOR = [
  ...[0x00, 0x61, 0x73, 0x6d, 0x01, 0x00, 0x00, 0x00], // magic, version
  ...[0x01, 0x05, 0x01, 0x60, 0x00, 0x01, 0x7b], // type: () -> v128
  ...[0x03, 0x02, 0x01, 0x00], // function 0 is of it
  ...[0x0a, 0x08, 0x01, 0x06, 0x00, 0x41, 0x00, 0xfd, 0x0f, 0x0b], // i32.const 0, i8x16.splat
];

/**
 * Where Vite's server for development has the scripts of packages, put together anew and without their modules. It
 * serves those too, from where they are installed.
 */
const REBUILT = /\/node_modules\/\.vite\/deps\/(?=[^/]*$)/;

const SOURCES = "be a URL, Request, Response, bytes or WebAssembly.Module";

const ADVICE = "give init() the address of raw_bg.wasm, or import muslin/inline, which has it inside";

let loading;

/** Loads the module; see index.d.ts. */
export default async function init(source) {
  if (isLoaded()) return;
  loading ??= load(source).finally(() => (loading = undefined));
  await loading;
}

/** Loads the module from what is already here; see index.d.ts. */
export function initSync(source) {
  if (isLoaded()) return;
  if (loading) throw new Error("init() is under way: await it instead of calling initSync()");
  const isModule = source instanceof WebAssembly.Module;
  check(isModule || isBytes(source), "source", "be bytes or a WebAssembly.Module");
  const module = ours(isModule ? source : new WebAssembly.Module(source));
  use(new WebAssembly.Instance(module, IMPORTS));
}

async function load(source) {
  const module = ours(await compile(await (source ?? beside())));
  use(await WebAssembly.instantiate(module, IMPORTS));
}

function use({ exports }) {
  hold(exports, WebAssembly.RuntimeError);
}

/** The module beside this file that the engine can run; written so that bundlers find both. */
function beside() {
  const hasVectors = WebAssembly.validate(new Uint8Array(VECTOR));
  const [vectors, plain] = [new URL("raw_bg.wasm", import.meta.url), new URL("plain_bg.wasm", import.meta.url)];
  const { href } = hasVectors ? vectors : plain;
  return new URL(href.replace(REBUILT, "/node_modules/muslin/"));
}

async function compile(source) {
  if (source instanceof WebAssembly.Module) return source;
  if (isBytes(source)) return WebAssembly.compile(source);
  const isHere = source instanceof URL || typeof source === "string";
  // At once: what awaits node 20's compiler may wait for ever, when V8 must collect garbage just then.
  if (isHere && String(source).startsWith("file:")) return new WebAssembly.Module(await file(source));
  if (source instanceof Response) return receive(source);
  check(isHere || source instanceof Request, "source", SOURCES);
  return receive(await fetch(source));
}

async function receive(response) {
  const type = response.headers.get("content-type") ?? "";
  // A server that knows no such file may answer with its front page and call that well done.
  const isThere = response.ok && !type.startsWith("text/html");
  const found = response.ok ? "is a page" : `answered ${response.status}`;
  check(isThere, "source", `be found, but ${response.url || "it"} ${found}; ${ADVICE}`);
  if (type.startsWith("application/wasm")) return WebAssembly.compileStreaming(response);
  return WebAssembly.compile(await response.arrayBuffer());
}

/** Node cannot fetch a file. The name is kept from bundlers, which would look for it for a browser. */
async function file(url) {
  const name = "node:fs/promises";
  const { readFile } = await import(/* @vite-ignore */ /* webpackIgnore: true */ name);
  return readFile(new URL(url));
}

/** Refuses a foreign module before it is bound, so that another load may follow. */
function ours(module) {
  const exported = WebAssembly.Module.exports(module).map(({ name }) => name);
  const holds = exported.includes("memory") && exported.includes("rawcloth_grid");
  check(holds, "source", "be the raw_bg.wasm of this package");
  return module;
}
