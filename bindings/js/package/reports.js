// What the core reports as lists of numbers, given names.

const KINDS = [
  "edge-torn",
  "vertex-split",
  "piece-detached",
  "recovered",
  "reserve-used-up",
  "held-apart",
  "edge-divided",
];

/** The fields that each kind of event has, besides kind, tick and position. */
const TOLD = [
  ["particleA", "particleB"],
  ["vertex", "source"],
  ["vertex", "count"],
  ["count"],
  [],
  ["particleA", "particleB", "count"],
  ["particleA", "particleB", "vertex"],
];

const FIELDS = ["particleA", "particleB", "vertex", "source", "count"];
const EVENT_SIZE = 5 + FIELDS.length;

const STATS = [
  "particles",
  "triangles",
  "constraints",
  "activeConstraints",
  "pieces",
  "ticks",
  "blend",
  "maxStretch",
  "meanStretch",
  "kineticEnergy",
  "overStretched",
  "asleep",
  "maxSpeed",
  "bytes",
];

export function readEvents(list) {
  const events = [];
  for (let at = 0; at < list.length; at += EVENT_SIZE) {
    const [kind, tick, ...rest] = list.subarray(at, at + EVENT_SIZE);
    const event = { kind: KINDS[kind], tick, position: rest.slice(0, 3) };
    for (const field of TOLD[kind]) event[field] = rest[3 + FIELDS.indexOf(field)];
    events.push(event);
  }
  return events;
}

const REPORT = [
  "vertices",
  "triangles",
  "particles",
  "keptTriangles",
  "weldedVertices",
  "droppedDegenerate",
  "droppedDuplicates",
  "turnedTriangles",
  "splitEdges",
  "splitVertices",
  "unusedVertices",
  "pieces",
  "oneSidedPieces",
];

export function readMeshReport(list) {
  const report = Object.fromEntries(REPORT.map((name, at) => [name, list[at]]));
  return Object.freeze({ ...report, isGrid: list[REPORT.length] !== 0 });
}

export function readChanges([firstVertex, vertexCount, firstIndex, indexCount]) {
  return { firstVertex, vertexCount, firstIndex, indexCount };
}

export function readHit(list) {
  if (list.length === 0) return undefined;
  const [triangle, particle, u, v, distance, ...rest] = list;
  return { triangle, particle, u, v, distance, position: rest.slice(0, 3), normal: rest.slice(3) };
}

export function readStats(list, stageNames) {
  const stats = Object.fromEntries(STATS.map((name, at) => [name, list[at]]));
  const seconds = stageNames.split(" ").map((name, at) => [name, list[STATS.length + at]]);
  return { ...stats, asleep: stats.asleep === 1, seconds: Object.fromEntries(seconds) };
}
