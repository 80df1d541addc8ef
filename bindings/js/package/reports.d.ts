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

/**
 * Something that happened in a tick, counted from creation or reset, at a place [m]. `particleA` and `particleB`
 * are particles, `vertex` and `source` are vertices, see `vertexParticles`.
 */
export type ClothEvent = { tick: number; position: Vec3 } & (
  | {
      /** The edge between the two tore. */
      kind: "edge-torn";
      particleA: number;
      particleB: number;
    }
  | {
      /**
       * `vertex` was split off from `source`. Where a particle with several vertices was split between them, so
       * that none had to be: both are the lowest vertex that went to the new particle.
       */
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
      /**
       * A cut made `vertex` on the edge between the two; and, if they are different vertices on either side of
       * that edge, the one after it for the other side.
       */
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
  /** How many particles there are. */
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
  /** The speed of its fastest particle [m/s]. */
  maxSpeed: number;
  /** Whether it sleeps, see `sleepSpeed` of the settings. */
  asleep: boolean;
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

/**
 * What had to be repaired of a mesh before it could be cloth, and what it is now. Repairs come in this order:
 * vertices are welded, triangles without an area and repeated ones are dropped, edges and vertices where more than
 * one sheet meets are split, triangles that face the other way are turned.
 */
export interface MeshReport {
  /** Vertices that were given. */
  vertices: number;
  /** Triangles that were given. */
  triangles: number;
  /** Particles that came of it. */
  particles: number;
  /** Triangles that were kept. */
  keptTriangles: number;
  /** Vertices that joined another one's particle. */
  weldedVertices: number;
  /** Triangles that were dropped: they had no area, or named a vertex twice. */
  droppedDegenerate: number;
  /** Triangles that were dropped: an earlier one has the same corners. */
  droppedDuplicates: number;
  /** Triangles that were turned round, so that they face as their neighbours do. */
  turnedTriangles: number;
  /** Edges that had more than two triangles. */
  splitEdges: number;
  /** Particles that came to be where sheets were parted that met at such an edge or at a mere point. */
  splitVertices: number;
  /** Vertices that no triangle uses: particles without mass that stay where they are, unless welded. */
  unusedVertices: number;
  /** Pieces: sets of triangles joined by edges. */
  pieces: number;
  /** Pieces that have no two sides; a line is left across them where neighbours face opposite ways. */
  oneSidedPieces: number;
  /** Whether it is woven as the regular grid that it was found to be. */
  isGrid: boolean;
}
