// What the package asks of WebAssembly, where the module is JavaScript itself.

import { instantiate } from "./code.js";
import { RuntimeError } from "./trap.js";

class Module {}

class Instance {
  constructor(_, imports) {
    this.exports = instantiate(imports);
  }
}

export const WebAssembly = { Module, Instance, RuntimeError };
