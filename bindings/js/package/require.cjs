// What `require()` finds in a Node that cannot load modules with it, and in tools that cannot.

throw new Error(
  'Muslin is an ES module, and require() cannot load those here: use `await import("muslin")`, ' +
    "or Node 20.19, 22.12 or newer, where require() can",
);
