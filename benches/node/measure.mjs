// Time measurement: rounds of several contenders are interleaved, so that the noise of a busy
// machine affects all of them alike.

/** Time that each contender runs before its rounds, so that V8 optimises its code [ms]. */
const WARM_UP = 400;

/**
 * Returns the processor time that `work` takes [s]: of this thread if Node can measure it, else of
 * the process.
 */
export function cpuTime(work) {
  const usage = () => process.threadCpuUsage?.() ?? process.cpuUsage();
  const start = usage();
  work();
  const end = usage();
  return 1e-6 * (end.user - start.user + (end.system - start.system));
}

/** Measurements of one contender, one per round. */
class Samples {
  list = [];

  /** The minimum: the time without disturbance by other processes. */
  get min() {
    return Math.min(...this.list);
  }

  get median() {
    return median(this.list);
  }

  /**
   * Returns by how many times this is faster than `slow`: the median of the ratios of the rounds.
   */
  speedupOver(slow) {
    return median(this.list.map((fast, round) => slow.list[round] / fast));
  }
}

/** Returns the median. */
export function median(values) {
  return [...values].sort((a, b) => a - b)[values.length >> 1];
}

/** Measures each contender in turn, `rounds` times, after a warm-up. */
export async function measureInterleaved(rounds, contenders) {
  const isTimed = rounds > 1;
  for (const contender of contenders) {
    const start = performance.now();
    do {
      contender();
      await new Promise(setImmediate); // lets V8 install code that it optimised
    } while (isTimed && performance.now() - start < WARM_UP);
  }
  const samples = contenders.map(() => new Samples());
  for (let round = 0; round < rounds; round++) {
    contenders.forEach((contender, index) => samples[index].list.push(contender()));
  }
  return samples;
}
