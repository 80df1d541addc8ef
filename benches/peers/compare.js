// Frames of every contender, timed in turn so that what else the machine does hits all alike.

import { contenders } from "./peers.js";

/** Frames that a sheet hangs before it is timed; the stretch after them is told. */
const HANG = 600;
/** How long a contender is timed in a round, and how long all of its hanging may take [ms]. */
const [SLICE, PATIENCE] = [40, 4_000];

const SIDES = [40, 128, 256];

/** Runs all of it; `say` hears of each sheet. Gives rows of a table. */
export async function compare(modules, { isTest, say, sides = SIDES }) {
  const rows = [];
  for (const side of isTest ? [8] : sides) {
    const sheets = contenders(modules)
      .filter(({ most = Infinity }) => side <= most)
      .map(({ name, make }) => ({ name, sheet: make(side), times: [] }));
    for (const one of sheets) {
      one.hung = hang(one.sheet, isTest ? 2 : HANG);
      one.stretch = one.sheet.stretch();
      if (!Number.isFinite(one.stretch)) throw new Error(`${one.name} is not a sheet any more`);
      say(`${side} x ${side}: ${one.name}`);
      await new Promise((done) => setTimeout(done)); // what was compiled meanwhile is taken up
    }
    for (let round = 0; round < (isTest ? 1 : 15); round++) {
      for (const one of sheets) one.times.push(slice(one.sheet, isTest ? 0 : SLICE));
    }
    const handwritten = sheets.find(({ name }) => name.startsWith("hand-written"));
    for (const { name, sheet, times, stretch, hung } of sheets) {
      const faster = median(times.map((ms, round) => handwritten.times[round] / ms));
      rows.push([`${side} x ${side}`, name, ...[Math.min(...times), median(times)].map((ms) => ms.toFixed(3)),
        `${faster.toFixed(1)} x`, `${(hung / 60).toFixed(1)} s`, `${(100 * stretch).toFixed(2)} %`]);
      sheet.free();
    }
  }
  return rows;
}

/** What it takes to ask for both views of a cloth that moved [µs]. */
export function reading({ Cloth }, isTest) {
  const [{ make }] = contenders({ Cloth });
  const sheet = make(40);
  const count = isTest ? 10 : 20_000;
  let [least, sum] = [Infinity, 0];
  for (let round = 0; round < 10; round++) {
    sheet.frame(); // normals are worked out when they are asked for first
    const start = performance.now();
    for (let i = 0; i < count; i++) sum += sheet.read();
    least = Math.min(least, (1000 * (performance.now() - start)) / count);
  }
  if (sum <= 0) throw new Error("nothing was read");
  sheet.free();
  return least;
}

export const HEAD = [["sheet", "with"], ["ms a frame", "median", "faster than by hand", "hung for", "max stretch"]];

/** Lets a sheet hang for so many frames, or for as many as there is patience; gives their number. */
function hang(sheet, frames) {
  const end = performance.now() + PATIENCE;
  let done = 0;
  while (done < frames && (done < 30 || performance.now() < end)) {
    sheet.frame();
    done++;
  }
  return done;
}

/** The mean of some frames [ms]. */
function slice(sheet, ms) {
  const start = performance.now();
  let frames = 0;
  do {
    sheet.frame();
    frames++;
  } while (performance.now() - start < ms);
  return (performance.now() - start) / frames;
}

function median(values) {
  return [...values].sort((a, b) => a - b)[values.length >> 1];
}
