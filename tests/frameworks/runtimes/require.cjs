const { default: init, Cloth } = require("muslin");

import("../shared.mjs").then(async ({ play }) => console.log(await play(init, Cloth)));
