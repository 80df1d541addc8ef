// Page of the cloth scenes: canvas, events, storage and clock. The demo in WebAssembly makes all
// decisions.

import { by, context, fail, isFree, listenToHand, listenToPointers, loop, moveCamera, setPageState } from "./canvas.js";
import init, { Demo } from "./muslin_demo.js";
import { drawPanel } from "./panel.js";
import { connectPhoto } from "./photo.js";

const KEY = "cloth3d.settings.v1";
const NARROW = matchMedia("(max-width: 640px)");
const REDUCED_MOTION = matchMedia("(prefers-reduced-motion: reduce)");
/** Width of the panel, distance of the instructions from the bottom, height of the footer; with margins. */
const PANEL_WIDTH = 300;
const HELP_BOTTOM = 68;
const FOOTER = 48;
/** In a lower window the instructions cover the scene. */
const LOW = 560;
const canvas = by("stage");

// A private window may refuse storage; the demo then runs without it.
function readSettings() {
  try {
    return localStorage.getItem(KEY) ?? undefined;
  } catch {
    return undefined;
  }
}

function saveSettings(settings) {
  try {
    localStorage.setItem(KEY, settings);
  } catch {
    // The settings are not saved.
  }
}

function run(demo) {
  const saveNow = () => saveSettings(demo.settings());
  const updatePanel = drawPanel(by("controls"), JSON.parse(Demo.controls()), {
    get: (name) => demo.get(name),
    text: (name) => demo.text(name),
    isEnabled: (name) => demo.isEnabled(name),
    set: (name, value) => {
      demo.set(name, value);
      refresh();
      saveNow();
    },
  });
  const showPhoto = connectPhoto(demo, () => refresh());
  const refresh = () => {
    updatePanel();
    showPhoto();
    for (const part of document.querySelectorAll("#help .walk")) part.hidden = demo.walker().length === 0;
    updateInsets();
  };
  const updateInsets = connectInsets(demo);
  refresh();
  // The demo has corrected invalid values; this corrects them in the storage too.
  saveNow();

  const applyReducedMotion = () => demo.setReducedMotion(REDUCED_MOTION.matches);
  REDUCED_MOTION.addEventListener("change", applyReducedMotion);
  applyReducedMotion();

  by("stages").addEventListener("toggle", () => demo.timeStages(by("stages").open));
  loop(canvas, demo, () => {
    showReadout(JSON.parse(demo.readout()));
    if (by("stages").open) showStages(JSON.parse(demo.stageTimes()));
  });
  // Any input ends the drift of the camera, also one to the panel.
  for (const name of ["pointerdown", "keydown"]) {
    addEventListener(name, () => demo.noteInput(), { capture: true });
  }
  listenToPointers(canvas, demo, (event, x, y) => {
    if (event.pointerType === "mouse" && event.button !== 0) return false;
    demo.holdBlade(event.shiftKey);
    demo.press(event.pointerId, x, y);
    by("help").dispatchEvent(new Event("touched"));
    return true;
  });
  listenToKeys(demo, () => {
    refresh();
    saveNow();
  });
  listenToHand(canvas, demo, () => middle(), (id, x, y) => demo.press(id, x, y));
  connectOverlays();
  for (const id of ["panel", "help", "ask"]) by(id).hidden = false;
  updateInsets();

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
    walker: () => Array.from(demo.walker()),
  };
  setPageState("running");
}

/**
 * Returns the scene of the page and the choices of the address, such as `?scene=curtain&fabric=denim`,
 * with numbers of options.
 */
function linkedChoices() {
  const wanted = new URLSearchParams(location.search);
  const { scene } = document.documentElement.dataset;
  if (scene && !wanted.has("scene")) wanted.set("scene", scene);
  const choice = ({ name, options = [] }) =>
    [name, options.findIndex((label) => label.toLowerCase() === wanted.get(name))];
  const choices = JSON.parse(Demo.controls()).map(choice).filter(([, option]) => option >= 0);
  return choices.map(([name, option]) => `${name}=${option}`).join("&");
}

function showReadout(stats) {
  by("stat-particles").textContent = stats.particles.toLocaleString("en");
  by("stat-constraints").textContent = stats.constraints.toLocaleString("en");
  by("stat-fps").textContent = `${stats.fps.toFixed(0)} fps`;
  by("stat-milliseconds").textContent = `${stats.milliseconds.toFixed(2)} ms`;
}

// The bars are relative to the longest stage.
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

/** Directions of the arrows that walk a person: right, and away from the camera. */
const WAYS = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1] };

/**
 * Walks the person of the scene, if it has one, while arrows are held and no control has the focus.
 * Returns a function that tells whether a pressed key does so. With Shift they orbit.
 */
function listenToWalk(demo) {
  const held = new Set();
  const walk = () => demo.walk(...[0, 1].map((i) => [...held].reduce((sum, key) => sum + WAYS[key][i], 0)));
  const stop = () => {
    held.clear();
    walk();
  };
  addEventListener("blur", stop);
  addEventListener("keyup", (event) => {
    if (held.delete(event.key)) walk();
  });
  return (event) => {
    if (!WAYS[event.key] || event.shiftKey || !isFree(event, canvas)) return false;
    held.add(event.key);
    if (walk()) return true;
    held.clear();
    return false;
  };
}

function listenToKeys(demo, changed) {
  const walks = listenToWalk(demo);
  const updateBlade = (event) => demo.holdBlade(event.shiftKey === true);
  addEventListener("keyup", updateBlade);
  addEventListener("blur", updateBlade);
  addEventListener("keydown", (event) => {
    if (event.key === "Shift") updateBlade(event);
    if (event.ctrlKey || event.metaKey || event.altKey) return;
    if (walks(event)) {
      event.preventDefault();
      return;
    }
    if (moveCamera(event, canvas, demo)) return;
    if (event.key === "?" || event.key === "h") {
      by("ask").click();
    } else if (event.key === "c") {
      by("collapse").click();
    } else if (event.key === "Escape") {
      by("dismiss").click();
    } else if (event.key.length === 1 && (event.key !== " " || isFree(event, canvas))) {
      if (demo.key(event.key, event.shiftKey)) {
        event.preventDefault();
        changed();
      }
    }
  });
}

/** Returns how far overlays reach into the canvas from left and bottom; on a phone the panel is at the bottom. */
function insets() {
  if (document.body.classList.contains("photo")) return [0, 0];
  const [panel, help] = ["panel", "help"].map(by);
  const isOpen = !panel.classList.contains("closed");
  if (isOpen && NARROW.matches) return [0, innerHeight - panel.offsetTop];
  const bottom = help.classList.contains("gone") ? FOOTER : help.offsetHeight + HELP_BOTTOM;
  return [isOpen ? PANEL_WIDTH : 0, innerHeight < LOW ? 0 : bottom];
}

/** Returns the middle of what overlays leave free of the canvas. */
function middle() {
  const [left, bottom] = insets();
  return [(left + innerWidth) / 2, (innerHeight - bottom) / 2];
}

/** Tells the demo what overlays leave free; returns a function that does so again. */
function connectInsets(demo) {
  const update = () => {
    const [left, bottom] = insets();
    demo.setInsets(left, 0, 0, bottom);
  };
  addEventListener("resize", update);
  for (const id of ["panel", "help"]) new MutationObserver(update).observe(by(id), { attributeFilter: ["class"] });
  return update;
}

function connectOverlays() {
  const [panel, collapse, help, ask] = ["panel", "collapse", "help", "ask"].map(by);
  // On a narrow screen both would be in the same place.
  const setPanelOpen = (on) => {
    if (on && NARROW.matches) showHelp(false);
    panel.classList.toggle("closed", !on);
    collapse.setAttribute("aria-expanded", String(on));
  };
  collapse.addEventListener("click", () => setPanelOpen(panel.classList.contains("closed")));
  const showHelp = (on) => {
    if (on && NARROW.matches) setPanelOpen(false);
    help.classList.toggle("gone", !on);
    ask.setAttribute("aria-expanded", String(on));
  };
  ask.addEventListener("click", () => showHelp(help.classList.contains("gone")));
  by("dismiss").addEventListener("click", () => {
    // Otherwise keys would go to a button that nobody sees.
    if (document.activeElement === by("dismiss")) canvas.focus({ focusVisible: false });
    showHelp(false);
  });
  help.addEventListener("touched", () => showHelp(false));
  NARROW.addEventListener("change", () => setPanelOpen(!NARROW.matches));
  setPanelOpen(!NARROW.matches);
  showHelp(true);
}

try {
  // Browsers load and compile the module while they start to draw.
  const ready = init({ module_or_path: new URL("./muslin_demo_bg.wasm", import.meta.url) });
  // Without WebGL nobody awaits it.
  ready.catch(() => {});
  const gl = context(canvas);
  if (gl) {
    await ready;
    const demo = new Demo(readSettings(), linkedChoices());
    demo.attach(gl);
    run(demo);
  } else {
    fail("This showcase needs WebGL 2: try a current browser.");
  }
} catch (error) {
  fail(`The demo could not start: ${error.message}`);
}
