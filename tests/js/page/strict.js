// Hangs a cloth in a page that may not compile WebAssembly, and leaves what came out in `window.result`.

import init, { Cloth } from "/js/without-wasm/index.js";

/** A module of nothing. */
const EMPTY = new Uint8Array([0x00, 0x61, 0x73, 0x6d, 0x01, 0x00, 0x00, 0x00]);

async function hang() {
  const isForbidden = await WebAssembly.compile(EMPTY).then(() => false, () => true);
  await init();
  const cloth = Cloth.grid({ columns: 12, rows: 12, spacing: 0.05, pinMode: "top-corners" });
  cloth.step(30);
  const { positions } = cloth;
  return { isForbidden, sag: -positions[3 * 6 + 1], isDrawable: positions.every(Number.isFinite) };
}

window.result = await hang().catch((error) => ({ error: `${error.stack ?? error}` }));
