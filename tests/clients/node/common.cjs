// Uses the package from CommonJS, through `import()`.

import("muslin").then(async ({ default: init, Cloth }) => {
  await init();
  const { hexOf, playScript } = await import("./script.mjs");
  console.log(hexOf(playScript(Cloth).stateHash()));
});
