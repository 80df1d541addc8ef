import { BufferGeometry } from "three";
import type { Camera, Mesh } from "three";
import type { Cloth } from "./index.js";

/**
 * A three.js geometry that follows a cloth, with positions, normals, uvs and indices.
 *
 * Its buffers are allocated once, with the capacity for everything that tears may add; the draw
 * range covers the part in use. `dispose()` frees the buffers of the graphics card and does not
 * free the cloth.
 *
 * @example
 * ```js
 * const sheet = new THREE.Mesh(new ClothGeometry(cloth), material);
 * renderer.setAnimationLoop(() => {
 *   cloth.advance(clock.getDelta());
 *   sheet.geometry.update();
 *   renderer.render(scene, camera);
 * });
 * ```
 */
export class ClothGeometry extends BufferGeometry {
  /** @throws if the cloth was freed */
  constructor(cloth: Cloth);

  /** The cloth that the geometry follows. */
  readonly cloth: Cloth;

  /**
   * Copies what changed since the last call: positions and normals if the cloth moved, indices and
   * uvs if it tore. Call it after `cloth.advance()`. Also updates the bounding sphere, and the
   * bounding box if there is one.
   *
   * @returns whether anything changed
   * @throws if the cloth was freed
   */
  update(): boolean;

  /** Returns a copy of the current state that does not follow the cloth. */
  clone(): this;
}

/**
 * Lets mice and fingers pull a cloth: it listens to the pointer events of `element`, grabs the
 * cloth where it is pressed, and drags it in the plane that faces the camera. Any number of
 * pointers can hold the cloth at once.
 *
 * If a press grabs the cloth, other listeners of the element do not get the event, so that
 * `OrbitControls` does not turn the camera meanwhile.
 *
 * It sets `touch-action: none` on the element. The mesh may have any position, rotation and
 * uniform scale in the scene.
 *
 * @example
 * ```js
 * const pointers = new ClothPointers(sheet, camera, renderer.domElement, { radius: 0.05 });
 * ```
 */
export class ClothPointers {
  /**
   * @param mesh the mesh that draws the cloth; its geometry is a `ClothGeometry`
   * @param element the canvas; its bounds are those of the camera's picture
   * @param options.radius how far a press may miss the cloth and still grab it [m]; default 0
   */
  constructor(
    mesh: Mesh<ClothGeometry>,
    camera: Camera,
    element: HTMLElement,
    options?: { radius?: number },
  );

  /** Whether presses grab the cloth; default true. Setting it to false keeps current grabs. */
  enabled: boolean;
  /** Number of pointers that hold the cloth. */
  readonly size: number;
  /** Returns whether the cloth is under a pointer; use it to choose the cursor. */
  meets(event: { clientX: number; clientY: number }): boolean;
  /** Lets go with all pointers. */
  liftAll(): void;
  /** Lets go with all pointers and removes the event listeners. */
  dispose(): void;
}
