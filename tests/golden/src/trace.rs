//! Trace of a scene: one hash over all outputs of its cloths, with an intermediate hash per tick.
//!
//! Reads cloths through their public interface. Invariant: the hash depends only on values that
//! must be equal on every platform, so times and memory sizes are left out.

use muslin::{Cloth, Event, EventKind, Hit, Stats};

/// The running hash after a tick.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct TickHash {
    /// Number of ticks so far, over all cloths of the scene.
    pub tick: u32,
    /// The hash over everything recorded so far.
    pub hash: u64,
}

/// A running hash with its value after every tick, so that the first tick that differs can be
/// found.
#[derive(Clone, Debug, Default)]
pub struct Trace {
    hash: u64,
    tick_hashes: Vec<TickHash>,
    events: Vec<EventKind>,
    /// Number of threads for the cloths; `None` leaves their own setting.
    #[cfg(feature = "parallel")]
    threads: Option<u32>,
}

/// Ticks between two full recordings of a cloth's outputs.
const FULL_RECORD_INTERVAL: u32 = 10;

impl Trace {
    /// The hash over everything recorded so far.
    pub fn hash(&self) -> u64 {
        self.hash
    }

    /// The hash after each tick.
    pub fn tick_hashes(&self) -> &[TickHash] {
        &self.tick_hashes
    }

    /// A trace whose cloths use `threads` threads.
    #[cfg(feature = "parallel")]
    pub fn with_threads(threads: u32) -> Self {
        Self { threads: Some(threads), ..Self::default() }
    }

    /// Sets the number of threads of a cloth, if the trace has one.
    fn apply_threads(&self, cloth: &mut Cloth) {
        #[cfg(feature = "parallel")]
        if let Some(threads) = self.threads {
            cloth.set_threads_eagerly(threads).expect("a scene must run on at least one thread");
        }
        let _ = cloth;
    }

    /// Steps the cloth `ticks` times and records its state hash after each tick.
    pub fn step(&mut self, cloth: &mut Cloth, ticks: u32) {
        self.apply_threads(cloth);
        for _ in 0..ticks {
            cloth.step(1);
            self.record_tick(cloth);
        }
    }

    /// Advances the cloth by `seconds` [s] and records the number of ticks, the blend and the state
    /// hash.
    ///
    /// # Errors
    /// As [`Cloth::advance`].
    pub fn advance(&mut self, cloth: &mut Cloth, seconds: f32) -> muslin::Result<()> {
        self.apply_threads(cloth);
        let ticks = cloth.advance(seconds)?;
        self.record_word(u64::from(ticks));
        self.record_float(cloth.blend());
        self.record_tick(cloth);
        Ok(())
    }

    /// Records the state hash, and all outputs every [`FULL_RECORD_INTERVAL`] ticks.
    fn record_tick(&mut self, cloth: &mut Cloth) {
        self.record_word(cloth.state_hash());
        let tick = self.tick_hashes.len() as u32 + 1;
        if tick.is_multiple_of(FULL_RECORD_INTERVAL) {
            self.record_outputs(cloth);
        }
        self.tick_hashes.push(TickHash { tick, hash: self.hash });
    }

    /// Number of events of a kind recorded so far.
    pub fn count_of(&self, kind: EventKind) -> usize {
        self.events.iter().filter(|event| **event == kind).count()
    }

    /// Records everything that a host can read: vertex data, links, time, stats and events. Removes
    /// all pending events from the cloth.
    pub fn record_outputs(&mut self, cloth: &mut Cloth) {
        let view = cloth.view();
        for v in view.positions.iter().chain(view.normals) {
            self.record_floats(&v.to_array());
        }
        for uv in view.uvs {
            self.record_floats(&uv.to_array());
        }
        for index in view.indices.iter().chain(view.source_vertices) {
            self.record_word(u64::from(*index));
        }
        for (a, b, kind) in cloth.links() {
            self.record_word(u64::from(a) << 32 | u64::from(b));
            self.record_word(kind as u64);
        }
        self.record_word(cloth.time().to_bits());
        self.record_stats(&cloth.stats());
        while let Some(event) = cloth.next_event() {
            self.record_event(&event);
        }
    }

    /// Records the hit of a ray, or that there was none.
    pub fn record_hit(&mut self, hit: Option<Hit>) {
        let Some(hit) = hit else {
            return self.record_word(0);
        };
        self.record_word(1 + u64::from(hit.triangle));
        self.record_word(u64::from(hit.particle));
        self.record_floats(&[hit.u, hit.v, hit.distance]);
        self.record_floats(&hit.position.to_array());
        self.record_floats(&hit.normal.to_array());
    }

    /// Records the length of a byte string and its bytes.
    pub fn record_bytes(&mut self, bytes: &[u8]) {
        self.record_word(bytes.len() as u64);
        bytes.iter().for_each(|byte| self.record_word(u64::from(*byte)));
    }

    /// Records the bits of floating-point numbers.
    pub fn record_floats(&mut self, values: &[f32]) {
        values.iter().for_each(|value| self.record_float(*value));
    }

    fn record_float(&mut self, value: f32) {
        self.record_word(u64::from(value.to_bits()));
    }

    /// Records a word: multiplies it by an odd number, then folds the high half onto the low half.
    /// Both steps are invertible, so no bit is lost.
    pub fn record_word(&mut self, word: u64) {
        let mixed = (self.hash ^ word).wrapping_mul(0x9e37_79b9_7f4a_7c15);
        self.hash = (mixed ^ (mixed >> 32)).wrapping_add(0x632b_e59b_d9b4_e019);
    }

    /// Records the stats except the memory size, which depends on the pointer size, and the times.
    fn record_stats(&mut self, stats: &Stats) {
        for count in [
            stats.particles,
            stats.triangles,
            stats.constraints,
            stats.active_constraints,
            stats.pieces,
            stats.ticks,
            stats.over_stretched,
        ] {
            self.record_word(u64::from(count));
        }
        self.record_floats(&[
            stats.blend,
            stats.max_stretch,
            stats.mean_stretch,
            stats.kinetic_energy,
        ]);
    }

    fn record_event(&mut self, event: &Event) {
        self.events.push(event.kind);
        let Event { kind, tick, position, particle_a, particle_b, vertex, source, count } = *event;
        for word in [kind as u32, tick, particle_a, particle_b, vertex, source, count] {
            self.record_word(u64::from(word));
        }
        self.record_floats(&position.to_array());
    }
}
