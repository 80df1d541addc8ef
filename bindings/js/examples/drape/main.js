// A hanging sheet with three.js from the page's own folder: no bundler, no import map, a strict
// content security policy.

import * as THREE from "../vendor/three.module.js";
import init, { Cloth } from "../muslin/index.js";
import { withThree } from "../muslin/three-with.js";
import { Orbit } from "./camera.js";
import { makeRenderer, makeScene, makeSheet } from "./scene.js";

const { ClothGeometry, ClothPointers } = withThree(THREE);
const $ = (id) => document.getElementById(id);
const canvas = $("stage");

await init();

const scene = makeScene(THREE);
const camera = new THREE.PerspectiveCamera(38, 1, 0.1, 40);
const orbit = new Orbit(camera);
const renderer = makeRenderer(THREE, canvas);
const wire = new THREE.MeshBasicMaterial({ color: 0xffe9d0, wireframe: true, transparent: true, opacity: 0.22 });

let shown;

/** Replaces the sheet by a new one. */
function replaceSheet() {
  if (shown) {
    shown.pointers.dispose();
    scene.remove(shown.sheet, shown.wires);
    shown.geometry.dispose();
    shown.cloth.free();
  }
  const cloth = Cloth.grid({
    columns: 40,
    rows: 40,
    spacing: 2 / 39,
    origin: [-1, 1, 0],
    pinMode: $("pins").value,
    material: { tearStretch: 1.6, tearVariation: 0.3 },
    settings: { substeps: 2, selfCollision: true, damping: 0.35 },
  });
  const geometry = new ClothGeometry(cloth);
  const { sheet, front } = makeSheet(THREE, geometry);
  const wires = new THREE.Mesh(geometry, wire);
  scene.add(sheet, wires);
  const pointers = new ClothPointers(front, camera, canvas, { radius: 0.04 });
  shown = { cloth, geometry, sheet, wires, front, pointers };
  applyPanel();
}

/** Applies the values of the panel to the cloth. */
function applyPanel() {
  const [wind, gravity, iterations] = ["wind", "gravity", "stiffness"].map((id) => $(id).valueAsNumber);
  shown.cloth.wind = { velocity: [0.25 * wind, 0, wind], gust: 0.6, wander: 0.5, turbulence: 0.3 };
  shown.cloth.settings = { gravity: [0, -gravity, 0], iterations, tearing: $("tear").checked };
  shown.wires.visible = $("wire").checked;
  for (const output of document.querySelectorAll("output")) output.value = $(output.htmlFor.value).value;
}

for (const id of ["wind", "gravity", "stiffness", "tear", "wire"]) $(id).addEventListener("input", applyPanel);
$("pins").addEventListener("change", replaceSheet);
$("reset").addEventListener("click", () => {
  shown.pointers.liftAll();
  shown.cloth.reset();
});
$("pause").addEventListener("click", ({ currentTarget: button }) => {
  const isPaused = button.getAttribute("aria-pressed") !== "true";
  button.setAttribute("aria-pressed", isPaused);
  button.textContent = isPaused ? "Resume" : "Pause";
});

replaceSheet();

// A press that grabs the cloth does not get here: ClothPointers listens first and stops the event.
canvas.addEventListener("pointerdown", (event) => {
  canvas.setPointerCapture(event.pointerId);
  orbit.press(event.pointerId, event.clientX, event.clientY);
});
canvas.addEventListener("pointermove", (event) => {
  orbit.drag(event.pointerId, event.clientX, event.clientY);
  canvas.style.cursor = shown.pointers.meets(event) ? "grab" : "default";
});
for (const type of ["pointerup", "pointercancel"]) {
  canvas.addEventListener(type, (event) => orbit.lift(event.pointerId));
}
canvas.addEventListener("wheel", (event) => {
  event.preventDefault();
  orbit.turn(0, 0, Math.exp(0.001 * event.deltaY));
}, { passive: false });

/** Fits the picture to the window, beside or above the panel. */
function fit() {
  const { clientWidth: width, clientHeight: height } = canvas;
  renderer.setPixelRatio(Math.min(devicePixelRatio, 2));
  renderer.setSize(width, height, false);
  const { top, right } = document.querySelector(".panel").getBoundingClientRect();
  const covered = right > width / 2 ? [0, height - top] : width < 1100 ? [right, 0] : [0, 0];
  orbit.fit(width, height, covered);
}
addEventListener("resize", fit);
fit();

let last = performance.now();
let [frames, since] = [0, last];

function frame(now) {
  requestAnimationFrame(frame);
  const seconds = Math.min(Math.max(now - last, 0) / 1000, 0.1); // the first frame may be older than `last`
  last = now;
  const { cloth, geometry, pointers } = shown;
  if ($("pause").getAttribute("aria-pressed") === "false") cloth.advance(seconds);
  geometry.update();
  orbit.update(seconds);
  if (pointers.size > 0) canvas.style.cursor = "grabbing";
  renderer.render(scene, camera);
  frames++;
  if (now - since < 500) return;
  const { particles, pieces } = cloth.stats;
  const torn = pieces > 1 ? `, ${pieces} pieces` : "";
  $("stats").textContent = `${particles} particles${torn} · ${Math.round((1000 * frames) / (now - since))} fps`;
  [frames, since] = [0, now];
}
requestAnimationFrame(frame);
