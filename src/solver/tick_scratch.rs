//! Scratch buffers of the stages of a tick.
//!
//! Data only: caches of one cloth that can be rebuilt; none of it is saved or hashed. The doc of a
//! field names the stage that writes it. The lists whose content lives within a tick belong to the
//! thread: `scratch_pool` lends them to the cloth that it steps, and they are empty otherwise.
//!
//! Invariant: `cloth::reserve` and `scratch_pool` allocate the buffers for all particles that ticks
//! may make, so that no tick allocates.

use crate::math::column::Column;
use crate::math::columns::Columns;
use crate::math::heap_bytes::heap_bytes;
use crate::math::swap::swap;
use crate::mesh::split_vertex::OpenedEdge;
use crate::solver::bend::bend_scratch::BendScratch;
use crate::solver::collide::contact_scratch::ContactScratch;
use crate::solver::integrate::expected_momentum::ExpectedMomentum;
use crate::solver::particle_stage::interleaved_particles::InterleavedParticles;
use crate::solver::self_collide::particle_pairs::ParticleCollision;
use crate::solver::self_collide::surface::surface_collision::SurfaceCollision;
use crate::solver::stretch::damping_scratch::DampingScratch;
use crate::solver::stretch::end_weights::EndWeights;
use crate::solver::stretch::line_scratch::{LineLengths, LineScratch};
use crate::solver::stretch::rollback_state::RollbackState;
use crate::solver::topology::piece_labels::PieceLabels;
use crate::solver::topology::piece_members::PieceGroups;
use crate::solver::topology::tear_scratch::TearScratch;
use core::sync::atomic::{AtomicUsize, Ordering};
use glam::Vec3;

/// Scratch buffers, allocated once so that no tick allocates.
///
/// Columns have one entry per particle, unless their doc says otherwise.
#[derive(Debug, Default)]
pub(crate) struct TickScratch {
    /// The cloth that these buffers belong to; in a pool, the last one that they were lent to.
    pub owner: ScratchOwner,
    /// Lengths of the lists of `lines`. Written by `cloth::reserve`.
    pub line_lengths: LineLengths,
    /// Acceleration of each particle by gravity and air [m/s²]. Written by stage `Forces`, once per
    /// tick or more often.
    pub acceleration: Columns,
    /// Air velocity minus particle velocity [m/s]. Stage `Forces` writes it and reads it at once;
    /// `momentum` uses it as a buffer for positions [m].
    pub relative_wind: Columns,
    /// Predicted displacement of each particle in this substep [m]. Written by stage `Predict`; the
    /// strain limit sets it to zero at the end of the tick.
    pub displacement: Columns,
    /// Predicted position of each particle in this substep [m]. Written by stage `Predict`; at the
    /// end of the tick the strain limit stores the positions before its corrections here.
    pub predicted: Columns,
    /// Velocity of each particle at the start of the tick [m/s]. Written by `strain_limit`; empty
    /// without a strain limit.
    pub initial_velocity: Columns,
    /// Position of the pin to which each particle is tethered [m], if there are several pins.
    /// Written by `tethers`.
    pub tether_pins: Columns,
    /// Mass plus soft-pin term of each particle [kg]; empty without soft pins. Written by
    /// `kinematic::targets`, for the bending solve.
    pub effective_mass: Vec<f32>,
    /// What internal stages moved each particle by in this substep [m]. Written by `momentum`.
    pub correction: Columns,
    /// Indices of the particles that anchors moved in this substep. Written by
    /// `kinematic::anchors`.
    pub anchor_moved: Vec<u32>,
    /// Weights of both ends of each link, from inverse masses. Written by
    /// `stretch::inverse_masses`.
    pub end_weights: EndWeights,
    /// Positions [m] as `[x, y, z, 0]`, and inverse masses [1/kg], for kernels that gather
    /// particles. Written by `mesh_kernel::gather` and the stages up to `mesh_kernel::scatter`.
    pub interleaved: InterleavedParticles,
    /// Particles and elimination steps of the line solver. Written by `line_gather` and
    /// `line_solver`.
    pub lines: LineScratch,
    /// Normals, rest directions and linear systems of stage `Bend`, which writes them.
    pub bend: BendScratch,
    /// Lagrange multiplier of each link, and of each dynamic link, accumulated in this substep.
    /// Written by stages `Stretch` and `Shear`.
    pub lambda: [Column; 2],
    /// Rest lengths [m] and compliances [m/N] of the links without damping. Written by
    /// `stretch::damping`.
    pub damping: DampingScratch,
    /// Nearby blocks and candidate pairs, contacts, and impulses on the colliders. Written by the
    /// stages in `collide`.
    pub contacts: ContactScratch,
    /// Tear candidates and fans. Written by stage `Tear`.
    pub tear: TearScratch,
    /// Positions [m] that the strain limit falls back to. Written by `stretch::rollback`.
    pub rollback: RollbackState,
    /// Edges that the current vertex split opened. Written by `topology::tear`.
    pub opened_edges: Vec<OpenedEdge>,
    /// Piece of each triangle, now and before the last tear or cut, and the particles of each piece.
    /// Written by tears and cuts.
    pub pieces: PieceLabels,
    /// What the momentum of a free cloth that hits a collider should be at the end of this substep.
    /// Written by `impact_momentum`.
    pub expected_momentum: Option<ExpectedMomentum>,
    /// Whether the cloth touched a collider without moving fast when the last substep ended. Written
    /// by `piece_momentum`.
    pub rests_on_collider: bool,
    /// Pieces that touch each other in this substep. Written by `piece_momentum`.
    pub piece_groups: PieceGroups,
    /// Stack of the flood fill that labels the pieces.
    pub piece_stack: Vec<u32>,
    /// Data of particle collision, while `self_collision` is `Particles`. Written by
    /// `particle_contacts`.
    pub particle_collision: Option<Box<ParticleCollision>>,
    /// Data of surface collision, while `self_collision` is `Surface`. Written by `surface_stages`.
    pub surface_collision: Option<Box<SurfaceCollision>>,
}

impl Clone for TickScratch {
    /// Makes buffers without memory: a cloned cloth allocates and fills its own.
    fn clone(&self) -> Self {
        Self::empty()
    }
}

heap_bytes!(
    TickScratch {
        tether_pins, effective_mass, anchor_moved, end_weights, bend, damping, contacts, tear,
        opened_edges, pieces, piece_groups, piece_stack, particle_collision, surface_collision,
    } plain {
        owner, line_lengths, acceleration, relative_wind, displacement, predicted,
        initial_velocity, correction, interleaved, lines, lambda, rollback, expected_momentum,
        rests_on_collider,
    }
);

/// The identity of a cloth among all those that use pools of scratch buffers. It changes with what the
/// cloth needs, so that a pool which it was lent to before that has to be adapted.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct ScratchOwner {
    id: usize,
    /// Number of particles, and of dynamic links for which there is memory.
    pub lengths: [usize; 2],
}

impl Default for ScratchOwner {
    /// Returns an identity that no other cloth has.
    fn default() -> Self {
        static NEXT: AtomicUsize = AtomicUsize::new(0);
        Self { id: NEXT.fetch_add(1, Ordering::Relaxed), lengths: [0; 2] }
    }
}

impl TickScratch {
    /// Makes buffers without memory.
    #[inline(never)]
    pub fn empty() -> Self {
        Self::default()
    }

    /// Exchanges the lists whose content lives within a tick with those of `other`.
    pub fn swap_lent(&mut self, other: &mut Self) {
        let [own, others] = [&mut *self, &mut *other].map(Self::lent_columns);
        own.into_iter().zip(others).for_each(|(own, other)| swap(own, other));
        swap(&mut self.interleaved, &mut other.interleaved);
        swap(&mut self.lines, &mut other.lines);
        swap(&mut self.lambda, &mut other.lambda);
        self.contacts.swap_lent(&mut other.contacts);
        self.bend.plates.swap_lent(&mut other.bend.plates);
    }

    fn lent_columns(&mut self) -> [&mut Columns; 8] {
        [
            &mut self.acceleration,
            &mut self.relative_wind,
            &mut self.displacement,
            &mut self.predicted,
            &mut self.initial_velocity,
            &mut self.correction,
            &mut self.rollback.positions,
            &mut self.rollback.before,
        ]
    }

    /// Makes the same lists those of a cloth that was just made, but for their memory.
    #[inline(never)]
    pub fn clear_lent(&mut self) {
        self.lent_columns().into_iter().for_each(|columns| columns.resize(0));
        self.interleaved.clear();
        self.lines.clear();
        self.lambda.iter_mut().for_each(Column::clear);
        self.contacts.clear_lent();
        self.bend.plates.clear_lent();
    }

    /// Allocates the columns for `capacity` particles, of which `count` exist now: also those that
    /// only a strain limit or a collider needs, where there is one.
    #[inline(never)]
    pub fn reserve_columns(&mut self, count: usize, capacity: usize, [limit, body]: [bool; 2]) {
        let is_used = [true, true, true, true, limit, true, true, body];
        for (columns, is_used) in self.lent_columns().into_iter().zip(is_used) {
            if is_used {
                columns.reserve(capacity);
            }
        }
        for columns in self.lent_columns().into_iter().take(4) {
            columns.resize(count);
        }
    }

    /// Appends one zeroed particle to the buffers that have one entry per particle.
    pub fn push_particle(&mut self) {
        self.acceleration.push(Vec3::ZERO);
        self.relative_wind.push(Vec3::ZERO);
        self.displacement.push(Vec3::ZERO);
        self.predicted.push(Vec3::ZERO);
    }
}
