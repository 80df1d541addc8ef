// Reports of a cloth: ray hits, events, statistics, changed ranges, mesh repairs.

import type { Vec3 } from "./check.js";

/** The point where a ray hits the cloth. */
export interface Hit {
  /** The triangle; its vertices are `indices[3 * triangle]` and the two that follow. */
  triangle: number;
  /** The particle of the triangle that is nearest to the hit. */
  particle: number;
  /** Barycentric weight of the second corner. */
  u: number;
  /** Barycentric weight of the third corner. The first has 1 − u − v. */
  v: number;
  /** Distance from the origin of the ray [m]. */
  distance: number;
  /** Position of the hit [m]. */
  position: Vec3;
  /** Unit normal of the triangle, on the side that was hit. */
  normal: Vec3;
}

/** Mass, center of mass and momentum of a whole cloth, pinned particles included. */
export interface ClothMass {
  /** Sum of the masses of all particles [kg]. */
  total: number;
  /** Center of mass [m]. */
  center: Vec3;
  /** Sum of mass times velocity of all particles [kg·m/s]. */
  momentum: Vec3;
}

/**
 * Something that happened to the cloth. `tick` counts from creation or reset; `position` is where
 * it happened [m]. `particleA` and `particleB` are particles; `vertex` and `source` are vertices,
 * see `cloth.vertexParticles`.
 *
 * @example
 * ```js
 * for (const event of cloth.events()) {
 *   if (event.kind === "edge-torn") playRip(event.position);
 * }
 * ```
 */
export type ClothEvent = { tick: number; position: Vec3 } & (
  | {
      /** The edge between two particles tore or was cut. */
      kind: "edge-torn";
      particleA: number;
      particleB: number;
    }
  | {
      /**
       * `vertex` was split off from `source`. If a particle with several vertices was split so that
       * no vertex had to be, both are the lowest vertex that moved to the new particle.
       */
      kind: "vertex-split";
      vertex: number;
      source: number;
    }
  | {
      /** A piece of `count` triangles came off; `vertex` belongs to one of them. */
      kind: "piece-detached";
      vertex: number;
      count: number;
    }
  | {
      /**
       * `count` particles had positions that are not finite, and were put back where they last
       * were.
       */
      kind: "recovered";
      count: number;
    }
  | {
      /** Tearing stopped because `extraParticles` is used up. Reported once. */
      kind: "reserve-used-up";
    }
  | {
      /**
       * Pins, grabs or anchors hold the cloth apart: `count` links exceed `maxStretch`, one of them
       * between these two particles. Reported once, until the limit holds again.
       */
      kind: "held-apart";
      particleA: number;
      particleB: number;
      count: number;
    }
  | {
      /**
       * A cut made `vertex` on the edge between two particles. If the vertices on the two sides of
       * the edge differ (a texture seam), the vertex after it belongs to the other side.
       */
      kind: "edge-divided";
      particleA: number;
      particleB: number;
      vertex: number;
    }
  | {
      /**
       * Pins, attachments or grabs hold `count` particles inside a collider; `particleA` is the
       * first of them. Reported once, until none is inside.
       */
      kind: "held-inside";
      particleA: number;
      count: number;
    }
  | {
      /**
       * `count` particles that nothing holds are inside a collider, because other colliders or held
       * cloth leave them no room, or because they were placed there; `particleA` is the first of
       * them. Reported once, until none is inside.
       */
      kind: "free-inside";
      particleA: number;
      count: number;
    }
  | {
      /**
       * With surface collision, edges of the cloth pass through triangles of it: `count` pairs of
       * both. One of the edges is between these two particles. Reported once, until none does.
       */
      kind: "layers-cross";
      particleA: number;
      particleB: number;
      count: number;
    }
  | {
      /** The stitch between two particles tore, see `sew`. */
      kind: "stitch-torn";
      particleA: number;
      particleB: number;
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

/** Statistics of a cloth. */
export interface Stats {
  /** Number of particles. */
  particles: number;
  /** Number of triangles. */
  triangles: number;
  /** Number of links at creation. */
  constraints: number;
  /** Number of links that are not torn. */
  activeConstraints: number;
  /** Number of pieces: sets of triangles connected by edges. */
  pieces: number;
  /** Ticks since creation or reset. */
  ticks: number;
  /** Where the time is between the last two ticks, 0 to 1; the same as `cloth.blend`. */
  blend: number;
  /** Largest strain of a stretch link: 0.01 means 1 % longer than at rest. */
  maxStretch: number;
  /** Mean strain of the stretch links. */
  meanStretch: number;
  /** Kinetic energy [J]. */
  kineticEnergy: number;
  /**
   * Number of links beyond `maxStretch` of the settings because pins, grabs or anchors hold them
   * apart.
   */
  overStretched: number;
  /**
   * Number of particles that pins, attachments or grabs hold more than 0.1 mm inside a collider.
   * Nothing is inside a triangle mesh, which has two sides.
   */
  heldInside: number;
  /** Number of other particles more than 0.1 mm inside a collider. */
  freeInside: number;
  /**
   * Number of crossings: pairs of an edge of the cloth and a triangle that it passes through, as
   * found in the last tick; 0 without surface collision. A cloth without known crossings is tested
   * in parts, all of it in 16 ticks.
   */
  crossings: number;
  /** Speed of the fastest particle [m/s]. */
  maxSpeed: number;
  /**
   * Number of substeps of the last tick: `substeps` of the settings, or more where cloth and
   * colliders moved fast relative to each other. A cloth that sleeps runs none and keeps the number.
   */
  substeps: number;
  /** Whether the cloth is asleep, see `sleepSpeed` of the settings. */
  asleep: boolean;
  /** Memory that the cloth occupies, approximately [bytes]. */
  bytes: number;
  /** Time of each stage in the last call that ran ticks [s]; all 0 unless `timing` is on. */
  seconds: Record<Stage, number>;
}

/**
 * The ranges of vertices and indices that a change of topology affected. They cover the data that
 * does not change every tick: indices, uvs, source vertices, frayed borders.
 */
export interface Changes {
  /** First vertex that is new or changed. */
  firstVertex: number;
  /** Number of vertices from there on. */
  vertexCount: number;
  /** First index that is new or changed. */
  firstIndex: number;
  /** Number of indices from there on. */
  indexCount: number;
}

/**
 * How a mesh was repaired when the cloth was created, what it is now, and its quality. The order of
 * the repairs is: weld vertices; drop degenerate and duplicate triangles; split edges and vertices
 * where more than one sheet meets; turn triangles that face the other way than their neighbours;
 * collapse short edges.
 */
export interface MeshReport {
  /** Vertices in the descriptor. */
  vertices: number;
  /** Triangles in the descriptor. */
  triangles: number;
  /** Particles of the cloth. */
  particles: number;
  /** Triangles of the cloth. */
  keptTriangles: number;
  /** Vertices that were welded to another one and share its particle. */
  weldedVertices: number;
  /** Triangles that were dropped because they have no area or use a vertex twice. */
  droppedDegenerate: number;
  /** Triangles that were dropped because an earlier one has the same corners. */
  droppedDuplicates: number;
  /** Triangles that were turned to face as their neighbours do. */
  turnedTriangles: number;
  /** Edges that had more than two triangles, and were split. */
  splitEdges: number;
  /**
   * Particles that were added to separate sheets at such edges, or where sheets touch at a point.
   */
  splitVertices: number;
  /**
   * Vertices that no triangle uses; their particles have no mass and do not move, unless welded.
   */
  unusedVertices: number;
  /** Number of pieces: sets of triangles connected by edges. */
  pieces: number;
  /** Pieces with one side only (Möbius strips), in which some neighbours face opposite ways. */
  oneSidedPieces: number;
  /** Whether the mesh was recognised as a regular grid, see `MeshDesc`. */
  isGrid: boolean;
  /** Length of the shortest edge [m]. */
  shortestEdge: number;
  /** Mean length of the edges [m]. */
  meanEdge: number;
  /**
   * Largest aspect ratio of a triangle: its longest edge divided by its least height. 1.15 with
   * equal edges, 2 on a grid.
   */
  worstAspect: number;
  /** Thin triangles: those with an aspect ratio above 100. */
  thinTriangles: number;
  /** The triangle with the largest aspect ratio, by its number among the given ones. */
  thinnestTriangle: number;
  /** Edges below `simplifyBelow` that were collapsed; each removed a particle. */
  collapsedEdges: number;
  /** Triangles that were removed with collapsed edges. */
  collapsedTriangles: number;
  /** Triangles that were removed at a border because they were lower than `simplifyBelow`. */
  trimmedTriangles: number;
  /** Edges that were flipped because a triangle was lower than `simplifyBelow`. */
  flippedEdges: number;
  /**
   * Edges that are still shorter than `simplifyBelow`: to collapse them would change the topology, a
   * border, a seam or a pin, or would turn a triangle over.
   */
  shortEdges: number;
  /**
   * A sentence for each property of the mesh that its author should know of: what was removed or
   * split, and what makes the cloth slow or uneven. Empty for a good mesh.
   */
  warnings: readonly string[];
}
