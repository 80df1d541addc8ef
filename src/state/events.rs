//! What happened, for the host to read: a queue that never grows.

use glam::Vec3;
use serde::{Deserialize, Serialize};
use std::collections::VecDeque;

/// What an [`Event`] tells of.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[repr(u32)]
pub enum EventKind {
    /// The edge between `particle_a` and `particle_b` tore.
    EdgeTorn = 0,
    /// `vertex` was split off from `source`. Where a particle with several vertices was split between them,
    /// so that none had to be: both are the lowest vertex that went to the new particle.
    VertexSplit = 1,
    /// A piece of `count` triangles, one of them at `vertex`, came off.
    PieceDetached = 2,
    /// `count` particles had left the realm of numbers and were put back where they last were.
    Recovered = 3,
    /// Tearing stopped here: the room that was reserved for it is used up. Told once.
    ReserveUsedUp = 4,
    /// Pins or grabs hold the cloth apart: `count` links are past `max_stretch`, one of them between
    /// `particle_a` and `particle_b`. Told once, until the bound holds again.
    HeldApart = 5,
    /// A cut made `vertex` on the edge between `particle_a` and `particle_b`; and, if they are different
    /// vertices on either side of that edge, the one after it for the other side.
    EdgeDivided = 6,
}

/// Something that happened in a tick. Fields that its kind does not mention are 0. `particle_a` and
/// `particle_b` are particles, `vertex` and `source` are vertices.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Event {
    /// What happened.
    pub kind: EventKind,
    /// In which tick, counted from creation or reset.
    pub tick: u32,
    /// Where [m].
    pub position: Vec3,
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

impl Event {
    pub(crate) fn new(kind: EventKind, tick: u32, position: Vec3) -> Self {
        Self { kind, tick, position, particle_a: 0, particle_b: 0, vertex: 0, source: 0, count: 0 }
    }
}

/// How many events wait to be read; when more come, the oldest go.
pub(crate) const MAX_EVENTS: usize = 1024;

/// Events in the order they happened.
///
/// By tick; in a tick recoveries first, then tears, the worst first, and of each the vertices that it
/// split before the torn edge; then, if there was no room for another, that; then the pieces that came
/// off, in the order of their first triangles; then what is held apart. A cut tells the edges that it
/// divided, in its order; those that it opened; the vertices that it split; and the pieces.
#[derive(Clone, Debug, Default, Serialize, Deserialize)]
pub(crate) struct Events {
    queue: VecDeque<Event>,
}

impl Events {
    pub fn new() -> Self {
        Self { queue: VecDeque::with_capacity(MAX_EVENTS) }
    }

    /// Makes room for all that may wait.
    pub fn reserve(&mut self) {
        self.queue.reserve_exact(MAX_EVENTS.saturating_sub(self.queue.len()));
    }

    pub fn push(&mut self, event: Event) {
        if self.queue.len() >= MAX_EVENTS {
            self.queue.pop_front();
        }
        self.queue.push_back(event);
    }

    pub fn len(&self) -> usize {
        self.queue.len()
    }

    pub fn pop(&mut self) -> Option<Event> {
        self.queue.pop_front()
    }
}
