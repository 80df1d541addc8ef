/// <reference lib="esnext.disposable" />

import type { Stream, WriteDesc } from "./write.js";

/** A render mesh for `cloth.skin()`. */
export interface SkinDesc {
  /**
   * Positions of the vertices, x y z x y z … [m], where the cloth is now; from 3 to 4194304
   * vertices. None may be farther from the cloth than half the diagonal of the cloth's bounding
   * box.
   */
  positions: Float32Array | Float64Array | readonly number[];
  /** Three vertices per triangle, counter-clockwise when seen from the front. */
  indices: Uint32Array | Uint16Array | readonly number[];
  /** Texture coordinates, u v u v …; default: none, zeros. */
  uvs?: Float32Array | Float64Array | readonly number[];
  /**
   * Curvature over each triangle of the cloth, from 0 (flat triangles) to 1; default 1. Above 0, a
   * fine skin has a smooth outline on a coarse cloth (Phong tessellation). At 1 a skin lies on a
   * circle between particles that lie on one. Particles are on the surface for any value.
   */
  smoothness?: number;
}

/**
 * A render mesh that follows a cloth, usually a fine mesh on a coarse cloth. `cloth.skin()` makes
 * it.
 *
 * The lists are views of the module's own memory, as those of a cloth: read them, do not write to
 * them, and get them anew in each frame. They are computed at the first read after a change of the
 * cloth.
 *
 * Every member except `free()` and `isFreed` throws after `free()`, and after `free()` of the cloth.
 * A skin that you do not free is freed some time after its last reference is gone. `cloth.save()`
 * contains no skins.
 */
export class Skin {
  private constructor();

  /** Frees the memory of the skin at once. Calling it again has no effect. */
  free(): void;
  /** The same as `free()`, for `using skin = cloth.skin(desc)`. */
  [Symbol.dispose](): void;
  /** Whether the skin was freed. */
  readonly isFreed: boolean;

  /** Positions of the vertices, x y z x y z … [m]. */
  readonly positions: Float32Array;
  /** Unit normals of the vertices, x y z x y z …. */
  readonly normals: Float32Array;
  /** Texture coordinates of the vertices, u v u v …; zeros if none were given. */
  readonly uvs: Float32Array;
  /** Three vertices per triangle. Triangles keep their numbers, and their number never changes. */
  readonly indices: Uint32Array;
  /**
   * The given vertex that each vertex came from. Given vertices keep their numbers; copies that
   * tears and cuts need follow.
   */
  readonly sourceVertices: Uint32Array;
  /** 1 for each vertex on an edge that a tear or cut opened, otherwise 0. */
  readonly frayed: Uint8Array;
  /** The largest number of vertices that the skin can ever have. */
  readonly vertexCapacity: number;
  /** Changes whenever the indices or the number of vertices change. */
  readonly topologyRevision: number;

  /**
   * Writes vertices to your own buffers, as `cloth.writeVertices` does, and returns how many.
   *
   * @throws if a stream or a field of `desc` is wrong; the buffers are untouched then
   */
  write(streams: readonly Stream[], desc?: WriteDesc): number;
}
