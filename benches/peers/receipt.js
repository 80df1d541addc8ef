// The receipt as its brief has it, with all that it asks for, against real time.

/** Ticks a second. */
const RATE = 120;
/** Sheets of 40 x 60 at 120 Hz, 8 substeps of 6 sweeps each, particles that push each other apart, a floor. */
const DESC = {
  columns: 40,
  rows: 60,
  spacing: 0.12,
  origin: [-2.34, 3.54, 0],
  pinMode: "top-corners",
  material: {
    stretchStiffnessWarp: 0,
    stretchStiffnessWeft: 0,
    shearStiffness: 0,
    bendStiffness: 1,
    drag: 0,
    tearStretch: 0,
  },
  settings: {
    tick: 1 / RATE,
    substeps: 8,
    iterations: 6,
    gravity: [0, -9.81, 0],
    damping: -Math.log(0.99) * 960,
    maxDisplacement: 4,
    tethers: false,
    selfCollision: "particles",
    selfDistance: 0.08,
  },
};
const FLOOR = {
  shape: "plane",
  position: [0, -4, 0],
  thickness: 0,
  friction: 0,
  restitution: 0.2,
  tangentialRestitution: 0.8,
};

const { columns: COLUMNS, rows: ROWS } = DESC;

/** What it goes through, one after the other: seconds before it is timed, what is done first, and at each tick. */
const STATES = [
  { name: "at rest", seconds: 2 },
  { name: "in wind", seconds: 2, begin: (cloth) => (cloth.wind = { model: "sine-field", velocity: [3, 0, 0] }) },
  {
    name: "dragged about by its hem",
    seconds: 1,
    begin(cloth) {
      cloth.wind = { model: "sine-field", velocity: [0, 0, 0] };
      this.grab = cloth.grabParticle((ROWS - 1) * COLUMNS + COLUMNS / 2);
      this.from = this.grab.position;
    },
    act(tick) {
      const [x, y, z] = this.from;
      const turned = (2 * Math.PI * tick) / (1.5 * RATE);
      this.grab.moveTo([x + 1.5 * Math.sin(turned), y + 1.5 - 1.5 * Math.cos(turned), z + Math.sin(2 * turned)]);
    },
    end() {
      this.grab.release();
    },
  },
  {
    name: "crumpled in a fist",
    seconds: 1,
    begin(cloth) {
      cloth.unpinAll();
      this.palms = palms(cloth);
    },
    act(tick) {
      // Closed, they stay where they are.
      const closed = (tick + 1) / RATE / CLOSING;
      if (closed >= 1) return;
      const share = closed * closed * (3 - 2 * closed);
      for (const { collider, out, from, rotation } of this.palms)
        collider.moveTo(at(out, from + share * (BALL - from)), rotation);
    },
    end() {
      for (const { collider } of this.palms) collider.remove();
    },
  },
  { name: "crumpled, let go, on the floor", seconds: 4 },
];

/** So many palms close all around a place, so far from it, in so many seconds, as the demo's do the first time. */
const [PALMS, MIDDLE, BALL, CLOSING] = [32, [0, -1, 0], 1.1, 1];

const at = (out, distance) => MIDDLE.map((x, axis) => x + out[axis] * distance);

/** Planes just outside, in directions each turned on by the golden angle: each with its way out, and how far out it is. */
function palms(cloth) {
  const { positions } = cloth;
  return Array.from({ length: PALMS }, (_, palm) => {
    const y = 1 - (2 * palm + 1) / PALMS;
    const [flat, turned] = [Math.sqrt(1 - y * y), 2.399963 * palm];
    const out = [flat * Math.cos(turned), y, flat * Math.sin(turned)];
    let from = BALL;
    for (let i = 0; i < positions.length; i += 3) {
      const way = out.reduce((sum, n, axis) => sum + n * (positions[i + axis] - MIDDLE[axis]), 0);
      from = Math.max(from, way);
    }
    // The shortest turn from up to inwards.
    const [x, z, w] = [-out[2], out[0], 1 - y];
    const length = Math.hypot(x, z, w);
    const rotation = [x / length, 0, z / length, w / length];
    const collider = cloth.addCollider({ shape: "plane", position: at(out, from), rotation, friction: 0.2 });
    return { collider, out, from, rotation };
  });
}

export const RECEIPT_HEAD = [["receipt of the brief"], ["ms a tick", "median", "x real time"]];

/** Figures of its states [ms a tick]: the least and the median of some rounds of so many seconds each. */
export function receipt({ Cloth }, { rounds, slice }) {
  const cloth = Cloth.grid(DESC);
  cloth.addCollider(FLOOR);
  const ticks = Math.max(1, Math.round(slice * RATE));
  const figures = STATES.map((state) => {
    let tick = 0;
    const run = (count) => {
      for (const end = tick + count; tick < end; tick++) {
        state.act?.(tick);
        cloth.step();
        cloth.normals;
      }
    };
    state.begin?.(cloth);
    run(Math.max(2, Math.min(1, slice * 4) * state.seconds * RATE));
    const times = [];
    for (let round = 0; round < rounds; round++) {
      const start = performance.now();
      run(ticks);
      times.push((performance.now() - start) / ticks);
    }
    state.end?.();
    times.sort((a, b) => a - b);
    return { name: state.name, least: times[0], median: times[times.length >> 1] };
  });
  if (!cloth.positions.every(Number.isFinite)) throw new Error("the receipt is no sheet any more");
  cloth.free();
  return figures;
}

/** The rows of a table. */
export const receiptRows = (figures) =>
  figures.map(({ name, least, median }) => [name, least.toFixed(3), median.toFixed(3), `${(1000 / RATE / median).toFixed(1)} x`]);
