import { BufferGeometry } from "three";
import type { Cloth } from "./index.js";

/**
 * A geometry that follows a cloth. Its buffers are made once, with room for all that tears may add;
 * the draw range covers what is in use.
 *
 * `dispose()` frees the buffers of the graphics card and leaves the cloth alone.
 */
export class ClothGeometry extends BufferGeometry {
  constructor(cloth: Cloth);

  /** The cloth that it follows. */
  readonly cloth: Cloth;

  /**
   * Takes over what changed: positions and normals when the cloth moved, indices and uvs when it tore.
   * Call it after `cloth.advance()`. Says whether anything changed.
   *
   * @throws if the cloth was freed
   */
  update(): boolean;

  /** A still copy, which follows nothing. */
  clone(): this;
}
