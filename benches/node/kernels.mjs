// What one projection of one constraint costs.

import { inTurn, seconds } from "./measure.mjs";
import { grid, hangingSheet, mesh } from "./sheets.mjs";
import { Table, times } from "./table.mjs";

/** Sweeps of a tick: many, so that the links are nearly all that is done. */
const SWEEPS = 16;

/** How often ticks are run again that others disturbed, by a greater share than this. */
const TRIES = 20;
const CALM = 0.02;

/**
 * How far links give way [N/m], 0 for not at all; those that do keep a multiplier from sweep to sweep. Links
 * over two cells are rigid, since otherwise sweeps leave bending to a stage of its own.
 */
const LAWS = [
  ["cotton's threads", 2.0e3, 50],
  ["all rigid", 0, 0],
];

export async function kernels(cases, makePlain, isTest) {
  const numbers = ["by particle", "by kind", "mesh", "grid", "mesh is faster", "grid is faster"];
  const table = new Table(["sheet", "links"], numbers);
  for (const test of cases) {
    for (const law of LAWS) {
      table.push(await measure(test, law, makePlain, isTest ? 1 : test.rounds));
    }
  }
  console.log(`
Kernels in wasm: ns of one thread for a projection of one constraint; the least, and in brackets the median, of rounds in turn.
by particle, by kind: the plain loop over Vec3, the same Rust in a module without vectors; mesh, grid: the npm package.
faster: than the plain loop by particle, and by kind; the median of the rounds' ratios.
`);
  console.log(`${table}`);
}

async function measure({ side, ticks }, [name, membrane, shear], makePlain, rounds) {
  const desc = {
    ...hangingSheet(side, side, "top-edge"),
    // Tethers are another stage, and with them goes the solving of whole lines.
    settings: { substeps: 1, iterations: SWEEPS, tethers: false },
    material: {
      stretchStiffnessWarp: membrane,
      stretchStiffnessWeft: membrane,
      shearStiffness: shear,
      bendStiffness: 1,
    },
  };
  const asGrid = grid(desc, true);
  const cloths = [mesh(desc, asGrid), asGrid];
  for (const cloth of cloths) cloth.timing = true;
  const sheets = [false, true].map((isByKind) => makePlain(desc, isByKind));
  const { tick } = asGrid.settings;
  const figures = await inTurn(rounds, [
    ...sheets.map((sheet) => () => plainNs(sheet, tick)),
    ...cloths.map((cloth) => () => sweepNs(cloth, ticks)),
  ]);
  for (const cloth of cloths) cloth.free();
  const [byParticle, byKind, ...ours] = figures;
  const faster = (slow) => (one) => times(one.timesBelow(slow));
  return [
    `${side} x ${side}`,
    name,
    ...figures.map((one) => `${one.min.toFixed(2)} (${one.median.toFixed(2)})`),
    ...ours.map((one) => `${faster(byParticle)(one)} ${faster(byKind)(one)}`),
  ];
}

/** Runs sweeps of the plain loop over a sheet that moves, and tells what a projection took [ns]. */
function plainNs(sheet, h) {
  sheet.predict(h);
  const spent = seconds(() => {
    for (let sweep = 0; sweep < SWEEPS; sweep++) sheet.sweep();
  });
  return (1e9 * spent) / (SWEEPS * sheet.link_count());
}

/**
 * Runs some ticks, and tells what a projection took by the cloth's own clock [ns]. That clock goes on
 * while others have the processor, so of some tries the least disturbed one counts.
 */
function sweepNs(cloth, ticks) {
  let [least, ns] = [Infinity, NaN];
  for (let tries = 0; tries < TRIES && least > CALM; tries++) {
    const start = performance.now();
    const spent = seconds(() => cloth.step(ticks));
    const disturbed = (1e-3 * (performance.now() - start)) / spent - 1;
    if (disturbed >= least) continue;
    const { constraints, seconds: stages } = cloth.stats;
    least = disturbed;
    ns = (1e9 * (stages.stretch + stages.shear + stages.bend)) / (ticks * SWEEPS * constraints);
  }
  return ns;
}
