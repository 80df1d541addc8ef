// The worker: simulates the cloth and draws it.

import * as THREE from "../vendor/three.module.js";
import init, { Cloth } from "../muslin/index.js";
import { Pointers } from "../muslin/pointers.js";
import { withThree } from "../muslin/three-with.js";
import { Orbit } from "../drape/camera.js";
import { makeRenderer, makeScene, makeSheet } from "../drape/scene.js";

const { ClothGeometry } = withThree(THREE);
const early = [];
let [handle, size] = [(...message) => early.push(message), [1, 1]];
addEventListener("message", ({ data }) => handle(...data)); // before the module loads: early messages are kept

await init();

const cloth = Cloth.grid({
  columns: 40,
  rows: 40,
  spacing: 2 / 39,
  origin: [-1, 1, 0],
  pinMode: "top-edge",
  settings: { tearing: true, iterations: 4 },
});
cloth.material = { tearStretch: 1.8 };
const setWind = (speed) => (cloth.wind = { velocity: [0.3 * speed, 0, speed], gust: 0.6, wander: 0.5, turbulence: 0.3 });
setWind(2);

const geometry = new ClothGeometry(cloth);
const pointers = new Pointers(cloth, { radius: 0.04 });
const scene = makeScene(THREE);
const { sheet } = makeSheet(THREE, geometry);
scene.add(sheet);
const camera = new THREE.PerspectiveCamera(38, 1, 0.1, 40);
const orbit = new Orbit(camera);
const caster = new THREE.Raycaster();
const facing = new THREE.Vector3();
let renderer;

function ray(x, y) {
  caster.setFromCamera(new THREE.Vector2(x, y), camera);
  return [caster.ray.origin.toArray(), caster.ray.direction.toArray()];
}

const handlers = {
  start(canvas) {
    renderer = makeRenderer(THREE, canvas);
    requestAnimationFrame(frame);
  },
  fit(width, height, covered, density) {
    size = [width, height];
    renderer.setPixelRatio(density);
    renderer.setSize(width, height, false);
    orbit.fit(width, height, covered);
    orbit.update(1);
  },
  pointerdown(id, x, y) {
    camera.getWorldDirection(facing);
    if (!pointers.press(id, ...ray(x, y), facing.toArray())) orbit.press(id, 0.5 * x * size[0], -0.5 * y * size[1]);
  },
  pointermove(id, x, y) {
    if (pointers.holds(id)) pointers.drag(id, ...ray(x, y));
    else orbit.drag(id, 0.5 * x * size[0], -0.5 * y * size[1]);
    const isOver = cloth.raycast(...ray(x, y)) !== undefined;
    postMessage({ cursor: pointers.holds(id) ? "grabbing" : isOver ? "grab" : "default" });
  },
  pointerup(id) {
    pointers.lift(id);
    orbit.lift(id);
  },
  pointercancel: (id) => handlers.pointerup(id),
  wind: setWind,
  reset: () => cloth.reset(),
};
handle = (name, ...rest) => handlers[name](...rest);
for (const message of early) handle(...message);

let last = performance.now();
let [frames, since] = [0, last];

function frame(now) {
  requestAnimationFrame(frame);
  const seconds = Math.min(Math.max(now - last, 0) / 1000, 0.1);
  last = now;
  cloth.advance(seconds);
  geometry.update();
  orbit.update(seconds);
  renderer.render(scene, camera);
  frames++;
  if (now - since < 500) return;
  const { particles } = cloth.stats;
  postMessage({ stats: `${particles} particles · ${Math.round((1000 * frames) / (now - since))} fps in the worker` });
  [frames, since] = [0, now];
}
