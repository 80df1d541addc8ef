import type { Vec3Like } from "./check.js";
import type { Cloth } from "./index.js";

/**
 * What pointers hold of a cloth: mice, fingers, controllers, each by a name of your choice (such as the
 * `pointerId` of an event) and a ray. A pointer pulls along the plane through what it holds that `facing` is
 * the normal of. For any engine; `muslin/three` has `ClothPointers`, which listens to a canvas by itself.
 *
 * A pointer whose cloth is reset or freed holds nothing from then on, and is not told so by an error.
 */
export class Pointers {
  /** @param options.radius how far beside the cloth a ray may pass and still take hold of it [m], 0 */
  constructor(cloth: Cloth, options?: { radius?: number });

  /** The cloth that is pulled. */
  readonly cloth: Cloth;
  /** How many pointers hold something. */
  readonly size: number;
  /** Whether this pointer holds something. */
  holds(pointer: unknown): boolean;

  /**
   * Takes hold of the cloth where the ray meets it, and says whether it does. `facing` is the normal of the plane
   * that `drag` stays in: give the way that the camera looks; the default is the ray's own direction. What the
   * pointer held before is let go.
   *
   * @throws if 64 grabs are held already
   */
  press(pointer: unknown, origin: Vec3Like, direction: Vec3Like, facing?: Vec3Like): boolean;
  /** Pulls what the pointer holds to where the ray meets the plane. Says whether it does. */
  drag(pointer: unknown, origin: Vec3Like, direction: Vec3Like): boolean;
  /** Lets go, with the speed that it has. Says whether something was held. */
  lift(pointer: unknown): boolean;
  /** Lets go of everything. */
  liftAll(): void;
}
