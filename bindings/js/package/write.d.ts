// Writing of vertices into buffers of the caller.

/** An attribute of a vertex. */
export type Attribute =
  /** Position, x y z [m]; with 16-bit formats x y z 1. */
  | "position"
  /** Unit normal, x y z; with 16-bit formats x y z 0. */
  | "normal"
  /**
   * Tangent, x y z w: the unit direction at a right angle to the normal in which the texture
   * coordinate u grows, and a sign w = ±1, so that v grows along cross(normal, tangent) · w.
   *
   * It is the sum over the triangles of the vertex of (p · dv₂ − q · dv₁) · sign(du₁ · dv₂ − du₂ ·
   * dv₁), orthogonalised against the normal; p and q are two edges, and du, dv their differences in
   * the texture. If the texture coordinates do not define a direction, it is an arbitrary one.
   */
  | "tangent"
  /** Texture coordinates, u v. */
  | "uv"
  /** 1 at a border that a tear or cut made, otherwise 0; with 16-bit formats followed by 0. */
  | "frayed";

/** The number format of an attribute. */
export type VertexFormat =
  /** 32-bit floats. */
  | "f32"
  /** 16-bit floats. Values beyond ±65504 are clamped. */
  | "f16"
  /** 16-bit signed normalised integers, −32767 to 32767 for −1 to 1. Not for positions and uvs. */
  | "snorm16"
  /**
   * Octahedral encoding, for normals and tangents: two snorm16 for a normal; for a tangent these
   * two, then w and 0. The direction is projected to x and y on the octahedron |x| + |y| + |z| = 1;
   * its lower half (z < 0) is folded outward to ((1 − |y|) · sign x, (1 − |x|) · sign y).
   */
  | "octahedral16";

/** Where one attribute of the vertices is written. Several streams may interleave in one buffer. */
export interface Stream {
  /** The attribute. */
  attribute: Attribute;
  /** The number format. @defaultValue "f32" */
  format?: VertexFormat;
  /** The destination: your own buffer, or a view of a part of one. */
  buffer: ArrayBuffer | ArrayBufferView;
  /** Bytes from the start of `buffer` to the first vertex. @defaultValue 0 */
  offset?: number;
  /**
   * Bytes from one vertex to the next; a multiple of the size of a number. 0 means tightly packed.
   *
   * @defaultValue 0
   */
  stride?: number;
}

/** Which vertices are written, and how they are transformed. */
export interface WriteDesc {
  /** The first vertex. It is written to the start of each stream. @defaultValue 0 */
  firstVertex?: number;
  /** Number of vertices. @defaultValue all from `firstVertex` on */
  vertexCount?: number;
  /**
   * Interpolation between the last tick (0) and the current one (1). Pass `cloth.blend` for smooth
   * motion at any frame rate.
   *
   * @defaultValue 1
   */
  blend?: number;
  /**
   * Affine transform of positions, applied after `offset`: three rows of four numbers, so that x
   * becomes t[0] · x + t[1] · y + t[2] · z + t[3]. Normals stay perpendicular to the surface and on
   * their side of it, and tangents stay along it. A transform that takes a cloth far from zero to a
   * place near zero loses no digits of the positions.
   *
   * @defaultValue identity
   */
  transform?: readonly number[] | Float32Array | Float64Array;
  /** Whether normals are negated, to draw the back of the cloth. @defaultValue false */
  flipNormals?: boolean;
  /** Distance by which positions move along the written normals [m]. @defaultValue 0 */
  offset?: number;
  /**
   * Whether positions are relative to `cloth.origin`, also those that `transform` applies to; else
   * they are absolute. @defaultValue false
   */
  relative?: boolean;
}
