//! Scratch buffers of the stages of a tick.
//!
//! Data only: caches of one cloth that can be rebuilt; none of it is saved or hashed. The doc of a
//! field names the stage that writes it.
//!
//! Invariant: `cloth::reserve` allocates the buffers for all particles that ticks may make, so that
//! no tick allocates.

use crate::math::columns::Columns;
use crate::math::heap_bytes::heap_bytes;
use crate::mesh::split_vertex::OpenedEdge;
use crate::solver::bend::bend_scratch::BendScratch;
use crate::solver::collide::contact_scratch::ContactScratch;
use crate::solver::integrate::expected_momentum::ExpectedMomentum;
use crate::solver::particle_stage::interleaved_particles::InterleavedParticles;
use crate::solver::stretch::damping_scratch::DampingScratch;
use crate::solver::stretch::end_weights::EndWeights;
use crate::solver::stretch::line_scratch::LineScratch;
use crate::solver::stretch::rollback_state::RollbackState;
use crate::solver::topology::piece_labels::PieceLabels;
use crate::solver::topology::piece_members::PieceGroups;
use crate::solver::topology::tear_scratch::TearScratch;
use glam::Vec3;

/// Scratch buffers, allocated once so that no tick allocates.
///
/// Columns have one entry per particle, unless their doc says otherwise.
#[derive(Clone, Debug)]
pub(crate) struct TickScratch {
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
}

heap_bytes!(
    TickScratch { acceleration, relative_wind, displacement, predicted, initial_velocity, tether_pins, effective_mass, correction, anchor_moved, end_weights, interleaved, lines, bend, damping, tear, rollback, opened_edges, pieces, piece_groups, piece_stack }
    plain { contacts, expected_momentum, rests_on_collider }
);

impl TickScratch {
    /// Allocates buffers for `capacity` particles, of which `count` exist now. Bending, lines,
    /// damping, pieces and tears get theirs later, see `cloth::reserve`.
    pub fn new(count: usize, capacity: usize) -> Self {
        let zero = |list: &mut Columns| (0..count).for_each(|_| list.push(Vec3::ZERO));
        let mut scratch = Self {
            acceleration: Columns::with_capacity(capacity),
            relative_wind: Columns::with_capacity(capacity),
            displacement: Columns::with_capacity(capacity),
            predicted: Columns::with_capacity(capacity),
            initial_velocity: Columns::with_capacity(capacity),
            tether_pins: Columns::with_capacity(capacity),
            correction: Columns::with_capacity(capacity),
            effective_mass: Vec::new(),
            anchor_moved: Vec::new(),
            end_weights: EndWeights::default(),
            interleaved: InterleavedParticles::default(),
            lines: LineScratch::default(),
            bend: BendScratch::default(),
            damping: DampingScratch::default(),
            contacts: ContactScratch::default(),
            tear: TearScratch::default(),
            rollback: RollbackState::with_capacity(capacity),
            opened_edges: Vec::new(),
            pieces: PieceLabels::default(),
            expected_momentum: None,
            rests_on_collider: false,
            piece_groups: PieceGroups::default(),
            piece_stack: Vec::new(),
        };
        zero(&mut scratch.acceleration);
        zero(&mut scratch.relative_wind);
        zero(&mut scratch.displacement);
        zero(&mut scratch.predicted);
        scratch
    }

    /// Allocates the buffers that have one entry per particle for `capacity` particles.
    pub fn reserve(&mut self, capacity: usize) {
        let Self { acceleration, relative_wind, displacement, predicted, correction, .. } = self;
        for columns in [acceleration, relative_wind, displacement, predicted, correction] {
            columns.reserve(capacity);
        }
        for columns in [&mut self.initial_velocity, &mut self.tether_pins] {
            columns.reserve(capacity);
        }
        self.rollback.positions.reserve(capacity);
    }

    /// Appends one zeroed particle to the buffers that have one entry per particle.
    pub fn push_particle(&mut self) {
        self.acceleration.push(Vec3::ZERO);
        self.relative_wind.push(Vec3::ZERO);
        self.displacement.push(Vec3::ZERO);
        self.predicted.push(Vec3::ZERO);
    }
}
