//! Links where a cut divides triangles: those on what was divided go, others take their place.
//!
//! Of the links around a divided edge, the one along it becomes two in a row. The new edges across its
//! triangles get links as any mesh has them, and every new fold a bend link across it. Links across an
//! edge that is only moved to a new triangle are knotted anew at the new vertex, and links of two edges
//! in a row are gone with either of them. New links are extra ones, so that no colour changes.

use crate::math::sort::sort;
use crate::mesh::split_edge::{EdgeSplit, SplitTriangle};
use crate::mesh::{Corner, Mesh, NONE, next_corner, prev_corner};
use crate::model::constraints::{Constraints, bend_shape, edge_of};
use crate::model::dynamic_links::DYNAMIC;
use crate::model::links::{LinkKind, LinkSpec, LinkSupport, ThreadDirection};
use crate::model::material::Material;
use glam::Vec3;

/// Which links touch each triangle; some may have left it since.
pub(crate) type LinksOfTriangle = Vec<Vec<u32>>;

/// How far a thread's direction may be from an edge along it: the cosine of a sixteenth of a circle.
const MIN_ALIGNMENT: f32 = 0.923_879_5;

/// The cloth at rest, and what it is made of.
#[derive(Clone, Copy)]
pub(crate) struct RestShape<'a> {
    pub mesh: &'a Mesh,
    /// Rest position of each site [m].
    pub rest: &'a [Vec3],
    pub material: &'a Material,
}

impl RestShape<'_> {
    fn at(&self, corner: Corner) -> Vec3 {
        self.rest[self.mesh.source[self.mesh.vertex(corner) as usize] as usize]
    }

    fn distance(&self, a: Corner, b: Corner) -> f32 {
        (self.at(b) - self.at(a)).length()
    }

    fn area(&self, triangle: u32) -> f32 {
        let [a, b, c] = [0, 1, 2].map(|k| self.at(3 * triangle + k));
        0.5 * (b - a).cross(c - a).length()
    }
}

impl Constraints {
    /// Which links touch which triangles.
    pub fn links_of_triangles(&self, triangles: usize) -> LinksOfTriangle {
        let mut links_of = vec![Vec::new(); triangles];
        let created = (0..self.links.len() as u32).map(|link| (link, &self.links.spec));
        let dynamic =
            (0..self.dynamic.len() as u32).map(|link| (DYNAMIC | link, &self.dynamic.spec));
        for (number, specs) in created.chain(dynamic) {
            register(&mut links_of, number, &specs[(number & !DYNAMIC) as usize]);
        }
        links_of
    }

    /// Brings the links in line with a division of the mesh, which is done already.
    pub fn split_edge(
        &mut self,
        rest_shape: RestShape<'_>,
        split: &EdgeSplit,
        links_of: &mut LinksOfTriangle,
    ) {
        self.link_of_edge.resize(3 * rest_shape.mesh.triangles.len(), NONE);
        links_of.resize(rest_shape.mesh.triangles.len(), Vec::new());
        let link_along = self.link_along(split);
        let mut affected: Vec<u32> =
            split.sides().flat_map(|side| links_of[side.kept() as usize].iter().copied()).collect();
        sort(&mut affected);
        affected.dedup();
        for number in affected {
            let (links, at) = self.link(number);
            match links.spec[at].support {
                LinkSupport::Edge => self.update_edge_link(split, number, links_of),
                LinkSupport::AcrossEdge(_) => {
                    self.replace_across_link(rest_shape, split, number, links_of)
                }
                LinkSupport::TwoEdges(_) => self.update_two_edge_link(split, number, links_of),
                LinkSupport::Removed => {}
            }
        }
        if let Some(link_along) = link_along {
            self.split_link(rest_shape, split, link_along, links_of);
        }
        for side in split.sides() {
            self.add_inner_edge_link(rest_shape, side, links_of);
        }
        self.add_bend_links(rest_shape, split, links_of);
    }

    /// The link along the edge that is divided.
    fn link_along(&self, split: &EdgeSplit) -> Option<u32> {
        let mut found = split.sides().map(|side| self.link_of_edge[side.edge as usize]);
        found.find(|number| *number != NONE)
    }

    /// A link along the edge that moved moves with it.
    fn update_edge_link(&mut self, split: &EdgeSplit, number: u32, links_of: &mut LinksOfTriangle) {
        let (links, at) = self.link(number);
        let edge = edge_of(links.spec[at].ends);
        let Some(side) = split.sides().find(|side| side.moved_edge() == edge) else { return };
        let (links, at) = self.link_mut(number);
        let spec = &mut links.spec[at];
        spec.ends = spec.ends.map(|corner| moved_corner(side, corner));
        links_of[side.added as usize].push(number);
        self.link_of_edge[side.moved_edge() as usize] = NONE;
        self.link_of_edge[side.new_edge() as usize] = number;
    }

    /// A link over two edges in a row lasts if neither was divided.
    fn update_two_edge_link(
        &mut self,
        split: &EdgeSplit,
        number: u32,
        links_of: &mut LinksOfTriangle,
    ) {
        let (links, at) = self.link(number);
        let spec = links.spec[at];
        let LinkSupport::TwoEdges(middles) = spec.support else { return };
        let (mut ends, mut middles) = (spec.ends, middles);
        for (end, middle) in ends.iter_mut().zip(&mut middles) {
            let edge = edge_of([*end, *middle]);
            if split.sides().any(|side| side.edge == edge) {
                return self.remove_link(number);
            }
            if let Some(side) = split.sides().find(|side| side.moved_edge() == edge) {
                (*end, *middle) = (moved_corner(side, *end), moved_corner(side, *middle));
                links_of[side.added as usize].push(number);
            }
        }
        let (links, at) = self.link_mut(number);
        links.spec[at] = LinkSpec { ends, support: LinkSupport::TwoEdges(middles), ..spec };
    }

    /// A link across an edge has lost an end: the new vertex is across that edge now. If the edge itself
    /// was divided, the folds across its parts get their own.
    fn replace_across_link(
        &mut self,
        rest_shape: RestShape<'_>,
        split: &EdgeSplit,
        number: u32,
        links_of: &mut LinksOfTriangle,
    ) {
        let (links, at) = self.link(number);
        let (mut spec, held) = (links.spec[at], links.active[at]);
        let LinkSupport::AcrossEdge(mut edge) = spec.support else { return };
        let mut is_met = false;
        for side in split.sides() {
            for end in &mut spec.ends {
                if *end / 3 != side.kept() {
                    continue;
                }
                is_met = true;
                if *end == prev_corner(side.edge) {
                    return self.remove_link(number);
                }
                // The near end was across from the edge that moved, the far end from the one that stays.
                *end = if *end == side.edge { 3 * side.added } else { next_corner(side.edge) };
            }
            edge = if edge == side.moved_edge() { side.new_edge() } else { edge };
        }
        if !is_met {
            return;
        }
        self.remove_link(number);
        let rest = rest_shape.distance(spec.ends[0], spec.ends[1]);
        if !held || rest <= 0.0 {
            return;
        }
        spec.support = LinkSupport::AcrossEdge(edge);
        if spec.kind == LinkKind::Bend {
            spec.stiffness_scale = bend_shape(rest_shape.distance(edge, next_corner(edge)), rest);
        }
        self.add_link(rest_shape, spec, rest, links_of);
    }

    /// The link along the divided edge becomes two.
    fn split_link(
        &mut self,
        rest_shape: RestShape<'_>,
        split: &EdgeSplit,
        link_along: u32,
        links_of: &mut LinksOfTriangle,
    ) {
        let (links, at) = self.link(link_along);
        let (spec, rest) = (links.spec[at], links.rest[at]);
        self.remove_link(link_along);
        let Some(side) = split.sides().next() else { return };
        let near = rest_shape.distance(side.edge, next_corner(side.edge));
        let far = rest_shape.distance(3 * side.added, 3 * side.added + 1);
        for (edge, length) in [(side.edge, near), (3 * side.added, far)] {
            let share = length / (near + far);
            let (ends, stiffness_scale) = ([edge, next_corner(edge)], spec.stiffness_scale / share);
            let split_link = LinkSpec { ends, stiffness_scale, support: LinkSupport::Edge, ..spec };
            self.add_link(rest_shape, split_link, rest * share, links_of);
        }
    }

    /// The edge from the new vertex to the opposite one gets a link.
    fn add_inner_edge_link(
        &mut self,
        rest_shape: RestShape<'_>,
        side: SplitTriangle,
        links_of: &mut LinksOfTriangle,
    ) {
        let edge = next_corner(side.edge);
        let way = rest_shape.at(next_corner(edge)) - rest_shape.at(edge);
        let length = way.length();
        let both = rest_shape.area(side.kept()) + rest_shape.area(side.added);
        let (kind, thread) = self.kind_in_direction(way * (1.0 / length));
        let spec = LinkSpec {
            kind,
            direction: thread,
            ends: [edge, next_corner(edge)],
            support: LinkSupport::Edge,
            stiffness_scale: both / (length * length),
        };
        self.add_link(rest_shape, spec, length, links_of);
    }

    /// Bend links across the new edges: within the divided triangles, and over the divided edge.
    fn add_bend_links(
        &mut self,
        rest_shape: RestShape<'_>,
        split: &EdgeSplit,
        links_of: &mut LinksOfTriangle,
    ) {
        for side in split.sides() {
            let across = [side.edge, 3 * side.added + 1];
            self.add_bend_link(rest_shape, next_corner(side.edge), across, links_of);
        }
        let [Some(one), Some(_)] = split.sides else { return };
        for edge in [one.edge, 3 * one.added] {
            let beyond = rest_shape.mesh.across(edge);
            let ends = rest_shape.mesh.ends(edge);
            let twin =
                (3 * beyond..3 * beyond + 3).find(|other| rest_shape.mesh.ends(*other) == ends);
            if let Some(twin) = twin {
                self.add_bend_link(
                    rest_shape,
                    edge,
                    [prev_corner(edge), prev_corner(twin)],
                    links_of,
                );
            }
        }
    }

    fn add_bend_link(
        &mut self,
        rest_shape: RestShape<'_>,
        edge: Corner,
        ends: [Corner; 2],
        links_of: &mut LinksOfTriangle,
    ) {
        let rest = rest_shape.distance(ends[0], ends[1]);
        if rest <= 0.0 {
            return;
        }
        let stiffness_scale = bend_shape(rest_shape.distance(edge, next_corner(edge)), rest);
        let (kind, thread) = (LinkKind::Bend, ThreadDirection::Warp);
        let spec = LinkSpec {
            kind,
            direction: thread,
            ends,
            support: LinkSupport::AcrossEdge(edge),
            stiffness_scale,
        };
        self.add_link(rest_shape, spec, rest, links_of);
    }

    /// What a link along a direction resists: on a grid, one across the threads only shear.
    fn kind_in_direction(&self, direction: Vec3) -> (LinkKind, ThreadDirection) {
        let Some([weft, warp]) = self.thread_directions else {
            return (LinkKind::Stretch, ThreadDirection::Warp);
        };
        if direction.dot(weft).abs() > MIN_ALIGNMENT {
            (LinkKind::Stretch, ThreadDirection::Weft)
        } else if direction.dot(warp).abs() > MIN_ALIGNMENT {
            (LinkKind::Stretch, ThreadDirection::Warp)
        } else {
            (LinkKind::Shear, ThreadDirection::Warp)
        }
    }

    fn add_link(
        &mut self,
        rest_shape: RestShape<'_>,
        spec: LinkSpec,
        rest: f32,
        links_of: &mut LinksOfTriangle,
    ) {
        let number = self.push_dynamic(rest_shape.mesh, spec, rest, rest_shape.material);
        register(links_of, number, &spec);
    }

    fn remove_link(&mut self, number: u32) {
        let (links, at) = self.link_mut(number);
        let spec = links.spec[at];
        links.spec[at].support = LinkSupport::Removed;
        links.active[at] = false;
        self.hinges.revision = self.hinges.revision.wrapping_add(1);
        let slot = edge_of(spec.ends) as usize;
        if spec.support == LinkSupport::Edge && self.link_of_edge[slot] == number {
            self.link_of_edge[slot] = NONE;
        }
    }
}

fn register(links_of: &mut LinksOfTriangle, number: u32, spec: &LinkSpec) {
    for corner in spec.dependent_corners() {
        let list = &mut links_of[corner as usize / 3];
        if list.last() != Some(&number) {
            list.push(number);
        }
    }
}

/// Where a corner at an end of the moved edge is now.
fn moved_corner(side: SplitTriangle, corner: Corner) -> Corner {
    if corner == next_corner(side.edge) { 3 * side.added + 1 } else { 3 * side.added + 2 }
}
