// From CommonJS where require() cannot load modules.

Promise.all([import("muslin"), import("../shared.mjs")])
  .then(([{ default: init, Cloth }, { play }]) => play(init, Cloth))
  .then(console.log);
