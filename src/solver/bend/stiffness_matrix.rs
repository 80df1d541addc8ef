//! What resists the bending of any mesh as a matrix: how much each particle is pulled towards each other one that
//! bends with it, per distance.
//!
//! The energy of bending is quadratic, so the matrix stays as long as links, masses and what is held do, and one
//! pass over it says what its hinges together would. A particle is pulled by *differences* of places, and as much
//! as it pulls: so it does not matter where the mesh is, and momentum stays.

use crate::math::sort::sort_by;
use crate::model::bend_elements::{PAIRS, TriangleStiffness};
use crate::model::hinge::Hinge;
use glam::Vec4;

/// Later ones that a row has room for: those around a particle that eight triangles meet at. What is more comes
/// behind all rows.
const WIDTH: usize = 12;

/// Particles of a triangle and of those beside it; 6 of them differ, unless the mesh is torn there.
const CORNERS: usize = 12;

/// Another particle, and what it pulls by [kg].
#[derive(Clone, Copy, Debug)]
struct Entry {
    with: u32,
    by: f32,
}

const NO_ENTRY: Entry = Entry { with: 0, by: 0.0 };

/// The matrix, of which one half says all.
#[derive(Clone, Debug, Default)]
pub(crate) struct StiffnessMatrix {
    /// For each particle those after it, and how many they are.
    rows: Vec<[Entry; WIDTH]>,
    counts: Vec<u32>,
    /// What found no room in the row of a particle, in the order of particles, each other one once.
    beyond: Vec<(u32, Entry)>,
    /// What each particle resists when it alone is moved, and all that pulls or pushes it, added up [kg].
    own: Vec<f32>,
    sum: Vec<f32>,
}

impl StiffnessMatrix {
    /// Room for so many particles.
    pub fn with_capacity(capacity: usize) -> Self {
        Self {
            rows: Vec::with_capacity(capacity),
            counts: Vec::with_capacity(capacity),
            beyond: Vec::with_capacity(capacity),
            own: Vec::with_capacity(capacity),
            sum: Vec::with_capacity(capacity),
        }
    }

    /// Adds up what triangles resist, times a stiffness [kg m²], for so many particles.
    pub fn assemble(
        &mut self,
        hinges: &[Hinge],
        elements: &[TriangleStiffness],
        stiffness: f32,
        count: usize,
    ) {
        self.rows.clear();
        self.rows.resize(count, [NO_ENTRY; WIDTH]);
        self.counts.clear();
        self.counts.resize(count, 0);
        self.beyond.clear();
        for element in elements {
            let patch = ElementStencil::of(hinges, element);
            for b in 1..patch.count {
                for a in 0..b {
                    self.add([patch.at[a], patch.at[b]], -patch.stiffness(a, b) * stiffness);
                }
            }
        }
        self.order_beyond();
        for sums in [&mut self.own, &mut self.sum] {
            sums.clear();
            sums.resize(count, 0.0);
        }
        let Self { rows, counts, beyond, own, sum } = self;
        let mut count_in = |i: usize, entry: &Entry| {
            for at in [i, entry.with as usize] {
                own[at] += entry.by;
                sum[at] += entry.by.abs();
            }
        };
        for (i, (row, count)) in rows.iter().zip(&*counts).enumerate() {
            row[..*count as usize].iter().for_each(|entry| count_in(i, entry));
        }
        beyond.iter().for_each(|(row, entry)| count_in(*row as usize, entry));
    }

    fn add(&mut self, [a, b]: [u32; 2], by: f32) {
        let (i, with) = if a < b { (a, b) } else { (b, a) };
        let (row, count) = (&mut self.rows[i as usize], &mut self.counts[i as usize]);
        let known = row[..*count as usize].iter_mut().find(|entry| entry.with == with);
        if let Some(entry) = known {
            entry.by += by;
        } else if let Some(entry) = row.get_mut(*count as usize) {
            *entry = Entry { with, by };
            *count += 1;
        } else {
            self.beyond.push((i, Entry { with, by }));
        }
    }

    /// Each pair once.
    fn order_beyond(&mut self) {
        let pair = |(row, entry): &(u32, Entry)| (*row, entry.with);
        sort_by(&mut self.beyond, |p, q| pair(p).cmp(&pair(q)).then(p.1.by.total_cmp(&q.1.by)));
        self.beyond.dedup_by(|next, known| {
            let is_known = pair(next) == pair(known);
            known.1.by += if is_known { next.1.by } else { 0.0 };
            is_known
        });
    }

    /// Adds what particles are pulled by, with all at these places.
    pub fn add_pulls(&self, x: &[Vec4], force: &mut [Vec4]) {
        for (i, (row, count)) in self.rows.iter().zip(&self.counts).enumerate() {
            let (from, mut sum) = (x[i], Vec4::ZERO);
            for Entry { with, by } in &row[..*count as usize] {
                let pull = (x[*with as usize] - from) * *by;
                force[*with as usize] -= pull;
                sum += pull;
            }
            force[i] += sum;
        }
        for (i, Entry { with, by }) in &self.beyond {
            let pull = (x[*with as usize] - x[*i as usize]) * *by;
            force[*with as usize] -= pull;
            force[*i as usize] += pull;
        }
    }

    /// What each particle resists when it alone is moved [kg].
    pub fn own(&self) -> &[f32] {
        &self.own
    }

    /// No shape has more of it over mass: the most that the rows of particles with these inverse masses add up to
    /// (Gershgorin 1931).
    pub fn bound(&self, w: &[f32]) -> f32 {
        let each = self.own.iter().zip(&self.sum).zip(w);
        each.map(|((own, sum), w)| (own.abs() + sum) * w)
            .fold(0.0, |most, each| if each > most { each } else { most })
    }
}

/// A triangle and those beside it.
struct ElementStencil {
    at: [u32; CORNERS],
    count: usize,
    /// What each hinge shows of each particle, and that times what it resists.
    shows: [[f32; CORNERS]; 3],
    resists: [[f32; CORNERS]; 3],
}

impl ElementStencil {
    fn of(hinges: &[Hinge], element: &TriangleStiffness) -> Self {
        let zero = [[0.0; CORNERS]; 3];
        let mut patch = Self { at: [0; CORNERS], count: 0, shows: zero, resists: zero };
        for slot in 0..3 {
            if element.own[slot] > 0.0 {
                let hinge = &hinges[element.hinges[slot] as usize];
                for (vertex, weight) in hinge.particles.into_iter().zip(hinge.weight) {
                    let place = patch.place_of(vertex);
                    patch.shows[slot][place] += weight;
                }
            }
        }
        for at in 0..patch.count {
            for (slot, own) in element.own.into_iter().enumerate() {
                patch.resists[slot][at] = patch.shows[slot][at] * own;
            }
            for (between, [p, q]) in element.between.into_iter().zip(PAIRS) {
                patch.resists[p][at] += patch.shows[q][at] * between;
                patch.resists[q][at] += patch.shows[p][at] * between;
            }
        }
        patch
    }

    fn place_of(&mut self, vertex: u32) -> usize {
        let known = self.at[..self.count].iter().position(|at| *at == vertex);
        known.unwrap_or_else(|| {
            self.at[self.count] = vertex;
            self.count += 1;
            self.count - 1
        })
    }

    fn stiffness(&self, a: usize, b: usize) -> f32 {
        let [p, q, r] = [0, 1, 2].map(|slot| self.shows[slot][a] * self.resists[slot][b]);
        (p + q) + r
    }
}
