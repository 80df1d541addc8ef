// Cloth without an engine: one interleaved vertex buffer, one index buffer, two small shaders.

import init, { Cloth } from "../muslin/index.js";
import { Pointers } from "../muslin/pointers.js";
import { colorChannel } from "../colors.js";
import { makeProgram } from "./shading.js";
import { eyeRay, perspective } from "./view.js";

const $ = (id) => document.getElementById(id);
const canvas = $("stage");
const gl = canvas.getContext("webgl2", { antialias: true });

await init();

const cloth = Cloth.grid({
  columns: 48,
  rows: 48,
  spacing: 2 / 47,
  origin: [-1, 1, 0],
  pinMode: "top-corners",
  material: "silk",
  settings: { tearing: true, iterations: 4, damping: 0.4 },
});
cloth.material = { tearStretch: 1.7 };
cloth.wind = { velocity: [0.3, 0, 1.4], gust: 0.7, wander: 0.5, turbulence: 0.4 };

// Vertex colours, as a mesh file has them in COLOR_0: red is the strength. Here the hem is stronger.
const colors = new Uint8Array(4 * 48 * 48).map((_, i) => (i % 4 === 0 && i < 4 * 48 * 44 ? 85 : 255));
cloth.setMap("tear", colorChannel(cloth, colors, 0).map((red) => 3 * red)); // 1 to 3 times the material

const STRIDE = 24; // position, normal: three floats each
const vertices = new Float32Array((STRIDE / 4) * cloth.vertexCapacity); // large enough for every tear
const indices = new Uint16Array(cloth.indexCapacity);
const streams = [
  { attribute: "position", buffer: vertices, stride: STRIDE },
  { attribute: "normal", buffer: vertices, stride: STRIDE, offset: 12 },
];
let seen = 0; // no revision yet

const uniforms = makeProgram(gl, STRIDE);
gl.bufferData(gl.ARRAY_BUFFER, vertices.byteLength, gl.DYNAMIC_DRAW);
gl.bufferData(gl.ELEMENT_ARRAY_BUFFER, indices.byteLength, gl.DYNAMIC_DRAW);

/** Uploads what changed: all vertices of a frame, and the indices that a tear changed. */
function upload() {
  const count = cloth.writeVertices(streams, { blend: cloth.blend });
  gl.bufferSubData(gl.ARRAY_BUFFER, 0, vertices, 0, (STRIDE / 4) * count);
  if (cloth.topologyRevision === seen) return;
  const { firstIndex, indexCount } = cloth.changes(seen);
  seen = cloth.topologyRevision;
  cloth.writeIndices(indices);
  if (indexCount > 0) gl.bufferSubData(gl.ELEMENT_ARRAY_BUFFER, 2 * firstIndex, indices, firstIndex, indexCount);
}

const pointers = new Pointers(cloth, { radius: 0.04 });

/** Returns the ray under an event. */
function ray({ clientX, clientY }) {
  const { left, top, width, height } = canvas.getBoundingClientRect();
  return eyeRay((2 * (clientX - left)) / width - 1, 1 - (2 * (clientY - top)) / height, width / height);
}

canvas.addEventListener("pointerdown", (event) => {
  if (pointers.press(event.pointerId, ...ray(event), [0, 0, -1])) canvas.setPointerCapture(event.pointerId);
});
canvas.addEventListener("pointermove", (event) => {
  pointers.drag(event.pointerId, ...ray(event));
  const isOver = cloth.raycast(...ray(event)) !== undefined;
  canvas.style.cursor = pointers.holds(event.pointerId) ? "grabbing" : isOver ? "grab" : "default";
});
for (const type of ["pointerup", "pointercancel"]) {
  canvas.addEventListener(type, (event) => pointers.lift(event.pointerId));
}
$("reset").addEventListener("click", () => cloth.reset());
$("cut").addEventListener("click", () => cloth.cut([-0.7, 0.3, -4], [0.5, -0.4, -4], [0, 0, 8]));

let last = performance.now();

function frame(now) {
  requestAnimationFrame(frame);
  cloth.advance(Math.min(Math.max(now - last, 0) / 1000, 0.1));
  last = now;
  upload();

  const density = Math.min(devicePixelRatio, 2);
  const [width, height] = [canvas.clientWidth, canvas.clientHeight].map((size) => Math.round(density * size));
  if (canvas.width !== width || canvas.height !== height) Object.assign(canvas, { width, height });
  gl.viewport(0, 0, width, height);
  gl.clearColor(0, 0, 0, 0);
  gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT);
  gl.uniformMatrix4fv(uniforms.view, false, perspective(width / height));
  gl.drawElements(gl.TRIANGLES, cloth.indices.length, gl.UNSIGNED_SHORT, 0);

  const { particles, pieces } = cloth.stats;
  $("stats").textContent = `${particles} particles · ${pieces === 1 ? "whole" : `${pieces} pieces`}`;
}
requestAnimationFrame(frame);
