// What a cloth tells.

import type { Vec3 } from "./check.js";

/** Where a ray hits a cloth. */
export interface Hit {
  /** The triangle: indices `3 * triangle` and the two after it. */
  triangle: number;
  /** Its particle nearest to the hit. */
  particle: number;
  /** Weight of the triangle's second corner. */
  u: number;
  /** Weight of the triangle's third corner. */
  v: number;
  /** Distance from the ray's origin [m]. */
  distance: number;
  /** Where [m]. */
  position: Vec3;
  /** Unit normal of the triangle, on the side that was hit. */
  normal: Vec3;
}

/** Something that happened in a tick, counted from creation or reset, at a place [m]. */
export type ClothEvent = { tick: number; position: Vec3 } & (
  | {
      /** The edge between the two tore. */
      kind: "edge-torn";
      particleA: number;
      particleB: number;
    }
  | {
      /** `vertex` was split off from `source`. */
      kind: "vertex-split";
      vertex: number;
      source: number;
    }
  | {
      /** A piece of `count` triangles, one of them at `vertex`, came off. */
      kind: "piece-detached";
      vertex: number;
      count: number;
    }
  | {
      /** `count` particles had left the realm of numbers and were put back where they last were. */
      kind: "recovered";
      count: number;
    }
  | {
      /** Tearing stopped: the room that was reserved for it is used up. Told once. */
      kind: "reserve-used-up";
    }
  | {
      /**
       * Pins or grabs hold the cloth apart: `count` links are past `maxStretch`, one of them between
       * the two. Told once, until the bound holds again.
       */
      kind: "held-apart";
      particleA: number;
      particleB: number;
      count: number;
    }
  | {
      /** A cut made `vertex` on the edge between the two. */
      kind: "edge-divided";
      particleA: number;
      particleB: number;
      vertex: number;
    }
);

/** The stages of a tick. */
export type Stage =
  | "colliders"
  | "forces"
  | "predict"
  | "hold"
  | "tethers"
  | "stretch"
  | "shear"
  | "bend"
  | "pairs"
  | "self-contacts"
  | "contacts"
  | "velocities"
  | "tear"
  | "limit"
  | "guard"
  | "outputs";

/** Numbers about a cloth. */
export interface Stats {
  /** How many particles (vertices) there are. */
  particles: number;
  /** How many triangles there are. */
  triangles: number;
  /** How many links it was woven with. */
  constraints: number;
  /** How many links hold now. */
  activeConstraints: number;
  /** How many pieces hang together by edges. */
  pieces: number;
  /** Ticks since it was made or reset. */
  ticks: number;
  /** How far to blend from the last tick to this one when drawing. */
  blend: number;
  /** The greatest stretch of a stretch link: 0.01 is 1 % over its rest length. */
  maxStretch: number;
  /** The mean stretch of the stretch links. */
  meanStretch: number;
  /** Energy of motion [J]. */
  kineticEnergy: number;
  /** How many links are past `maxStretch`, if there is such a bound: pins or grabs hold them apart. */
  overStretched: number;
  /** Memory that it holds [B], about. */
  bytes: number;
  /** Time that each stage took in the last call that ran ticks [s]; zeros unless `timing` is on. */
  seconds: Record<Stage, number>;
}

/**
 * The parts of a cloth's lists that changed with its triangles: of what does not change with every tick, as
 * uvs, source vertices and frayed borders.
 */
export interface Changes {
  /** The first vertex that is new or not as it was. */
  firstVertex: number;
  /** How many vertices from there on. */
  vertexCount: number;
  /** The first index that is new or not as it was. */
  firstIndex: number;
  /** How many indices from there on. */
  indexCount: number;
}
