// ClothGeometry with the real three.js, without a screen: the newest release, and the one that the
// example pages use.

import assert from "node:assert/strict";
import { suite, test } from "node:test";

import init, { Cloth } from "muslin";
import * as bare from "muslin/three";
import { withThree } from "muslin/three-with";
import * as newest from "three";
import * as r160 from "three-160";

await init();

test("muslin/three and withThree() give the same classes", () => {
  assert.deepEqual(Object.keys(withThree(newest)), Object.keys(bare));
  assert.ok(bare.ClothGeometry.prototype instanceof newest.BufferGeometry);
});

for (const [release, three, { ClothGeometry }] of [
  [newest.REVISION, newest, bare],
  [r160.REVISION, r160, withThree(r160)],
]) {
  suite(`three.js r${release}`, () => testGeometry(three, ClothGeometry));
}

/** Returns the attributes that the next draw would upload, and marks them as uploaded. */
function takeUploads(geometry, versions) {
  const lists = { ...geometry.attributes, index: geometry.index };
  const uploaded = Object.keys(lists).filter((name) => lists[name].version !== versions[name]);
  for (const name of Object.keys(lists)) versions[name] = lists[name].version;
  return uploaded.sort();
}

function testGeometry({ BufferGeometry, Mesh, MeshBasicMaterial, Raycaster, Vector3 }, ClothGeometry) {
  test("it has capacity for every tear and draws the part in use", () => {
    const cloth = Cloth.grid({ columns: 10, rows: 5, extraParticles: 7 });
    const geometry = new ClothGeometry(cloth);
    assert.ok(geometry.isBufferGeometry);
    assert.equal(geometry.cloth, cloth);
    const { position, normal, uv } = geometry.attributes;
    assert.deepEqual([position.count, normal.count, uv.count], [57, 57, 57]);
    assert.deepEqual(geometry.drawRange, { start: 0, count: cloth.indices.length });
    assert.equal(geometry.index.count, cloth.indexCapacity);
    assert.deepEqual([...geometry.index.array.subarray(0, cloth.indices.length)], [...cloth.indices]);
    assert.deepEqual([...position.array.subarray(0, 150)], [...cloth.positions]);
    assert.deepEqual([...normal.array.subarray(0, 150)], [...cloth.normals]);
    assert.deepEqual([...uv.array.subarray(0, 100)], [...cloth.uvs]);
  });

  test("update() uploads only what changed", () => {
    const cloth = Cloth.grid();
    const [geometry, versions] = [new ClothGeometry(cloth), {}];
    assert.deepEqual(takeUploads(geometry, versions), ["index", "normal", "position", "uv"]);
    assert.equal(geometry.update(), false);
    assert.deepEqual(takeUploads(geometry, versions), []);
    cloth.step(1);
    assert.equal(geometry.update(), true);
    assert.deepEqual(takeUploads(geometry, versions), ["normal", "position"]);
    assert.deepEqual(geometry.attributes.position.updateRanges, [{ start: 0, count: 4800 }]);
    cloth.tearEdge(820, 860);
    const arrays = Object.values(geometry.attributes).map(({ array }) => array);
    assert.equal(geometry.update(), true);
    assert.deepEqual(takeUploads(geometry, versions), ["index", "normal", "position", "uv"]);
    assert.deepEqual(Object.values(geometry.attributes).map(({ array }) => array), arrays);
    assert.deepEqual([...geometry.attributes.position.array.subarray(0, 4803)], [...cloth.positions]);
    const drawn = () => [...geometry.index.array.subarray(0, cloth.indices.length)];
    assert.deepEqual(drawn(), [...cloth.indices]);
    assert.ok(cloth.cut([-1, -0.51, -1], [1.23, -0.53, -1], [0, 0, 2]) > 20);
    assert.equal(geometry.update(), true);
    assert.deepEqual(drawn(), [...cloth.indices]);
    assert.equal(geometry.drawRange.count, cloth.indices.length);
    assert.deepEqual(Object.values(geometry.attributes).map(({ array }) => array), arrays, "in place");
  });

  test("a tear uploads its range of indices, merged with ranges that are still pending", () => {
    const cloth = Cloth.grid();
    const geometry = new ClothGeometry(cloth);
    const { index } = geometry;
    const tear = (a, b) => {
      cloth.tearEdge(a, b);
      geometry.update();
      return index.updateRanges;
    };
    index.clearUpdateRanges(); // as the renderer does once it has uploaded them
    const [first, ...none] = tear(820, 860);
    assert.deepEqual(none, []);
    assert.ok(first.count > 0 && first.count < 500, `${first.count} indices`);
    const [both] = tear(220, 260);
    assert.ok(both.start < first.start && both.start + both.count === first.start + first.count);
    assert.deepEqual([...index.array.subarray(0, cloth.indices.length)], [...cloth.indices]);
  });

  test("it still works after the memory has grown", () => {
    const cloth = Cloth.grid();
    const geometry = new ClothGeometry(cloth);
    const held = cloth.positions;
    while (held.length > 0) Cloth.grid({ columns: 100, rows: 100 });
    cloth.step(1);
    geometry.update();
    assert.deepEqual([...geometry.attributes.position.array.subarray(0, 4800)], [...cloth.positions]);
  });

  test("the bounds cover every vertex in use and no spare capacity", () => {
    const cloth = Cloth.grid({ origin: [100, 100, 100], pinMode: "none" });
    const geometry = new ClothGeometry(cloth);
    geometry.computeBoundingBox();
    for (let i = 0; i < 5; i++) {
      cloth.step(12);
      geometry.update();
      const { boundingSphere, boundingBox } = geometry;
      assert.ok(boundingSphere.radius > 1.3 && boundingSphere.radius < 1.6, `${boundingSphere.radius}`);
      const vertex = new Vector3();
      for (let at = 0; at < cloth.positions.length; at += 3) {
        vertex.fromArray(cloth.positions, at);
        assert.ok(vertex.distanceTo(boundingSphere.center) <= boundingSphere.radius + 1e-4);
        assert.ok(boundingBox.distanceToPoint(vertex) <= 1e-4);
      }
    }
  });

  test("three.js's raycaster agrees with cloth.raycast()", () => {
    const cloth = Cloth.grid({ pinMode: "top-corners" });
    cloth.wind = { velocity: [0, 0, 3] };
    cloth.step(60);
    const mesh = new Mesh(new ClothGeometry(cloth), new MeshBasicMaterial({ side: 2 }));
    const [origin, direction] = [new Vector3(0.9, -0.8, 5), new Vector3(0, 0, -1)];
    const [theirs] = new Raycaster(origin, direction).intersectObject(mesh);
    const ours = cloth.raycast([0.9, -0.8, 5], [0, 0, -1]);
    assert.equal(theirs.faceIndex, ours.triangle);
    assert.ok(Math.abs(theirs.distance - ours.distance) < 1e-5);
  });

  test("dispose() does not free the cloth, and update() throws after free()", () => {
    const cloth = Cloth.grid();
    const geometry = new ClothGeometry(cloth);
    let disposed = 0;
    geometry.addEventListener("dispose", () => disposed++);
    geometry.dispose();
    assert.equal(disposed, 1);
    cloth.step(1);
    assert.equal(geometry.update(), true);
    cloth.free();
    assert.throws(() => geometry.update(), /`cloth` must be live, but was freed/);
  });

  test("a clone is a copy that does not follow the cloth", () => {
    const cloth = Cloth.grid();
    const geometry = new ClothGeometry(cloth);
    const copy = geometry.clone();
    const before = copy.attributes.position.array.slice();
    assert.equal(copy.constructor, BufferGeometry);
    cloth.step(5);
    geometry.update();
    assert.deepEqual(copy.attributes.position.array, before);
    assert.deepEqual(copy.drawRange, geometry.drawRange);
  });
}
