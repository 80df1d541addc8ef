/**
 * Cloth as a component of react-three-fiber, release 8 or newer.
 *
 * @example
 * ```jsx
 * <Canvas>
 *   <Cloth grid={{ columns: 40, rows: 40, spacing: 0.05, material: "denim" }} wind={{ velocity: [0, 0, 2] }}>
 *     <meshStandardMaterial color="crimson" side={DoubleSide} />
 *     <Collider shape="sphere" radius={0.3} position={[1, -1, 0]} />
 *   </Cloth>
 * </Canvas>
 * ```
 *
 * @module
 */

import type { ThreeElements } from "@react-three/fiber";
import type { ForwardRefExoticComponent, ReactNode, RefAttributes } from "react";
import type { Group, Material, Mesh } from "three";
import type { ColliderDesc, Cloth as MuslinCloth, GridDesc, MeshDesc, Wind } from "./index.js";
import type { ClothGeometry } from "./three.js";

type MeshProps = Omit<ThreeElements["mesh"], "args" | "children" | "geometry" | "ref">;
type GroupProps = Omit<ThreeElements["group"], "args" | "children" | "ref">;

/** The props of `<Cloth>`; all others are props of its mesh, such as `position` and `castShadow`. */
export type ClothProps = MeshProps & {
  /**
   * A grid, as `Cloth.grid` of `muslin` takes it. If `material` or `settings` change, the cloth
   * takes over the fields that are given; if another field changes, a new cloth is made.
   */
  grid?: GridDesc;
  /** A mesh in place of a grid, as `Cloth.mesh` of `muslin` takes it; changes as those of `grid`. */
  mesh?: MeshDesc;
  /** The air around the cloth; a change takes over the fields that are given. */
  wind?: Partial<Wind>;
  /**
   * Whether mice and fingers pull the cloth, and how far a press may miss it [m]. Default: true,
   * with radius 0. A press that grabs the cloth reaches neither camera controls nor the handlers of
   * other objects.
   */
  pointers?: boolean | { radius?: number };
  /** Whether the cloth stands still; default false. */
  paused?: boolean;
  /** The material of three.js, colliders, and objects that move with the mesh. */
  children?: ReactNode;
};

/**
 * A mesh that draws a cloth and advances it in each frame. The cloth is simulated in the local
 * space of the mesh and freed when the component is removed.
 *
 * The first one loads the module with `init()` of `muslin` and suspends until it is loaded, unless
 * you loaded it before, such as with `muslin/inline`. The ref gives the mesh, whose
 * `geometry.cloth` is the cloth.
 *
 * @throws to the nearest error boundary, if the module cannot be loaded or if a field is wrong
 */
export const Cloth: ForwardRefExoticComponent<
  ClothProps & RefAttributes<Mesh<ClothGeometry, Material>>
>;

/** The props of `<Collider>`; all others are props of its group, such as `position` and `rotation`. */
export type ColliderProps = GroupProps &
  Omit<ColliderDesc, "position" | "rotation"> & {
    /** Objects that show the collider; they move with it. */
    children?: ReactNode;
  };

/**
 * A collider of the cloth that it is inside. It is where its group is, in position and rotation
 * (not in scale), also if you move that group through its ref in `useFrame`: the cloth is swept
 * along the way. If a field of the shape changes, a new collider is made.
 *
 * @throws to the nearest error boundary, if it is not inside `<Cloth>` or if a field is wrong
 */
export const Collider: ForwardRefExoticComponent<ColliderProps & RefAttributes<Group>>;

/**
 * Returns the cloth that the component is inside.
 *
 * @throws if it is not inside `<Cloth>`
 */
export function useCloth(): MuslinCloth;
