// Table `ticks` in wasm: the cost of whole ticks with normals, and the stretch and speed of the
// cloth after a while.

import { cpuTime, measureInterleaved } from "./measure.mjs";
import { createGrid, hangingSheet } from "./sheets.mjs";
import { Table, formatPercent, formatRatio } from "./table.mjs";

/** Variants of each case: name, pin mode, whether there is wind. */
const VARIANTS = [
  ["top edge", "top-edge", false],
  ["top edge, wind", "top-edge", true],
  ["top corners", "top-corners", false],
  ["top corners, wind", "top-corners", true],
];

const NUMBERS = [
  "ms per tick",
  "median",
  "ns per projection",
  "x real time",
  "plain ms",
  "faster",
  "simulated",
  "max stretch",
  "mean",
  "plain max",
  "rms mm/s",
];

export async function printTicks(cases, makePlain, isTest) {
  const table = new Table(["sheet", "tick", "sweeps", "pins"], NUMBERS);
  for (const testCase of cases) {
    for (const variant of VARIANTS) {
      table.push(await measure(testCase, variant, makePlain, isTest));
    }
  }
  console.log(`
Ticks in wasm: ms per tick on one thread with normals through the npm package, after the simulated time; minimum and median of
interleaved rounds.
plain: Verlet with the plain loop by kind (the faster order, which also comes to rest), as many sweeps, normals; the same Rust in
a module without SIMD; no wind, no floor.
x real time, faster: from medians. Stretch is that of the stretch links.
`);
  console.log(`${table}`);
}

async function measure(testCase, [pins, pinMode, isWindy], makePlain, isTest) {
  const desc = { ...hangingSheet(testCase.columns, testCase.rows, pinMode), settings: testCase.settings };
  desc.spacing = testCase.spacing ?? desc.spacing;
  const cloth = createGrid(desc, isWindy);
  if (testCase.floor) cloth.addCollider({ shape: "plane", position: floorPosition(desc) });
  const { tick, substeps, iterations } = cloth.settings;
  const tickCount = isTest ? 2 : Math.round(testCase.seconds / tick);
  const [count, rounds] = isTest ? [1, 1] : [testCase.ticks, testCase.rounds];
  cloth.step(tickCount);
  const { constraints, maxStretch, meanStretch } = cloth.stats;
  const speed = rmsSpeed(cloth);

  const run = (work, ticks) => {
    for (let tick = 0; tick < ticks; tick++) work();
  };
  const muslinTick = () => {
    cloth.step();
    cloth.normals;
  };
  const ms = (work) => () => (1e3 / count) * cpuTime(() => run(work, count));
  let [muslin, plain, plainStretch] = [];
  if (isWindy) {
    [muslin] = await measureInterleaved(rounds, [ms(muslinTick)]);
  } else {
    const sheet = makePlain(desc, true);
    const plainTick = () => sheet.tick(tick, substeps, iterations);
    run(plainTick, tickCount);
    plainStretch = sheet.max_stretch();
    [muslin, plain] = await measureInterleaved(rounds, [ms(muslinTick), ms(plainTick)]);
  }
  cloth.free();
  return [
    `${desc.columns} x ${desc.rows}${testCase.floor ? ", floor" : ""}`,
    `1/${Math.round(1 / tick)} s`,
    `${substeps} x ${iterations}`,
    pins,
    muslin.min.toFixed(3),
    muslin.median.toFixed(3),
    ((1e6 * muslin.min) / (substeps * iterations * constraints)).toFixed(2),
    ((1e3 * tick) / muslin.median).toFixed(1),
    plain?.min.toFixed(3) ?? "-",
    plain ? formatRatio(muslin.speedupOver(plain)) : "-",
    `${(tickCount * tick).toFixed(1)} s`,
    formatPercent(maxStretch),
    formatPercent(meanStretch),
    plainStretch === undefined ? "-" : formatPercent(plainStretch),
    (1e3 * speed).toFixed(2),
  ];
}

/** Returns the position of a floor below the sheet, at a distance of a twentieth of its length. */
function floorPosition({ origin: [x, y, z], rows, spacing }) {
  return [x, y - 1.05 * spacing * (rows - 1), z];
}

/** Returns the root mean square speed of the particles [m/s]. */
function rmsSpeed(cloth) {
  const count = cloth.positions.length / 3;
  let sum = 0;
  for (let particle = 0; particle < count; particle++) {
    const [x, y, z] = cloth.velocity(particle);
    sum += x * x + y * y + z * z;
  }
  return Math.sqrt(sum / count);
}
