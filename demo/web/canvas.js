// Canvas of a demo page: WebGL context, frame loop, pointers and keys for the camera.
// Reads browser events; calls the demo in WebAssembly, which makes all decisions.

export const by = (id) => document.getElementById(id);

/** Sets the state of the page for its style sheet and its tests: running, lost or failed. */
export function setPageState(state) {
  document.documentElement.dataset.state = state;
}

export function fail(reason) {
  by("reason").textContent = reason;
  by("failure").hidden = false;
  setPageState("failed");
}

/** Returns the WebGL 2 context of the canvas; null if it cannot render to half-float textures. */
export function context(canvas) {
  const gl = canvas.getContext("webgl2", {
    alpha: false,
    antialias: false,
    depth: false,
    powerPreference: "high-performance",
  });
  return gl?.getExtension("EXT_color_buffer_float") ? gl : null;
}

/**
 * Draws frames while the page is visible, and calls `updateReadout` four times a second. The cursor
 * is updated each frame: cloth also moves under a pointer that rests.
 */
export function loop(canvas, demo, updateReadout) {
  const gl = canvas.getContext("webgl2");
  let last = 0;
  let lastReadout = 0;
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
    canvas.style.cursor = demo.cursor();
    if (now - lastReadout > 250) {
      lastReadout = now;
      updateReadout();
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
    setPageState("lost");
  });
  canvas.addEventListener("webglcontextrestored", () => {
    demo.attach(context(canvas));
    setPageState("running");
    start();
  });
  start();
}

/**
 * Passes pointer and wheel events to the demo. `press(event, x, y)` handles a pressed pointer and
 * returns whether the demo uses it.
 */
export function listenToPointers(canvas, demo, press) {
  const at = (event) => {
    const box = canvas.getBoundingClientRect();
    return [event.clientX - box.left, event.clientY - box.top];
  };
  canvas.addEventListener("pointerdown", (event) => {
    if (press(event, ...at(event))) canvas.setPointerCapture(event.pointerId);
  });
  canvas.addEventListener("pointermove", (event) => {
    // Browsers merge the moves since the last frame; the event has the latest position.
    demo.drag(event.pointerId, ...at(event));
  });
  for (const name of ["pointerup", "pointercancel", "lostpointercapture"]) {
    canvas.addEventListener(name, (event) => demo.lift(event.pointerId));
  }
  canvas.addEventListener("pointerleave", () => demo.clearHover());
  canvas.addEventListener("contextmenu", (event) => event.preventDefault());
  canvas.addEventListener(
    "wheel",
    (event) => {
      event.preventDefault();
      const unit = [1, 33, canvas.clientHeight][event.deltaMode];
      // A pinch on a trackpad arrives as a wheel event with Ctrl, in much smaller steps.
      demo.wheel(event.deltaY * unit * (event.ctrlKey ? 6 : 1));
    },
    { passive: false },
  );
  for (const name of ["touchstart", "touchmove", "gesturestart"]) {
    // A running scroll cannot be cancelled, and the browser logs an error for an attempt.
    const stop = (event) => event.cancelable && event.preventDefault();
    canvas.addEventListener(name, stop, { passive: false });
  }
}

/** Pointer id of the keyboard. */
const HAND = 4096;

const ARROWS = {
  ArrowLeft: [-0.04, 0],
  ArrowRight: [0.04, 0],
  ArrowUp: [0, -0.04],
  ArrowDown: [0, 0.04],
};

/**
 * Moves the camera by keys: arrows orbit while no control has the focus, plus and minus zoom.
 * Returns whether the key was one of these.
 */
export function moveCamera(event, canvas, demo) {
  if (isFree(event, canvas) && ARROWS[event.key]) {
    demo.orbit(...ARROWS[event.key]);
    event.preventDefault();
    return true;
  }
  if (event.key === "+" || event.key === "-") {
    demo.wheel(event.key === "+" ? -120 : 120);
    return true;
  }
  return false;
}

/**
 * Lets the keyboard grab: Enter presses in the middle of what overlays leave free, arrows drag, Enter
 * or Escape lifts. `press(x, y)` presses, `middle()` returns that place.
 */
export function listenToHand(canvas, demo, middle, press) {
  const hand = by("hand");
  let at;
  const show = () => {
    hand.hidden = !at;
    if (at) [hand.style.left, hand.style.top] = at.map((x) => `${x}px`);
  };
  const lift = () => {
    if (at) demo.lift(HAND);
    at = undefined;
    show();
  };
  canvas.addEventListener("blur", lift);
  canvas.addEventListener("keydown", (event) => {
    const arrow = ARROWS[event.key];
    if (event.key === "Enter" && !event.repeat && !at) {
      at = middle();
      press(HAND, ...at);
    } else if (at && (event.key === "Enter" || event.key === "Escape")) {
      if (!event.repeat) lift();
    } else if (at && arrow) {
      at = at.map((x, i) => x + 600 * arrow[i]);
      demo.drag(HAND, ...at);
    } else {
      return;
    }
    event.preventDefault();
    event.stopPropagation();
    show();
  });
}

/** Returns whether no control has the focus; a focused control uses keys such as the space bar. */
export const isFree = (event, canvas) => event.target === canvas || event.target === document.body;
