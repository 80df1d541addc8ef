// A figure from a glTF file walks and kicks in a skirt and a shirt, with three.js.

import * as THREE from "three";
import { GLTFLoader } from "../jsm/loaders/GLTFLoader.js";
import init from "../muslin/index.js";
import { makeRenderer } from "../drape/scene.js";
import { Dressed } from "./dress.js";
import { makeFigure } from "./glb.mjs";

const $ = (id) => document.getElementById(id);
const canvas = $("stage");
const renderer = makeRenderer(THREE, canvas);
const scene = new THREE.Scene();
const camera = new THREE.PerspectiveCamera(32, 1, 0.1, 40);

/** Returns a texture with `paint(context, size)`; its rows are those of the garment, from the hem up. */
function makeTexture(paint) {
  const image = new OffscreenCanvas(256, 256);
  paint(image.getContext("2d"), 256);
  const texture = new THREE.CanvasTexture(image);
  texture.flipY = false;
  texture.colorSpace = THREE.SRGBColorSpace;
  texture.anisotropy = 8;
  return texture;
}

const fill = (context, color, ...rows) => {
  context.fillStyle = color;
  for (const [from, to] of rows) context.fillRect(0, from, 256, to - from);
};
const cloth = (map) => new THREE.MeshStandardMaterial({ map, side: THREE.DoubleSide, shadowSide: THREE.DoubleSide, roughness: 0.85 });
const materials = {
  skirt: cloth(makeTexture((context, size) => {
    fill(context, "#a8403a", [0, size]);
    fill(context, "#f0dfc4", [8, 11], [19, 29], [34, 37]);
  })),
  shirt: cloth(makeTexture((context, size) => {
    fill(context, "#ece4d6", [0, size]);
    for (let row = 8; row < size; row += 18) fill(context, "#2b3a63", [row, row + 6]);
  })),
};

scene.add(new THREE.HemisphereLight(0xb4c0e0, 0x5a4638, 1.3));
const key = new THREE.DirectionalLight(0xfff1dc, 2.4);
key.position.set(-2, 3.6, 2.6);
key.castShadow = true;
key.shadow.mapSize.set(1024, 1024);
Object.assign(key.shadow.camera, { left: -1.4, right: 1.4, top: 2, bottom: -1.4, near: 1, far: 9 });
Object.assign(key.shadow, { bias: -0.0006, normalBias: 0.02, radius: 4 });
const rim = new THREE.DirectionalLight(0xff9a5c, 1.4);
rim.position.set(1.8, 2, -3);
const floor = new THREE.Mesh(
  new THREE.CircleGeometry(2.2, 64),
  new THREE.MeshStandardMaterial({ color: 0x2c313e, roughness: 0.9 }),
);
floor.rotation.x = -Math.PI / 2;
floor.receiveShadow = true;
scene.add(key, rim, floor);

await init();
// The file that `write-figure.mjs` writes, without a file.
const bytes = makeFigure();
const load = () => new GLTFLoader().parseAsync(bytes.buffer.slice(0), "");
const linen = new THREE.MeshStandardMaterial({ color: 0xd8c9b4, roughness: 0.7 });

let shown;

/** Replaces the figure by one at the start of its clip. */
async function restart() {
  const gltf = await load();
  if (shown) {
    scene.remove(shown.figure, ...shown.meshes);
    shown.free();
  }
  shown = new Dressed(gltf, materials);
  for (const name of ["body", "limbs"]) {
    const mesh = shown.figure.getObjectByName(name);
    mesh.material = linen;
    mesh.castShadow = mesh.receiveShadow = true;
    mesh.frustumCulled = false;
  }
  // The pattern pieces of the file are not drawn, their cloths are.
  for (const name of ["skirt", "skirtSkin", "shirt", "shirtSkin"]) shown.figure.getObjectByName(name).visible = false;
  scene.add(shown.figure, ...shown.meshes);
}
await restart();

const view = { azimuth: -0.75, polar: 1.45, zoom: 1 };
const fingers = new Map();
canvas.addEventListener("pointerdown", (event) => {
  canvas.setPointerCapture(event.pointerId);
  fingers.set(event.pointerId, [event.clientX, event.clientY]);
});
canvas.addEventListener("pointermove", (event) => {
  const last = fingers.get(event.pointerId);
  if (!last) return;
  const other = [...fingers].find(([id]) => id !== event.pointerId)?.[1];
  const now = [event.clientX, event.clientY];
  if (other) {
    const [before, after] = [last, now].map(([x, y]) => Math.hypot(x - other[0], y - other[1]));
    zoom(before / Math.max(after, 1));
  } else {
    view.azimuth -= 0.006 * (now[0] - last[0]);
    view.polar = Math.min(Math.max(view.polar - 0.006 * (now[1] - last[1]), 0.5), 1.55);
  }
  fingers.set(event.pointerId, now);
});
for (const type of ["pointerup", "pointercancel"]) canvas.addEventListener(type, ({ pointerId }) => fingers.delete(pointerId));
const zoom = (factor) => (view.zoom = Math.min(Math.max(view.zoom * factor, 0.5), 2));
canvas.addEventListener("wheel", (event) => {
  event.preventDefault();
  zoom(Math.exp(0.001 * event.deltaY));
}, { passive: false });

$("reset").addEventListener("click", restart);
$("pause").addEventListener("click", ({ currentTarget: button }) => {
  const isPaused = button.getAttribute("aria-pressed") !== "true";
  button.setAttribute("aria-pressed", isPaused);
  button.textContent = isPaused ? "Resume" : "Pause";
});

function fit() {
  const { clientWidth: width, clientHeight: height } = canvas;
  renderer.setPixelRatio(Math.min(devicePixelRatio, 2));
  renderer.setSize(width, height, false);
  camera.aspect = width / height;
  // The panel of a narrow window covers its lower part.
  const { top, right } = document.querySelector(".panel").getBoundingClientRect();
  camera.setViewOffset(width, height, 0, right > width / 2 ? (height - top) / 2 : 0, width, height);
  camera.updateProjectionMatrix();
}
addEventListener("resize", fit);
fit();

let last = performance.now();
let [frames, since] = [0, last];

function frame(now) {
  requestAnimationFrame(frame);
  const seconds = Math.min(Math.max(now - last, 0) / 1000, 0.05);
  last = now;
  if ($("pause").getAttribute("aria-pressed") === "false") shown.advance(seconds);
  shown.draw();
  const radius = (view.zoom * 1.15) / (Math.tan((camera.fov * Math.PI) / 360) * Math.min(camera.aspect, 1));
  const { azimuth, polar } = view;
  camera.position.set(Math.sin(azimuth) * Math.sin(polar), Math.cos(polar), Math.cos(azimuth) * Math.sin(polar)).multiplyScalar(radius);
  camera.position.y += 0.9;
  camera.lookAt(0, 0.9, 0);
  renderer.render(scene, camera);
  frames++;
  if (now - since < 500) return;
  $("stats").textContent = `${shown.cloth.stats.particles} particles · ${Math.round((1000 * frames) / (now - since))} fps`;
  [frames, since] = [0, now];
}
requestAnimationFrame(frame);
