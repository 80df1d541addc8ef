// The private state of cloths and handles. A proxy of an object, such as those of Vue's `ref`, has no
// private fields, but answers with the property that holds the state.

const STATE = Symbol("state");

/** Gives a new object its private state. It is behind a function because Vue wraps objects. */
export function setState(object, state) {
  Object.defineProperty(object, STATE, { value: () => state });
}

/** Returns the state of an object or of a proxy of it. Throws if it is no `kind`. */
export function stateOf(object, kind) {
  const read = object?.[STATE];
  if (!read) throw new TypeError(`\`this\` must be a ${kind}, but is another value`);
  return read();
}
