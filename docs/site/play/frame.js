// The page that runs the code of the playground. It takes its orders from the page around it:
//
//   run {code, settings, isPaused}    settings {settings}    pause {isPaused}    step
//
// and answers: ready, started, state {ticks, hash, …}, error {message, line, column}, log {text}.
//
// It is safe to run anybody's code here: the page is sandboxed without an origin, so it reads
// nothing of the site, and its policy lets it load nothing. It refuses to work with an origin.

import * as THREE from "three";
import * as muslinThree from "muslin/three";
import * as muslin from "muslin";
import * as api from "./api.js";
import { Stage } from "./stage.js";

/** A frame of a step [s]. */
const STEP = 1 / 60;
/** The longest frame; a page that was hidden does not catch up [s]. */
const MAX_FRAME = 0.1;
/** Time between two reports [ms]. */
const REPORT = 250;

const send = (type, message = {}) => parent.postMessage({ type, ...message }, "*");
let isPaused = false;
let hasFailed = false;
let codeUrl = "";

globalThis.playgroundModules = { muslin, "muslin/three": muslinThree, three: THREE, playground: api };

/** Reports an error of the code, with its place in the code if it is known; the code then rests. */
function fail(error, place = placeIn(error?.stack)) {
  if (hasFailed) return;
  hasFailed = true;
  const message = error instanceof Error ? `${error.name}: ${error.message}` : String(error);
  send("error", { message, ...place });
}

/** The line and column of the code that a stack names first. */
function placeIn(stack) {
  const at = typeof stack === "string" && codeUrl ? stack.indexOf(codeUrl) : -1;
  const [, line, column] = (at >= 0 && stack.slice(at + codeUrl.length).match(/^:(\d+):(\d+)/)) || [];
  return line ? { line: Number(line), column: Number(column) } : {};
}

addEventListener("error", (event) => {
  event.preventDefault();
  if (!event.error && codeUrl) {
    // Chromium hides an error after a top-level `await`; the promise of the same module has it.
    import(/* @vite-ignore */ codeUrl).then(() => fail(event.message), fail);
    return;
  }
  const isOwn = event.filename === codeUrl && event.lineno > 0;
  fail(event.error ?? event.message, isOwn ? { line: event.lineno, column: event.colno } : undefined);
});
addEventListener("unhandledrejection", (event) => {
  event.preventDefault();
  fail(event.reason);
});

for (const level of ["log", "info", "warn", "error"]) {
  const text = (value) => {
    try {
      return typeof value === "string" ? value : JSON.stringify(value) ?? String(value);
    } catch {
      return String(value);
    }
  };
  console[level] = (...values) => send("log", { text: values.map(text).join(" ").slice(0, 2000) });
}

/** Calls what the code wants to do in a frame. */
function update(seconds) {
  if (hasFailed) return;
  try {
    for (const one of api.stage.updates) one(seconds);
  } catch (error) {
    fail(error);
  }
}

function report(milliseconds) {
  const { cloths } = api.stage.current;
  const live = cloths.filter(({ cloth }) => !cloth.isFreed).map(({ cloth }) => cloth);
  if (live.length === 0) return;
  const [first] = live;
  send("state", {
    ticks: first.ticks,
    hash: first.stateHash().toString(16).padStart(16, "0"),
    particles: live.reduce((sum, cloth) => sum + cloth.stats.particles, 0),
    milliseconds,
  });
}

function step(seconds) {
  const start = performance.now();
  update(seconds);
  return performance.now() - start;
}

function animate() {
  let last = performance.now();
  let [spent, frames, reported] = [0, 0, 0];
  const frame = (now) => {
    requestAnimationFrame(frame);
    const seconds = Math.min(Math.max(now - last, 0) / 1000, MAX_FRAME);
    last = now;
    if (!isPaused) {
      spent += step(seconds);
      frames++;
    }
    draw(seconds);
    if (frames > 0 && now - reported > REPORT) {
      report(spent / frames);
      [spent, frames, reported] = [0, 0, now];
    }
  };
  requestAnimationFrame(frame);
}

function draw(seconds) {
  try {
    api.stage.current.draw(seconds);
  } catch (error) {
    fail(error);
  }
}

/** Runs the code as a module. */
async function run({ code, settings, isPaused: pausedFirst }) {
  Object.assign(api.settings, settings);
  isPaused = pausedFirst;
  await muslin.default();
  try {
    Object.assign(api.stage, { current: new Stage(document.getElementById("stage"), settings), updates: [] });
  } catch (error) {
    fail(error);
    return;
  }
  codeUrl = URL.createObjectURL(new Blob([code], { type: "text/javascript" }));
  const script = document.createElement("script");
  Object.assign(script, { type: "module", src: codeUrl });
  script.addEventListener("load", () => {
    if (hasFailed) return;
    if (isPaused) report(0);
    send("started");
  });
  document.head.append(script);
  animate();
}

const orders = {
  run: (order) => run(order).catch(fail),
  settings: ({ settings }) => Object.assign(api.settings, settings),
  pause: (order) => {
    isPaused = order.isPaused;
  },
  step: () => {
    const milliseconds = step(STEP);
    report(milliseconds);
  },
};

// With an origin, this page would be the site's own, and code in it could act for its visitors.
if (self.origin === "null" && parent !== self) {
  addEventListener("message", ({ source, data }) => {
    if (source === parent && Object.hasOwn(orders, data?.type)) orders[data.type](data);
  });
  send("ready");
} else {
  document.body.textContent = "This page works only inside the playground.";
}
