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
  "collapsedEdges",
  "collapsedTriangles",
  "trimmedTriangles",
  "flippedEdges",
  "shortEdges",
  "isGrid",
  "shortestEdge",
  "meanEdge",
  "worstAspect",
];

/** The warnings of the core's `MeshReport::warnings`: here they take a fifth of the bytes. */
const WARNINGS = [
  ["droppedDegenerate", "triangle was", "triangles were", "removed for lack of an area"],
  ["splitEdges", "edge was", "edges were", "split: more than two triangles met there"],
  ["oneSidedPieces", "piece has", "pieces have", "one side only"],
  ["unusedVertices", "vertex is", "vertices are", "in no triangle"],
  ["shortEdges", "edge is", "edges are", "shorter than `simplifyBelow`"],
  ["thinTriangles", "triangle has", "triangles have", "a height under a hundredth of the longest edge"],
];

function warningsOf(report) {
  const found = WARNINGS.filter(([name]) => report[name] > 0);
  const warnings = found.map(([name, one, many, rest]) => `${report[name]} ${report[name] === 1 ? one : many} ${rest}`);
  if (report.thinTriangles > 0) warnings.push(`${warnings.pop()}; the thinnest is triangle ${report.thinnestTriangle}`);
  if (report.shortestEdge < 0.01 * report.meanEdge) {
    warnings.push("the shortest edge is under a hundredth of the mean edge");
  }
  return warnings;
}

export function readMeshReport(list) {
  const report = Object.fromEntries(REPORT.map((name, index) => [name, list[index]]));
  const warnings = Object.freeze(warningsOf(report));
  return Object.freeze({ ...report, isGrid: report.isGrid !== 0, warnings });
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
