// Times frames of all contenders. Their rounds are interleaved, so that the noise of a busy machine
// affects all of them alike.

import { contenders } from "./peers.js";

/** Frames before a sheet is timed; its stretch is measured after them. */
const WARM_UP_FRAMES = 600;
/** Duration of a round of a contender, and the largest duration of its warm-up [ms]. */
const [ROUND, MAX_WARM_UP] = [40, 4_000];

const SIDES = [40, 128, 256];

/** Measures all contenders and returns the rows of a table. `log` gets a line for each sheet. */
export async function compare(modules, { isTest, log, sides = SIDES }) {
  const rows = [];
  for (const side of isTest ? [8] : sides) {
    const sheets = contenders(modules)
      .filter(({ maxSide = Infinity }) => side <= maxSide)
      .map(({ name, make }) => ({ name, sheet: make(side), times: [] }));
    for (const one of sheets) {
      one.frames = warmUp(one.sheet, isTest ? 2 : WARM_UP_FRAMES);
      one.stretch = one.sheet.stretch();
      if (!Number.isFinite(one.stretch)) throw new Error(`${one.name} has positions that are not finite`);
      log(`${side} x ${side}: ${one.name}`);
      await new Promise((done) => setTimeout(done)); // lets the engine install optimised code
    }
    for (let round = 0; round < (isTest ? 1 : 15); round++) {
      for (const one of sheets) one.times.push(timeFrames(one.sheet, isTest ? 0 : ROUND));
    }
    const handwritten = sheets.find(({ name }) => name.startsWith("hand-written"));
    for (const { name, sheet, times, stretch, frames } of sheets) {
      const faster = median(times.map((ms, round) => handwritten.times[round] / ms));
      rows.push([`${side} x ${side}`, name, ...[Math.min(...times), median(times)].map((ms) => ms.toFixed(3)),
        `${faster.toFixed(1)} x`, `${(frames / 60).toFixed(1)} s`, `${(100 * stretch).toFixed(2)} %`]);
      sheet.free();
    }
  }
  return rows;
}

/** Returns the time to read the views of positions and normals again [µs]. */
export function timeReading({ Cloth }, isTest) {
  const [{ make }] = contenders({ Cloth });
  const sheet = make(40);
  const count = isTest ? 10 : 20_000;
  let [shortest, sum] = [Infinity, 0];
  for (let round = 0; round < 10; round++) {
    sheet.frame(); // the first read after a change computes the normals
    const start = performance.now();
    for (let i = 0; i < count; i++) sum += sheet.read();
    shortest = Math.min(shortest, (1000 * (performance.now() - start)) / count);
  }
  if (sum <= 0) throw new Error("nothing was read");
  sheet.free();
  return shortest;
}

export const HEAD = [["sheet", "with"], ["ms per frame", "median", "faster than hand-written", "simulated", "max stretch"]];

/** Runs frames, at most as long as the warm-up may take, and returns how many ran. */
function warmUp(sheet, frames) {
  const end = performance.now() + MAX_WARM_UP;
  let done = 0;
  while (done < frames && (done < 30 || performance.now() < end)) {
    sheet.frame();
    done++;
  }
  return done;
}

/** Runs frames for `ms` [ms], and returns the mean time of a frame [ms]. */
function timeFrames(sheet, ms) {
  const start = performance.now();
  let frames = 0;
  do {
    sheet.frame();
    frames++;
  } while (performance.now() - start < ms);
  return (performance.now() - start) / frames;
}

/** Returns the median. */
function median(values) {
  return [...values].sort((a, b) => a - b)[values.length >> 1];
}
