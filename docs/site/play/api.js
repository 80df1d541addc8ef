// The module `playground` that code of the playground imports: the values of the panel, and where
// cloth is drawn.

/** The values of the panel. They change while the code runs. */
export const settings = {};

/** The parts of the stage, set by the page before the code runs. */
export const stage = {};

/** Draws a cloth, in the colour of its fabric or in `options.color`. It can be pulled. */
export function show(cloth, options = {}) {
  return stage.current.show(cloth, options);
}

/** Adds any object of three.js to the picture. */
export function add(object) {
  stage.current.scene.add(object);
  return object;
}

/** Calls `update(seconds)` before each picture, with the seconds since the last one. */
export function onFrame(update) {
  if (typeof update !== "function") throw new TypeError("onFrame takes a function");
  stage.updates.push(update);
}
