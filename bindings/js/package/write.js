// Writing vertices and indices into buffers of the page: the module writes into room of its own, and that
// is copied.

import * as raw from "./raw.js";
import { check, choice, flag, keys, whole } from "./check.js";
import { isOurs, ready } from "./memory.js";
import * as fields from "./fields.js";

const ATTRIBUTES = ["position", "normal", "tangent", "uv", "frayed"];
const FORMATS = ["f32", "f16", "snorm16", "octahedral16"];
const STREAM_KEYS = ["attribute", "format", "buffer", "offset", "stride"];
const ALL_VERTICES = 0xffffffff;

/** A buffer of the page, as all of its bytes, and which of them the caller means. */
function bytesOf(buffer, name) {
  const isView = ArrayBuffer.isView(buffer);
  const holds = isView || buffer instanceof ArrayBuffer;
  check(holds, name, "be an ArrayBuffer or a view of one");
  const view = isView ? buffer : new Uint8Array(buffer);
  check(!isOurs(view), name, "be your own, not the memory of the module");
  return { buffer: view.buffer, start: view.byteOffset, end: view.byteOffset + view.byteLength };
}

/** A stream of `count` vertices: what it is, and the bytes from its first to its last. */
function readStream(stream, name, count) {
  keys(stream, name, STREAM_KEYS);
  const { format = "f32", offset = 0, stride = 0 } = stream;
  const attribute = choice(stream.attribute, `${name}.attribute`, ATTRIBUTES);
  const kind = choice(format, `${name}.format`, FORMATS);
  const { buffer, start, end } = bytesOf(stream.buffer, `${name}.buffer`);
  const first = start + whole(offset, `${name}.offset`);
  const step = whole(stride, `${name}.stride`);
  const width = raw.vertex_width(attribute, kind);
  const span = count > 0 ? (count - 1) * (step || width) + width : 0;
  const has = Math.max(end - first, 0);
  if (span > has) check(false, `${name}.buffer`, `hold ${span} bytes from its offset on, but has ${has}`);
  return { attribute, kind, step, buffer, first, end: first + span, written: count * width };
}

/** The parts of buffers that streams lie in, each with its place in the room. */
function partsOf(streams) {
  const parts = new Map();
  for (const { buffer, first, end, written } of streams) {
    const part = parts.get(buffer) ?? { first, end: first, written: 0 };
    part.first = Math.min(part.first, first);
    part.end = Math.max(part.end, end);
    part.written += written;
    parts.set(buffer, part);
  }
  let size = 0;
  for (const part of parts.values()) {
    part.at = size + (part.first % 8); // aligned as in the page
    size = Math.ceil((part.at + part.end - part.first) / 8) * 8;
  }
  return { parts, size };
}

export function writeVertices(live, streams, options) {
  check(Array.isArray(streams), "streams", "be an array of streams");
  const desc = fields.merge(fields.WRITE, raw.default_write(), options, "desc");
  const { firstVertex, vertexCount } = fields.unpack(fields.WRITE, desc);
  const vertices = live.vertex_count();
  const left = Math.max(vertices - firstVertex, 0);
  // What does not fit the cloth is refused there.
  const count = vertexCount === ALL_VERTICES ? left : Math.min(vertexCount, left);
  const read = streams.map((stream, at) => readStream(stream, `streams[${at}]`, count));
  const { parts, size } = partsOf(read);
  const room = live.room(size);
  // Asked last: the memory may have grown.
  const inRoom = ({ at, first, end }) => new Uint8Array(ready().buffer, room + at, end - first);
  for (const [buffer, part] of parts) {
    const { first, end, written } = part;
    if (written !== end - first) inRoom(part).set(new Uint8Array(buffer, first, end - first));
  }
  const list = read.flatMap(({ attribute, kind, step, buffer, first, end }) => {
    const part = parts.get(buffer);
    return [attribute, kind, step, part.at + first - part.first, end - first];
  });
  live.write_vertices(Float64Array.from(list), desc);
  for (const [buffer, part] of parts) {
    new Uint8Array(buffer, part.first, part.end - part.first).set(inRoom(part));
  }
  return count;
}

export function writeIndices(live, buffer, options) {
  const { flip = false, baseVertex = 0 } = keys(options, "options", ["flip", "baseVertex"]);
  const isWide = buffer instanceof Uint32Array;
  check(isWide || buffer instanceof Uint16Array, "buffer", "be a Uint16Array or a Uint32Array");
  check(!isOurs(buffer), "buffer", "be your own, not the memory of the module");
  flag(flip, "options.flip");
  const last = whole(baseVertex, "options.baseVertex") + live.vertex_count() - 1;
  check(isWide || last < 0xffff, "buffer", "be a Uint32Array where an index is above 65534");
  check(last < 0xffffffff, "options.baseVertex", "leave every index below 4294967295");
  const count = live.index_count();
  const has = buffer.length;
  if (count > has) check(false, "buffer", `have room for ${count} indices, but has it for ${has}`);
  const at = live.room(count * buffer.BYTES_PER_ELEMENT);
  live.write_indices(isWide, flip, baseVertex);
  buffer.set(new buffer.constructor(ready().buffer, at, count));
  return count;
}
