// The memory of the module, once it is loaded.

let memory;

/** From now on the module is loaded, and this is its memory. */
export function hold(loaded) {
  memory = loaded;
}

/** Whether the module is loaded. */
export function isLoaded() {
  return memory !== undefined;
}

/** The memory of the module; throws before there is one. */
export function ready() {
  if (!memory) throw new Error("Muslin is not loaded: call await init() first");
  return memory;
}

/** Whether a list lies in the module's own memory, which may move while the list is handed over. */
export function isOurs(list) {
  return list.buffer === memory?.buffer;
}
