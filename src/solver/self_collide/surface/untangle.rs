//! Untangling: separates surfaces that already intersect, over the next ticks.
//!
//! ```text
//!          q ●                    Edge p q intersects triangle T. Without the edges that intersect
//!            │    ▲ n             something, p is in a smaller connected component than q. So p
//!   T ───────┼────┴──             has penetrated: it moves along T's normal n to q's side.
//!          p ●                    If both are in one component, the edge moves along the line
//!                                 where its triangles intersect T, so that the line becomes
//!                                 shorter.
//! ```
//! The first rule is global intersection analysis (Baraff, Witkin, Kass, "Untangling Cloth",
//! SIGGRAPH 2003), the second one contour minimization (Volino, Magnenat-Thalmann, "Resolving
//! Surface Collisions through Intersection Contour Minimization", SIGGRAPH 2006), restricted to
//! motion along the line: the part across it, where surfaces hardly intersect, is mostly noise.
//! Contacts would keep the sides crossed, so the contacts of the particles involved are disabled.
//!
//! Reads the mesh, cluster pairs and start positions; writes `SweptParticles::now`, predicted
//! positions (no velocity results), velocities, and disables contacts.
//!
//! Invariant: without intersections no data changes. Intersections are listed in the order of
//! cluster pairs.

use crate::geometry::aabb::Aabb;
use crate::math::columns::Columns;
use crate::math::sort::sort;
use crate::math::wide4::{Float4, xyz};
use crate::math::{TINY, min};
use crate::mesh::{Fan, Mesh, triangle_of};
use crate::solver::particle_stage::interleaved::translate;
use crate::solver::self_collide::connected_pieces::find_root;
use crate::solver::self_collide::surface::cluster_bvh::ClusterBvh;
use crate::solver::self_collide::surface::contact::{Contact, ContactKind, MIN_DISTANCE};
use crate::solver::self_collide::surface::speculative::SpeculativeContact;
use crate::solver::self_collide::surface::swept_particles::SweptParticles;
use glam::Vec3;

/// Speed of untangling [mean rest lengths per second], and the largest displacement per substep
/// [mean rest lengths].
const SPEED: f32 = 40.0;
const MAX_STEP: f32 = 1.0 / 6.0;

/// A cloth without known intersections is scanned in parts: the whole cloth once in this number of
/// ticks.
const SCAN_TICKS: u32 = 16;

/// Flags of a particle: it has penetrated; it is on a penetrated triangle or next to one; it is on
/// an intersection whose penetrated side is unknown; an intersection line ends there, at a common
/// corner of both triangles.
const PENETRATED: u8 = 1;
const PIERCED: u8 = 2;
const UNDECIDED: u8 = 4;
const LINE_END: u8 = 8;

/// An intersection of an edge and a triangle, and how it is resolved.
#[derive(Clone, Copy, Debug)]
struct EdgeIntersection {
    /// The ends of the edge, and the corners of the triangle.
    ids: [u32; 5],
    /// Weights of the particles at the intersection point, negative on the triangle. For a
    /// penetrated end: all weight of the edge is on that end.
    weights: [f32; 5],
    /// Direction in which the edge moves relative to the triangle, and how far in a substep [m].
    direction: Vec3,
    distance: f32,
}

/// All intersections of a cloth, and scratch buffers for their analysis.
#[derive(Clone, Debug, Default)]
pub(crate) struct SurfaceIntersections {
    intersections: Vec<EdgeIntersection>,
    /// Flags of each particle.
    flags: Vec<u8>,
    /// Union-find over edges that intersect nothing: parent of each particle, and the size of each
    /// component by its root.
    parents: Vec<u32>,
    sizes: Vec<u32>,
    /// Edges that intersect something, sorted.
    intersecting_edges: Vec<[u32; 2]>,
    fan: Fan,
}

impl SurfaceIntersections {
    /// Heap memory [bytes].
    pub fn bytes(&self) -> usize {
        let fan = self.fan.corners.capacity() + self.fan.ring.capacity();
        let words = self.parents.capacity()
            + self.sizes.capacity()
            + 2 * self.intersecting_edges.capacity()
            + fan;
        size_of::<EdgeIntersection>() * self.intersections.capacity()
            + self.flags.capacity()
            + 4 * words
    }

    pub fn is_empty(&self) -> bool {
        self.intersections.is_empty()
    }

    pub fn len(&self) -> usize {
        self.intersections.len()
    }

    /// Returns the edge of the first intersection: its two particles.
    pub fn first_edge(&self) -> Option<[u32; 2]> {
        self.intersections.first().map(|intersection| [intersection.ids[0], intersection.ids[1]])
    }

    pub fn clear(&mut self) {
        self.intersections.clear();
    }

    /// Scans the clusters that are due in this tick for intersections, and returns whether there
    /// are any. `pairs` are the substep pairs.
    pub fn scan(
        &mut self,
        mesh: &Mesh,
        bvh: &ClusterBvh,
        pairs: &[u32],
        start: &[Float4],
        tick: u32,
    ) -> bool {
        self.collect(mesh, bvh, pairs, start, Some(tick % SCAN_TICKS));
        !self.is_empty()
    }

    /// Detects all intersections at the start of a substep, and how each is resolved.
    ///
    /// `pairs` are the substep pairs, `gap` the gap between layers [m], `mean_edge` the mean rest
    /// length [m], `h` the length of the substep [s].
    pub fn detect(
        &mut self,
        mesh: &Mesh,
        (bvh, pairs): (&ClusterBvh, &[u32]),
        start: &[Float4],
        [gap, mean_edge, h]: [f32; 3],
    ) {
        self.collect(mesh, bvh, pairs, start, None);
        if self.is_empty() {
            return;
        }
        self.flags.clear();
        self.flags.resize(start.len(), 0);
        self.mark_line_ends(mesh);
        self.build_components(bvh, start.len());
        let max_step = mean_edge * min(SPEED * h, MAX_STEP);
        for i in 0..self.intersections.len() {
            let intersection = self.intersections[i];
            self.intersections[i] = self
                .resolve_by_component(&intersection, mesh, start, gap, max_step)
                .unwrap_or_else(|| self.resolve_by_contour(&intersection, mesh, start, max_step));
        }
    }

    /// Collects the intersections in cluster pairs: in all, or in those whose first cluster is due.
    #[inline(never)]
    fn collect(
        &mut self,
        mesh: &Mesh,
        bvh: &ClusterBvh,
        pairs: &[u32],
        x: &[Float4],
        due: Option<u32>,
    ) {
        self.intersections.clear();
        for pair in pairs {
            let [one, other] = bvh.tick_pair(*pair);
            if due.is_none_or(|due| one % SCAN_TICKS == due) {
                self.collect_in_pair(mesh, bvh, [one, other], x);
                if one != other {
                    self.collect_in_pair(mesh, bvh, [other, one], x);
                }
            }
        }
    }

    /// Collects the intersections of edges that cluster `one` owns with triangles of cluster
    /// `other`.
    #[inline(never)]
    fn collect_in_pair(
        &mut self,
        mesh: &Mesh,
        bvh: &ClusterBvh,
        [one, other]: [u32; 2],
        x: &[Float4],
    ) {
        let at = |id: u32| xyz(&x[id as usize]);
        let [from, to] = bvh.clusters[one as usize].edges;
        let edges = &bvh.edges[from as usize..to as usize];
        let [from, to] = bvh.clusters[other as usize].triangles;
        let triangles = &bvh.triangles[from as usize..to as usize];
        let swept = &bvh.swept_aabbs[other as usize];
        let whole = Aabb { low: xyz(&swept.low), high: xyz(&swept.high) };
        for ends in edges {
            let edge = ends.map(at);
            let aabb = Aabb::from_points(edge);
            if !whole.overlaps(&aabb) {
                continue;
            }
            for triangle in triangles {
                let corners = mesh.triangles[*triangle as usize];
                let points = corners.map(at);
                let are_adjacent = corners.iter().any(|corner| ends.contains(corner));
                if are_adjacent || !Aabb::from_points(points).overlaps(&aabb) {
                    continue;
                }
                if let Some(weights) = intersect_edge_triangle(edge, points) {
                    let ([p, q], [a, b, c]) = (*ends, corners);
                    self.intersections.push(EdgeIntersection {
                        ids: [p, q, a, b, c],
                        weights,
                        direction: Vec3::ZERO,
                        distance: 0.0,
                    });
                }
            }
        }
    }

    /// Marks the ends of intersection lines: the common corners of two triangles that intersect.
    fn mark_line_ends(&mut self, mesh: &Mesh) {
        for intersection in &self.intersections {
            let [p, q, corners @ ..] = intersection.ids;
            for third in opposite_vertices([p, q], mesh, &mut self.fan) {
                if corners.contains(&third) {
                    self.flags[third as usize] |= LINE_END;
                }
            }
        }
    }

    /// Builds the connected components of the mesh without the edges that intersect something and
    /// without line ends.
    fn build_components(&mut self, bvh: &ClusterBvh, particles: usize) {
        self.intersecting_edges.clear();
        let edges = self.intersections.iter().map(|it| [it.ids[0], it.ids[1]]);
        self.intersecting_edges.extend(edges);
        sort(&mut self.intersecting_edges);
        self.parents.clear();
        self.parents.extend(0..particles as u32);
        for ends in &bvh.edges {
            if !self.has_line_end(*ends) && self.intersecting_edges.binary_search(ends).is_err() {
                let [one, other] = ends.map(|end| find_root(&mut self.parents, end));
                self.parents[one.max(other) as usize] = one.min(other);
            }
        }
        self.sizes.clear();
        self.sizes.resize(particles, 0);
        for i in 0..particles as u32 {
            let root = find_root(&mut self.parents, i);
            self.sizes[root as usize] += 1;
        }
    }

    fn has_line_end(&self, ends: [u32; 2]) -> bool {
        ends.into_iter().any(|end| self.flags[end as usize] & LINE_END != 0)
    }

    /// Resolves an intersection whose ends are in different components: the end in the smaller one
    /// moves along the triangle's normal to the side of the other end. `None` if both are in one
    /// component.
    fn resolve_by_component(
        &mut self,
        intersection: &EdgeIntersection,
        mesh: &Mesh,
        x: &[Float4],
        gap: f32,
        max_step: f32,
    ) -> Option<EdgeIntersection> {
        let at = |id: u32| xyz(&x[id as usize]);
        let [p, q, corners @ ..] = intersection.ids;
        let roots = [p, q].map(|end| find_root(&mut self.parents, end));
        if roots[0] == roots[1] || self.has_line_end([p, q]) {
            return None;
        }
        let [size_p, size_q] = roots.map(|root| (self.sizes[root as usize], root));
        let is_first = size_p < size_q;
        let penetrated = if is_first { p } else { q };
        self.flags[penetrated as usize] |= PENETRATED;
        for corner in corners {
            self.flags[corner as usize] |= PIERCED;
            mesh.gather_fan(mesh.corner_of[corner as usize], &mut self.fan);
            for neighbour in &self.fan.ring {
                self.flags[*neighbour as usize] |= PIERCED;
            }
        }
        let [_, _, a, b, c] = intersection.weights;
        let weights = if is_first { [1.0, 0.0, a, b, c] } else { [0.0, 1.0, a, b, c] };
        let normal = unit_normal(corners.map(at));
        let height = normal.dot(at(penetrated) - at(corners[0]));
        let direction = if height > 0.0 { -normal } else { normal };
        let distance = min(height.abs() + gap, max_step);
        Some(EdgeIntersection { weights, direction, distance, ..*intersection })
    }

    /// Resolves an intersection by contour minimization: the edge moves along the intersection
    /// lines of its triangles with the other triangle. At a border the line runs into the only
    /// triangle. Elsewhere the directions into both triangles are added: the sum points to the
    /// inner side of the bend of the line, and is zero for a straight line.
    fn resolve_by_contour(
        &mut self,
        intersection: &EdgeIntersection,
        mesh: &Mesh,
        x: &[Float4],
        max_step: f32,
    ) -> EdgeIntersection {
        let at = |id: u32| xyz(&x[id as usize]);
        let [p, q, corners @ ..] = intersection.ids;
        for id in intersection.ids {
            self.flags[id as usize] |= UNDECIDED;
        }
        let (edge, normal) = (at(q) - at(p), unit_normal(corners.map(at)));
        let mut sum = Vec3::ZERO;
        for third in opposite_vertices([p, q], mesh, &mut self.fan) {
            let inwards = at(third) - at(p);
            let line = edge.cross(inwards).cross(normal);
            // The sign that points into the triangle of the edge.
            let is_inwards = line.cross(edge).dot(inwards.cross(edge)) > 0.0;
            let length = if is_inwards { line.length() } else { -line.length() };
            if length != 0.0 {
                sum += line * (1.0 / length);
            }
        }
        let length = sum.length();
        let distance = min(length, 1.0) * max_step;
        EdgeIntersection { direction: sum * (1.0 / (length + TINY)), distance, ..*intersection }
    }

    /// Whether a contact of this pair could keep an intersection from being resolved.
    fn blocks_untangling(&self, ids: [u32; 4], kind: ContactKind) -> bool {
        let all = ids.map(|id| self.flags[id as usize]);
        let (one, other) = all.split_at(kind as usize);
        let [one, other] = [one, other].map(|side| side.iter().fold(0, |sum, flags| sum | flags));
        let penetrates =
            |one: u8, other: u8| one & PENETRATED != 0 && other & (PENETRATED | PIERCED) != 0;
        penetrates(one, other) || penetrates(other, one) || one & other & UNDECIDED != 0
    }

    /// Disables contacts and removes speculative contacts that could keep an intersection from
    /// being resolved.
    pub fn disable_contacts(
        &self,
        contacts: &mut [Contact],
        speculative: &mut Vec<SpeculativeContact>,
    ) {
        if self.is_empty() {
            return;
        }
        for contact in contacts {
            if self.blocks_untangling(contact.ids, contact.kind) {
                contact.disable();
            }
        }
        speculative.retain(|pair| !self.blocks_untangling(pair.ids, pair.kind));
    }

    /// Moves each intersection by its distance in the substep. Predicted positions move along, so
    /// no velocity results.
    pub fn resolve(&self, motion: &mut SweptParticles, predicted: &mut Columns) {
        let SweptParticles { start, now, .. } = motion;
        for EdgeIntersection { ids, weights, direction, distance } in &self.intersections {
            let all = ids.map(|id| id as usize).into_iter().zip(*weights);
            let (mut moved, mut sum) = (0.0, 0.0);
            for (id, weight) in all.clone() {
                moved += weight * direction.dot(xyz(&now[id]) - xyz(&start[id]));
                sum += weight * weight * now[id][3];
            }
            let missing = distance - moved;
            if missing <= 0.0 || sum <= 0.0 {
                continue;
            }
            for (id, weight) in all {
                let by = *direction * (missing * weight * now[id][3] / sum);
                translate(&mut now[id], by);
                predicted.add(id, by);
            }
        }
    }

    /// Removes the part of the velocities that deepens an intersection.
    #[inline(never)]
    pub fn remove_deepening_velocities(&self, inverse_masses: &[f32], velocities: &mut Columns) {
        for EdgeIntersection { ids, weights, direction, .. } in &self.intersections {
            let all = ids.map(|id| id as usize).into_iter().zip(*weights);
            let (mut speed, mut sum) = (0.0, 0.0);
            for (id, weight) in all.clone() {
                speed += weight * direction.dot(velocities.get(id));
                sum += weight * weight * inverse_masses[id];
            }
            if speed < 0.0 && sum > 0.0 {
                for (id, weight) in all {
                    velocities.add(id, *direction * (-speed * weight * inverse_masses[id] / sum));
                }
            }
        }
    }
}

/// The vertices opposite an edge in its triangles.
fn opposite_vertices<'a>(
    [p, q]: [u32; 2],
    mesh: &'a Mesh,
    fan: &'a mut Fan,
) -> impl Iterator<Item = u32> + 'a {
    mesh.gather_fan(mesh.corner_of[p as usize], fan);
    let all = fan.corners.iter().map(|corner| mesh.triangles[triangle_of(*corner)]);
    all.filter(move |corners| corners.contains(&q))
        .flat_map(move |corners| corners.into_iter().filter(move |id| *id != p && *id != q))
}

fn unit_normal([a, b, c]: [Vec3; 3]) -> Vec3 {
    let doubled = (b - a).cross(c - a);
    doubled * (1.0 / (doubled.length() + TINY))
}

/// The intersection of edge p q and triangle a b c, as the weights of the five points; `None` if
/// they do not intersect or an end is too near the plane.
fn intersect_edge_triangle([p, q]: [Vec3; 2], [a, b, c]: [Vec3; 3]) -> Option<[f32; 5]> {
    let normal = (b - a).cross(c - a);
    let (over_p, over_q) = (normal.dot(p - a), normal.dot(q - a));
    let least = normal.length() * MIN_DISTANCE;
    let is_clear = over_p.abs() > least && over_q.abs() > least;
    if !is_clear || (over_p > 0.0) == (over_q > 0.0) {
        return None;
    }
    let t = over_p / (over_p - over_q);
    let x = p + (q - p) * t;
    let area = |b: Vec3, c: Vec3| (b - x).cross(c - x).dot(normal);
    let [u, v, w] = [area(b, c), area(c, a), area(a, b)];
    let is_inside = u > 0.0 && v > 0.0 && w > 0.0;
    let total = u + v + w;
    is_inside.then(|| [1.0 - t, t, -u / total, -v / total, -w / total])
}
