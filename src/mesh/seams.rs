//! UV seams: render vertices that share one particle and have different texture coordinates.
//!
//! Particles are simulated, torn and cut; a renderer draws vertices. Without welding or
//! non-manifold splits each vertex is the particle of the same number, and there are no `Seams`.
//! Otherwise both index lists describe the same triangles, and `Seams` holds the list over
//! vertices.
//!
//! ```text
//! particle p ●  has vertices a, b:   triangles left of the seam use a, right of it b
//! ```
//! When a particle is split, a vertex with triangles on both sides is split too; a vertex with
//! triangles on one side only goes to that side.
//!
//! Reads `EdgeSplit` and the corners of split particles; writes its own lists.
//!
//! Invariant: `particles[triangles[t][k]]` is the particle at corner k of triangle t.

use crate::math::heap_bytes::heap_bytes;
use crate::math::reserve::ReserveTotal;
use crate::math::sort::sort;
use crate::mesh::split_edge::{CutSite, EdgeSplit};
use crate::mesh::{Corner, Mesh, next_corner, prev_corner, triangle_of};
use serde::{Deserialize, Serialize};

/// The render vertices of a mesh. Field order is part of the save format.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub(crate) struct Seams {
    /// Vertex of each corner.
    pub triangles: Vec<[u32; 3]>,
    /// Particle of each vertex.
    pub particles: Vec<u32>,
    /// Site of each vertex: the given vertex that it came from, or a site created by a cut. The
    /// latter have the numbers from `original_count` on.
    pub sites: Vec<u32>,
    /// Sites created by cuts, each between two older sites.
    pub cut_sites: Vec<CutSite>,
    /// Number of given vertices.
    pub original_count: u32,
    /// Number of corners that use each vertex.
    #[serde(skip)]
    corner_counts: Vec<u32>,
    /// Maximum number of vertices.
    #[serde(skip)]
    capacity: usize,
}

heap_bytes!(
    Seams {
        triangles, particles, sites, cut_sites, corner_counts,
    } plain { original_count, capacity }
);

impl Seams {
    /// Creates seams from triangles over vertices and the particle of each vertex.
    pub fn new(triangles: Vec<[u32; 3]>, particles: Vec<u32>) -> Self {
        let original_count = particles.len() as u32;
        let mut seams = Self {
            triangles,
            particles,
            sites: (0..original_count).collect(),
            cut_sites: Vec::new(),
            original_count,
            corner_counts: Vec::new(),
            capacity: original_count as usize,
        };
        seams.count_corners();
        seams
    }

    /// Replaces the triangles and the particle of each vertex; the vertices stay.
    pub fn replace(&mut self, triangles: Vec<[u32; 3]>, particles: Vec<u32>) {
        (self.triangles, self.particles) = (triangles, particles);
        self.count_corners();
    }

    fn count_corners(&mut self) {
        self.corner_counts.clear();
        self.corner_counts.resize(self.particles.len(), 0);
        for vertex in self.triangles.as_flattened() {
            self.corner_counts[*vertex as usize] += 1;
        }
    }

    /// Maximum number of vertices.
    pub fn capacity(&self) -> usize {
        self.capacity
    }

    /// Sets the capacity to that of `extra` more particles, in a mesh of at most `triangles`
    /// triangles, without allocating it.
    ///
    /// A split gives the new particle a copy of each vertex of the old one at most, so the largest
    /// number of vertices per particle bounds the growth. No corner needs more than one vertex of
    /// its own.
    pub fn set_capacity(&mut self, extra: usize, triangles: usize) {
        let mut used: Vec<u32> = (0..self.particles.len())
            .filter(|vertex| self.corner_counts[*vertex] > 0)
            .map(|vertex| self.particles[vertex])
            .collect();
        sort(&mut used);
        let most = used.chunk_by(|a, b| a == b).map(<[u32]>::len).max().unwrap_or(1);
        let unused = self.particles.len() - used.len();
        let count = self.particles.len();
        self.capacity = (count + most * extra).min(unused + 3 * triangles).max(count);
    }

    /// Allocates up to the capacity, for a cloth that can tear. A clone needs this too, since
    /// cloning drops spare capacity.
    pub fn reserve(&mut self) {
        for list in [&mut self.particles, &mut self.sites, &mut self.corner_counts] {
            list.reserve_total(self.capacity);
        }
    }

    /// Applies the split of a particle: the vertices at `corners` move to, or are copied for, the
    /// new `particle`.
    ///
    /// Calls `on_new_vertex(new, old)` for each copied vertex. If none was copied, calls it once,
    /// with the lowest vertex that moved as both arguments.
    pub fn split_particle(
        &mut self,
        particle: u32,
        corners: &[Corner],
        mut on_new_vertex: impl FnMut(u32, u32),
    ) {
        let first = self.particles.len() as u32;
        let mut lowest = u32::MAX;
        for (at, corner) in corners.iter().enumerate() {
            let old = self.vertex(*corner);
            if self.particles[old as usize] == particle {
                continue;
            }
            let is_old = |other: &&Corner| self.vertex(**other) == old;
            let moving = corners[at..].iter().filter(is_old).count() as u32;
            if moving == self.corner_counts[old as usize] {
                self.particles[old as usize] = particle;
                lowest = lowest.min(old);
                continue;
            }
            let new = self.particles.len() as u32;
            for other in &corners[at..] {
                if self.vertex(*other) == old {
                    self.triangles[triangle_of(*other)][*other as usize % 3] = new;
                }
            }
            self.particles.push(particle);
            self.sites.push(self.sites[old as usize]);
            self.corner_counts.push(moving);
            self.corner_counts[old as usize] -= moving;
            on_new_vertex(new, old);
        }
        if self.particles.len() as u32 == first && lowest != u32::MAX {
            on_new_vertex(lowest, lowest);
        }
    }

    /// Applies the split of the edge between the particles `ends` at `share` from the first.
    /// Returns the new vertex on the first side; where the edge is a seam, the next vertex is the
    /// one on the other side.
    pub fn split_edge(&mut self, split: &EdgeSplit, ends: [u32; 2], share: f32) -> u32 {
        let first = self.particles.len() as u32;
        for side in split.sides() {
            let edge = side.edge;
            let [near, far, opposite] =
                [edge, next_corner(edge), prev_corner(edge)].map(|c| self.vertex(c));
            let [near_site, far_site] = [near, far].map(|vertex| self.sites[vertex as usize]);
            let is_reversed = self.particles[near as usize] != ends[0];
            let ends = if is_reversed { [far_site, near_site] } else { [near_site, far_site] };
            let cut_site = CutSite { ends, fraction: share };
            // The other side shares the vertex unless the edge is a seam.
            let is_shared =
                self.particles.len() as u32 > first && self.cut_sites.last() == Some(&cut_site);
            let new = self.particles.len() as u32 - u32::from(is_shared);
            if !is_shared {
                self.particles.push(split.vertex);
                self.sites.push(self.original_count + self.cut_sites.len() as u32);
                self.cut_sites.push(cut_site);
                self.corner_counts.push(0);
            }
            self.corner_counts[new as usize] += 2;
            self.corner_counts[opposite as usize] += 1;
            self.triangles[edge as usize / 3][next_corner(edge) as usize % 3] = new;
            self.triangles.push([new, far, opposite]);
        }
        first
    }

    /// All particles that now belong to the given original vertices.
    pub fn particles_of(&self, vertices: &[u32]) -> Vec<u32> {
        let mut is_given = vec![false; self.original_count as usize];
        vertices.iter().for_each(|vertex| is_given[*vertex as usize] = true);
        let with_particles = self.sites.iter().zip(&self.particles);
        with_particles.filter(|(site, _)| is_given[**site as usize]).map(|(_, at)| *at).collect()
    }

    fn vertex(&self, corner: Corner) -> u32 {
        self.triangles[triangle_of(corner)][corner as usize % 3]
    }

    /// Completes seams that were read from a save. Returns false if they do not fit the mesh, where
    /// `fresh` are the seams of the same mesh before any tear or cut.
    pub fn restore_checked(&mut self, fresh: &Self, mesh: &Mesh) -> bool {
        let count = self.particles.len();
        let original = fresh.original_count as usize;
        let sites = original + self.cut_sites.len();
        let are_valid = self.cut_sites.iter().enumerate().all(|(at, cut_site)| {
            cut_site.ends.iter().all(|end| (*end as usize) < original + at)
                && cut_site.fraction > 0.0
                && cut_site.fraction < 1.0
        });
        let fits = self.original_count == fresh.original_count
            && are_valid
            && self.triangles.len() == mesh.triangles.len()
            && self.sites.len() == count
            && count >= fresh.sites.len()
            && count <= fresh.capacity
            && self.sites[..fresh.sites.len()] == fresh.sites
            && self.sites.iter().all(|site| (*site as usize) < sites)
            && self.particles.iter().all(|at| (*at as usize) < mesh.vertex_count());
        let mut corners = self.triangles.as_flattened().iter().zip(mesh.triangles.as_flattened());
        let fits = fits
            && corners
                .all(|(vertex, particle)| self.particles.get(*vertex as usize) == Some(particle));
        if fits {
            self.capacity = fresh.capacity;
            self.count_corners();
        }
        fits
    }
}
