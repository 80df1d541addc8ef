// Counts the cloths that live and their memory, and warns once where many seem to be forgotten.

/** From this memory and this number of cloths on there is a warning [B]. */
const [MAX_BYTES, MAX_COUNT] = [2 ** 28, 32];

const live = { bytes: 0, count: 0, hasWarned: false };
/** The bytes of each cloth that was not freed, by its state. */
const sizes = new WeakMap();
const collected = globalThis.FinalizationRegistry && new FinalizationRegistry((bytes) => add(-bytes, -1));

function add(bytes, count) {
  live.bytes += bytes;
  live.count += count;
}

/** Counts a new cloth of `bytes` bytes. A warning goes to the console the first time it is due. */
export function countCloth(cloth, state, bytes) {
  sizes.set(state, bytes);
  collected?.register(cloth, bytes, state);
  add(bytes, 1);
  if (live.hasWarned || live.bytes < MAX_BYTES || live.count < MAX_COUNT) return;
  live.hasWarned = true;
  console.warn(
    `Muslin: ${live.count} cloths hold ${Math.round(live.bytes / 2 ** 20)} MiB. Call free() on each cloth ` +
      "that you no longer need: one that is only forgotten is not freed before the page yields and garbage is collected.",
  );
}

/** Stops counting a cloth that was freed. */
export function discountCloth(state) {
  if (!sizes.has(state)) return;
  add(-sizes.get(state), -1);
  sizes.delete(state);
  collected?.unregister(state);
}
