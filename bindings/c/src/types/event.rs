//! What happened.

use super::value::MuslinVec3;
use muslin_core::{Event, EventKind};

/// The edge between `particle_a` and `particle_b` tore.
pub const MUSLIN_EVENT_EDGE_TORN: u32 = 0;
/// `vertex` was split off from `source`. Where a particle with several vertices was split between them, so that
/// none had to be: both are the lowest vertex that went to the new particle.
pub const MUSLIN_EVENT_VERTEX_SPLIT: u32 = 1;
/// A piece of `count` triangles, one of them at `vertex`, came off.
pub const MUSLIN_EVENT_PIECE_DETACHED: u32 = 2;
/// `count` particles had left the realm of numbers and were put back where they last were.
pub const MUSLIN_EVENT_RECOVERED: u32 = 3;
/// Tearing stopped: the room that `extra_particles` reserved for it is used up. Told once.
pub const MUSLIN_EVENT_RESERVE_USED_UP: u32 = 4;
/// Pins or grabs hold the cloth apart: `count` links are past `max_stretch`, one of them between
/// `particle_a` and `particle_b`. Told once, until the bound holds again.
pub const MUSLIN_EVENT_HELD_APART: u32 = 5;
/// A cut made `vertex` on the edge between `particle_a` and `particle_b`; and, if they are different vertices on
/// either side of that edge, the one after it for the other side.
pub const MUSLIN_EVENT_EDGE_DIVIDED: u32 = 6;

/// Something that happened in a tick. Fields that its kind does not mention are 0. `particle_a` and `particle_b`
/// are particles, `vertex` and `source` are vertices, see MuslinView's `particles`. Begin with
/// muslin_event_init.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default)]
pub struct MuslinEvent {
    /// Set by muslin_event_init.
    pub struct_size: u32,
    /// What happened: one of MUSLIN_EVENT_...
    pub kind: u32,
    /// In which tick, counted from creation or reset.
    pub tick: u32,
    /// Where [m].
    pub position: MuslinVec3,
    /// An end of the edge.
    pub particle_a: u32,
    /// The other end.
    pub particle_b: u32,
    /// The vertex that came to be.
    pub vertex: u32,
    /// The vertex that it was split off from.
    pub source: u32,
    /// How many.
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
};
