// Page of the receipt: canvas, events and buttons. The demo in WebAssembly makes all decisions.

import { by, context, fail, isFree, listenToHand, listenToPointers, loop, moveCamera, setPageState } from "./canvas.js";
import init, { Receipt } from "./muslin_demo.js";

const REDUCED_MOTION = matchMedia("(prefers-reduced-motion: reduce)");
/** Small and touch screens, and reduced motion, get the sheet with fewer particles. */
const USE_SMALL_SHEET = navigator.maxTouchPoints > 0 || innerWidth < 768 || REDUCED_MOTION.matches;
/** Time that the instructions stay, and longest time between the presses of a double press [ms]. */
const INSTRUCTIONS_MS = 3000;
const DOUBLE_PRESS_MS = 350;
/** Where the title and the instructions are above the paper, which hangs in the upper half anyway. */
const NARROW = matchMedia("(max-width: 640px)");
const PAPER_ABOVE_MIDDLE = 40;
const canvas = by("stage");

function run(receipt) {
  const refresh = drawButtons(receipt);
  const applyReducedMotion = () => receipt.setReducedMotion(REDUCED_MOTION.matches);
  REDUCED_MOTION.addEventListener("change", applyReducedMotion);
  applyReducedMotion();
  const updateInsets = () => {
    const top = NARROW.matches ? document.querySelector("header").getBoundingClientRect().bottom : 0;
    receipt.setInsets(0, top, 0, top && PAPER_ABOVE_MIDDLE);
  };
  addEventListener("resize", updateInsets);
  updateInsets();
  loop(canvas, receipt, () => showReadout(JSON.parse(receipt.readout())));
  listenToPointers(canvas, receipt, pressHandler(receipt));
  const middle = () => [innerWidth / 2, innerHeight / 2];
  listenToHand(canvas, receipt, middle, (id, x, y) => receipt.press(id, x, y, false));
  listenToKeys(receipt, refresh);
  by("loading").hidden = true;
  by("pills").hidden = false;
  setTimeout(() => by("instructions").classList.add("gone"), INSTRUCTIONS_MS);

  window.muslinDemo = {
    stateHash: () => receipt.stateHash(),
    stats: () => JSON.parse(receipt.readout()),
    isOn: (name) => receipt.isOn(name),
    play: (ticks) => receipt.play(ticks),
    particleScreen: (i) => {
      const at = receipt.particleScreen(i);
      return at && Array.from(at);
    },
    eye: () => Array.from(receipt.eye()),
  };
  setPageState("running");
}

/** Creates the buttons of the table of controls; returns a function that updates them. */
function drawButtons(receipt) {
  const table = JSON.parse(Receipt.controls());
  const pills = table.map((control) => {
    const made = document.createElement("button");
    // What has only a key needs a button where there is no keyboard.
    if (!control.pill) made.className = "touch";
    made.type = "button";
    made.id = `control-${control.name}`;
    made.textContent = control.label;
    made.title = `${control.about} (${control.key})`;
    made.setAttribute("aria-keyshortcuts", control.key);
    made.addEventListener("click", () => {
      receipt.act(control.name);
      refresh();
    });
    return [made, control];
  });
  by("pills").append(...pills.map(([made]) => made));
  const refresh = () => {
    for (const [made, { name, switch: holds }] of pills) {
      if (holds) made.setAttribute("aria-pressed", String(receipt.isOn(name)));
    }
    by("paused").hidden = !receipt.isOn("paused");
    by("counter").hidden = !receipt.isOn("counter");
  };
  refresh();
  return refresh;
}

function pressHandler(receipt) {
  let last = { time: -DOUBLE_PRESS_MS, x: 0, y: 0 };
  return (event, x, y) => {
    const turns = event.pointerType === "mouse" && event.button === 2;
    if (event.button !== 0 && !turns) return false;
    const before = last;
    last = { time: event.timeStamp, x, y };
    const twice = last.time - before.time < DOUBLE_PRESS_MS && Math.hypot(x - before.x, y - before.y) < 12;
    if (twice && !turns) receipt.crease(x, y);
    receipt.press(event.pointerId, x, y, turns);
    return true;
  };
}

function listenToKeys(receipt, changed) {
  const updateLeaveInPlace = (event) => receipt.setLeaveInPlace(event.shiftKey === true);
  addEventListener("keyup", updateLeaveInPlace);
  addEventListener("blur", updateLeaveInPlace);
  addEventListener("keydown", (event) => {
    if (event.key === "Shift") updateLeaveInPlace(event);
    if (event.ctrlKey || event.metaKey || event.altKey) return;
    if (moveCamera(event, canvas, receipt)) return;
    if (!event.repeat && event.key.length === 1 && (event.key !== " " || isFree(event, canvas))) {
      if (receipt.key(event.key)) {
        event.preventDefault();
        changed();
      }
    }
  });
}

function showReadout(stats) {
  by("stat-fps").textContent = stats.fps.toFixed(0);
  by("stat-particles").textContent = stats.particles.toLocaleString("en");
  by("stat-constraints").textContent = stats.constraints.toLocaleString("en");
  by("stat-milliseconds").textContent = `${stats.milliseconds.toFixed(2)} ms`;
}

try {
  // Browsers load and compile the module while they start to draw.
  const ready = init({ module_or_path: new URL("./muslin_demo_bg.wasm", import.meta.url) });
  // Without WebGL nobody awaits it.
  ready.catch(() => {});
  const gl = context(canvas);
  if (gl) {
    await ready;
    const receipt = new Receipt(USE_SMALL_SHEET);
    receipt.attach(gl);
    run(receipt);
  } else {
    by("loading").hidden = true;
    fail("This scene needs WebGL 2: try a current browser.");
  }
} catch (error) {
  by("loading").hidden = true;
  fail(`The scene could not start: ${error.message}`);
}
