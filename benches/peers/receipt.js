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

/** What it goes through: seconds before it is timed, and what is done first. */
const STATES = [
  ["hanging", 2, () => {}],
  ["in wind", 2, (cloth) => (cloth.wind = { model: "sine-field", velocity: [3, 0, 0] })],
  ["crumpled on the floor", 4, (cloth) => {
    cloth.wind = { model: "sine-field", velocity: [0, 0, 0] };
    cloth.unpinAll();
  }],
];

export const RECEIPT_HEAD = [["receipt of the brief"], ["ms a tick", "median", "x real time"]];

/** Rows of its states, each the least and the median of some rounds of a quarter of a second each. */
export function receipt({ Cloth }, isTest) {
  const cloth = Cloth.grid(DESC);
  cloth.addCollider(FLOOR);
  const ticks = isTest ? 1 : RATE / 4;
  const rows = STATES.map(([name, seconds, begin]) => {
    begin(cloth);
    cloth.step(isTest ? 2 : seconds * RATE);
    const times = [];
    for (let round = 0; round < (isTest ? 1 : 15); round++) {
      const start = performance.now();
      for (let tick = 0; tick < ticks; tick++) {
        cloth.step();
        cloth.normals;
      }
      times.push((performance.now() - start) / ticks);
    }
    times.sort((a, b) => a - b);
    const [least, median] = [times[0], times[times.length >> 1]];
    return [name, least.toFixed(3), median.toFixed(3), `${(1000 / RATE / median).toFixed(1)} x`];
  });
  if (!cloth.positions.every(Number.isFinite)) throw new Error("the receipt is no sheet any more");
  cloth.free();
  return rows;
}
