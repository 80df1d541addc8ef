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
    seconds: 1.2,
    begin(cloth) {
      cloth.unpinAll();
      this.fingers = fingers(cloth);
    },
    act(tick) {
      const closed = Math.min(tick / RATE / 1.1, 1);
      const share = closed * closed * (3 - 2 * closed);
      for (const { grab, from, to } of this.fingers) grab.moveTo(from.map((x, i) => x + (to[i] - x) * share));
    },
    end() {
      for (const { grab } of this.fingers) grab.release();
    },
  },
  { name: "crumpled, let go, on the floor", seconds: 4 },
];

/** Eight rows of six fingers that hold it, each with where it takes hold and where in a fist it goes. */
function fingers(cloth) {
  const [down, across, radius] = [8, 6, 0.65];
  const middle = [0, -1, 0];
  return Array.from({ length: down * across }, (_, finger) => {
    const [i, j] = [Math.floor(finger / across), finger % across];
    const [row, column] = [Math.floor((i * (ROWS - 1)) / (down - 1)), Math.floor((j * (COLUMNS - 1)) / (across - 1))];
    const grab = cloth.grabParticle(row * COLUMNS + column);
    // By turns to the front and to the back, so that it buckles between the fingers.
    const to = [j / (across - 1) - 0.5, 0.5 - i / (down - 1), (i + j) % 2 ? -0.38 : 0.38];
    return { grab, from: grab.position, to: to.map((x, axis) => middle[axis] + radius * x) };
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
