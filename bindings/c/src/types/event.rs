//! Events: what happened in the ticks.

use super::value::MuslinVec3;
use muslin_core::{Event, EventKind};

/// The edge between `particle_a` and `particle_b` tore.
pub const MUSLIN_EVENT_EDGE_TORN: u32 = 0;
/// `vertex` was split off from `source`.
///
/// If a particle with several vertices was split between these vertices, no vertex had to be split:
/// then both are the lowest vertex that moved to the new particle.
pub const MUSLIN_EVENT_VERTEX_SPLIT: u32 = 1;
/// A piece of `count` triangles came off; `vertex` belongs to one of them.
pub const MUSLIN_EVENT_PIECE_DETACHED: u32 = 2;
/// `count` particles had positions or velocities that were not finite, and were put back to their
/// last valid positions.
pub const MUSLIN_EVENT_RECOVERED: u32 = 3;
/// Tearing stopped: the particles that `extra_particles` reserved are used up. Reported once.
pub const MUSLIN_EVENT_RESERVE_USED_UP: u32 = 4;
/// Pins, grabs or anchors stretch the cloth past `max_stretch`: `count` links exceed it, one of
/// them between `particle_a` and `particle_b`. Reported once, until the limit holds again. Also for
/// `count` sewn pairs whose particles are both held apart.
pub const MUSLIN_EVENT_HELD_APART: u32 = 5;
/// A cut added `vertex` on the edge between `particle_a` and `particle_b`.
///
/// If the two sides of that edge have different vertices there, the next vertex belongs to the
/// other side.
pub const MUSLIN_EVENT_EDGE_DIVIDED: u32 = 6;
/// Pins, attachments or grabs hold `count` particles inside a collider; `particle_a` is the first
/// of them. Reported once, until none is inside.
pub const MUSLIN_EVENT_HELD_INSIDE: u32 = 7;
/// `count` particles that nothing holds are inside a collider; `particle_a` is the first of them.
/// Reported once, until none is inside.
///
/// Other colliders or held cloth leave them no room, or they were placed there.
pub const MUSLIN_EVENT_FREE_INSIDE: u32 = 8;
/// With surface collision, edges of the cloth pass through triangles of it: `count` pairs of both.
/// One of the edges is between `particle_a` and `particle_b`. Reported once, until none does.
pub const MUSLIN_EVENT_LAYERS_CROSS: u32 = 9;
/// The stitch between `particle_a` and `particle_b` tore, see muslin_cloth_sew.
pub const MUSLIN_EVENT_STITCH_TORN: u32 = 10;

/// An event. Fields that its kind does not mention are 0. Initialise it with muslin_event_init.
///
/// `particle_a` and `particle_b` are particles, `vertex` and `source` are vertices; see `particles`
/// of MuslinView.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default)]
pub struct MuslinEvent {
    /// Set by muslin_event_init.
    pub struct_size: u32,
    /// Kind: one of MUSLIN_EVENT_....
    pub kind: u32,
    /// Tick of the event, counted from creation or reset.
    pub tick: u32,
    /// Position of the event [m].
    pub position: MuslinVec3,
    /// First end of the edge, or the particle.
    pub particle_a: u32,
    /// Second end of the edge.
    pub particle_b: u32,
    /// The new vertex.
    pub vertex: u32,
    /// The vertex that the new one was split off from.
    pub source: u32,
    /// Number of triangles, particles, links or pairs.
    pub count: u32,
}

impl From<Event> for MuslinEvent {
    fn from(event: Event) -> Self {
        Self {
            struct_size: size_of::<Self>() as u32,
            kind: event.kind as u32,
            tick: event.tick,
            position: event.position.into(),
            particle_a: event.particle_a,
            particle_b: event.particle_b,
            vertex: event.vertex,
            source: event.source,
            count: event.count,
        }
    }
}

const _: () = {
    assert!(MUSLIN_EVENT_EDGE_TORN == EventKind::EdgeTorn as u32);
    assert!(MUSLIN_EVENT_VERTEX_SPLIT == EventKind::VertexSplit as u32);
    assert!(MUSLIN_EVENT_PIECE_DETACHED == EventKind::PieceDetached as u32);
    assert!(MUSLIN_EVENT_RECOVERED == EventKind::Recovered as u32);
    assert!(MUSLIN_EVENT_RESERVE_USED_UP == EventKind::ReserveUsedUp as u32);
    assert!(MUSLIN_EVENT_HELD_APART == EventKind::HeldApart as u32);
    assert!(MUSLIN_EVENT_EDGE_DIVIDED == EventKind::EdgeDivided as u32);
    assert!(MUSLIN_EVENT_HELD_INSIDE == EventKind::HeldInside as u32);
    assert!(MUSLIN_EVENT_FREE_INSIDE == EventKind::FreeInside as u32);
    assert!(MUSLIN_EVENT_LAYERS_CROSS == EventKind::LayersCross as u32);
    assert!(MUSLIN_EVENT_STITCH_TORN == EventKind::StitchTorn as u32);
};
