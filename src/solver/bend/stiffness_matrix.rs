//! Sparse stiffness matrix of the bending energy of any mesh.
//!
//! ```text
//! force on i = Σⱼ kᵢⱼ (xⱼ − xᵢ)         kᵢⱼ = kⱼᵢ [kg], the stiffness times h²
//! ```
//! Method: the energy is quadratic, so the matrix is constant while links, stiffness and held
//! particles stay. Only the upper half is stored, in rows of fixed width with a list for the
//! overflow.
//!
//! Reads hinges and elements in `assemble`; `add_forces` reads positions and adds to forces.
//! Invariant: forces depend on differences of positions and come in opposite pairs, so they do not
//! depend on where the mesh is, and they conserve linear momentum.

use crate::math::heap_bytes::heap_bytes;
use crate::math::sort::sort_by;
use crate::model::bend_elements::{PAIRS, TriangleStiffness};
use crate::model::hinge::Hinge;
use glam::{DVec3, Vec4};

/// Entries per row: enough for a particle with eight triangles. Further entries go to `overflow`.
const WIDTH: usize = 12;

/// Largest stiffness of an element at a particle, in rigidities per area of the particle. Well-shaped
/// elements have 1 to 20. Slivers would have thousands: links and bending then never agree, and the
/// cloth never comes to rest.
const MAX_RELATIVE_STIFFNESS: f32 = 30.0;

/// Hinge corners of a triangle: three hinges of four; 6 particles differ, unless the mesh is torn.
const CORNERS: usize = 12;

/// Stiffness [kg] between the particle of the row and the particle `column`.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Entry {
    pub column: u32,
    pub stiffness: f32,
}

const NO_ENTRY: Entry = Entry { column: 0, stiffness: 0.0 };

/// Symmetric matrix, stored as its upper half.
#[derive(Clone, Debug, Default)]
pub(crate) struct StiffnessMatrix {
    /// Entries of each row with larger index, and their number.
    rows: Vec<[Entry; WIDTH]>,
    counts: Vec<u32>,
    /// Entries beyond the row width, sorted by row and column, without duplicates.
    overflow: Vec<(u32, Entry)>,
    /// Diagonal entries [kg].
    diagonal: Vec<f32>,
}

heap_bytes!(StiffnessMatrix { rows, counts, overflow, diagonal } plain {});

impl StiffnessMatrix {
    /// Allocates a matrix for `capacity` particles.
    pub fn with_capacity(capacity: usize) -> Self {
        Self {
            rows: Vec::with_capacity(capacity),
            counts: Vec::with_capacity(capacity),
            overflow: Vec::with_capacity(capacity),
            diagonal: Vec::with_capacity(capacity),
        }
    }

    /// Assembles the matrix: all elements times `stiffness` [kg m²]. `area` is that of each particle
    /// [m²], or 0 where no limit applies; an element that is stiffer than `MAX_RELATIVE_STIFFNESS`
    /// allows is scaled down. `rank` is the row of each particle.
    pub fn assemble(
        &mut self,
        hinges: &[Hinge],
        elements: &mut [TriangleStiffness],
        stiffness: f32,
        area: &[f32],
        rank: &[u32],
    ) {
        self.rows.clear();
        let count = area.len();
        self.rows.resize(count, [NO_ENTRY; WIDTH]);
        self.counts.clear();
        self.counts.resize(count, 0);
        self.overflow.clear();
        for element in elements {
            let mut stencil = ElementStencil::of(hinges, element);
            let scale = stencil.limiting_scale(element.stiffness_scale, area);
            if scale < 1.0 {
                element.scale(scale);
                stencil = ElementStencil::of(hinges, element);
            }
            for b in 1..stencil.count {
                for a in 0..b {
                    let rows = [a, b].map(|at| rank[stencil.at[at] as usize]);
                    self.add(rows, -stencil.stiffness(a, b) * stiffness);
                }
            }
        }
        self.sort_overflow();
        self.diagonal.clear();
        self.diagonal.resize(count, 0.0);
        for row in 0..count {
            let mut sum = self.diagonal[row];
            for Entry { column, stiffness } in &self.rows[row][..self.counts[row] as usize] {
                self.diagonal[*column as usize] += stiffness;
                sum += stiffness;
            }
            self.diagonal[row] = sum;
        }
        for (row, Entry { column, stiffness }) in &self.overflow {
            for at in [*row, *column] {
                self.diagonal[at as usize] += stiffness;
            }
        }
    }

    fn add(&mut self, [a, b]: [u32; 2], stiffness: f32) {
        let (i, column) = if a < b { (a, b) } else { (b, a) };
        let (row, count) = (&mut self.rows[i as usize], &mut self.counts[i as usize]);
        let existing = row[..*count as usize].iter_mut().find(|entry| entry.column == column);
        if let Some(entry) = existing {
            entry.stiffness += stiffness;
        } else if let Some(entry) = row.get_mut(*count as usize) {
            *entry = Entry { column, stiffness };
            *count += 1;
        } else {
            self.overflow.push((i, Entry { column, stiffness }));
        }
    }

    /// Sorts the overflow and merges entries of the same pair.
    fn sort_overflow(&mut self) {
        let pair = |(row, entry): &(u32, Entry)| (*row, entry.column);
        sort_by(&mut self.overflow, |p, q| {
            pair(p).cmp(&pair(q)).then(p.1.stiffness.total_cmp(&q.1.stiffness))
        });
        self.overflow.dedup_by(|next, existing| {
            let is_same_pair = pair(next) == pair(existing);
            existing.1.stiffness += if is_same_pair { next.1.stiffness } else { 0.0 };
            is_same_pair
        });
    }

    /// Adds the bending force at positions `x`, times h² [kg m], to `force`.
    pub fn add_forces(&self, x: &[Vec4], force: &mut [Vec4]) {
        for (i, (row, count)) in self.rows.iter().zip(&self.counts).enumerate() {
            let (from, mut sum) = (x[i], Vec4::ZERO);
            for Entry { column, stiffness } in &row[..*count as usize] {
                let pair_force = (x[*column as usize] - from) * *stiffness;
                force[*column as usize] -= pair_force;
                sum += pair_force;
            }
            force[i] += sum;
        }
        for (i, Entry { column, stiffness }) in &self.overflow {
            let pair_force = (x[*column as usize] - x[*i as usize]) * *stiffness;
            force[*column as usize] -= pair_force;
            force[*i as usize] += pair_force;
        }
    }

    /// Adds the same with sums in double precision, which `sums` receives: the forces of a stiff mesh
    /// nearly cancel, so their rounding errors would shake it.
    #[inline(never)]
    pub fn add_precise_forces(&self, x: &[Vec4], sums: &mut Vec<DVec3>, force: &mut [Vec4]) {
        sums.clear();
        sums.resize(x.len(), DVec3::ZERO);
        let position = |i: usize| x[i].truncate().as_dvec3();
        for i in 0..x.len() {
            self.for_each_in_row(i, |Entry { column, stiffness }| {
                let column = column as usize;
                let pair_force = (position(column) - position(i)) * f64::from(stiffness);
                sums[column] -= pair_force;
                sums[i] += pair_force;
            });
        }
        for (force, sum) in force.iter_mut().zip(sums) {
            *force += sum.as_vec3().extend(0.0);
        }
    }

    /// Diagonal entries [kg].
    pub fn diagonal(&self) -> &[f32] {
        &self.diagonal
    }

    /// Calls `visit` with each entry of a row right of the diagonal.
    #[inline(always)]
    pub fn for_each_in_row(&self, row: usize, mut visit: impl FnMut(Entry)) {
        self.rows[row][..self.counts[row] as usize].iter().for_each(|entry| visit(*entry));
        let start = self.overflow.partition_point(|(at, _)| (*at as usize) < row);
        let of_row = self.overflow[start..].iter().take_while(|(at, _)| *at as usize == row);
        of_row.for_each(|(_, entry)| visit(*entry));
    }
}

/// The particles of a bending element, and its dense stiffness over them.
struct ElementStencil {
    at: [u32; CORNERS],
    count: usize,
    /// Weight of each particle in each hinge, and the same times the element matrix.
    weights: [[f32; CORNERS]; 3],
    weighted: [[f32; CORNERS]; 3],
}

impl ElementStencil {
    fn of(hinges: &[Hinge], element: &TriangleStiffness) -> Self {
        let zero = [[0.0; CORNERS]; 3];
        let mut stencil = Self { at: [0; CORNERS], count: 0, weights: zero, weighted: zero };
        for slot in 0..3 {
            if element.own[slot] > 0.0 {
                let hinge = &hinges[element.hinges[slot] as usize];
                for (vertex, weight) in hinge.particles.into_iter().zip(hinge.weight) {
                    let index = stencil.slot_of(vertex);
                    stencil.weights[slot][index] += weight;
                }
            }
        }
        for at in 0..stencil.count {
            for (slot, own) in element.own.into_iter().enumerate() {
                stencil.weighted[slot][at] = stencil.weights[slot][at] * own;
            }
            for (between, [p, q]) in element.between.into_iter().zip(PAIRS) {
                stencil.weighted[p][at] += stencil.weights[q][at] * between;
                stencil.weighted[q][at] += stencil.weights[p][at] * between;
            }
        }
        stencil
    }

    fn slot_of(&mut self, vertex: u32) -> usize {
        let existing = self.at[..self.count].iter().position(|at| *at == vertex);
        existing.unwrap_or_else(|| {
            self.at[self.count] = vertex;
            self.count += 1;
            self.count - 1
        })
    }

    /// The scale, at most 1, that brings the element within `MAX_RELATIVE_STIFFNESS` times its own
    /// `stiffness_scale` at all its particles.
    fn limiting_scale(&self, stiffness_scale: f32, area: &[f32]) -> f32 {
        let most = MAX_RELATIVE_STIFFNESS * stiffness_scale;
        self.at[..self.count].iter().enumerate().fold(1.0, |scale, (at, particle)| {
            let relative = self.stiffness(at, at) * area[*particle as usize];
            if relative * scale > most { most / relative } else { scale }
        })
    }

    fn stiffness(&self, a: usize, b: usize) -> f32 {
        let [p, q, r] = [0, 1, 2].map(|slot| self.weights[slot][a] * self.weighted[slot][b]);
        (p + q) + r
    }
}
