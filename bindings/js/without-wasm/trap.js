// What ends a call that cannot go on.

export class RuntimeError extends Error {}

/** What the module calls instead of going on. */
export function trap() {
  throw new RuntimeError("unreachable");
}
