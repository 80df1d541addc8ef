// The page's part: it hands its canvas to a worker, and tells it of pointers, sizes and switches.

const $ = (id) => document.getElementById(id);
const canvas = $("stage");
const worker = new Worker(new URL("./worker.js", import.meta.url), { type: "module" });
const tell = (what, ...rest) => worker.postMessage([what, ...rest]);

const offscreen = canvas.transferControlToOffscreen();
worker.postMessage(["start", offscreen], [offscreen]);

function fit() {
  const { clientWidth: width, clientHeight: height } = canvas;
  const { top, right } = document.querySelector(".panel").getBoundingClientRect();
  const covered = right > width / 2 ? [0, height - top] : width < 1100 ? [right, 0] : [0, 0];
  tell("fit", width, height, covered, Math.min(devicePixelRatio, 2));
}
addEventListener("resize", fit);
fit();

for (const type of ["pointerdown", "pointermove", "pointerup", "pointercancel"]) {
  canvas.addEventListener(type, (event) => {
    if (type === "pointerdown") canvas.setPointerCapture(event.pointerId);
    const { left, top, width, height } = canvas.getBoundingClientRect();
    const x = (2 * (event.clientX - left)) / width - 1;
    const y = 1 - (2 * (event.clientY - top)) / height;
    tell(type, event.pointerId, x, y);
  });
}
$("wind").addEventListener("input", ({ target }) => {
  document.querySelector("output").value = target.value;
  tell("wind", target.valueAsNumber);
});
$("reset").addEventListener("click", () => tell("reset"));
$("busy").addEventListener("click", () => {
  const end = performance.now() + 1000;
  while (performance.now() < end); // and the cloth goes on
});
worker.addEventListener("message", ({ data }) => {
  if (data.cursor) canvas.style.cursor = data.cursor;
  if (data.stats) $("stats").textContent = data.stats;
});
