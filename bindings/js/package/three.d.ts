import { BufferGeometry } from "three";
import type { Camera, Mesh } from "three";
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

/**
 * Lets mice and fingers pull a cloth: listens to `element`, takes hold of what is pressed, and pulls it along the
 * plane that faces the camera. As many pointers as there are. A press that takes hold is kept from every other
 * listener of the element, so that `OrbitControls` does not turn the camera meanwhile.
 *
 * It sets `touch-action: none` on the element. The mesh may have any place, turn and even size in the scene.
 */
export class ClothPointers {
  /**
   * @param mesh draws the cloth: its geometry is a `ClothGeometry`
   * @param element what is drawn on: its bounds are those of the camera's picture
   * @param options.radius how far beside the cloth a press still takes hold of it [m], 0
   */
  constructor(mesh: Mesh<ClothGeometry>, camera: Camera, element: HTMLElement, options?: { radius?: number });

  /** Whether presses take hold; true. What is held stays so until it is lifted. */
  enabled: boolean;
  /** How many pointers hold the cloth. */
  readonly size: number;
  /** Whether the cloth is under a pointer: for the look of the cursor. */
  meets(event: { clientX: number; clientY: number }): boolean;
  /** Lets go of everything. */
  liftAll(): void;
  /** Lets go of everything and listens no more. */
  dispose(): void;
}
