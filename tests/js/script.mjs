// The script of tests/golden/tests/golden/script.rs in JavaScript, for Node and for a page.

/**
 * Runs 630 ticks and returns the cloth: it hangs in the wind, is dragged until it rips, is torn by
 * a call, released and cut, falls to the floor, and is picked up by a corner.
 */
export function playScript(Cloth) {
  const cloth = Cloth.grid({ settings: { tearing: true }, material: { tearStretch: 1.5 } });
  cloth.wind = { velocity: [0.25, 0, 1], gust: 0.5, wander: 0.25, turbulence: 0.25, seed: 7 };
  cloth.addCollider({ shape: "plane", position: [0, -2.5, 0] });
  cloth.step(120);

  const grab = cloth.grabRay([1, -1, 5], [0, 0, -1], { radius: 0.1 });
  const [x, y, z] = grab.position;
  for (let i = 1; i <= 120; i++) {
    grab.moveTo([Math.fround(x + 0.015625 * i), y, Math.fround(z + 0.03125 * i)]);
    cloth.step(1);
  }
  cloth.tearEdge(820, 860);
  grab.release();
  cloth.step(180);
  const opened = cloth.cut([-1, -0.59375, -9], [3, -0.78125, -9], [0, 0, 18]);
  if (opened <= 40) throw new Error(`the cut must go all the way through, but opened ${opened} edges`);
  cloth.step(30);

  cloth.unpinAll();
  cloth.step(120);
  cloth.pin(0, [0, 0, 0.5]);
  cloth.step(59);
  const ticks = cloth.advance(1 / 60);
  if (ticks !== 1) throw new Error(`the last frame must run 1 tick, but ran ${ticks}`);
  return cloth;
}

/** Formats a hash as in tests/script.hash. */
export function hexOf(hash) {
  return `0x${hash.toString(16).padStart(16, "0")}`;
}
