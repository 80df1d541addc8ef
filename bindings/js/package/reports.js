// Conversion of the module's flat lists to reports: events, statistics, hits, mesh reports.

/** Kinds of events, in the order of the core's `EventKind`. */
const EVENT_KINDS = [
  "edge-torn",
  "vertex-split",
  "piece-detached",
  "recovered",
  "reserve-used-up",
  "held-apart",
  "edge-divided",
  "held-inside",
  "free-inside",
  "layers-cross",
  "stitch-torn",
];

/** The fields of each kind of event besides kind, tick and position. */
const FIELDS_OF_KIND = [
  ["particleA", "particleB"],
  ["vertex", "source"],
  ["vertex", "count"],
  ["count"],
  [],
  ["particleA", "particleB", "count"],
  ["particleA", "particleB", "vertex"],
  ["particleA", "count"],
  ["particleA", "count"],
  ["particleA", "particleB", "count"],
  ["particleA", "particleB"],
];

/** The fields in the list behind kind, tick and position. */
const FIELDS = ["particleA", "particleB", "vertex", "source", "count"];
const EVENT_SIZE = 5 + FIELDS.length;

/** Statistics in the order of `stats` in src/read.rs. */
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
  "substeps",
  "heldInside",
  "freeInside",
  "crossings",
  "bytes",
];

export function readEvents(list) {
  const events = [];
  for (let start = 0; start < list.length; start += EVENT_SIZE) {
    const [kind, tick, ...rest] = list.subarray(start, start + EVENT_SIZE);
    const event = { kind: EVENT_KINDS[kind], tick, position: rest.slice(0, 3) };
    for (const field of FIELDS_OF_KIND[kind]) event[field] = rest[3 + FIELDS.indexOf(field)];
    events.push(event);
  }
  return events;
}

/** Fields of the mesh report in the order of `mesh_report` in src/read.rs. */
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
  "thinTriangles",
  "thinnestTriangle",
  "isGrid",
  "shortestEdge",
  "meanEdge",
  "worstAspect",
];

export function readMeshReport(list, warnings) {
  const report = Object.fromEntries(REPORT.map((name, index) => [name, list[index]]));
  const lines = Object.freeze(warnings.split("\n").filter(Boolean));
  return Object.freeze({ ...report, isGrid: report.isGrid !== 0, warnings: lines });
}

export function readChanges([firstVertex, vertexCount, firstIndex, indexCount]) {
  return { firstVertex, vertexCount, firstIndex, indexCount };
}

export function readHit(list) {
  if (list.length === 0) return undefined;
  const [triangle, particle, u, v, distance, ...rest] = list;
  return { triangle, particle, u, v, distance, position: rest.slice(0, 3), normal: rest.slice(3) };
}

/** Returns the memory of the cloth [B] from its statistics. */
export function readBytes(stats) {
  return stats[STATS.indexOf("bytes")];
}

export function readStats(list, stageNames) {
  const stats = Object.fromEntries(STATS.map((name, index) => [name, list[index]]));
  const seconds = stageNames.split(" ").map((name, index) => [name, list[STATS.length + index]]);
  return { ...stats, asleep: stats.asleep === 1, seconds: Object.fromEntries(seconds) };
}

/**
 * Gives the function that returns the mass of a particle the mass of the whole cloth as properties,
 * which `read` computes when one of them is first read.
 */
export function withMassOfCloth(massOfParticle, read) {
  let list;
  const at = (start, end) => (list ??= Array.from(read())).slice(start, end);
  const property = (get) => ({ get, enumerable: true });
  return Object.defineProperties(massOfParticle, {
    total: property(() => at(0, 1)[0]),
    center: property(() => at(1, 4)),
    momentum: property(() => at(4, 7)),
  });
}
