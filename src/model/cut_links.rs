//! Update of links when a cut splits an edge.
//!
//! ```text
//!       o                     o        link along near–far  ─▶ two links
//!      ╱ ╲                   ╱│╲       new edge v–o         ─▶ stretch or shear link, and a
//! near ─── far   ─▶   near ──v── far                           bend link across it
//!      ╲ ╱                   ╲│╱       links across moved edges ─▶ end at v instead
//!       o′                    o′       links over two edges ─▶ removed with either edge
//! ```
//! New links are dynamic links, so that the colours of the original ones do not change.
//!
//! Reads `EdgeSplit`, mesh and rest positions; writes `Constraints` and the list of links per
//! triangle.
//!
//! Invariant: every edge has a link again after `split_edge`.

use crate::math::sort::sort;
use crate::mesh::split_edge::{EdgeSplit, SplitTriangle};
use crate::mesh::{Corner, Mesh, NONE, next_corner, prev_corner};
use crate::model::constraints::{Constraints, bend_link_stiffness, edge_of};
use crate::model::dynamic_links::DYNAMIC;
use crate::model::links::{LinkKind, LinkSpec, LinkSupport, ThreadDirection};
use crate::model::maps::Maps;
use crate::model::material::Material;
use glam::Vec3;

/// Numbers of the links that depend on each triangle; may contain links that no longer do.
pub(crate) type LinksOfTriangle = Vec<Vec<u32>>;

/// Minimum cosine between an edge and a thread direction for a stretch link: 22.5°.
const MIN_ALIGNMENT: f32 = 0.923_879_5;

/// The cloth at rest, its material and maps.
#[derive(Clone, Copy)]
pub(crate) struct RestShape<'a> {
    pub mesh: &'a Mesh,
    /// Rest position of each site [m].
    pub rest: &'a [Vec3],
    pub material: &'a Material,
    pub maps: &'a Maps,
}

impl RestShape<'_> {
    fn position(&self, corner: Corner) -> Vec3 {
        self.rest[self.mesh.source[self.mesh.vertex(corner) as usize] as usize]
    }

    fn distance(&self, a: Corner, b: Corner) -> f32 {
        (self.position(b) - self.position(a)).length()
    }

    fn area(&self, triangle: u32) -> f32 {
        let [a, b, c] = [0, 1, 2].map(|k| self.position(3 * triangle + k));
        0.5 * (b - a).cross(c - a).length()
    }
}

impl Constraints {
    /// Lists the links that depend on each triangle.
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

    /// Updates all links after `Mesh::split_edge`.
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
                    self.replace_across_link(rest_shape, split, number, links_of);
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

    /// The link along the edge that was split.
    fn link_along(&self, split: &EdgeSplit) -> Option<u32> {
        let mut found = split.sides().map(|side| self.link_of_edge[side.edge as usize]);
        found.find(|number| *number != NONE)
    }

    /// Moves the link along the moved edge to the added triangle.
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

    /// Removes a link over two consecutive edges if one of them was split; otherwise updates its
    /// corners.
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

    /// Replaces a link across an edge that lost an end: it ends at the new vertex instead. If the
    /// edge itself was split, the link is only removed, and `add_bend_links` adds links across its
    /// parts.
    fn replace_across_link(
        &mut self,
        rest_shape: RestShape<'_>,
        split: &EdgeSplit,
        number: u32,
        links_of: &mut LinksOfTriangle,
    ) {
        let (links, at) = self.link(number);
        let (mut spec, was_active) = (links.spec[at], links.active[at]);
        let LinkSupport::AcrossEdge(mut edge) = spec.support else { return };
        let mut is_affected = false;
        for side in split.sides() {
            for end in &mut spec.ends {
                if *end / 3 != side.kept() {
                    continue;
                }
                is_affected = true;
                if *end == prev_corner(side.edge) {
                    return self.remove_link(number);
                }
                // The near end lay opposite the moved edge, the far end opposite the edge that
                // stays.
                *end = if *end == side.edge { 3 * side.added } else { next_corner(side.edge) };
            }
            edge = if edge == side.moved_edge() { side.new_edge() } else { edge };
        }
        if !is_affected {
            return;
        }
        self.remove_link(number);
        let rest = rest_shape.distance(spec.ends[0], spec.ends[1]);
        if !was_active || rest <= 0.0 {
            return;
        }
        spec.support = LinkSupport::AcrossEdge(edge);
        if spec.kind == LinkKind::Bend {
            spec.stiffness_scale =
                bend_link_stiffness(rest_shape.distance(edge, next_corner(edge)), rest);
        }
        self.add_link(rest_shape, spec, rest, links_of);
    }

    /// Replaces the link along the split edge by two, with the same stiffness per length.
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
            let half = LinkSpec { ends, stiffness_scale, support: LinkSupport::Edge, ..spec };
            self.add_link(rest_shape, half, rest * share, links_of);
        }
    }

    /// Adds a link along the new edge from the new vertex to the opposite one.
    fn add_inner_edge_link(
        &mut self,
        rest_shape: RestShape<'_>,
        side: SplitTriangle,
        links_of: &mut LinksOfTriangle,
    ) {
        let edge = next_corner(side.edge);
        let vector = rest_shape.position(next_corner(edge)) - rest_shape.position(edge);
        let length = vector.length();
        let both_areas = rest_shape.area(side.kept()) + rest_shape.area(side.added);
        let (kind, thread) = self.kind_in_direction(vector * (1.0 / length));
        let spec = LinkSpec {
            kind,
            direction: thread,
            ends: [edge, next_corner(edge)],
            support: LinkSupport::Edge,
            stiffness_scale: both_areas / (length * length),
        };
        self.add_link(rest_shape, spec, length, links_of);
    }

    /// Adds bend links across the new edges: within the divided triangles, and across both parts of
    /// the split edge.
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
        let stiffness_scale =
            bend_link_stiffness(rest_shape.distance(edge, next_corner(edge)), rest);
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

    /// Kind and thread direction of a link along `direction`: on a grid, links oblique to the
    /// threads resist shear only.
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
        let number =
            self.push_dynamic(rest_shape.mesh, spec, rest, (rest_shape.material, rest_shape.maps));
        register(links_of, number, &spec);
    }

    /// Marks a link as removed. It stays in its list, so that the numbers of the others do not
    /// change.
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

/// Adds a link to the lists of all triangles that it depends on.
fn register(links_of: &mut LinksOfTriangle, number: u32, spec: &LinkSpec) {
    for corner in spec.dependent_corners() {
        let list = &mut links_of[corner as usize / 3];
        if list.last() != Some(&number) {
            list.push(number);
        }
    }
}

/// Present place of a corner at an end of the moved edge.
fn moved_corner(side: SplitTriangle, corner: Corner) -> Corner {
    if corner == next_corner(side.edge) { 3 * side.added + 1 } else { 3 * side.added + 2 }
}
