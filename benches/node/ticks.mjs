// What whole ticks cost, normals included, and how the cloth hangs after a while.

import { inTurn, seconds } from "./measure.mjs";
import { grid, hangingSheet } from "./sheets.mjs";
import { Table, percent, times } from "./table.mjs";

/** Ways to hang: by what, and whether there is wind. */
const WAYS = [
  ["top edge", "top-edge", false],
  ["top edge, wind", "top-edge", true],
  ["top corners", "top-corners", false],
  ["top corners, wind", "top-corners", true],
];

const NUMBERS = [
  "ms a tick",
  "median",
  "ns a projection",
  "x real time",
  "plain ms",
  "faster",
  "hung for",
  "max stretch",
  "mean",
  "plain's max",
  "rms mm/s",
];

export async function ticks(cases, makePlain, isTest) {
  const table = new Table(["sheet", "tick", "sweeps", "hung by"], NUMBERS);
  for (const timed of cases) {
    for (const way of WAYS) {
      table.push(await measure(timed, way, makePlain, isTest));
    }
  }
  console.log(`
Ticks in wasm: ms of one thread for a whole tick with normals through the npm package, after the sheet hung for a while; least and median of rounds in turn.
plain: Verlet, the natural-order loop by kind (the faster and calmer order) with as many sweeps, normals;
the same Rust in a module without vectors; no wind, no floor.
x real time and faster: by medians. Stretch is that of the threads.
`);
  console.log(`${table}`);
}

async function measure(timed, [hungBy, pinMode, isWindy], makePlain, isTest) {
  const desc = { ...hangingSheet(timed.columns, timed.rows, pinMode), settings: timed.settings };
  desc.spacing = timed.spacing ?? desc.spacing;
  const cloth = grid(desc, isWindy);
  if (timed.floor) cloth.addCollider({ shape: "plane", position: below(desc) });
  const { tick, substeps, iterations } = cloth.settings;
  const hangs = isTest ? 2 : Math.round(timed.seconds / tick);
  const [count, rounds] = isTest ? [1, 1] : [timed.ticks, timed.rounds];
  cloth.step(hangs);
  const { constraints, maxStretch, meanStretch } = cloth.stats;
  const speed = rmsSpeed(cloth);

  const run = (work, ticks) => {
    for (let tick = 0; tick < ticks; tick++) work();
  };
  const ourTick = () => {
    cloth.step();
    cloth.normals;
  };
  const ms = (work) => () => (1e3 / count) * seconds(() => run(work, count));
  let [ours, plain, plainStretch] = [];
  if (isWindy) {
    [ours] = await inTurn(rounds, [ms(ourTick)]);
  } else {
    const sheet = makePlain(desc, true);
    const plainTick = () => sheet.tick(tick, substeps, iterations);
    run(plainTick, hangs);
    plainStretch = sheet.max_stretch();
    [ours, plain] = await inTurn(rounds, [ms(ourTick), ms(plainTick)]);
  }
  cloth.free();
  return [
    `${desc.columns} x ${desc.rows}${timed.floor ? ", floor" : ""}`,
    `1/${Math.round(1 / tick)} s`,
    `${substeps} x ${iterations}`,
    hungBy,
    ours.min.toFixed(3),
    ours.median.toFixed(3),
    ((1e6 * ours.min) / (substeps * iterations * constraints)).toFixed(2),
    ((1e3 * tick) / ours.median).toFixed(1),
    plain?.min.toFixed(3) ?? "-",
    plain ? times(ours.timesBelow(plain)) : "-",
    `${(hangs * tick).toFixed(1)} s`,
    percent(maxStretch),
    percent(meanStretch),
    plainStretch === undefined ? "-" : percent(plainStretch),
    (1e3 * speed).toFixed(2),
  ];
}

/** A floor under the sheet, by a twentieth of its length. */
function below({ origin: [x, y, z], rows, spacing }) {
  return [x, y - 1.05 * spacing * (rows - 1), z];
}

/** Root of the mean square speed of the particles [m/s]. */
function rmsSpeed(cloth) {
  const count = cloth.positions.length / 3;
  let sum = 0;
  for (let particle = 0; particle < count; particle++) {
    const [x, y, z] = cloth.velocity(particle);
    sum += x * x + y * y + z * z;
  }
  return Math.sqrt(sum / count);
}
