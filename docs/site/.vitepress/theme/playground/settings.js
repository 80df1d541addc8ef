// The values of the panel: what may be set, and how a link is checked.

/** The controls, in the order of the panel. `restarts`: the code runs anew, since it reads the value once. */
export const CONTROLS = [
  { name: "fabric", label: "Fabric", choices: ["silk", "cotton", "denim", "leather", "paper", "flag-nylon"], value: "silk", restarts: true },
  { name: "pins", label: "Pinned at", choices: ["top-edge", "top-corners", "corners", "none"], value: "top-corners", restarts: true },
  { name: "columns", label: "Particles per side", min: 8, max: 96, step: 1, value: 40, restarts: true },
  { name: "size", label: "Size", unit: "m", min: 0.4, max: 3, step: 0.1, value: 2, restarts: true },
  { name: "wind", label: "Wind", unit: "m/s", min: 0, max: 12, step: 0.1, value: 2.5 },
  { name: "gust", label: "Gusts", min: 0, max: 1, step: 0.05, value: 0.6 },
  { name: "gravity", label: "Gravity", unit: "m/s²", min: 0, max: 20, step: 0.1, value: 9.8 },
  { name: "substeps", label: "Substeps", min: 1, max: 16, step: 1, value: 4 },
  { name: "iterations", label: "Iterations", min: 1, max: 10, step: 1, value: 2 },
  { name: "selfCollision", label: "Self-collision", value: false },
  { name: "tearing", label: "Tearing", value: false },
];

/** The values that the panel starts with. */
export function defaults() {
  return Object.fromEntries(CONTROLS.map(({ name, value }) => [name, value]));
}

/**
 * Returns all settings, those of `given` in place of the defaults.
 *
 * @throws if a value is not allowed or not known; the message names it and the rule
 */
export function checkedSettings(given = {}) {
  const unknown = Object.keys(given).find((name) => !CONTROLS.some((control) => control.name === name));
  if (unknown !== undefined) throw new Error(`there is no setting \`${unknown}\``);
  const settings = defaults();
  for (const { name, choices, min, max } of CONTROLS) {
    if (!Object.hasOwn(given, name)) continue;
    const value = given[name];
    if (choices && !choices.includes(value)) throw new Error(`\`${name}\` must be one of ${choices.join(", ")}`);
    if (min !== undefined && !(typeof value === "number" && value >= min && value <= max)) {
      throw new Error(`\`${name}\` must be ${min} to ${max}`);
    }
    if (!choices && min === undefined && typeof value !== "boolean") throw new Error(`\`${name}\` must be true or false`);
    settings[name] = value;
  }
  return settings;
}
