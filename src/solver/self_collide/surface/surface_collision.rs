//! Data of surface collision: the BVH, all lists of a substep, and their scratch buffers.
//!
//! Plain data; the stages in `surface_stages` work on it. `World` holds it in a box while
//! `self_collision` is `Surface`.
//!
//! Reads the mesh and its rest shape at creation; writes nothing.
//!
//! Invariant: nothing here is state. It can be rebuilt at any tick without changing the result; the
//! forces for warm starts are kept elsewhere ([`WarmStart`]).
//!
//! [`WarmStart`]: crate::solver::self_collide::contact_forces::WarmStart

use crate::math::heap_bytes::HeapBytes;
use crate::math::wide4::Float4;
use crate::mesh::Mesh;
use crate::solver::self_collide::connected_pieces::piece_of_sites;
use crate::solver::self_collide::surface::cluster_bvh::ClusterBvh;
use crate::solver::self_collide::surface::contact::Contact;
use crate::solver::self_collide::surface::contact_graph::ContactGraph;
use crate::solver::self_collide::surface::contact_solver::ActiveContact;
use crate::solver::self_collide::surface::detection::{CandidateLists, new_escaped_batch};
use crate::solver::self_collide::surface::narrow_phase::NarrowPhase;
use crate::solver::self_collide::surface::separation_test::CandidatePairs;
use crate::solver::self_collide::surface::speculative::SpeculativeContact;
use crate::solver::self_collide::surface::split_separation::SplitSeparation;
use crate::solver::self_collide::surface::support_planes::SupportPlanes;
use crate::solver::self_collide::surface::swept_particles::SweptParticles;
use crate::solver::self_collide::surface::tick_bounds::TickBounds;
use crate::solver::self_collide::surface::untangle::SurfaceIntersections;
use crate::solver::self_collide::surface::warm_start::WarmStartIndex;
use glam::Vec3;

/// Everything that surface collision keeps between stages.
#[derive(Clone, Debug)]
pub(crate) struct SurfaceCollision {
    pub bvh: ClusterBvh,
    pub motion: SweptParticles,
    pub tick_bounds: TickBounds,
    /// Scratch: positions before the contact solver, or velocities relative to the rigid motion.
    pub vectors: Vec<Float4>,
    /// Indices of the cluster pairs that may meet in this substep.
    pub pairs: Vec<u32>,
    /// Candidate pairs of the substep, and those of escaped particles.
    pub candidates: CandidateLists,
    pub escaped_candidates: CandidatePairs,
    /// Narrow phase of vertex–triangle pairs, and of edge–edge pairs.
    pub narrow_phase: [NarrowPhase; 2],
    pub contacts: Vec<Contact>,
    pub speculative: Vec<SpeculativeContact>,
    /// Scratch: a bit for each speculative contact that is separated.
    pub separated: Vec<u8>,
    /// Whether contacts were detected since the tick began.
    pub has_detected: bool,
    /// Contacts that the contact solver works on in this substep.
    pub active: Vec<ActiveContact>,
    /// For each particle the share of its inverse mass that counts in the damping of contacts.
    pub mobility: Vec<f32>,
    pub graph: ContactGraph,
    /// Planes of the colliders that particles touch in this substep.
    pub planes: SupportPlanes,
    /// Scratch of the non-crossing pass: leader of each particle that rolled back.
    pub leaders: Vec<u32>,
    /// Scratch: open contacts of the non-crossing pass, or impacts.
    pub open: Vec<u32>,
    pub warm_start_index: WarmStartIndex,
    /// Connected piece of each site in the mesh as created.
    pub pieces: Vec<u32>,
    pub split_separation: SplitSeparation,
    pub intersections: SurfaceIntersections,
    /// Whether no substep of the tick has run yet.
    pub is_new_tick: bool,
    /// Gap between layers [m].
    pub gap: f32,
}

impl SurfaceCollision {
    /// Builds the BVH and allocates all lists for a cloth of `count` particles that may grow to
    /// `capacity`.
    pub fn new(mesh: &Mesh, rest: &[Vec3], count: usize, capacity: usize) -> Self {
        let pieces = piece_of_sites(mesh, rest.len());
        Self {
            bvh: ClusterBvh::new(mesh, rest, &pieces, capacity),
            motion: SweptParticles::new(capacity),
            tick_bounds: TickBounds::new(capacity),
            vectors: Vec::with_capacity(capacity),
            pairs: Vec::with_capacity(8 * count),
            candidates: CandidateLists::new(count),
            escaped_candidates: new_escaped_batch(),
            narrow_phase: [(); 2].map(|()| NarrowPhase::new(8 * count)),
            contacts: Vec::with_capacity(24 * count),
            speculative: Vec::with_capacity(16 * count),
            separated: Vec::with_capacity(2 * count),
            has_detected: false,
            active: Vec::with_capacity(24 * count),
            mobility: Vec::with_capacity(capacity),
            graph: ContactGraph::new(capacity, 24 * count),
            planes: SupportPlanes::new(capacity),
            leaders: Vec::with_capacity(capacity),
            open: Vec::with_capacity(24 * count),
            warm_start_index: WarmStartIndex::new(count),
            pieces,
            split_separation: SplitSeparation::new(capacity),
            intersections: SurfaceIntersections::default(),
            is_new_tick: false,
            gap: 0.0,
        }
    }

    /// Gap between layers in the last tick [m].
    pub fn gap(&self) -> f32 {
        self.gap
    }

    /// Makes the next tick search all pairs again.
    pub fn invalidate(&mut self) {
        self.tick_bounds.is_valid = false;
    }
}

impl HeapBytes for SurfaceCollision {
    fn heap_bytes(&self) -> usize {
        let words = self.open.capacity()
            + self.pieces.capacity()
            + self.leaders.capacity()
            + self.pairs.capacity()
            + self.mobility.capacity();
        self.bvh.bytes()
            + self.motion.bytes()
            + self.tick_bounds.bytes()
            + self.split_separation.bytes()
            + self.intersections.bytes()
            + self.graph.bytes()
            + self.planes.bytes()
            + self.escaped_candidates.bytes()
            + self.candidates.bytes()
            + self.narrow_phase.iter().map(NarrowPhase::bytes).sum::<usize>()
            + size_of::<Float4>() * self.vectors.capacity()
            + size_of::<Contact>() * self.contacts.capacity()
            + size_of::<ActiveContact>() * self.active.capacity()
            + size_of::<SpeculativeContact>() * self.speculative.capacity()
            + self.separated.capacity()
            + self.warm_start_index.bytes()
            + size_of::<u32>() * words
    }
}
