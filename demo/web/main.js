// The page: canvas, events, storage and clock. What any of it means is decided in the wasm.

import init, { Demo } from "./muslin_demo.js";
import { drawPanel } from "./panel.js";

const KEY = "cloth3d.settings.v1";
const NARROW = matchMedia("(max-width: 640px)");
const CALM = matchMedia("(prefers-reduced-motion: reduce)");
const by = (id) => document.getElementById(id);
const canvas = by("stage");

function fail(reason) {
  by("reason").textContent = reason;
  by("failure").hidden = false;
  document.documentElement.dataset.state = "failed";
}

// A private window may refuse storage; the demo runs without it.
function kept() {
  try {
    return localStorage.getItem(KEY) ?? undefined;
  } catch {
    return undefined;
  }
}

function keep(settings) {
  try {
    localStorage.setItem(KEY, settings);
  } catch {
    // Nothing is kept then.
  }
}

function context() {
  const gl = canvas.getContext("webgl2", {
    alpha: false,
    antialias: false,
    depth: false,
    powerPreference: "high-performance",
  });
  return gl?.getExtension("EXT_color_buffer_float") ? gl : null;
}

function run(demo) {
  const keepNow = () => keep(demo.settings());
  const refresh = drawPanel(by("controls"), JSON.parse(Demo.controls()), {
    get: (name) => demo.get(name),
    text: (name) => demo.text(name),
    set: (name, value) => {
      demo.set(name, value);
      refresh();
      keepNow();
    },
  });
  // What was corrupt or out of range is put right in the storage too.
  keepNow();

  const calm = () => demo.setCalm(CALM.matches);
  CALM.addEventListener("change", calm);
  calm();

  by("stages").addEventListener("toggle", () => demo.timeStages(by("stages").open));
  loop(demo);
  followPointers(demo);
  followKeys(demo, () => {
    refresh();
    keepNow();
  });
  overlays();
  for (const id of ["panel", "help", "ask"]) by(id).hidden = false;

  window.muslinDemo = {
    stateHash: () => demo.stateHash(),
    stats: () => JSON.parse(demo.readout()),
    settings: () => JSON.parse(demo.settings()),
    stages: () => JSON.parse(demo.stageTimes()),
    particleScreen: (i) => {
      const at = demo.particleScreen(i);
      return at && Array.from(at);
    },
    eye: () => Array.from(demo.eye()),
  };
  document.documentElement.dataset.state = "running";
}

function loop(demo) {
  const gl = canvas.getContext("webgl2");
  let last = 0;
  let shown = 0;
  let request = 0;

  function frame(now) {
    request = requestAnimationFrame(frame);
    if (gl.isContextLost()) return;
    const seconds = last ? Math.max(0, now - last) / 1000 : 0;
    last = now;
    const scale = Math.min(devicePixelRatio || 1, 2);
    const [wide, high] = [canvas.clientWidth, canvas.clientHeight];
    if (!wide || !high) return;
    const [width, height] = [Math.round(wide * scale), Math.round(high * scale)];
    if (canvas.width !== width || canvas.height !== height) {
      canvas.width = width;
      canvas.height = height;
    }
    demo.resize(wide, high);
    demo.frame(seconds, width, height);
    if (now - shown > 250) {
      shown = now;
      show(JSON.parse(demo.readout()));
      if (by("stages").open) showStages(JSON.parse(demo.stageTimes()));
    }
  }

  function start() {
    if (!request && !document.hidden && !gl.isContextLost()) {
      last = 0;
      request = requestAnimationFrame(frame);
    }
  }

  function stop() {
    cancelAnimationFrame(request);
    request = 0;
  }

  document.addEventListener("visibilitychange", () => (document.hidden ? stop() : start()));
  canvas.addEventListener("webglcontextlost", (event) => {
    event.preventDefault();
    stop();
    demo.detach();
    document.documentElement.dataset.state = "lost";
  });
  canvas.addEventListener("webglcontextrestored", () => {
    demo.attach(context());
    document.documentElement.dataset.state = "running";
    start();
  });
  start();
}

function show(stats) {
  by("stat-particles").textContent = stats.particles.toLocaleString("en");
  by("stat-constraints").textContent = stats.constraints.toLocaleString("en");
  by("stat-fps").textContent = `${stats.fps.toFixed(0)} fps`;
  by("stat-milliseconds").textContent = `${stats.milliseconds.toFixed(2)} ms`;
}

// Bars are drawn against the longest stage.
function showStages(stages) {
  const list = by("stage-times");
  const longest = Math.max(0.05, ...stages.map((stage) => stage.milliseconds));
  if (list.children.length !== stages.length) {
    const row = ({ name }) => {
      const made = document.createElement("div");
      made.append(document.createElement("dt"), document.createElement("dd"));
      made.firstChild.textContent = name;
      return made;
    };
    list.replaceChildren(...stages.map(row));
  }
  stages.forEach(({ milliseconds }, i) => {
    const row = list.children[i];
    row.style.setProperty("--share", `${(100 * milliseconds) / longest}%`);
    row.lastChild.textContent = `${milliseconds.toFixed(3)} ms`;
  });
}

function followPointers(demo) {
  const at = (event) => {
    const box = canvas.getBoundingClientRect();
    return [event.clientX - box.left, event.clientY - box.top];
  };
  const cursor = () => {
    canvas.style.cursor = demo.cursor();
  };
  canvas.addEventListener("pointerdown", (event) => {
    if (event.pointerType === "mouse" && event.button !== 0) return;
    canvas.setPointerCapture(event.pointerId);
    demo.holdBlade(event.shiftKey);
    demo.press(event.pointerId, ...at(event));
    cursor();
    by("help").dispatchEvent(new Event("touched"));
  });
  canvas.addEventListener("pointermove", (event) => {
    // The last of the moves since the frame before is where the pointer is.
    demo.drag(event.pointerId, ...at(event));
    cursor();
  });
  for (const name of ["pointerup", "pointercancel", "lostpointercapture"]) {
    canvas.addEventListener(name, (event) => {
      demo.lift(event.pointerId);
      cursor();
    });
  }
  canvas.addEventListener("pointerleave", () => demo.leave());
  canvas.addEventListener("contextmenu", (event) => event.preventDefault());
  canvas.addEventListener(
    "wheel",
    (event) => {
      event.preventDefault();
      const unit = [1, 33, canvas.clientHeight][event.deltaMode];
      // A trackpad's pinch arrives as a wheel with Ctrl held, in much smaller steps.
      demo.wheel(event.deltaY * unit * (event.ctrlKey ? 6 : 1));
    },
    { passive: false },
  );
  for (const name of ["touchstart", "touchmove", "gesturestart"]) {
    // A scroll that is under way cannot be stopped, and the browser complains of attempts.
    const stop = (event) => event.cancelable && event.preventDefault();
    canvas.addEventListener(name, stop, { passive: false });
  }
}

function followKeys(demo, changed) {
  const arrows = {
    ArrowLeft: [-0.04, 0],
    ArrowRight: [0.04, 0],
    ArrowUp: [0, -0.04],
    ArrowDown: [0, 0.04],
  };
  const blade = (event) => {
    demo.holdBlade(event.shiftKey === true);
    canvas.style.cursor = demo.cursor();
  };
  addEventListener("keyup", blade);
  addEventListener("blur", blade);
  addEventListener("keydown", (event) => {
    if (event.key === "Shift") blade(event);
    if (event.ctrlKey || event.metaKey || event.altKey) return;
    const free = event.target === canvas || event.target === document.body;
    if (free && arrows[event.key]) {
      demo.orbit(...arrows[event.key]);
      event.preventDefault();
    } else if (event.key === "+" || event.key === "-") {
      demo.wheel(event.key === "+" ? -120 : 120);
    } else if (event.key === "?" || event.key === "h") {
      by("ask").click();
    } else if (event.key === "c") {
      by("collapse").click();
    } else if (event.key === "Escape") {
      by("dismiss").click();
    } else if (event.key.length === 1 && (event.key !== " " || free)) {
      if (demo.key(event.key, event.shiftKey)) {
        event.preventDefault();
        changed();
      }
    }
  });
}

function overlays() {
  const [panel, collapse, help, ask] = ["panel", "collapse", "help", "ask"].map(by);
  const open = (on) => {
    panel.classList.toggle("closed", !on);
    collapse.setAttribute("aria-expanded", String(on));
  };
  collapse.addEventListener("click", () => open(panel.classList.contains("closed")));
  NARROW.addEventListener("change", () => open(!NARROW.matches));
  open(!NARROW.matches);

  const explain = (on) => {
    help.classList.toggle("gone", !on);
    ask.setAttribute("aria-expanded", String(on));
  };
  ask.addEventListener("click", () => explain(help.classList.contains("gone")));
  by("dismiss").addEventListener("click", () => explain(false));
  help.addEventListener("touched", () => explain(false));
  explain(true);
}

try {
  const gl = context();
  if (gl) {
    await init({ module_or_path: new URL("./muslin_demo_bg.wasm", import.meta.url) });
    const demo = new Demo(kept());
    demo.attach(gl);
    run(demo);
  } else {
    fail("This showcase needs WebGL 2: try a current browser.");
  }
} catch (error) {
  fail(`The demo could not start: ${error.message}`);
}
