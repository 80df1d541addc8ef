//! Links where a cut divides triangles: those on what was divided go, others take their place.
//!
//! Of the links around a divided edge, the one along it becomes two in a row. The new edges across its
//! triangles get links as any mesh has them, and every new fold a bend link across it. Links across an
//! edge that is only moved to a new triangle are knotted anew at the new vertex, and links of two edges
//! in a row are gone with either of them. New links are extra ones, so that no colour changes.

use crate::math::sort::sort;
use crate::mesh::split_edge::{Division, Side};
use crate::mesh::{Corner, Mesh, NONE, after, before};
use crate::model::constraints::{Constraints, bend_shape, edge_of};
use crate::model::dynamic_links::EXTRA;
use crate::model::links::{LinkKind, Spec, Support, Thread};
use crate::model::material::Material;
use glam::Vec3;

/// Which links touch each triangle; some may have left it since.
pub(crate) type Touching = Vec<Vec<u32>>;

/// How far a thread's direction may be from an edge along it: the cosine of a sixteenth of a circle.
const ALONG: f32 = 0.923_879_5;

/// The cloth at rest, and what it is made of.
#[derive(Clone, Copy)]
pub(crate) struct Recipe<'a> {
    pub mesh: &'a Mesh,
    /// Rest position of each site [m].
    pub rest: &'a [Vec3],
    pub material: &'a Material,
}

impl Recipe<'_> {
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
    pub fn touching(&self, triangles: usize) -> Touching {
        let mut touching = vec![Vec::new(); triangles];
        let woven = (0..self.links.len() as u32).map(|link| (link, &self.links.spec));
        let extra = (0..self.extra.len() as u32).map(|link| (EXTRA | link, &self.extra.spec));
        for (number, specs) in woven.chain(extra) {
            touch(&mut touching, number, &specs[(number & !EXTRA) as usize]);
        }
        touching
    }

    /// Brings the links in line with a division of the mesh, which is done already.
    pub fn divide(&mut self, recipe: Recipe<'_>, division: &Division, touching: &mut Touching) {
        self.link_of_edge.resize(3 * recipe.mesh.triangles.len(), NONE);
        touching.resize(recipe.mesh.triangles.len(), Vec::new());
        let along = self.along(division);
        let mut met: Vec<u32> = division
            .sides()
            .flat_map(|side| touching[side.kept() as usize].iter().copied())
            .collect();
        sort(&mut met);
        met.dedup();
        for number in met {
            let (links, at) = self.link(number);
            match links.spec[at].support {
                Support::Edge => self.keep_edge(division, number, touching),
                Support::Flap(_) => self.knot_flap(recipe, division, number, touching),
                Support::Pair(_) => self.keep_pair(division, number, touching),
                Support::Gone => {}
            }
        }
        if let Some(along) = along {
            self.part(recipe, division, along, touching);
        }
        for side in division.sides() {
            self.cross(recipe, side, touching);
        }
        self.fold(recipe, division, touching);
    }

    /// The link along the edge that is divided.
    fn along(&self, division: &Division) -> Option<u32> {
        let mut found = division.sides().map(|side| self.link_of_edge[side.edge as usize]);
        found.find(|number| *number != NONE)
    }

    /// A link along the edge that moved moves with it.
    fn keep_edge(&mut self, division: &Division, number: u32, touching: &mut Touching) {
        let (links, at) = self.link(number);
        let edge = edge_of(links.spec[at].anchors);
        let Some(side) = division.sides().find(|side| side.moved_edge() == edge) else { return };
        let (links, at) = self.link_mut(number);
        let spec = &mut links.spec[at];
        spec.anchors = spec.anchors.map(|corner| moved(side, corner));
        touching[side.added as usize].push(number);
        self.link_of_edge[side.moved_edge() as usize] = NONE;
        self.link_of_edge[side.new_edge() as usize] = number;
    }

    /// A link over two edges in a row lasts if neither was divided.
    fn keep_pair(&mut self, division: &Division, number: u32, touching: &mut Touching) {
        let (links, at) = self.link(number);
        let spec = links.spec[at];
        let Support::Pair(middles) = spec.support else { return };
        let (mut anchors, mut middles) = (spec.anchors, middles);
        for (anchor, middle) in anchors.iter_mut().zip(&mut middles) {
            let edge = edge_of([*anchor, *middle]);
            if division.sides().any(|side| side.edge == edge) {
                return self.retire(number);
            }
            if let Some(side) = division.sides().find(|side| side.moved_edge() == edge) {
                (*anchor, *middle) = (moved(side, *anchor), moved(side, *middle));
                touching[side.added as usize].push(number);
            }
        }
        let (links, at) = self.link_mut(number);
        links.spec[at] = Spec { anchors, support: Support::Pair(middles), ..spec };
    }

    /// A link across an edge has lost an end: the new vertex is across that edge now. If the edge itself
    /// was divided, the folds across its parts get their own.
    fn knot_flap(
        &mut self,
        recipe: Recipe<'_>,
        division: &Division,
        number: u32,
        touching: &mut Touching,
    ) {
        let (links, at) = self.link(number);
        let (mut spec, held) = (links.spec[at], links.active[at]);
        let Support::Flap(mut edge) = spec.support else { return };
        let mut is_met = false;
        for side in division.sides() {
            for anchor in &mut spec.anchors {
                if *anchor / 3 != side.kept() {
                    continue;
                }
                is_met = true;
                if *anchor == before(side.edge) {
                    return self.retire(number);
                }
                // The near end was across from the edge that moved, the far end from the one that stays.
                *anchor = if *anchor == side.edge { 3 * side.added } else { after(side.edge) };
            }
            edge = if edge == side.moved_edge() { side.new_edge() } else { edge };
        }
        if !is_met {
            return;
        }
        self.retire(number);
        let rest = recipe.distance(spec.anchors[0], spec.anchors[1]);
        if !held || rest <= 0.0 {
            return;
        }
        spec.support = Support::Flap(edge);
        if spec.kind == LinkKind::Bend {
            spec.shape = bend_shape(recipe.distance(edge, after(edge)), rest);
        }
        self.put(recipe, spec, rest, touching);
    }

    /// The link along the divided edge becomes two.
    fn part(
        &mut self,
        recipe: Recipe<'_>,
        division: &Division,
        along: u32,
        touching: &mut Touching,
    ) {
        let (links, at) = self.link(along);
        let (spec, rest) = (links.spec[at], links.rest[at]);
        self.retire(along);
        let Some(side) = division.sides().next() else { return };
        let near = recipe.distance(side.edge, after(side.edge));
        let far = recipe.distance(3 * side.added, 3 * side.added + 1);
        for (edge, length) in [(side.edge, near), (3 * side.added, far)] {
            let share = length / (near + far);
            let (anchors, shape) = ([edge, after(edge)], spec.shape / share);
            let part = Spec { anchors, shape, support: Support::Edge, ..spec };
            self.put(recipe, part, rest * share, touching);
        }
    }

    /// The edge from the new vertex to the opposite one gets a link.
    fn cross(&mut self, recipe: Recipe<'_>, side: Side, touching: &mut Touching) {
        let edge = after(side.edge);
        let way = recipe.at(after(edge)) - recipe.at(edge);
        let length = way.length();
        let both = recipe.area(side.kept()) + recipe.area(side.added);
        let (kind, thread) = self.kind_along(way * (1.0 / length));
        let spec = Spec {
            kind,
            thread,
            anchors: [edge, after(edge)],
            support: Support::Edge,
            shape: both / (length * length),
        };
        self.put(recipe, spec, length, touching);
    }

    /// Bend links across the new edges: within the divided triangles, and over the divided edge.
    fn fold(&mut self, recipe: Recipe<'_>, division: &Division, touching: &mut Touching) {
        for side in division.sides() {
            let across = [side.edge, 3 * side.added + 1];
            self.put_fold(recipe, after(side.edge), across, touching);
        }
        let [Some(one), Some(_)] = division.sides else { return };
        for edge in [one.edge, 3 * one.added] {
            let beyond = recipe.mesh.across(edge);
            let ends = recipe.mesh.ends(edge);
            let twin = (3 * beyond..3 * beyond + 3).find(|other| recipe.mesh.ends(*other) == ends);
            if let Some(twin) = twin {
                self.put_fold(recipe, edge, [before(edge), before(twin)], touching);
            }
        }
    }

    fn put_fold(
        &mut self,
        recipe: Recipe<'_>,
        edge: Corner,
        anchors: [Corner; 2],
        touching: &mut Touching,
    ) {
        let rest = recipe.distance(anchors[0], anchors[1]);
        if rest <= 0.0 {
            return;
        }
        let shape = bend_shape(recipe.distance(edge, after(edge)), rest);
        let (kind, thread) = (LinkKind::Bend, Thread::Warp);
        let spec = Spec { kind, thread, anchors, support: Support::Flap(edge), shape };
        self.put(recipe, spec, rest, touching);
    }

    /// What a link along a direction resists: on a grid, one across the threads only shear.
    fn kind_along(&self, direction: Vec3) -> (LinkKind, Thread) {
        let Some([weft, warp]) = self.threads else { return (LinkKind::Stretch, Thread::Warp) };
        if direction.dot(weft).abs() > ALONG {
            (LinkKind::Stretch, Thread::Weft)
        } else if direction.dot(warp).abs() > ALONG {
            (LinkKind::Stretch, Thread::Warp)
        } else {
            (LinkKind::Shear, Thread::Warp)
        }
    }

    fn put(&mut self, recipe: Recipe<'_>, spec: Spec, rest: f32, touching: &mut Touching) {
        let number = self.add(recipe.mesh, spec, rest, recipe.material);
        touch(touching, number, &spec);
    }

    fn retire(&mut self, number: u32) {
        let (links, at) = self.link_mut(number);
        let spec = links.spec[at];
        links.spec[at].support = Support::Gone;
        links.active[at] = false;
        self.hinges.revision = self.hinges.revision.wrapping_add(1);
        let slot = edge_of(spec.anchors) as usize;
        if spec.support == Support::Edge && self.link_of_edge[slot] == number {
            self.link_of_edge[slot] = NONE;
        }
    }
}

fn touch(touching: &mut Touching, number: u32, spec: &Spec) {
    for corner in spec.corners() {
        let list = &mut touching[corner as usize / 3];
        if list.last() != Some(&number) {
            list.push(number);
        }
    }
}

/// Where a corner at an end of the moved edge is now.
fn moved(side: Side, corner: Corner) -> Corner {
    if corner == after(side.edge) { 3 * side.added + 1 } else { 3 * side.added + 2 }
}
