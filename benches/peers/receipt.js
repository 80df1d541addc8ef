// The receipt scene with the numbers of its brief: the time of a tick in several situations, and
// its ratio to real time.

/** Ticks per second. */
const RATE = 120;
/** A sheet of 40 x 60 at 120 Hz with 8 substeps of 6 sweeps and particle collision. */
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

/**
 * The situations, one after the other: seconds before timing, and what is done at the start, at
 * each tick and at the end.
 */
const SITUATIONS = [
  { name: "at rest", seconds: 2 },
  { name: "in wind", seconds: 2, begin: (cloth) => (cloth.wind = { model: "sine-field", velocity: [3, 0, 0] }) },
  {
    name: "dragged by its hem",
    seconds: 1,
    begin(cloth) {
      cloth.wind = { model: "sine-field", velocity: [0, 0, 0] };
      this.grab = cloth.grabParticle((ROWS - 1) * COLUMNS + COLUMNS / 2);
      this.from = this.grab.position;
    },
    act(tick) {
      const [x, y, z] = this.from;
      const angle = (2 * Math.PI * tick) / (1.5 * RATE);
      this.grab.moveTo([x + 1.5 * Math.sin(angle), y + 1.5 - 1.5 * Math.cos(angle), z + Math.sin(2 * angle)]);
    },
    end() {
      this.grab.release();
    },
  },
  {
    name: "being crumpled",
    seconds: 1,
    begin(cloth) {
      cloth.unpinAll();
      this.palms = addPalms(cloth);
    },
    act(tick) {
      // After closing, they stay where they are.
      const progress = (tick + 1) / RATE / CLOSING;
      if (progress >= 1) return;
      const share = progress * progress * (3 - 2 * progress);
      for (const { collider, outward, start, rotation } of this.palms) {
        collider.moveTo(pointAt(outward, start + share * (CLOSED_RADIUS - start)), rotation);
      }
    },
    end() {
      for (const { collider } of this.palms) collider.remove();
    },
  },
  { name: "crumpled, released, on the floor", seconds: 4 },
];

/**
 * Number of plane colliders that close in, their centre and final distance from it [m], and the
 * duration [s].
 */
const [PALMS, CENTRE, CLOSED_RADIUS, CLOSING] = [32, [0, -1, 0], 1.1, 1];

/** Returns the point at a distance from the centre. */
const pointAt = (outward, distance) => CENTRE.map((x, axis) => x + outward[axis] * distance);

/**
 * Adds planes just outside the sheet that face its centre, in directions of a Fibonacci lattice.
 */
function addPalms(cloth) {
  const { positions } = cloth;
  return Array.from({ length: PALMS }, (_, palm) => {
    const y = 1 - (2 * palm + 1) / PALMS;
    const [horizontal, angle] = [Math.sqrt(1 - y * y), 2.399963 * palm];
    const outward = [horizontal * Math.cos(angle), y, horizontal * Math.sin(angle)];
    let start = CLOSED_RADIUS;
    for (let i = 0; i < positions.length; i += 3) {
      const distance = outward.reduce((sum, n, axis) => sum + n * (positions[i + axis] - CENTRE[axis]), 0);
      start = Math.max(start, distance);
    }
    // The shortest rotation from +y to the inward direction.
    const [x, z, w] = [-outward[2], outward[0], 1 - y];
    const length = Math.hypot(x, z, w);
    const rotation = [x / length, 0, z / length, w / length];
    const collider = cloth.addCollider({ shape: "plane", position: pointAt(outward, start), rotation, friction: 0.2 });
    return { collider, outward, start, rotation };
  });
}

export const RECEIPT_HEAD = [["receipt of the brief"], ["ms per tick", "median", "x real time"]];

/**
 * Returns the minimum and median time per tick in each situation [ms], of `rounds` rounds of
 * `slice` [s] each. `clock` returns a time, or a promise of one [ms].
 */
export async function measureReceipt({ Cloth }, { rounds, slice }, clock = () => performance.now()) {
  const cloth = Cloth.grid(DESC);
  cloth.addCollider(FLOOR);
  const ticks = Math.max(1, Math.round(slice * RATE));
  const results = [];
  for (const situation of SITUATIONS) {
    let tick = 0;
    const run = (count) => {
      for (const end = tick + count; tick < end; tick++) {
        situation.act?.(tick);
        cloth.step();
        cloth.normals;
      }
    };
    situation.begin?.(cloth);
    run(Math.max(2, Math.min(1, slice * 4) * situation.seconds * RATE));
    const times = [];
    for (let round = 0; round < rounds; round++) {
      const start = await clock();
      run(ticks);
      times.push(((await clock()) - start) / ticks);
    }
    situation.end?.();
    times.sort((a, b) => a - b);
    results.push({ name: situation.name, min: times[0], median: times[times.length >> 1] });
  }
  if (!cloth.positions.every(Number.isFinite)) throw new Error("the receipt has positions that are not finite");
  cloth.free();
  return results;
}

/** Returns the rows of a table. */
export const receiptRows = (results) =>
  results.map(({ name, min, median }) => [name, min.toFixed(3), median.toFixed(3), `${(1000 / RATE / median).toFixed(1)} x`]);
