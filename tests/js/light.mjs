// Plays what `muslin/light` can do with one build of the package: `node light.mjs SPECIFIER [no-simd]`
// prints, as JSON, the state hash, what happened, what the rest answers, and the sizes of the modules
// that were compiled. The second word makes this engine one without SIMD.

import { limitEngine } from "./engine.mjs";
import { hexOf } from "./script.mjs";

const [specifier, ...missing] = process.argv.slice(2);
const compiled = limitEngine(missing);

const { default: init, Cloth } = await import(specifier);
await init();

const settings = { tearing: true, selfCollision: "particles", maxStretch: 0.05 };
const cloth = Cloth.grid({ columns: 24, rows: 24, pinMode: "top-corners", settings, material: "silk" });
cloth.material = { tearStretch: 1.2 };
cloth.wind = { velocity: [0.25, 0, 3], gust: 0.5, turbulence: 0.25, seed: 3 };
const shapes = [
  { shape: "plane", position: [0, -2, 0] },
  { shape: "sphere", position: [0.4, -0.6, 0.2], radius: 0.2 },
  { shape: "capsule", position: [0.9, -0.8, 0.2], radius: 0.1, halfHeight: 0.3 },
  { shape: "box", position: [0.7, -1.3, 0.2], halfExtents: [0.3, 0.1, 0.2] },
];
const [, ball] = shapes.map((desc) => cloth.addCollider(desc));
const grab = cloth.grabRay([0.5, -0.5, 5], [0, 0, -1], { radius: 0.1 });
for (let frame = 0; frame < 60; frame += 1) {
  ball.moveTo([0.4 + 0.005 * frame, -0.6, 0.2]);
  grab.moveTo([0.6, -0.6, 0.05 * frame]);
  cloth.advance(1 / 60);
}
grab.release();
cloth.step(30);
const torn = [...cloth.events()].filter(({ kind }) => kind === "edge-torn").length;
const hash = hexOf(cloth.stateHash());

/** Returns what a call answers: the message of its error, or "done". */
function answer(call) {
  try {
    call();
    return "done";
  } catch (error) {
    return error instanceof Error ? error.message : `${error}`;
  }
}

const other = Cloth.grid({ columns: 8, rows: 8 });
const points = [0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1];
const answers = {
  cut: answer(() => cloth.cut([-1, -0.4, -9], [0.3, -0.5, -9], [0, 0, 18])),
  save: answer(() => cloth.save()),
  restore: answer(() => Cloth.restore(new Uint8Array(100))),
  duplicate: answer(() => cloth.duplicate()),
  sew: answer(() => cloth.sew([[0, 23]])),
  skin: answer(() => cloth.skin({ positions: [0, 0, 0, 0.1, 0, 0, 0, -0.1, 0], indices: [0, 1, 2] }).free()),
  surface: answer(() => (cloth.settings = { selfCollision: true })),
  made: answer(() => Cloth.grid({ settings: { selfCollision: true } })),
  convex: answer(() => cloth.addCollider({ shape: "convex", positions: points })),
  mesh: answer(() => cloth.addCollider({ shape: "mesh", positions: points, indices: [0, 1, 2] })),
  heightfield: answer(() => cloth.addCollider({ shape: "heightfield", columns: 2, rows: 2, heights: [0, 0, 0, 0] })),
  update: answer(() => ball.update(points)),
  layer: answer(() => cloth.collideWith(other)),
};
const isUnchanged = hexOf(cloth.stateHash()) === hash;
console.log(JSON.stringify({ hash, torn, answers, isUnchanged, compiled }));
