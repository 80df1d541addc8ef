// writeVertices and writeIndices. The module cannot reach the caller's buffers, so it writes into
// staging memory of its own, and the result is copied from there:
//
//   buffers ──(if there are bytes between the streams)──▶ staging ◀── core
//           ◀─────────────────────────────────────────── staging

import * as raw from "./raw.js";
import { check, checkKeys, toBoolean, toChoiceIndex, toUint32 } from "./check.js";
import { isModuleMemory, requireMemory } from "./memory.js";
import * as fields from "./fields.js";

const ATTRIBUTES = ["position", "normal", "tangent", "uv", "frayed"];
const FORMATS = ["f32", "f16", "snorm16", "octahedral16"];
const STREAM_KEYS = ["attribute", "format", "buffer", "offset", "stride"];

/** The default of `vertexCount`: all vertices from the first one on. */
const ALL_VERTICES = 0xffffffff;

/** Alignment of the staging memory [B]; the same as in src/write.rs. */
const ALIGNMENT = 8;

/**
 * Returns the ArrayBuffer of a buffer or view, and the range of bytes in it that the caller means.
 */
function byteRange(buffer, name) {
  const isView = ArrayBuffer.isView(buffer);
  check(isView || buffer instanceof ArrayBuffer, name, "be an ArrayBuffer or a view of one");
  const view = isView ? buffer : new Uint8Array(buffer);
  check(!isModuleMemory(view), name, "be your own, not the memory of the module");
  return { buffer: view.buffer, start: view.byteOffset, end: view.byteOffset + view.byteLength };
}

/**
 * Checks a stream of `count` vertices. Returns its attribute, format and stride, and the range of
 * bytes from its first vertex to its last; `written` is how many of those bytes are written.
 */
function parseStream(stream, name, count) {
  checkKeys(stream, name, STREAM_KEYS);
  const { format = "f32", offset = 0, stride = 0 } = stream;
  const attribute = toChoiceIndex(stream.attribute, `${name}.attribute`, ATTRIBUTES);
  const formatIndex = toChoiceIndex(format, `${name}.format`, FORMATS);
  const { buffer, start, end } = byteRange(stream.buffer, `${name}.buffer`);
  const first = start + toUint32(offset, `${name}.offset`);
  const step = toUint32(stride, `${name}.stride`);
  const width = raw.vertex_width(attribute, formatIndex);
  const needed = count > 0 ? (count - 1) * (step || width) + width : 0;
  const available = Math.max(end - first, 0);
  if (needed > available) {
    check(false, `${name}.buffer`, `hold ${needed} bytes from its offset on, but has ${available}`);
  }
  return { attribute, format: formatIndex, step, buffer, first, end: first + needed, written: count * width };
}

/**
 * Lays out the staging memory: for each buffer, the range of bytes that its streams cover, and the
 * offset of that range in the staging memory. Streams that share a buffer share a range.
 */
function layOutStaging(streams) {
  const ranges = new Map();
  for (const { buffer, first, end, written } of streams) {
    const range = ranges.get(buffer) ?? { first, end: first, written: 0 };
    range.first = Math.min(range.first, first);
    range.end = Math.max(range.end, end);
    range.written += written;
    ranges.set(buffer, range);
  }
  let size = 0;
  for (const range of ranges.values()) {
    range.offset = size + (range.first % ALIGNMENT); // aligned as in the caller's buffer
    size = Math.ceil((range.offset + range.end - range.first) / ALIGNMENT) * ALIGNMENT;
  }
  return { ranges, size };
}

export function writeVertices(live, streams, options) {
  check(Array.isArray(streams), "streams", "be an array of streams");
  const desc = fields.merge(fields.WRITE, raw.default_write(), options, "desc");
  const { firstVertex, vertexCount } = fields.unpack(fields.WRITE, desc);
  const remaining = Math.max(live.vertex_count() - firstVertex, 0);
  // The core refuses a `vertexCount` above `remaining`.
  const count = vertexCount === ALL_VERTICES ? remaining : Math.min(vertexCount, remaining);
  const parsed = streams.map((stream, index) => parseStream(stream, `streams[${index}]`, count));
  const { ranges, size } = layOutStaging(parsed);
  const staging = live.reserve_staging(size);
  // The buffer is read anew each time: the memory may have grown.
  const staged = ({ offset, first, end }) => new Uint8Array(requireMemory().buffer, staging + offset, end - first);
  for (const [buffer, range] of ranges) {
    const { first, end, written } = range;
    // Bytes between the streams are copied first, so that copying back does not change them.
    if (written !== end - first) staged(range).set(new Uint8Array(buffer, first, end - first));
  }
  const list = parsed.flatMap(({ attribute, format, step, buffer, first, end }) => {
    const range = ranges.get(buffer);
    return [attribute, format, step, range.offset + first - range.first, end - first];
  });
  live.write_vertices(Float64Array.from(list), desc);
  for (const [buffer, range] of ranges) {
    new Uint8Array(buffer, range.first, range.end - range.first).set(staged(range));
  }
  return count;
}

export function writeIndices(live, buffer, options) {
  const { flip = false, baseVertex = 0 } = checkKeys(options, "options", ["flip", "baseVertex"]);
  const isWide = buffer instanceof Uint32Array;
  check(isWide || buffer instanceof Uint16Array, "buffer", "be a Uint16Array or a Uint32Array");
  check(!isModuleMemory(buffer), "buffer", "be your own, not the memory of the module");
  toBoolean(flip, "options.flip");
  const last = toUint32(baseVertex, "options.baseVertex") + live.vertex_count() - 1;
  check(isWide || last < 0xffff, "buffer", "be a Uint32Array where an index is above 65534");
  check(last < 0xffffffff, "options.baseVertex", "leave every index below 4294967295");
  const count = live.index_count();
  const capacity = buffer.length;
  if (count > capacity) check(false, "buffer", `have room for ${count} indices, but has room for ${capacity}`);
  const staging = live.reserve_staging(count * buffer.BYTES_PER_ELEMENT);
  live.write_indices(isWide, flip, baseVertex);
  buffer.set(new buffer.constructor(requireMemory().buffer, staging, count));
  return count;
}
