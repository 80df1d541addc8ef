//! What a scene leaves behind: one hash over all that could be seen of its cloths, tick by tick.

use muslin::{Cloth, Event, EventKind, Hit, Stats};

/// The hash as it stood after a tick.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Mark {
    /// Ticks that the scene had played, all its cloths together.
    pub tick: u32,
    /// The hash over everything up to there.
    pub hash: u64,
}

/// A running hash, and how it stood after every tick, so that a difference can be traced to where it
/// began.
#[derive(Clone, Debug, Default)]
pub struct Trace {
    hash: u64,
    marks: Vec<Mark>,
    events: Vec<EventKind>,
    /// What cloths are to use, if that is said.
    #[cfg(feature = "parallel")]
    threads: Option<u32>,
}

/// Every so many ticks a cloth is looked at closely.
const CLOSE_LOOK: u32 = 10;

impl Trace {
    /// The hash over everything so far.
    pub fn hash(&self) -> u64 {
        self.hash
    }

    /// The hash after each tick.
    pub fn marks(&self) -> &[Mark] {
        &self.marks
    }

    /// A trace of cloths that use so many threads.
    #[cfg(feature = "parallel")]
    pub fn on(threads: u32) -> Self {
        Self { threads: Some(threads), ..Self::default() }
    }

    /// Gives a cloth the threads that it is to use.
    fn lend_threads(&self, cloth: &mut Cloth) {
        #[cfg(feature = "parallel")]
        if let Some(threads) = self.threads {
            cloth.set_threads_eagerly(threads).expect("scenes are played on one thread at least");
        }
        let _ = cloth;
    }

    /// Runs the cloth for so many ticks, with its state in the hash after each.
    pub fn run(&mut self, cloth: &mut Cloth, ticks: u32) {
        self.lend_threads(cloth);
        for _ in 0..ticks {
            cloth.step(1);
            self.mark(cloth);
        }
    }

    /// Runs the ticks that a frame of `seconds` [s] owes, with their number and the state in the hash.
    ///
    /// # Errors
    /// As [`Cloth::advance`].
    pub fn advance(&mut self, cloth: &mut Cloth, seconds: f32) -> muslin::Result<()> {
        self.lend_threads(cloth);
        let ticks = cloth.advance(seconds)?;
        self.word(u64::from(ticks));
        self.float(cloth.blend());
        self.mark(cloth);
        Ok(())
    }

    fn mark(&mut self, cloth: &mut Cloth) {
        self.word(cloth.state_hash());
        let tick = self.marks.len() as u32 + 1;
        if tick.is_multiple_of(CLOSE_LOOK) {
            self.look(cloth);
        }
        self.marks.push(Mark { tick, hash: self.hash });
    }

    /// How many events of a kind close looks have come upon.
    pub fn count_of(&self, kind: EventKind) -> usize {
        self.events.iter().filter(|seen| **seen == kind).count()
    }

    /// Takes in all that a host can read: what is drawn, links, numbers, and events, which are used up.
    pub fn look(&mut self, cloth: &mut Cloth) {
        let view = cloth.view();
        for v in view.positions.iter().chain(view.normals) {
            self.floats(&v.to_array());
        }
        for uv in view.uvs {
            self.floats(&uv.to_array());
        }
        for index in view.indices.iter().chain(view.source_vertices) {
            self.word(u64::from(*index));
        }
        for (a, b, kind) in cloth.links() {
            self.word(u64::from(a) << 32 | u64::from(b));
            self.word(kind as u64);
        }
        self.word(cloth.time().to_bits());
        self.stats(&cloth.stats());
        while let Some(event) = cloth.next_event() {
            self.event(&event);
        }
    }

    /// Takes in what a ray hit, or that it hit nothing.
    pub fn hit(&mut self, hit: Option<Hit>) {
        let Some(hit) = hit else {
            return self.word(0);
        };
        self.word(1 + u64::from(hit.triangle));
        self.word(u64::from(hit.particle));
        self.floats(&[hit.u, hit.v, hit.distance]);
        self.floats(&hit.position.to_array());
        self.floats(&hit.normal.to_array());
    }

    /// Takes in bytes.
    pub fn bytes(&mut self, bytes: &[u8]) {
        self.word(bytes.len() as u64);
        bytes.iter().for_each(|byte| self.word(u64::from(*byte)));
    }

    /// Takes in numbers, bit by bit.
    pub fn floats(&mut self, values: &[f32]) {
        values.iter().for_each(|value| self.float(*value));
    }

    fn float(&mut self, value: f32) {
        self.word(u64::from(value.to_bits()));
    }

    /// Takes in a word. Multiplied, then folded over: no bit of it is lost on the way up.
    pub fn word(&mut self, word: u64) {
        let mixed = (self.hash ^ word).wrapping_mul(0x9e37_79b9_7f4a_7c15);
        self.hash = (mixed ^ (mixed >> 32)).wrapping_add(0x632b_e59b_d9b4_e019);
    }

    /// All numbers but the memory, which depends on the size of a pointer, and the times.
    fn stats(&mut self, stats: &Stats) {
        for count in [
            stats.particles,
            stats.triangles,
            stats.constraints,
            stats.active_constraints,
            stats.pieces,
            stats.ticks,
            stats.over_stretched,
        ] {
            self.word(u64::from(count));
        }
        self.floats(&[stats.blend, stats.max_stretch, stats.mean_stretch, stats.kinetic_energy]);
    }

    fn event(&mut self, event: &Event) {
        self.events.push(event.kind);
        let Event { kind, tick, position, particle_a, particle_b, vertex, source, count } = *event;
        for word in [kind as u32, tick, particle_a, particle_b, vertex, source, count] {
            self.word(u64::from(word));
        }
        self.floats(&position.to_array());
    }
}
