//! Events: what happened, in a bounded queue that the host reads.

use crate::math::heap_bytes::heap_bytes;
use glam::Vec3;
use serde::{Deserialize, Serialize};
use std::collections::VecDeque;

/// The kind of an [`Event`].
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[repr(u32)]
pub enum EventKind {
    /// The edge between `particle_a` and `particle_b` tore.
    EdgeTorn = 0,
    /// `vertex` was split off from `source`. If a particle with several vertices (a UV seam) was
    /// split and each vertex went to one side whole, then no vertex is new, and both fields name
    /// the lowest vertex that went to the new particle.
    VertexSplit = 1,
    /// A piece of `count` triangles came off; `vertex` belongs to one of them.
    PieceDetached = 2,
    /// `count` particles had positions or velocities that are not finite. They were reset to their
    /// last valid position.
    Recovered = 3,
    /// Tearing stopped, because all `extra_particles` are used. Reported once.
    ReserveUsedUp = 4,
    /// Pins or grabs hold the cloth beyond `max_stretch`: `count` links exceed it, one of them
    /// between `particle_a` and `particle_b`. Reported once until the limit holds again. Also for
    /// `count` sewn pairs whose two particles are held apart.
    HeldApart = 5,
    /// A cut inserted `vertex` into the edge between `particle_a` and `particle_b`. If that edge is
    /// a UV seam, `vertex + 1` is the new vertex on its other side.
    EdgeDivided = 6,
    /// Pins, attachments or grabs hold `count` particles inside a collider; `particle_a` is the
    /// first of them. Reported once until none is inside.
    HeldInside = 7,
    /// `count` particles that nothing holds are inside a collider, because other colliders or held
    /// cloth leave them no room, or because they were placed there; `particle_a` is the first of
    /// them. Reported once until none is inside.
    FreeInside = 8,
    /// With surface collision, edges of the cloth pass through triangles of it: `count` pairs of
    /// both. One of the edges is between `particle_a` and `particle_b`. Reported once until none
    /// does.
    LayersCross = 9,
    /// The stitch between `particle_a` and `particle_b` tore, see [`Cloth::sew`](crate::Cloth::sew).
    StitchTorn = 10,
}

/// Something that happened in a tick. Fields that the kind does not mention are 0.
///
/// `particle_a` and `particle_b` are particle indices; `vertex` and `source` are vertex indices.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Event {
    /// What happened.
    pub kind: EventKind,
    /// Tick in which it happened, counted from creation or reset.
    pub tick: u32,
    /// Position [m].
    pub position: Vec3,
    /// One end of the edge.
    pub particle_a: u32,
    /// The other end of the edge.
    pub particle_b: u32,
    /// The new vertex.
    pub vertex: u32,
    /// The vertex that `vertex` was split off from.
    pub source: u32,
    /// Number of triangles, particles or links.
    pub count: u32,
}

impl Event {
    pub(crate) fn new(kind: EventKind, tick: u32, position: Vec3) -> Self {
        Self { kind, tick, position, particle_a: 0, particle_b: 0, vertex: 0, source: 0, count: 0 }
    }
}

/// Capacity of the queue. A new event replaces the oldest one when it is full.
pub(crate) const MAX_EVENTS: usize = 1024;

/// Number of events that the queue of a cloth holds without allocating, before it can tear.
const FEW_EVENTS: usize = 16;

/// Queue of events in the order in which they happened.
///
/// Order by tick. Within a tick: recoveries; tears, the most overstretched edge first, each
/// preceded by the vertices that it split; `ReserveUsedUp`; detached pieces in the order of their
/// first triangles; torn stitches in the order in which they were sewn; `HeldApart`; `HeldInside`;
/// `FreeInside`; `LayersCross`. A cut reports the divided edges in its order, the opened edges, the
/// split vertices, the pieces.
#[derive(Clone, Debug, Default, Serialize, Deserialize)]
pub(crate) struct Events {
    queue: VecDeque<Event>,
}

heap_bytes!(Events { queue } plain {});

impl Events {
    /// Makes an empty queue for the few events of a cloth that cannot tear.
    pub fn new() -> Self {
        Self { queue: VecDeque::with_capacity(FEW_EVENTS) }
    }

    /// Allocates the full capacity, for a cloth that can tear.
    pub fn reserve(&mut self) {
        self.queue.reserve_exact(MAX_EVENTS.saturating_sub(self.queue.len()));
    }

    /// Appends an event, and drops the oldest one if the queue is full.
    pub fn push(&mut self, event: Event) {
        if self.queue.len() >= MAX_EVENTS {
            self.queue.pop_front();
        }
        self.queue.push_back(event);
    }

    pub fn len(&self) -> usize {
        self.queue.len()
    }

    /// Removes and returns the oldest event.
    pub fn pop(&mut self) -> Option<Event> {
        self.queue.pop_front()
    }
}
