//! Cuts by a blade: split the edges that the blade crosses, then open the edges along it.
//!
//! ```text
//!      ╱╲                    ╱╲                    ╱╲
//!   ━━╱━━╲━━ blade          ●──●                  ●──●
//!    ╱    ╲                ╱ ╲  ╲                 ●──●       ●: new vertices
//!   ╱──────╲              ╱───╲──╲               ╱─╲──╲
//!   crossed edges      1. split edges        2. open edges
//! ```
//! Method: `plan` makes the cut on a copy of the mesh, so it is known to fit before anything
//! changes. A crossing near a vertex moves to that vertex, so that no sliver triangle appears; the
//! cut deviates from the blade by at most `NEAR_VERTEX` of an edge there. At a pinned vertex the
//! crossing moves to that distance from it instead, so that a cut beside pins does not end at them.
//!
//! Reads mesh, positions, rest positions and pins; `cut` writes everything that follows from the
//! mesh.
//! Invariant: a triangle that a cut makes has angles of at least 5°. A plan is valid only for the
//! world that it was made for.

use crate::geometry::blade::Blade;
use crate::geometry::triangle::corner_areas;
use crate::math::sort::sort_by;
use crate::mesh::split_edge::CutSite;
use crate::mesh::{Corner, Fan, Mesh, NONE, next_corner, prev_corner};
use crate::model::cut_links::{LinksOfTriangle, RestShape};
use crate::solver::topology::tear::{push_edge_torn_event, push_split_vertex, update_pieces};
use crate::solver::world::World;
use crate::state::anchors::AnchorConstraint;
use crate::state::events::EventKind;
use glam::Vec3;

/// A crossing nearer to an end of its edge than this share of the edge moves to the end.
const NEAR_VERTEX: f32 = 0.125;

/// Smallest sine of an angle of a triangle that a split may leave: 5°.
const MIN_SINE: f32 = 0.087_155_74;

/// Smallest area of such a triangle, relative to the square of the mean edge.
const MIN_AREA: f32 = 0.005;

/// A planned cut.
#[derive(Clone, Debug, Default)]
pub(crate) struct CutPlan {
    /// Edges to split, one after the other, and the share of the edge at which to split.
    splits: Vec<(Corner, f32)>,
    /// Edges to open afterwards.
    open: Vec<Corner>,
    vertices: usize,
    triangles: usize,
    opened: usize,
}

impl CutPlan {
    /// Number of edges that open.
    pub fn opened_count(&self) -> u32 {
        self.opened as u32
    }

    /// Whether the cut fits in a cloth with these capacities for vertices and triangles.
    pub fn fits(&self, vertices: usize, triangles: usize) -> bool {
        self.vertices <= vertices && self.triangles <= triangles
    }
}

/// Plans a cut by `blade` without changing the world.
pub(crate) fn plan(world: &World, blade: &Blade) -> CutPlan {
    let mut draft = CutDraft::new(world, blade);
    draft.split_crossed_edges(blade);
    draft.mesh.rebuild_vertex_corners();
    let mut plan = CutPlan { open: draft.edges_along(blade), ..CutPlan::default() };
    plan.splits = draft.splits;
    let (mut opened, mut copies) = (Vec::new(), Vec::new());
    draft.mesh.open_edges(&plan.open, &mut opened, &mut copies);
    plan.vertices = draft.mesh.vertex_count();
    plan.triangles = draft.mesh.triangles.len();
    plan.opened = opened.len();
    plan
}

/// Executes a plan that was made for this world in its current state.
pub(crate) fn cut(world: &mut World, plan: &CutPlan) {
    let mut links_of_triangle = world.constraints.links_of_triangles(world.mesh.triangles.len());
    let links = plan.opened + 12 * plan.splits.len();
    world.constraints.reserve(links, world.capacity());
    for (edge, share) in &plan.splits {
        split_edge(world, *edge, *share, &mut links_of_triangle);
    }
    world.mesh.rebuild_vertex_corners();
    let (mut opened, mut copies) = (Vec::new(), Vec::new());
    let ends = |world: &World, edge: Corner| world.mesh.ends(edge);
    let edges: Vec<(u32, u32)> = plan.open.iter().map(|edge| ends(world, *edge)).collect();
    let edges: Vec<_> = plan.open.iter().zip(edges).collect();
    world.mesh.open_edges(&plan.open, &mut opened, &mut copies);
    for (_, (a, b)) in edges.iter().filter(|(edge, _)| opened.iter().any(|pair| pair[0] == **edge))
    {
        push_edge_torn_event(world, *a, *b);
    }
    let mut fan = Fan::default();
    for [new, old] in copies {
        push_split_vertex(world, new, old, &mut fan);
    }
    for sides in opened {
        world.constraints.open_edge(&world.mesh, sides, (&world.material, &world.maps));
    }
    (0..world.rest.len() as u32).for_each(|site| world.refresh_constraints_at(site));
    world.compute_masses();
    world.reserve_after_cut();
    world.rebuild_crack_tips();
    update_pieces(world);
    world.rebuild_tethers();
}

/// Splits one edge of the world at `share`, with its particle, links, seams, areas and anchors.
fn split_edge(
    world: &mut World,
    edge: Corner,
    share: f32,
    links_of_triangle: &mut LinksOfTriangle,
) {
    let [a, b] = [world.mesh.vertex(edge), world.mesh.vertex(next_corner(edge))];
    let ends = [a, b].map(|end| world.mesh.source[end as usize]);
    let site = world.rest.len() as u32;
    let crossing = CutSite { ends, fraction: share };
    let at_crossing = crossing.interpolate(|end| world.rest[end as usize]);
    world.rest.push(at_crossing);
    world.cut_sites.push(crossing);
    let division = world.mesh.split_edge(edge, site);
    let vertex = match &mut world.seams {
        Some(seams) => seams.split_edge(&division, [a, b], share),
        None => division.vertex,
    };
    let (mesh, rest) = (&world.mesh, &world.rest);
    let at = |triangle: u32| {
        mesh.triangles[triangle as usize].map(|v| rest[mesh.source[v as usize] as usize])
    };
    let pieces = &mut world.scratch.pieces;
    for side in division.sides() {
        world.corner_area[side.kept() as usize] = corner_areas(at(side.kept()));
        world.corner_area.push(corner_areas(at(side.added)));
        pieces.push_split_of(side.kept() as usize);
    }
    let new = world.particles.push_between(a as usize, b as usize, share);
    world.scratch.push_particle();
    let scales = [a, b].map(|end| world.mass_scales.get(end as usize));
    world.mass_scales.push(scales[0] + (scales[1] - scales[0]) * share);
    world.maps.push_between([a, b], share);
    let anchors = [a, b].map(|end| world.anchors.get(end).copied());
    if let [Some(a), Some(b)] = anchors {
        world.anchors.insert(AnchorConstraint::between(new as u32, &a, &b, share));
    }
    let World { mesh, rest, material, maps, constraints, .. } = &mut *world;
    let rest_shape = RestShape { mesh, rest, material, maps };
    constraints.split_edge(rest_shape, &division, links_of_triangle);
    let mut event = world.event_at(EventKind::EdgeDivided, world.particles.x.get(new));
    (event.particle_a, event.particle_b, event.vertex) = (a, b, vertex);
    world.events.push(event);
}

/// Copy of the mesh on which a cut is planned.
struct CutDraft<'a> {
    world: &'a World,
    mesh: Mesh,
    /// Rest position of each vertex [m].
    rest: Vec<Vec3>,
    x: Vec<Vec3>,
    /// Whether the cut passes through each vertex.
    is_on_cut: Vec<bool>,
    splits: Vec<(Corner, f32)>,
}

impl<'a> CutDraft<'a> {
    fn new(world: &'a World, blade: &Blade) -> Self {
        let x: Vec<Vec3> = world.particles.x.iter().collect();
        let is_on_cut = x
            .iter()
            .map(|x| blade.signed_side(*x) == 0.0 && blade.contains(x.as_dvec3()))
            .collect();
        let rest = world.mesh.source.iter().map(|site| world.rest[*site as usize]).collect();
        Self { world, mesh: Mesh::clone(&world.mesh), rest, x, is_on_cut, splits: Vec::new() }
    }

    /// Splits the edges that the blade crosses.
    fn split_crossed_edges(&mut self, blade: &Blade) {
        let mut crossed: Vec<(Corner, f32)> = Vec::new();
        for edge in self.mesh.edges() {
            let [a, b] = self.ends(edge).map(|end| self.x[end]);
            if let Some(share) = blade.segment_crossing(a, b) {
                crossed.push((edge, share as f32));
            }
        }
        for (edge, share) in &mut crossed {
            let [a, b] = self.ends(*edge);
            let (near, end) = if *share > 0.5 { (1.0 - *share, b) } else { (*share, a) };
            if near >= NEAR_VERTEX {
                continue;
            }
            if self.is_pinned(end) {
                *share = if end == a { NEAR_VERTEX } else { 1.0 - NEAR_VERTEX };
            } else {
                self.is_on_cut[end] = true;
            }
        }
        let continues = self.continuations(&crossed);
        let mut pending: Vec<(Corner, f32)> = crossed
            .into_iter()
            .zip(continues)
            .filter_map(|(crossed, continues)| continues.then_some(crossed))
            .collect();
        for at in 0..pending.len() {
            let (edge, share) = pending[at];
            let [a, b] = self.ends(edge);
            if self.is_on_cut[a] || self.is_on_cut[b] {
                continue;
            }
            if !self.can_split(edge, share) {
                let nearer_first = if share > 0.5 { [b, a] } else { [a, b] };
                let end = nearer_first.into_iter().find(|end| !self.is_pinned(*end));
                self.is_on_cut[end.unwrap_or(nearer_first[0])] = true;
                continue;
            }
            let division = self.mesh.split_edge(edge, NONE);
            self.splits.push((edge, share));
            self.rest.push(self.rest[a] + (self.rest[b] - self.rest[a]) * share);
            self.x.push(self.x[a] + (self.x[b] - self.x[a]) * share);
            self.is_on_cut.push(true);
            for side in division.sides() {
                for (other, _) in &mut pending[at + 1..] {
                    *other = if *other == side.moved_edge() { side.new_edge() } else { *other };
                }
            }
        }
    }

    /// Whether the cut continues from each crossed edge into a triangle: to another crossed edge or
    /// to a vertex. If the blade ends inside a triangle, the cut ends at the last edge before.
    fn continuations(&self, crossed: &[(Corner, f32)]) -> Vec<bool> {
        let is_between_ends =
            |edge: Corner| !self.ends(edge).iter().any(|end| self.is_on_cut[*end]);
        let mut hits = vec![0_u8; self.mesh.triangles.len()];
        let sides = |edge: Corner| [edge / 3, self.mesh.across(edge)];
        for (edge, _) in crossed.iter().filter(|(edge, _)| is_between_ends(*edge)) {
            for triangle in sides(*edge).into_iter().filter(|triangle| *triangle != NONE) {
                hits[triangle as usize] += 1;
            }
        }
        for (hits, triangle) in hits.iter_mut().zip(&self.mesh.triangles) {
            *hits += triangle.iter().filter(|v| self.is_on_cut[**v as usize]).count() as u8;
        }
        let continues = |edge: Corner| {
            sides(edge).iter().any(|triangle| *triangle != NONE && hits[*triangle as usize] > 1)
        };
        crossed.iter().map(|(edge, _)| continues(*edge)).collect()
    }

    /// Whether splitting an edge at `share` leaves no sliver triangle.
    fn can_split(&self, edge: Corner, share: f32) -> bool {
        let [a, b] = self.ends(edge);
        let middle = self.rest[a] + (self.rest[b] - self.rest[a]) * share;
        let neighbor = self.mesh.across(edge);
        let ends = self.mesh.ends(edge);
        let twin = (0..3)
            .filter(|_| neighbor != NONE)
            .map(|k| 3 * neighbor + k)
            .find(|other| self.mesh.ends(*other) == ends);
        [Some(edge), twin].into_iter().flatten().all(|edge| {
            let opposite = self.rest[self.mesh.vertex(prev_corner(edge)) as usize];
            [a, b].into_iter().all(|end| self.is_well_shaped([self.rest[end], middle, opposite]))
        })
    }

    fn is_well_shaped(&self, [a, b, c]: [Vec3; 3]) -> bool {
        let doubled = (b - a).cross(c - a).length();
        let mut sides = [(b - a).length(), (c - b).length(), (a - c).length()];
        sort_by(&mut sides, f32::total_cmp);
        // The smallest angle lies between the two longer sides.
        let spacing = self.world.mean_edge;
        doubled >= MIN_SINE * sides[1] * sides[2] && doubled >= 2.0 * MIN_AREA * spacing * spacing
    }

    /// Edges along the blade: both ends lie on the cut, and the two triangles lie on different
    /// sides.
    fn edges_along(&self, blade: &Blade) -> Vec<Corner> {
        let side = |triangle: u32| self.side(blade, triangle);
        let is_along = |edge: &Corner| {
            let neighbor = self.mesh.across(*edge);
            neighbor != NONE
                && self.ends(*edge).iter().all(|end| self.is_on_cut[*end])
                && side(edge / 3) != side(neighbor)
        };
        self.mesh.edges().filter(is_along).collect()
    }

    /// Whether a triangle lies on the positive side of the blade: by its corners that are not on
    /// the cut if these agree, else by its centroid.
    fn side(&self, blade: &Blade, triangle: u32) -> bool {
        let corners = self.mesh.triangles[triangle as usize].map(|v| v as usize);
        let off_cut = || corners.into_iter().filter(|v| !self.is_on_cut[*v]);
        let on_positive = |v: usize| blade.signed_side(self.x[v]) > 0.0;
        let positive = off_cut().filter(|v| on_positive(*v)).count();
        match (positive, off_cut().count()) {
            (0, all) if all > 0 => false,
            (some, all) if some == all && all > 0 => true,
            _ => {
                let [a, b, c] = corners.map(|v| self.x[v]);
                blade.signed_side((a + b + c) * (1.0 / 3.0)) > 0.0
            }
        }
    }

    fn ends(&self, edge: Corner) -> [usize; 2] {
        [edge, next_corner(edge)].map(|corner| self.mesh.vertex(corner) as usize)
    }

    fn is_pinned(&self, vertex: usize) -> bool {
        self.world.pins.get(vertex as u32).is_some()
    }
}
