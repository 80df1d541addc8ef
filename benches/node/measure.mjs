// Measuring several things so that the noise of a busy machine hits all of them alike.

/** Time that a contender runs before its rounds [ms]: V8 compiles well what it has seen to be hot. */
const WARM_UP = 400;

/** Seconds of processor time that `work` takes: of this thread where node can tell, else of node. */
export function seconds(work) {
  const usage = () => process.threadCpuUsage?.() ?? process.cpuUsage();
  const start = usage();
  work();
  const end = usage();
  return 1e-6 * (end.user - start.user + (end.system - start.system));
}

/** What was measured of one contender, a figure a round. */
class Figures {
  list = [];

  /** The least: what the machine does when nobody disturbs it. */
  get min() {
    return Math.min(...this.list);
  }

  get median() {
    return median(this.list);
  }

  /** How many times less this is than `slow`: the median over the rounds. */
  timesBelow(slow) {
    return median(this.list.map((fast, round) => slow.list[round] / fast));
  }
}

/** The one in the middle. */
export function median(values) {
  return [...values].sort((a, b) => a - b)[values.length >> 1];
}

/** Asks each contender for a figure, in turn, `rounds` times; only when they are warm. */
export async function inTurn(rounds, contenders) {
  const isTimed = rounds > 1;
  for (const contender of contenders) {
    const start = performance.now();
    do {
      contender();
      await new Promise(setImmediate); // what was compiled meanwhile is taken up
    } while (isTimed && performance.now() - start < WARM_UP);
  }
  const figures = contenders.map(() => new Figures());
  for (let round = 0; round < rounds; round++) {
    contenders.forEach((contender, at) => figures[at].list.push(contender()));
  }
  return figures;
}
