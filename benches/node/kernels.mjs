// Table `kernels` in wasm: the cost of one projection of one distance constraint.

import { cpuTime, measureInterleaved } from "./measure.mjs";
import { createGrid, createMesh, hangingSheet } from "./sheets.mjs";
import { Table, formatRatio } from "./table.mjs";

/** Sweeps per tick: many, so that nearly all time is spent on links. */
const SWEEPS = 16;

/** The largest number of repetitions of a measurement that other processes disturbed. */
const MAX_TRIES = 20;
/** Share of wall time beyond processor time up to which a measurement counts as undisturbed. */
const MAX_DISTURBANCE = 0.02;

/**
 * Name, membrane and shear stiffness of the links [N/m]; 0 is rigid. Soft links keep a Lagrange
 * multiplier from sweep to sweep. Bend links over two cells are rigid in both: with a lower bending
 * stiffness another stage would do the bending.
 */
const LAWS = [
  ["cotton's threads", 2.0e3, 50],
  ["all rigid", 0, 0],
];

export async function printKernels(cases, makePlain, isTest) {
  const numbers = ["by particle", "by kind", "mesh", "grid", "mesh is faster", "grid is faster"];
  const table = new Table(["sheet", "links"], numbers);
  for (const test of cases) {
    for (const law of LAWS) {
      table.push(await measure(test, law, makePlain, isTest ? 1 : test.rounds));
    }
  }
  console.log(`
Kernels in wasm: ns of one thread for a projection of one constraint; minimum, and in brackets median, of interleaved rounds.
by particle, by kind: the plain loop over Vec3, the same Rust in a module without SIMD; mesh, grid: the npm package.
faster: than the plain loop by particle and by kind; median of the ratios of the rounds.
`);
  console.log(`${table}`);
}

async function measure({ side, ticks }, [name, membrane, shear], makePlain, rounds) {
  const desc = {
    ...hangingSheet(side, side, "top-edge"),
    // Without tethers there is no line solver either.
    settings: { substeps: 1, iterations: SWEEPS, tethers: false },
    material: {
      stretchStiffnessWarp: membrane,
      stretchStiffnessWeft: membrane,
      shearStiffness: shear,
      bendStiffness: 1,
    },
  };
  const asGrid = createGrid(desc, true);
  const cloths = [createMesh(desc, asGrid), asGrid];
  for (const cloth of cloths) cloth.timing = true;
  const sheets = [false, true].map((isByKind) => makePlain(desc, isByKind));
  const { tick } = asGrid.settings;
  const all = await measureInterleaved(rounds, [
    ...sheets.map((sheet) => () => plainNs(sheet, tick)),
    ...cloths.map((cloth) => () => sweepNs(cloth, ticks)),
  ]);
  for (const cloth of cloths) cloth.free();
  const [byParticle, byKind, ...muslin] = all;
  const faster = (slow) => (samples) => formatRatio(samples.speedupOver(slow));
  return [
    `${side} x ${side}`,
    name,
    ...all.map((samples) => `${samples.min.toFixed(2)} (${samples.median.toFixed(2)})`),
    ...muslin.map((samples) => `${faster(byParticle)(samples)} ${faster(byKind)(samples)}`),
  ];
}

/**
 * Runs sweeps of the plain loop over a moving sheet, and returns the time of one projection [ns].
 */
function plainNs(sheet, h) {
  sheet.predict(h);
  const spent = cpuTime(() => {
    for (let sweep = 0; sweep < SWEEPS; sweep++) sheet.sweep();
  });
  return (1e9 * spent) / (SWEEPS * sheet.link_count());
}

/**
 * Runs ticks, and returns the time of one projection by the clock of the cloth [ns]. That clock
 * also counts the time of other processes, so the least disturbed of several tries is used.
 */
function sweepNs(cloth, ticks) {
  let [leastDisturbed, ns] = [Infinity, NaN];
  for (let tries = 0; tries < MAX_TRIES && leastDisturbed > MAX_DISTURBANCE; tries++) {
    const start = performance.now();
    const spent = cpuTime(() => cloth.step(ticks));
    const disturbed = (1e-3 * (performance.now() - start)) / spent - 1;
    if (disturbed >= leastDisturbed) continue;
    const { constraints, seconds: stages } = cloth.stats;
    leastDisturbed = disturbed;
    ns = (1e9 * (stages.stretch + stages.shear + stages.bend)) / (ticks * SWEEPS * constraints);
  }
  return ns;
}
