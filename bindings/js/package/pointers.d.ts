import type { Vec3Like } from "./check.js";
import type { Cloth } from "./index.js";

/**
 * Lets pointers (mice, fingers, controllers) pull a cloth in any rendering engine: you pass the ray
 * of each pointer event, and it grabs the cloth and drags what it holds.
 *
 * A pointer is any value that you use as its key, such as the `pointerId` of an event. While it is
 * dragged, the grabbed particle moves in a plane through the point where it was grabbed, with the
 * normal `facing`. If the cloth is reset or freed, all pointers let go without an error.
 *
 * `muslin/three` has `ClothPointers`, which listens to the events of a canvas itself.
 *
 * @example
 * ```js
 * const pointers = new Pointers(cloth, { radius: 0.05 });
 * canvas.onpointerdown = (e) => pointers.press(e.pointerId, ...rayOf(e), camera.forward);
 * canvas.onpointermove = (e) => pointers.drag(e.pointerId, ...rayOf(e));
 * canvas.onpointerup = (e) => pointers.lift(e.pointerId);
 * ```
 */
export class Pointers {
  /**
   * @param options.radius how far a ray may miss the cloth and still grab it [m]; default 0
   * @throws if `radius` is not a number
   */
  constructor(cloth: Cloth, options?: { radius?: number });

  /** The cloth that the pointers pull. */
  readonly cloth: Cloth;
  /** Number of pointers that hold the cloth. */
  readonly size: number;
  /** Returns whether `pointer` holds the cloth. */
  holds(pointer: unknown): boolean;

  /**
   * Grabs the cloth where the ray hits it, and returns whether it did. If `pointer` holds
   * something already, it lets go of that first.
   *
   * @param facing normal of the plane that `drag` moves in; pass the viewing direction of the
   *   camera. Default: `direction`
   * @throws if 64 grabs are held already, or if a vector is wrong
   */
  press(pointer: unknown, origin: Vec3Like, direction: Vec3Like, facing?: Vec3Like): boolean;
  /**
   * Moves the grab of `pointer` to where the ray hits its plane. Returns whether it moved; it does
   * not if the pointer holds nothing, or if the ray is nearly parallel to the plane or points away.
   */
  drag(pointer: unknown, origin: Vec3Like, direction: Vec3Like): boolean;
  /** Lets go of the cloth, which keeps its velocity. Returns whether `pointer` held something. */
  lift(pointer: unknown): boolean;
  /** Lets go with all pointers. */
  liftAll(): void;
}
