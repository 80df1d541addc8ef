//! What resists the bending of any mesh as a matrix: how much each particle is pulled towards each other one that
//! bends with it, per distance.
//!
//! The energy of bending is quadratic, so the matrix stays as long as links, masses and what is held do, and one
//! pass over it says what its hinges together would. A particle is pulled by *differences* of places, and as much
//! as it pulls: so it does not matter where the mesh is, and momentum stays.

use crate::fabric::facets::{Element, PAIRS};
use crate::fabric::hinges::Hinge;
use crate::math::sort::sort_by;
use glam::Vec4;

/// Others that a row has room for: those around a particle that eight triangles meet at. What is more comes behind
/// all rows.
const WIDTH: usize = 24;

/// Particles of a triangle and of those beside it; 6 of them differ, unless the mesh is torn there.
const CORNERS: usize = 12;

/// Another particle, and what it pulls by [1/m²].
#[derive(Clone, Copy, Debug)]
struct Entry {
    with: u32,
    by: f32,
}

/// The others of one particle, two by two.
#[derive(Clone, Copy, Debug)]
struct Row {
    entries: [Entry; WIDTH],
    count: u32,
    /// What its particle resists when it alone is moved, and all that pulls or pushes it, added up [1/m²].
    own: f32,
    sum: f32,
}

/// The matrix, over the stiffness.
#[derive(Clone, Debug, Default)]
pub(crate) struct Stiffness {
    rows: Vec<Row>,
    /// What found no room in the row of a particle, in the order of particles, each other one once.
    beyond: Vec<(u32, Entry)>,
}

impl Stiffness {
    /// Room for so many particles.
    pub fn with_capacity(capacity: usize) -> Self {
        Self { rows: Vec::with_capacity(capacity), beyond: Vec::with_capacity(capacity) }
    }

    /// Adds up what triangles resist, for so many particles.
    pub fn assemble(&mut self, hinges: &[Hinge], elements: &[Element], count: usize) {
        self.rows.clear();
        self.beyond.clear();
        self.rows.extend((0..count as u32).map(Row::empty));
        for element in elements {
            let patch = Patch::of(hinges, element);
            for b in 1..patch.count {
                for a in 0..b {
                    self.add([patch.at[a], patch.at[b]], -patch.stiffness(a, b));
                }
            }
        }
        let by_row = |(row, entry): &(u32, Entry)| (*row, entry.with);
        sort_by(&mut self.beyond, |p, q| by_row(p).cmp(&by_row(q)).then(p.1.by.total_cmp(&q.1.by)));
        self.beyond.dedup_by(|next, known| {
            let is_known = by_row(next) == by_row(known);
            known.1.by += if is_known { next.1.by } else { 0.0 };
            is_known
        });
        for (row, entry) in &self.beyond {
            self.rows[*row as usize].count_in(entry.by);
        }
        for row in &mut self.rows {
            for at in 0..row.count as usize {
                row.count_in(row.entries[at].by);
            }
            // Two by two: one that is no other pulls by nothing.
            row.count += row.count % 2;
        }
    }

    fn add(&mut self, [a, b]: [u32; 2], by: f32) {
        for (row, with) in [(a, b), (b, a)] {
            if !self.rows[row as usize].add(with, by) {
                self.beyond.push((row, Entry { with, by }));
            }
        }
    }

    /// What a particle is pulled by, with all at these places.
    #[inline(always)]
    pub fn pull(&self, i: usize, x: &[Vec4]) -> Vec4 {
        let (row, from) = (&self.rows[i], x[i]);
        let [mut even, mut odd] = [Vec4::ZERO; 2];
        for pair in row.entries[..row.count as usize].chunks_exact(2) {
            even += (x[pair[0].with as usize] - from) * pair[0].by;
            odd += (x[pair[1].with as usize] - from) * pair[1].by;
        }
        let sum = even + odd;
        if row.count as usize == WIDTH { sum + self.pull_beyond(i, x) } else { sum }
    }

    #[cold]
    fn pull_beyond(&self, i: usize, x: &[Vec4]) -> Vec4 {
        let first = self.beyond.partition_point(|(row, _)| (*row as usize) < i);
        let own = self.beyond[first..].iter().take_while(|(row, _)| *row as usize == i);
        own.fold(Vec4::ZERO, |sum, (_, entry)| sum + (x[entry.with as usize] - x[i]) * entry.by)
    }

    /// What a particle resists when it alone is moved [1/m²].
    pub fn own(&self, i: usize) -> f32 {
        self.rows[i].own
    }

    /// No shape has more of it over mass: the most that the rows of particles with these inverse masses add up to
    /// (Gershgorin 1931).
    pub fn bound(&self, w: &[f32]) -> f32 {
        let each = self.rows.iter().zip(w).map(|(row, w)| (row.own.abs() + row.sum) * w);
        each.fold(0.0, |most, each| if each > most { each } else { most })
    }
}

impl Row {
    fn empty(own: u32) -> Self {
        let none = Entry { with: own, by: 0.0 };
        Self { entries: [none; WIDTH], count: 0, own: 0.0, sum: 0.0 }
    }

    /// False if there is no room.
    fn add(&mut self, with: u32, by: f32) -> bool {
        let known = self.entries[..self.count as usize].iter_mut().find(|e| e.with == with);
        if let Some(entry) = known {
            entry.by += by;
            return true;
        }
        let Some(entry) = self.entries.get_mut(self.count as usize) else { return false };
        *entry = Entry { with, by };
        self.count += 1;
        true
    }

    fn count_in(&mut self, by: f32) {
        self.own += by;
        self.sum += by.abs();
    }
}

/// A triangle and those beside it.
struct Patch {
    at: [u32; CORNERS],
    count: usize,
    /// What each hinge shows of each particle, and that times what it resists.
    shows: [[f32; CORNERS]; 3],
    resists: [[f32; CORNERS]; 3],
}

impl Patch {
    fn of(hinges: &[Hinge], element: &Element) -> Self {
        let zero = [[0.0; CORNERS]; 3];
        let mut patch = Self { at: [0; CORNERS], count: 0, shows: zero, resists: zero };
        for slot in 0..3 {
            if element.own[slot] > 0.0 {
                let hinge = &hinges[element.hinges[slot] as usize];
                for (vertex, weight) in hinge.at.into_iter().zip(hinge.weight) {
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
