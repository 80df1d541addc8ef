// Meshes as artists export them: meshReport counts the repairs, and vertexParticles maps vertices
// to particles.

import assert from "node:assert/strict";
import { test } from "node:test";

import init, { Cloth } from "muslin";

await init();

/**
 * Returns two sheets of 5 × 6 vertices side by side; the last column of one coincides with the
 * first of the other.
 */
function seamedSheet() {
  const desc = { positions: [], uvs: [], indices: [], weldDistance: 0 };
  for (const half of [0, 1]) {
    for (let i = 0; i < 30; i++) {
      desc.positions.push(((i % 5) + 4 * half) / 8, -Math.floor(i / 5) / 8, 0);
      desc.uvs.push(half + (i % 5) / 8, Math.floor(i / 5) / 8);
    }
    for (let cell = 0; cell < 20; cell++) {
      const a = 30 * half + Math.floor(cell / 4) * 5 + (cell % 4);
      desc.indices.push(a, a + 5, a + 1, a + 5, a + 6, a + 1);
    }
  }
  return desc;
}

test("without repairs vertex i is particle i", () => {
  const cloth = Cloth.mesh({ ...seamedSheet(), weldDistance: -1 });
  assert.deepEqual([...cloth.vertexParticles], [...Array(60).keys()]);
  const { vertices, particles, pieces, weldedVertices, isGrid } = cloth.meshReport;
  assert.deepEqual({ vertices, particles, pieces, weldedVertices, isGrid }, {
    vertices: 60,
    particles: 60,
    pieces: 2,
    weldedVertices: 0,
    isGrid: false,
  });
  assert.equal(Cloth.grid().meshReport.isGrid, true);
});

test("meshReport counts every repair", () => {
  const desc = seamedSheet();
  desc.indices.push(1, 0, 5, 7, 7, 8, 0, 1, 2);
  [desc.indices[6], desc.indices[7]] = [desc.indices[7], desc.indices[6]];
  const cloth = Cloth.mesh(desc);
  const { shortestEdge, meanEdge, worstAspect, thinTriangles, thinnestTriangle, warnings, ...counts } = cloth.meshReport;
  assert.ok(shortestEdge > 0 && meanEdge > shortestEdge && worstAspect > 1.9 && thinTriangles === 0);
  assert.ok(thinnestTriangle < 83);
  assert.deepEqual(warnings, ["2 triangles were removed for lack of an area"]);
  assert.deepEqual(counts, {
    vertices: 60,
    triangles: 83,
    particles: 54,
    keptTriangles: 80,
    weldedVertices: 6,
    droppedDegenerate: 2,
    droppedDuplicates: 1,
    turnedTriangles: 1,
    splitEdges: 0,
    splitVertices: 0,
    unusedVertices: 0,
    pieces: 1,
    oneSidedPieces: 0,
    isGrid: false,
    collapsedEdges: 0,
    collapsedTriangles: 0,
    trimmedTriangles: 0,
    flippedEdges: 0,
    shortEdges: 0,
  });
  assert.throws(() => (cloth.meshReport.pieces = 7), TypeError);
});

test("simplifyBelow collapses short edges, and the vertices follow their particles", () => {
  // Two squares of 1 m whose middle vertex is 5 mm from that of the left border.
  const positions = [0, 0, 0, 1, 0, 0, 0, 0.5, 0, 0.005, 0.5, 0, 1, 0.5, 0, 0, 1, 0, 1, 1, 0];
  const indices = [0, 1, 3, 0, 3, 2, 1, 4, 3, 2, 3, 5, 3, 6, 5, 3, 4, 6];
  const cloth = Cloth.mesh({ positions, indices, pinned: [3, 2], simplifyBelow: 0.01 });
  const { collapsedEdges, collapsedTriangles, shortEdges, particles, keptTriangles, shortestEdge } = cloth.meshReport;
  assert.deepEqual({ collapsedEdges, collapsedTriangles, shortEdges }, { collapsedEdges: 1, collapsedTriangles: 2, shortEdges: 0 });
  assert.deepEqual({ particles, keptTriangles, shortestEdge }, { particles: 6, keptTriangles: 4, shortestEdge: 0.5 });
  assert.deepEqual([...cloth.vertexParticles], [0, 1, 2, 2, 3, 4, 5]);
  assert.deepEqual([...cloth.pinned], [2]);
  const same = Cloth.restore(cloth.save());
  for (const each of [cloth, same]) each.step(10);
  assert.equal(same.stateHash(), cloth.stateHash());
});

test("vertices of a welded seam share particles and keep their uvs, until a cut splits them", () => {
  const desc = seamedSheet();
  const cloth = Cloth.mesh({ ...desc, pinned: [4, 30] });
  assert.deepEqual([...cloth.pinned], [4]);
  const pairs = Array.from({ length: 6 }, (_, row) => [5 * row + 4, 30 + 5 * row]);
  const isShared = ([a, b]) => cloth.vertexParticles[a] === cloth.vertexParticles[b];
  assert.ok(pairs.every(isShared));
  cloth.step(10);
  for (const [a, b] of pairs) {
    const position = cloth.position(cloth.vertexParticles[a]);
    assert.deepEqual(position, [...cloth.positions.subarray(3 * a, 3 * a + 3)]);
    assert.deepEqual(position, [...cloth.positions.subarray(3 * b, 3 * b + 3)]);
  }
  cloth.reset();
  const since = cloth.topologyRevision;
  assert.equal(cloth.cut([0.5, -0.3, -1], [0.5, -9, -1], [0, 0, 2]), 2);
  // The cut ends at row 3.
  assert.deepEqual(pairs.map(isShared), [true, true, true, true, false, false]);
  assert.deepEqual([...cloth.uvs], desc.uvs);
  assert.deepEqual([...cloth.indices], desc.indices);
  assert.ok(cloth.changes(since).vertexCount > 0);
  const splits = cloth.events().filter(({ kind }) => kind === "vertex-split");
  assert.deepEqual(splits.map(({ vertex, source }) => [vertex, source]), [[50, 50], [55, 55]]);
  assert.throws(() => cloth.position(56), /`particle` must be below 56/);
});

test("a grid that is passed as a mesh moves with the bits of the grid", () => {
  const grid = Cloth.grid();
  const { positions, indices, uvs, pinned } = grid;
  const mesh = Cloth.mesh({ positions, indices, uvs, pinned });
  assert.equal(mesh.meshReport.isGrid, true);
  for (const cloth of [grid, mesh]) cloth.step(60);
  assert.equal(mesh.stateHash(), grid.stateHash());
});

test("meshReport warns of every defect in the words of the core", () => {
  // Three triangles on one edge, one without area, a vertex in no triangle; a small triangle apart.
  const corners = [[0, 0, 0], [1, 0, 0], [0.5, 1, 0], [0.5, -1, 0], [0.5, 0, 1], [5, 5, 5]];
  const small = [[9, 0, 0], [9.005, 0, 0], [9.0025, 0.005, 0]];
  const indices = [0, 1, 2, 1, 0, 3, 0, 1, 4, 0, 0, 1, 6, 7, 8];
  const { meshReport } = Cloth.mesh({ positions: [...corners, ...small].flat(), indices });
  assert.deepEqual(meshReport.warnings, [
    "1 triangle was removed for lack of an area",
    "1 edge was split: more than two triangles met there",
    "1 vertex is in no triangle",
    "the shortest edge is under a hundredth of the mean edge",
  ]);
});

test("meshReport measures the quality of a mesh and warns of thin triangles", () => {
  // A right triangle of 1 m and 2 m, and a thin one with a height of 2 mm on an edge of 1 m.
  const positions = [0, 0, 0, 1, 0, 0, 0, 2, 0, 0.5, -0.002, 0];
  const { meshReport } = Cloth.mesh({ positions, indices: [0, 1, 2, 1, 0, 3] });
  assert.ok(Math.abs(meshReport.worstAspect - 500) < 0.1 && meshReport.thinnestTriangle === 1);
  assert.ok(Math.abs(meshReport.shortestEdge - 0.5) < 1e-4);
  assert.ok(Math.abs(meshReport.meanEdge - (1 + 2 + Math.sqrt(5) + 2 * 0.500004) / 5) < 1e-5);
  assert.deepEqual(meshReport.warnings, [
    "1 triangle has a height under a hundredth of the longest edge; the thinnest is triangle 1",
  ]);
  assert.throws(() => meshReport.warnings.push(""), TypeError);
  assert.deepEqual(Cloth.grid().meshReport.warnings, []);
});
