// The page: transfers its canvas to a worker, and posts pointer events, sizes and control values to
// it.

const $ = (id) => document.getElementById(id);
const canvas = $("stage");
const worker = new Worker(new URL("./worker.js", import.meta.url), { type: "module" });
const post = (name, ...rest) => worker.postMessage([name, ...rest]);

const offscreen = canvas.transferControlToOffscreen();
worker.postMessage(["start", offscreen], [offscreen]);

function fit() {
  const { clientWidth: width, clientHeight: height } = canvas;
  const { top, right } = document.querySelector(".panel").getBoundingClientRect();
  const covered = right > width / 2 ? [0, height - top] : width < 1100 ? [right, 0] : [0, 0];
  post("fit", width, height, covered, Math.min(devicePixelRatio, 2));
}
addEventListener("resize", fit);
fit();

for (const type of ["pointerdown", "pointermove", "pointerup", "pointercancel"]) {
  canvas.addEventListener(type, (event) => {
    if (type === "pointerdown") canvas.setPointerCapture(event.pointerId);
    const { left, top, width, height } = canvas.getBoundingClientRect();
    const x = (2 * (event.clientX - left)) / width - 1;
    const y = 1 - (2 * (event.clientY - top)) / height;
    post(type, event.pointerId, x, y);
  });
}
$("wind").addEventListener("input", ({ target }) => {
  document.querySelector("output").value = target.value;
  post("wind", target.valueAsNumber);
});
$("reset").addEventListener("click", () => post("reset"));
$("busy").addEventListener("click", () => {
  const end = performance.now() + 1000;
  while (performance.now() < end); // blocks the page for a second; the cloth still moves
});
worker.addEventListener("message", ({ data }) => {
  if (data.cursor) canvas.style.cursor = data.cursor;
  if (data.stats) $("stats").textContent = data.stats;
});
