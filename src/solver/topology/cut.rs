//! Cuts by a blade: the edges that it crosses are divided, and what then lies along it opens.
//!
//! The cut is made on a copy of the mesh first, so that it is known to fit before anything changes. A
//! crossing near a vertex goes through that vertex instead, so that no sliver is left: the cut bends
//! aside by at most `NEAR` of an edge there. A vertex that is pinned is passed by at that distance,
//! so that a cut beside pins does not end at them.

use crate::geometry::blade::Blade;
use crate::geometry::triangle::corner_areas;
use crate::math::sort::sort_by;
use crate::mesh::split_edge::CutSite;
use crate::mesh::{Corner, Fan, Mesh, NONE, next_corner, prev_corner};
use crate::model::cut_links::{LinksOfTriangle, RestShape};
use crate::solver::topology::tear::{push_edge_torn_event, push_split_vertex, update_pieces};
use crate::solver::world::World;
use crate::state::anchors::AnchorConstraint;
use crate::state::events::{Event, EventKind};
use glam::Vec3;

/// A crossing nearer to an end of its edge than this share of it goes through the end.
const NEAR: f32 = 0.125;

/// The sine of the sharpest angle of a triangle that a division may leave: of 5°.
const LEAST_SINE: f32 = 0.087_155_74;

/// Its least area, over that of a square as wide as the mean edge.
const LEAST_AREA: f32 = 0.005;

/// A cut that is known to fit.
#[derive(Clone, Debug, Default)]
pub(crate) struct Plan {
    /// Which edges to divide, one after the other, and at which share of them.
    divisions: Vec<(Corner, f32)>,
    /// Which edges to open then.
    open: Vec<Corner>,
    vertices: usize,
    triangles: usize,
    opened: usize,
}

impl Plan {
    /// How many edges open.
    pub fn opened(&self) -> u32 {
        self.opened as u32
    }

    /// Whether a cloth with room for so many vertices and triangles can take it.
    pub fn fits(&self, vertices: usize, triangles: usize) -> bool {
        self.vertices <= vertices && self.triangles <= triangles
    }
}

/// Plans a cut by `blade`.
pub(crate) fn plan(world: &World, blade: &Blade) -> Plan {
    let mut draft = Draft::new(world, blade);
    draft.divide(blade);
    draft.mesh.rebuild_vertex_corners();
    let mut plan = Plan { open: draft.along(blade), ..Plan::default() };
    plan.divisions = draft.divisions;
    let (mut opened, mut copies) = (Vec::new(), Vec::new());
    draft.mesh.open_edges(&plan.open, &mut opened, &mut copies);
    plan.vertices = draft.mesh.vertex_count();
    plan.triangles = draft.mesh.triangles.len();
    plan.opened = opened.len();
    plan
}

/// Does what was planned for this world as it is.
pub(crate) fn cut(world: &mut World, plan: &Plan) {
    let mut touching = world.constraints.links_of_triangles(world.mesh.triangles.len());
    let links = plan.opened + 12 * plan.divisions.len();
    world.constraints.reserve(links, world.capacity());
    for (edge, share) in &plan.divisions {
        divide(world, *edge, *share, &mut touching);
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
        world.constraints.open_edge(&world.mesh, sides, &world.material);
    }
    (0..world.rest.len() as u32).for_each(|site| world.refresh_constraints_at(site));
    world.compute_masses();
    world.reserve_for_tears();
    world.rebuild_crack_tips();
    update_pieces(world);
    world.rebuild_tethers();
}

/// Divides one edge and all that lies on it.
fn divide(world: &mut World, edge: Corner, share: f32, touching: &mut LinksOfTriangle) {
    let [a, b] = [world.mesh.vertex(edge), world.mesh.vertex(next_corner(edge))];
    let ends = [a, b].map(|end| world.mesh.source[end as usize]);
    let site = world.rest.len() as u32;
    let crossing = CutSite { ends, fraction: share };
    world.rest.push(crossing.interpolate(|end| world.rest[end as usize]));
    world.crossings.push(crossing);
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
    let leashes = [a, b].map(|end| world.anchors.get(end).copied());
    if let [Some(a), Some(b)] = leashes {
        world.anchors.insert(AnchorConstraint::between(new as u32, &a, &b, share));
    }
    let recipe = RestShape { mesh: &world.mesh, rest: &world.rest, material: &world.material };
    world.constraints.split_edge(recipe, &division, touching);
    let mut event = Event::new(EventKind::EdgeDivided, world.tick, world.particles.x.at(new));
    (event.particle_a, event.particle_b, event.vertex) = (a, b, vertex);
    world.events.push(event);
}

/// A cut in the making.
struct Draft<'a> {
    world: &'a World,
    mesh: Mesh,
    /// Rest position of each vertex [m].
    rest: Vec<Vec3>,
    x: Vec<Vec3>,
    /// Whether the cut goes through a vertex.
    is_on: Vec<bool>,
    divisions: Vec<(Corner, f32)>,
}

impl<'a> Draft<'a> {
    fn new(world: &'a World, blade: &Blade) -> Self {
        let x: Vec<Vec3> = world.particles.x.iter().collect();
        let is_on = x
            .iter()
            .map(|x| blade.signed_side(*x) == 0.0 && blade.contains(x.as_dvec3()))
            .collect();
        let rest = world.mesh.source.iter().map(|site| world.rest[*site as usize]).collect();
        Self { world, mesh: world.mesh.clone(), rest, x, is_on, divisions: Vec::new() }
    }

    /// Divides the edges that the blade crosses.
    fn divide(&mut self, blade: &Blade) {
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
            if near >= NEAR {
                continue;
            }
            if self.is_pinned(end) {
                *share = if end == a { NEAR } else { 1.0 - NEAR };
            } else {
                self.is_on[end] = true;
            }
        }
        let leads_on = self.leads_on(&crossed);
        let mut pending: Vec<(Corner, f32)> = crossed
            .into_iter()
            .zip(leads_on)
            .filter_map(|(crossed, leads_on)| leads_on.then_some(crossed))
            .collect();
        for at in 0..pending.len() {
            let (edge, share) = pending[at];
            let [a, b] = self.ends(edge);
            if self.is_on[a] || self.is_on[b] {
                continue;
            }
            if !self.may_divide(edge, share) {
                let nearer_first = if share > 0.5 { [b, a] } else { [a, b] };
                let end = nearer_first.into_iter().find(|end| !self.is_pinned(*end));
                self.is_on[end.unwrap_or(nearer_first[0])] = true;
                continue;
            }
            let division = self.mesh.split_edge(edge, NONE);
            self.divisions.push((edge, share));
            self.rest.push(self.rest[a] + (self.rest[b] - self.rest[a]) * share);
            self.x.push(self.x[a] + (self.x[b] - self.x[a]) * share);
            self.is_on.push(true);
            for side in division.sides() {
                for (other, _) in &mut pending[at + 1..] {
                    *other = if *other == side.moved_edge() { side.new_edge() } else { *other };
                }
            }
        }
    }

    /// For each crossed edge, whether the cut goes on from it into a triangle: to another crossed edge, or
    /// to a vertex. Where the blade ends inside a triangle, the cut ends at the last edge before.
    fn leads_on(&self, crossed: &[(Corner, f32)]) -> Vec<bool> {
        let is_passed = |edge: Corner| !self.ends(edge).iter().any(|end| self.is_on[*end]);
        let mut met = vec![0_u8; self.mesh.triangles.len()];
        let sides = |edge: Corner| [edge / 3, self.mesh.across(edge)];
        for (edge, _) in crossed.iter().filter(|(edge, _)| is_passed(*edge)) {
            for triangle in sides(*edge).into_iter().filter(|triangle| *triangle != NONE) {
                met[triangle as usize] += 1;
            }
        }
        for (met, triangle) in met.iter_mut().zip(&self.mesh.triangles) {
            *met += triangle.iter().filter(|v| self.is_on[**v as usize]).count() as u8;
        }
        let leads_on = |edge: Corner| {
            sides(edge).iter().any(|triangle| *triangle != NONE && met[*triangle as usize] > 1)
        };
        crossed.iter().map(|(edge, _)| leads_on(*edge)).collect()
    }

    /// Whether dividing an edge there leaves no sliver.
    fn may_divide(&self, edge: Corner, share: f32) -> bool {
        let [a, b] = self.ends(edge);
        let middle = self.rest[a] + (self.rest[b] - self.rest[a]) * share;
        let beyond = self.mesh.across(edge);
        let ends = self.mesh.ends(edge);
        let twin = (0..3)
            .filter(|_| beyond != NONE)
            .map(|k| 3 * beyond + k)
            .find(|other| self.mesh.ends(*other) == ends);
        [Some(edge), twin].into_iter().flatten().all(|edge| {
            let opposite = self.rest[self.mesh.vertex(prev_corner(edge)) as usize];
            [a, b].into_iter().all(|end| self.is_no_sliver([self.rest[end], middle, opposite]))
        })
    }

    fn is_no_sliver(&self, [a, b, c]: [Vec3; 3]) -> bool {
        let doubled = (b - a).cross(c - a).length();
        let mut sides = [(b - a).length(), (c - b).length(), (a - c).length()];
        sort_by(&mut sides, f32::total_cmp);
        // The sharpest angle is between the two longer sides.
        let spacing = self.world.mean_edge;
        doubled >= LEAST_SINE * sides[1] * sides[2]
            && doubled >= 2.0 * LEAST_AREA * spacing * spacing
    }

    /// The edges along the blade: between vertices that the cut goes through, with a triangle on either
    /// side of it.
    fn along(&self, blade: &Blade) -> Vec<Corner> {
        let side = |triangle: u32| self.side(blade, triangle);
        let is_along = |edge: &Corner| {
            let beyond = self.mesh.across(*edge);
            beyond != NONE
                && self.ends(*edge).iter().all(|end| self.is_on[*end])
                && side(edge / 3) != side(beyond)
        };
        self.mesh.edges().filter(is_along).collect()
    }

    /// On which side of the blade a triangle is, by the corners that the cut does not go through if they
    /// agree, or else by its middle.
    fn side(&self, blade: &Blade, triangle: u32) -> bool {
        let corners = self.mesh.triangles[triangle as usize].map(|v| v as usize);
        let off = || corners.into_iter().filter(|v| !self.is_on[*v]);
        let on_positive = |v: usize| blade.signed_side(self.x[v]) > 0.0;
        let positive = off().filter(|v| on_positive(*v)).count();
        match (positive, off().count()) {
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
