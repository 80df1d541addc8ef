//! Simplification: collapses edges that are too short, and flips the longest edge of triangles that
//! are too low.
//!
//! ```text
//!   ╲ │  ╱               ╲   ╱                d                d
//!  ── u ─ v ──    ─▶    ── v ──             ╱───╲            ╱ │ ╲
//!   ╱ │  ╲               ╱   ╲             a ─── b    ─▶    a  │  b
//!                                           ╲   ╱            ╲ │ ╱
//!  collapse of u to v                         e     flip       e
//! ```
//! Half-edge collapses (Hoppe et al., "Mesh Optimization", SIGGRAPH 1993), the shortest edge first.
//! v stays where it is, so each particle is at the position of a given vertex. A collapse is
//! refused if
//!
//! - it would change the topology: link condition of Dey, Edelsbrunner, Guha and Nekhayev,
//!   "Topology Preserving Edge Contraction", 1999;
//! - u would leave its border or its seam of texture coordinates, or is a corner or an end of one;
//! - u is pinned and v is not;
//! - a triangle would turn over, or would become lower than half of the limit and lower than all
//!   triangles around u.
//!
//! A flip makes the lower of two triangles higher. It never crosses a seam. An obtuse low
//! triangle whose longest edge is on the border is removed, once at each place.
//!
//! Functions with several callers are not inlined: they run once, and a page loads them.
//!
//! Reads positions, texture coordinates and pins; writes the triangles of a repaired mesh.
//! Invariant: the mesh stays sound; its pieces and their borders stay as many.

use crate::math::sort::{sort, sort_measured};
use crate::mesh::intake::remove_degenerate::is_degenerate;
use crate::mesh::report::MeshReport;
use crate::mesh::seams::Seams;
use crate::mesh::{Mesh, NONE};
use glam::{DVec3, Vec2, Vec3};

/// What to simplify.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Simplify<'a> {
    /// Edges and heights below this are too small [m]; 0 for none.
    pub below: f32,
    /// Texture coordinates of the given vertices, or empty.
    pub uvs: &'a [Vec2],
    /// Pinned vertices.
    pub pinned: &'a [u32],
}

/// A neighbour of a particle, and a triangle with both.
type Spoke = (u32, u32);

/// A mesh whose particles and triangles can be removed.
pub(super) struct Surface<'a> {
    uvs: &'a [Vec2],
    /// Given vertex of each vertex.
    sites: &'a [u32],
    /// Particle of each vertex.
    particles: &'a [u32],
    /// Position of each particle [m].
    x: Vec<Vec3>,
    is_pinned: Vec<bool>,
    /// Whether a particle came to the border when a low triangle was removed.
    is_trimmed: Vec<bool>,
    /// Particles at the corners of each triangle; `NONE` for a removed one.
    triangles: Vec<[u32; 3]>,
    /// Vertices at the same corners.
    vertices: Vec<[u32; 3]>,
    /// Triangles of each particle.
    fans: Vec<Vec<u32>>,
    /// The particle that each collapsed one went to; others are their own.
    moved_to: Vec<u32>,
    /// Square of the limit [m²].
    below2: f64,
}

impl<'a> Surface<'a> {
    /// Copies a sound mesh with its particles at `x`.
    pub fn new(mesh: &Mesh, x: Vec<Vec3>, seams: &'a Seams, options: &Simplify<'a>) -> Self {
        let mut is_pinned = vec![false; x.len()];
        seams.particles_of(options.pinned).iter().for_each(|p| is_pinned[*p as usize] = true);
        let mut fans = vec![Vec::new(); x.len()];
        for (t, corners) in (0..).zip(&mesh.triangles) {
            corners.iter().for_each(|p| fans[*p as usize].push(t));
        }
        Self {
            uvs: options.uvs,
            sites: &seams.sites,
            particles: &seams.particles,
            moved_to: (0..x.len() as u32).collect(),
            is_trimmed: vec![false; x.len()],
            x,
            is_pinned,
            triangles: mesh.triangles.clone(),
            vertices: seams.triangles.clone(),
            fans,
            below2: f64::from(options.below) * f64::from(options.below),
        }
    }

    /// Collapses and flips until nothing changes, and writes the counts into the report. Returns
    /// whether anything changed.
    pub fn simplify(&mut self, report: &mut MeshReport) -> bool {
        let changes = |report: &MeshReport| {
            report.collapsed_edges + report.flipped_edges + report.trimmed_triangles
        };
        loop {
            let before = changes(report);
            let short_edges = self.short_edges();
            for (_, a, b) in &short_edges {
                report.collapsed_edges += u32::from(self.collapse_one_way(*a, *b));
            }
            for t in 0..self.triangles.len() as u32 {
                if self.triangles[t as usize][0] != NONE {
                    self.remove_low_triangle(t, report);
                }
            }
            if changes(report) == before {
                report.short_edges = short_edges.len() as u32;
                return before > 0;
            }
        }
    }

    /// Returns the remaining triangles over particles, which are numbered anew, the same over
    /// vertices, and the particle of each vertex. Removes what was removed from `source_vertices`
    /// and `given`, the given vertex of each particle and the given triangle of each triangle.
    pub fn finish(
        self,
        source_vertices: &mut Vec<u32>,
        given: &mut Vec<u32>,
    ) -> (Vec<[u32; 3]>, Vec<[u32; 3]>, Vec<u32>) {
        let mut numbers = vec![0; self.x.len()];
        let mut count = 0;
        for p in (0..self.x.len()).filter(|p| self.moved_to[*p] == *p as u32) {
            numbers[p] = count as u32;
            source_vertices[count] = source_vertices[p];
            count += 1;
        }
        source_vertices.truncate(count);
        let number = |p: &u32| {
            let mut p = *p as usize;
            while self.moved_to[p] != p as u32 {
                p = self.moved_to[p] as usize;
            }
            numbers[p]
        };
        let (mut triangles, mut vertices) = (Vec::new(), Vec::new());
        for (t, corners) in self.triangles.iter().enumerate().filter(|(_, c)| c[0] != NONE) {
            given[triangles.len()] = given[t];
            triangles.push(corners.map(|p| numbers[p as usize]));
            vertices.push(self.vertices[t]);
        }
        given.truncate(triangles.len());
        (triangles, vertices, self.particles.iter().map(number).collect())
    }

    /// The edges below the limit, the shortest first: square of the length [m²] and both ends.
    #[inline(never)]
    fn short_edges(&self) -> Vec<(f64, u32, u32)> {
        let mut edges = Vec::new();
        for [a, b, c] in self.triangles.iter().filter(|corners| corners[0] != NONE) {
            for (p, q) in [(a, b), (b, c), (c, a)] {
                let length2 = self.edge(*p, *q).length_squared();
                if length2 < self.below2 {
                    edges.push((length2, *p.min(q), *p.max(q)));
                }
            }
        }
        sort_measured(&mut edges);
        edges.dedup();
        edges
    }

    /// Collapses an edge in the better of both directions. Returns false if none is possible.
    fn collapse_one_way(&mut self, a: u32, b: u32) -> bool {
        let (up, down) = (self.height_after(a, b), self.height_after(b, a));
        if up < 0.0 && down < 0.0 {
            return false;
        }
        // Of equally good ones the lower number stays.
        let (from, to) = if up > down { (a, b) } else { (b, a) };
        self.collapse(from, to);
        true
    }

    #[inline(never)]
    fn edge(&self, from: u32, to: u32) -> DVec3 {
        self.x[to as usize].as_dvec3() - self.x[from as usize].as_dvec3()
    }

    /// Normal of a triangle, as long as twice its area [m²], and square of its least height [m²].
    #[inline(never)]
    fn measure(&self, [a, b, c]: [u32; 3]) -> (DVec3, f64) {
        let normal = self.edge(a, b).cross(self.edge(a, c));
        let longest2 = [(a, b), (b, c), (c, a)].iter().fold(0.0_f64, |longest2, (p, q)| {
            let length2 = self.edge(*p, *q).length_squared();
            if length2 > longest2 { length2 } else { longest2 }
        });
        (normal, normal.length_squared() / longest2)
    }

    /// The neighbours of a particle, each with its one or two triangles, sorted.
    #[inline(never)]
    fn spokes(&self, u: u32) -> Vec<Spoke> {
        let mut spokes = Vec::new();
        for t in &self.fans[u as usize] {
            let others = self.triangles[*t as usize].iter().filter(|p| **p != u);
            spokes.extend(others.map(|p| (*p, *t)));
        }
        sort(&mut spokes);
        spokes
    }

    /// The vertex of a particle in a triangle.
    #[inline(never)]
    fn vertex(&self, t: u32, particle: u32) -> u32 {
        let mut corners = self.triangles[t as usize].iter().zip(&self.vertices[t as usize]);
        corners.find(|(p, _)| **p == particle).map_or(NONE, |(_, vertex)| *vertex)
    }

    /// Whether two vertices have the same texture coordinates.
    fn is_same(&self, a: u32, b: u32) -> bool {
        let uv = |vertex: u32| self.uvs[self.sites[vertex as usize] as usize];
        a == b || self.uvs.is_empty() || uv(a) == uv(b)
    }

    /// Whether the edge from `u` is a border or a seam, by its one or two spokes.
    #[inline(never)]
    fn is_feature(&self, u: u32, edge: &[Spoke]) -> bool {
        let [(p, one), (_, other)] = edge else { return true };
        [u, *p].iter().any(|p| !self.is_same(self.vertex(*one, *p), self.vertex(*other, *p)))
    }

    /// Whether `u` may move to `v` without leaving its borders and seams.
    fn may_move(&self, u: u32, v: u32, spokes: &[Spoke]) -> bool {
        let features = spokes.chunk_by(|a, b| a.0 == b.0).filter(|edge| self.is_feature(u, edge));
        let features: Vec<u32> = features.map(|edge| edge[0].0).collect();
        let [a, b] = features[..] else { return features.is_empty() };
        let (along, back) = (self.edge(u, a), self.edge(u, b));
        let dot = along.dot(back);
        // A turn of more than 60° is a corner.
        let is_straight =
            dot < 0.0 && dot * dot >= 0.25 * along.length_squared() * back.length_squared();
        (v == a || v == b) && is_straight
    }

    /// Least height [m²] of the triangles around `u` if it collapses to `v`; -1 if it cannot.
    #[inline(never)]
    fn height_after(&self, u: u32, v: u32) -> f64 {
        const REFUSED: f64 = -1.0;
        let (at_u, at_v) = (self.spokes(u), self.spokes(v));
        let sides = |p: u32, spokes: &[Spoke]| spokes.iter().filter(|spoke| spoke.0 == p).count();
        let side_count = sides(v, &at_u);
        if side_count == 0 || self.is_pinned[u as usize] && !self.is_pinned[v as usize] {
            return REFUSED;
        }
        if !self.may_move(u, v, &at_u) {
            return REFUSED;
        }
        // Link condition: the common neighbours are the tips of the removed triangles, and no tip
        // loses all its triangles.
        let mut tips = Vec::new();
        for edge in at_u.chunk_by(|a, b| a.0 == b.0) {
            let tip = edge[0].0;
            let other_sides = sides(tip, &at_v);
            if tip != v && other_sides > 0 {
                tips.push(tip);
                if edge.len() + other_sides == 2 {
                    return REFUSED;
                }
            }
        }
        if tips.len() != side_count {
            return REFUSED;
        }
        let (mut before, mut after) = (f64::INFINITY, f64::INFINITY);
        let fan = || self.fans[u as usize].iter().map(|t| self.triangles[*t as usize]);
        let mean_normal: DVec3 = fan().map(|corners| self.measure(corners).0).sum();
        for corners in fan() {
            let (normal, height2) = self.measure(corners);
            before = if height2 < before { height2 } else { before };
            if corners.contains(&v) {
                continue;
            }
            let moved = corners.map(|p| if p == u { v } else { p });
            let is_tip = |p: &&u32| tips.contains(p);
            if moved.iter().filter(is_tip).count() == 2 && self.has_triangle(v, &tips) {
                return REFUSED;
            }
            let (new_normal, new_height2) = self.measure(moved);
            after = if new_height2 < after { new_height2 } else { after };
            // The normal of a low triangle is that of rounding.
            let facing = if height2 < self.below2 { mean_normal } else { normal };
            if new_normal.dot(facing) <= 0.0 || is_degenerate(&self.x, &moved) {
                return REFUSED;
            }
        }
        if after < before && after < 0.25 * self.below2 { REFUSED } else { after }
    }

    /// Whether `v` has a triangle with both tips.
    fn has_triangle(&self, v: u32, tips: &[u32]) -> bool {
        let mut fan = self.fans[v as usize].iter().map(|t| self.triangles[*t as usize]);
        fan.any(|corners| tips.iter().all(|tip| corners.contains(tip)))
    }

    /// Moves the triangles of `u` to `v`, and removes those with both.
    #[inline(never)]
    fn collapse(&mut self, u: u32, v: u32) {
        let fan = core::mem::take(&mut self.fans[u as usize]);
        // The vertex of v that takes the place of a vertex of u, where a removed triangle has both.
        let mut replaced: Vec<[u32; 2]> = Vec::new();
        for t in &fan {
            if self.triangles[*t as usize].contains(&v) {
                replaced.push([self.vertex(*t, u), self.vertex(*t, v)]);
                self.remove(*t);
            }
        }
        for t in fan {
            if self.triangles[t as usize][0] == NONE {
                continue;
            }
            let mut vertex = self.vertex(t, u);
            // Without texture coordinates, vertices may differ in what only the host knows.
            let is_same = |a: u32, b: u32| a == b || !self.uvs.is_empty() && self.is_same(a, b);
            let mut found = replaced.iter().filter(|[old, _]| is_same(*old, vertex));
            if let Some([_, new]) = found.next()
                && found.all(|[_, other]| is_same(*other, *new))
            {
                vertex = *new;
            }
            self.replace_corner(t, u, v, vertex);
        }
        self.moved_to[u as usize] = v;
        self.is_trimmed[v as usize] |= self.is_trimmed[u as usize];
    }

    /// Flips the longest edge of a triangle that is too low, if that makes the lower of both
    /// triangles there higher. If that edge is a border, removes the triangle.
    fn remove_low_triangle(&mut self, t: u32, report: &mut MeshReport) {
        let corners = self.triangles[t as usize];
        let (normal, height2) = self.measure(corners);
        if height2 >= self.below2 {
            return;
        }
        let length2 = |k: usize| self.edge(corners[k], corners[(k + 1) % 3]).length_squared();
        let longest = if length2(1) > length2(0) { 1 } else { 0 };
        let longest = if length2(2) > length2(longest) { 2 } else { longest };
        let [a, b, d] = [0, 1, 2].map(|k| corners[(longest + k) % 3]);
        let edge: Vec<Spoke> = self.spokes(a).into_iter().filter(|spoke| spoke.0 == b).collect();
        let at_d = self.spokes(d);
        if edge.len() == 1 {
            let is_inside = at_d.chunk_by(|p, q| p.0 == q.0).all(|edge| edge.len() == 2);
            let is_obtuse = self.edge(d, a).dot(self.edge(d, b)) < 0.0;
            // The border moves by less than the limit, and only once.
            let is_first = !self.is_trimmed[a as usize] && !self.is_trimmed[b as usize];
            if is_inside && is_obtuse && is_first {
                self.is_trimmed[d as usize] = true;
                self.remove(t);
                report.trimmed_triangles += 1;
            }
            return;
        }
        let s = if edge[0].1 == t { edge[1].1 } else { edge[0].1 };
        let across = self.triangles[s as usize];
        let tip = across.into_iter().find(|p| *p != a && *p != b);
        let Some(e) = tip.filter(|_| !self.is_feature(a, &edge)) else { return };
        // Corner b of t becomes e, and corner a of s becomes d.
        let flipped = [
            corners.map(|p| if p == b { e } else { p }),
            across.map(|p| if p == a { d } else { p }),
        ];
        let (normal_across, height2_across) = self.measure(across);
        let least2 = if height2_across < height2 { height2_across } else { height2 };
        let is_better = |corners: &[u32; 3]| {
            let (new_normal, new_height2) = self.measure(*corners);
            let faces = new_normal.dot(normal + normal_across) > 0.0;
            faces && new_height2 > least2 && !is_degenerate(&self.x, corners)
        };
        let is_joined = d == e || at_d.iter().any(|spoke| spoke.0 == e);
        if is_joined || !flipped.iter().all(is_better) {
            return;
        }
        let vertices = [self.vertex(s, e), self.vertex(t, d)];
        self.replace_corner(t, b, e, vertices[0]);
        self.replace_corner(s, a, d, vertices[1]);
        report.flipped_edges += 1;
    }

    /// Gives a triangle the particle `new`, with its `vertex`, in place of `old`.
    #[inline(never)]
    fn replace_corner(&mut self, t: u32, old: u32, new: u32, vertex: u32) {
        for k in 0..3 {
            if self.triangles[t as usize][k] == old {
                self.triangles[t as usize][k] = new;
                self.vertices[t as usize][k] = vertex;
            }
        }
        self.fans[old as usize].retain(|other| *other != t);
        self.fans[new as usize].push(t);
    }

    /// Removes a triangle.
    #[inline(never)]
    fn remove(&mut self, t: u32) {
        for p in core::mem::replace(&mut self.triangles[t as usize], [NONE; 3]) {
            self.fans[p as usize].retain(|other| *other != t);
        }
    }
}
