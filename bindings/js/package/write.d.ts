// Where vertices and indices are written.

/** What of a vertex a stream takes. */
export type Attribute =
  /** Where it is, x y z [m]; in 16 bits x y z 1. */
  | "position"
  /** Its unit normal, x y z; in 16 bits x y z 0. */
  | "normal"
  /**
   * x y z w: the unit direction square to the normal in which the texture coordinate u grows, and 1 or −1;
   * v grows along cross(normal, tangent) · w. It is the sum over the vertex's triangles of
   * (p · dv₂ − q · dv₁) · sign(du₁ · dv₂ − du₂ · dv₁), p and q being edges and du, dv what they are in the
   * texture, made square to the normal; where a texture says nothing, any such direction.
   */
  | "tangent"
  /** Its texture coordinates, u v. */
  | "uv"
  /** 1 at a border that a tear or a cut made, else 0; in 16 bits followed by 0. */
  | "frayed";

/** How numbers are written. */
export type VertexFormat =
  /** 32-bit floats. */
  | "f32"
  /** 16-bit floats; what is beyond 65504 becomes that. */
  | "f16"
  /** 16-bit whole numbers from −32767 to 32767, which stand for −1 to 1; no positions, no uvs. */
  | "snorm16"
  /**
   * A normal as two of those, x and y where it meets the octahedron |x| + |y| + |z| = 1, its lower half
   * (z < 0) folded outward, to (1 − |y|) · sign x and (1 − |x|) · sign y; a tangent as those, w and 0.
   */
  | "octahedral16";

/** A place that one attribute of vertices is written to; streams may share a buffer. */
export interface Stream {
  /** What is written. */
  attribute: Attribute;
  /** How; "f32". */
  format?: VertexFormat;
  /** Where: a buffer of your own, or a view of one. */
  buffer: ArrayBuffer | ArrayBufferView;
  /** Bytes from the beginning of `buffer` to the first vertex; 0. */
  offset?: number;
  /** Bytes from one vertex to the next, a multiple of a number's size; 0 leaves no gaps. */
  stride?: number;
}

/** Which vertices are written, and how they are placed. */
export interface WriteDesc {
  /** The first vertex; 0. It goes to the beginning of each stream. */
  firstVertex?: number;
  /** How many; all from the first one on. */
  vertexCount?: number;
  /** How far from the last tick to this one, 0 to 1; 1. `cloth.blend` is where the time is. */
  blend?: number;
  /**
   * What is done to positions, after the offset: three rows of four numbers, so that x becomes
   * t[0] · x + t[1] · y + t[2] · z + t[3]; nothing. Normals stay square to the surface and on their side
   * of it, tangents along it.
   */
  transform?: readonly number[] | Float32Array | Float64Array;
  /** Normals point to the other side, for the back of a cloth; false. */
  flipNormals?: boolean;
  /** How far positions are moved along the normals that are written [m]; 0. */
  offset?: number;
}
