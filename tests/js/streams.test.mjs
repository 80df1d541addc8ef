// writeVertices and writeIndices into buffers of the caller.

import assert from "node:assert/strict";
import { test } from "node:test";

import init, { Cloth } from "muslin";

await init();

/** Returns a torn cloth in motion. */
function movingCloth() {
  const cloth = Cloth.grid({ columns: 12, rows: 9, pinMode: "top-corners" });
  cloth.step(20);
  assert.equal(cloth.tearEdge(50, 62), true);
  cloth.step(2);
  return cloth;
}

test("f32 streams hold the numbers of the views, in separate and interleaved buffers", () => {
  const cloth = movingCloth();
  const count = cloth.positions.length / 3;
  const [positions, normals] = [new Float32Array(3 * count), new ArrayBuffer(12 * count + 8)];
  const written = cloth.writeVertices([
    { attribute: "position", buffer: positions },
    { attribute: "normal", buffer: normals, offset: 8 },
  ]);
  assert.equal(written, count);
  assert.deepEqual(positions, cloth.positions);
  assert.deepEqual(new Float32Array(normals, 8), cloth.normals);

  // One buffer: 8 bytes before the view, then position, uv and 4 bytes of the page per vertex. The
  // rest must not change.
  const whole = new ArrayBuffer(8 + 24 * count);
  const bytes = new Uint8Array(whole).fill(0xee);
  const view = new Float32Array(whole, 8);
  cloth.writeVertices([
    { attribute: "position", buffer: view, stride: 24 },
    { attribute: "uv", buffer: view, stride: 24, offset: 12 },
  ]);
  for (let v = 0; v < count; v++) {
    assert.deepEqual(view.subarray(6 * v, 6 * v + 3), cloth.positions.subarray(3 * v, 3 * v + 3));
    assert.deepEqual(view.subarray(6 * v + 3, 6 * v + 5), cloth.uvs.subarray(2 * v, 2 * v + 2));
    assert.deepEqual([...bytes.subarray(24 * v + 28, 24 * v + 32)], [0xee, 0xee, 0xee, 0xee]);
  }
  assert.ok(bytes.subarray(0, 8).every((byte) => byte === 0xee));
});

test("16-bit formats hold the same values in lower precision", () => {
  const cloth = movingCloth();
  const count = cloth.positions.length / 3;
  const [buffer, frayed] = [new Int16Array(8 * count), new Float32Array(count)];
  cloth.writeVertices([
    { attribute: "normal", format: "snorm16", buffer, stride: 16 },
    { attribute: "tangent", format: "octahedral16", buffer, stride: 16, offset: 8 },
    { attribute: "frayed", buffer: frayed },
  ]);
  for (let v = 0; v < count; v++) {
    for (let k = 0; k < 3; k++) {
      assert.ok(Math.abs(buffer[8 * v + k] / 32767 - cloth.normals[3 * v + k]) < 1e-4);
    }
    assert.deepEqual([buffer[8 * v + 3], buffer[8 * v + 6], buffer[8 * v + 7]], [0, 32767, 0]);
  }
  assert.deepEqual([...frayed], [...cloth.frayed]);
  assert.ok(frayed.includes(1) && frayed.includes(0));
});

test("vertices are blended, transformed, flipped and offset", () => {
  const cloth = movingCloth();
  const before = cloth.positions.slice();
  cloth.step(1);
  const now = cloth.positions.slice();
  const buffer = new Float32Array(now.length);
  cloth.writeVertices([{ attribute: "position", buffer }], { blend: 0 });
  assert.deepEqual(buffer, before);
  cloth.writeVertices([{ attribute: "position", buffer }], { blend: 0.5 });
  assert.ok(buffer.every((x, i) => Math.abs(x - (before[i] + now[i]) / 2) < 1e-6));
  const transform = [0, 0, 1, 5, 0, 1, 0, 0, -1, 0, 0, 0];
  cloth.writeVertices([{ attribute: "position", buffer }], { transform });
  assert.deepEqual([...buffer.subarray(0, 3)], [now[2] + 5, now[1], 0 - now[0]].map(Math.fround));
  const normals = new Float32Array(now.length);
  cloth.writeVertices([{ attribute: "normal", buffer: normals }], { flipNormals: true });
  assert.ok(normals.every((x, i) => x === -cloth.normals[i]));
  cloth.writeVertices([{ attribute: "position", buffer }], { offset: 0.25, flipNormals: true });
  assert.ok(buffer.every((x, i) => Math.abs(x - now[i] - 0.25 * normals[i]) < 1e-6));
  const some = new Float32Array(6).fill(9);
  const range = { firstVertex: 40, vertexCount: 1 };
  assert.equal(cloth.writeVertices([{ attribute: "position", buffer: some }], range), 1);
  assert.deepEqual([...some], [...now.subarray(120, 123), 9, 9, 9]);
});

test("indices have the width of their array", () => {
  const cloth = movingCloth();
  const { indices } = cloth;
  const [narrow, wide] = [new Uint16Array(indices.length + 1).fill(7), new Uint32Array(indices.length)];
  assert.equal(cloth.writeIndices(narrow), indices.length);
  assert.deepEqual([...narrow], [...indices, 7]);
  cloth.writeIndices(wide, { flip: true, baseVertex: 100 });
  for (let at = 0; at < indices.length; at += 3) {
    const [a, b, c] = indices.subarray(at, at + 3);
    assert.deepEqual([...wide.subarray(at, at + 3)], [a + 100, c + 100, b + 100]);
  }
});

test("writing works while the memory of the module grows and moves", () => {
  const cloth = Cloth.grid({ columns: 200, rows: 200 });
  const others = [];
  const buffer = new Float32Array(3 * 40000);
  for (let i = 0; i < 30; i++) {
    others.push(Cloth.grid({ columns: 60, rows: 60 }));
    cloth.step(1);
    cloth.writeVertices([{ attribute: "position", buffer }], { blend: 1 });
    assert.deepEqual(buffer, cloth.positions);
  }
  others.forEach((other) => other.free());
});

/** Tests that `call` throws an Error with `text`, and changes no byte of the buffer. */
function refuses(name, text, call) {
  test(`${name} throws and writes nothing`, () => {
    const cloth = movingCloth();
    const count = cloth.positions.length / 3;
    const buffer = new ArrayBuffer(32 * count);
    new Uint8Array(buffer).fill(0xee);
    const good = [
      { attribute: "position", buffer, stride: 32 },
      { attribute: "normal", format: "snorm16", buffer, stride: 32, offset: 16 },
    ];
    const hash = cloth.stateHash();
    const hasText = (error) => error.constructor === Error && error.message.includes(text);
    assert.throws(() => call(cloth, good, buffer, count), hasText);
    assert.ok(new Uint8Array(buffer).every((byte) => byte === 0xee));
    assert.equal(cloth.stateHash(), hash);
    cloth.writeVertices(good);
  });
}

const stream = (change) => (cloth, [first, second]) => cloth.writeVertices([first, { ...second, ...change }]);
const desc = (change) => (cloth, good) => cloth.writeVertices(good, change);
refuses("an object instead of an array", "`streams` must be an array", (cloth) => cloth.writeVertices({}));
refuses("an empty list", "`streams` must be from 1 to 16", (cloth) => cloth.writeVertices([]));
refuses("a list of 40 streams", "`streams` must be from 1 to 16", (cloth, [one]) => cloth.writeVertices(Array(40).fill(one)));
refuses("null for a stream", "`streams[0]` must be an object", (cloth) => cloth.writeVertices([null]));
refuses("a misspelt field", "`streams[1].strid` is not known", stream({ strid: 4 }));
refuses("an unknown attribute", "`streams[1].attribute` must be one of", stream({ attribute: "colour" }));
refuses("an unknown format", "`streams[1].format` must be one of", stream({ format: "f64" }));
refuses("a format that the attribute lacks", "`streams[1].format`", stream({ attribute: "uv" }));
refuses("an array instead of a buffer", "`streams[1].buffer` must be an ArrayBuffer", stream({ buffer: [0, 0] }));
refuses("a short buffer", "`streams[1].buffer` must hold", stream({ buffer: new ArrayBuffer(99) }));
refuses("an offset past the end", "bytes from its offset on, but has 0", stream({ offset: 1e6 }));
refuses("an odd offset", "`streams[1].buffer` must be aligned", stream({ offset: 17 }));
refuses("an odd stride", "`streams[1].stride`", stream({ stride: 25 }));
refuses("a small stride", "`streams[1].stride`", stream({ stride: 4 }));
refuses("a negative stride", "`streams[1].stride`", stream({ stride: -32 }));
refuses("an overlap", "`streams[1].buffer` must be apart", stream({ offset: 8 }));
refuses("a view of the module", "must be your own", (cloth) => {
  cloth.writeVertices([{ attribute: "position", buffer: cloth.normals }]);
});
refuses("a misspelt desc", "`desc.bland` is not known", desc({ bland: 1 }));
refuses("a first vertex past the end", "`firstVertex`", desc({ firstVertex: 9999 }));
refuses("too many vertices", "`vertexCount`", desc({ firstVertex: 1, vertexCount: 109 }));
refuses("a blend beyond 1", "`blend`", desc({ blend: 1.5 }));
refuses("a short transform", "`desc.transform` must be 12 numbers", desc({ transform: [1, 0, 0] }));
refuses("a singular transform", "`transform` must be one that can be inverted", desc({ transform: Array(12).fill(1) }));
refuses("an infinite transform", "`transform` must be finite", desc({ transform: Array(12).fill(Infinity) }));
refuses("a number instead of a boolean", "`desc.flipNormals` must be true or false", desc({ flipNormals: 1 }));
refuses("a number for `relative`", "`desc.relative` must be true or false", desc({ relative: 1 }));
refuses("an infinite offset", "`offset` must be finite", desc({ offset: Infinity }));
refuses("floats for indices", "`buffer` must be a Uint16Array", (cloth) => cloth.writeIndices(new Float32Array(999)));
refuses("a short buffer for indices", "`buffer` must have room for", (cloth) => cloth.writeIndices(new Uint16Array(9)));
refuses("wide indices in 16 bits", "`buffer` must be a Uint32Array", (cloth) => {
  cloth.writeIndices(new Uint16Array(9999), { baseVertex: 65500 });
});
refuses("an index beyond 32 bits", "`options.baseVertex` must leave", (cloth) => {
  cloth.writeIndices(new Uint32Array(9999), { baseVertex: 4294967295 });
});
refuses("the module's own indices", "must be your own", (cloth) => cloth.writeIndices(cloth.indices));
