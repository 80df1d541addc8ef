//! What sticks out of a shape of flat facets: ridges, where two of them fold, and corners.

use crate::geometry::aabb::Aabb;
use crate::geometry::bvh::Bvh;
use crate::math::sort::{sort, sort_by};
use glam::Vec3;

/// How much a shape bends somewhere.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Bend {
    /// What the ways out of two facets differ by: nearly the angle, if that is small.
    pub fold: f32,
    /// The same, a metre of a facet's width [1/m].
    pub per_metre: f32,
}

impl Bend {
    /// How far what spans `length` over such bends gets inside.
    ///
    /// ```text
    /// one fold in the middle: fold L / 4    many, close together: curvature L² / 8
    /// ```
    pub fn sag(&self, length: f32) -> f32 {
        let (one, many) = (self.fold * length * 0.25, self.per_metre * length * length * 0.125);
        if one > many { one } else { many }
    }

    /// At least as much as another.
    pub fn merge(&mut self, other: Self) {
        self.fold = self.fold.max(other.fold);
        self.per_metre = self.per_metre.max(other.per_metre);
    }
}

/// Which sides of a ridge or corner are outside.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Sides {
    /// The one that `out` points to; behind is a body.
    SignedDistance,
    /// The same, but behind there may be cloth too.
    Fold,
    /// All but the facet: it is a border.
    Border,
}

/// Where two facets meet, or one ends.
#[derive(Clone, Copy, Debug)]
pub(crate) struct EdgeFeature {
    pub ends: [Vec3; 2],
    /// From it into each facet, square to it, of length one.
    pub into: [Vec3; 2],
    /// Out of each facet, of length one.
    pub normals: [Vec3; 2],
    /// Out, between the facets.
    pub out: Vec3,
    pub sides: Sides,
    pub bend: Bend,
}

impl EdgeFeature {
    /// Of two facets on whose planes `tips` are; nothing if they do not fold. One facet alone is twice the
    /// same.
    pub fn new(ends: [Vec3; 2], tips: [Vec3; 2], sides: Sides) -> Option<Self> {
        let span = ends[1] - ends[0];
        let length = span.length();
        let along = span * (1.0 / length);
        let widths = tips.map(|tip| {
            let side = tip - ends[0];
            side - along * side.dot(along)
        });
        let width = widths.map(Vec3::length);
        let into = [widths[0] * (1.0 / width[0]), widths[1] * (1.0 / width[1])];
        let inward = into[0] + into[1];
        let fold = inward.length();
        if !(fold > STRAIGHT && length > 0.0) {
            return None;
        }
        let out = inward * (-1.0 / fold);
        let normals = into.map(|into| {
            let normal = along.cross(into);
            if normal.dot(out) < 0.0 { -normal } else { normal }
        });
        let narrow = if width[0] < width[1] { width[0] } else { width[1] };
        let bend = Bend { fold, per_metre: fold / narrow };
        Some(Self { ends, into, normals, out, sides, bend })
    }

    /// Whether a point is on the outer side of a fold.
    pub fn is_outside(&self, p: Vec3) -> bool {
        self.normals.iter().any(|normal| (p - self.ends[0]).dot(*normal) > 0.0)
    }
}

/// Facets that fold less than this are one plane.
const STRAIGHT: f32 = 5.0e-3;

/// Where ridges end.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Corner {
    pub at: Vec3,
    /// Out, between the ridges.
    pub out: Vec3,
    pub sides: Sides,
    /// The most of its ridges.
    pub bend: Bend,
    /// Its entries of `Features::spokes`.
    from: u32,
    end: u32,
}

/// A ridge; or a corner, and its number among corners.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Feature<'a> {
    EdgeFeature(&'a EdgeFeature),
    Corner(u32, &'a Corner),
}

/// Ridges and corners.
#[derive(Clone, Debug, Default)]
pub(crate) struct Features {
    pub ridges: Vec<EdgeFeature>,
    pub corners: Vec<Corner>,
    /// Directions along ridges, away from corners, and out of the facets on either side of each.
    spokes: Vec<Spoke>,
}

/// A ridge as one of its ends sees it.
#[derive(Clone, Copy, Debug)]
struct Spoke {
    along: Vec3,
    normals: [Vec3; 2],
}

impl Features {
    /// Sees to room for so many ridges and corners.
    pub fn reserve(&mut self, count: usize) {
        self.ridges.reserve(count);
        self.corners.reserve(count);
        self.spokes.reserve(2 * count);
    }

    pub fn clear(&mut self) {
        self.ridges.clear();
        self.corners.clear();
        self.spokes.clear();
    }

    /// Adds a corner where ridges end; nothing without ridges.
    pub fn add_corner(&mut self, at: Vec3, ridges: impl Iterator<Item = (Vec3, EdgeFeature)>) {
        let (from, mut out) = (self.spokes.len() as u32, Vec3::ZERO);
        let (mut bend, mut sides) = (Bend::default(), Sides::SignedDistance);
        for (to, ridge) in ridges {
            let along = to - at;
            let along = along * (1.0 / along.length());
            self.spokes.push(Spoke { along, normals: ridge.normals });
            out += ridge.out;
            bend.merge(ridge.bend);
            if sides == Sides::SignedDistance || ridge.sides == Sides::Border {
                sides = ridge.sides;
            }
        }
        let (end, length) = (self.spokes.len() as u32, out.length());
        if length > 0.0 {
            let out = out * (1.0 / length);
            self.corners.push(Corner { at, out, sides, bend, from, end });
        } else {
            self.spokes.truncate(from as usize);
        }
    }

    /// How many ridges and corners there are.
    pub fn counts(&self) -> [usize; 2] {
        [self.ridges.len(), self.corners.len()]
    }

    /// Numbers of what was added when there were so many: ridges first, then corners, which are numbered after
    /// all ridges.
    pub fn numbers_after(
        &self,
        [ridges, corners]: [usize; 2],
    ) -> impl Iterator<Item = u32> + use<> {
        let [ridge_count, corner_count] = self.counts();
        let corners = ridge_count + corners..ridge_count + corner_count;
        (ridges..ridge_count).chain(corners).map(|number| number as u32)
    }

    /// What has a number.
    pub fn at(&self, number: u32) -> Feature<'_> {
        match self.ridges.get(number as usize) {
            Some(ridge) => Feature::EdgeFeature(ridge),
            None => {
                let own = number as usize - self.ridges.len();
                Feature::Corner(own as u32, &self.corners[own])
            }
        }
    }

    /// Where it is.
    pub fn bounds(&self, number: u32) -> Aabb {
        match self.at(number) {
            Feature::EdgeFeature(ridge) => Aabb::from_points(ridge.ends),
            Feature::Corner(_, corner) => Aabb { low: corner.at, high: corner.at },
        }
    }

    /// How much the shape bends there.
    pub fn bend(&self, number: u32) -> Bend {
        match self.at(number) {
            Feature::EdgeFeature(ridge) => ridge.bend,
            Feature::Corner(_, corner) => corner.bend,
        }
    }

    fn spokes(&self, corner: &Corner) -> &[Spoke] {
        &self.spokes[corner.from as usize..corner.end as usize]
    }

    /// Whether a plane with this normal may lie on a corner: all its ridges go down from there.
    pub fn is_tip(&self, corner: &Corner, normal: Vec3, most: f32) -> bool {
        self.spokes(corner).iter().all(|spoke| spoke.along.dot(normal) <= most)
    }

    /// Whether a point is on the outer side of a corner.
    pub fn is_outside(&self, corner: &Corner, p: Vec3) -> bool {
        let facing = |normal: &Vec3| {
            let side = (p - corner.at).dot(*normal);
            if normal.dot(corner.out) > 0.0 { side > 0.0 } else { side < 0.0 }
        };
        self.spokes(corner).iter().any(|spoke| spoke.normals.iter().any(facing))
    }
}

/// The ridges and corners of a shape that stays as it is, in a tree.
#[derive(Clone, Debug)]
pub(crate) struct ShapeFeatures {
    pub features: Features,
    /// Over ridges, then corners; nothing where all is flat.
    tree: Option<Bvh>,
    pub steps: Steps,
}

impl ShapeFeatures {
    /// Of triangles with an area. Corners in the same place are one.
    pub fn build(positions: &[Vec3], triangles: &[[u32; 3]], is_solid: bool) -> Self {
        let same = join_places(positions);
        let mut edges = Vec::new();
        for triangle in triangles {
            let [a, b, c] = triangle.map(|i| same[i as usize]);
            for [from, to, tip] in [[a, b, c], [b, c, a], [c, a, b]] {
                edges.push(([from.min(to), from.max(to)], tip));
            }
        }
        sort(&mut edges);
        let (mut features, mut steps) = (Features::default(), Steps::default());
        let mut ends = Vec::new();
        for edge in edges.chunk_by(|a, b| a.0 == b.0) {
            let whole = if is_solid { Sides::SignedDistance } else { Sides::Fold };
            let sides = if edge.len() == 2 { whole } else { Sides::Border };
            let at = |i: u32| positions[i as usize];
            let tips = [at(edge[0].1), at(edge[edge.len().min(2) - 1].1)];
            let Some(ridge) = EdgeFeature::new(edge[0].0.map(at), tips, sides) else { continue };
            steps.add(ridge.bend);
            let [from, to] = edge[0].0;
            ends.extend([(from, to, features.ridges.len()), (to, from, features.ridges.len())]);
            features.ridges.push(ridge);
        }
        sort(&mut ends);
        for own in ends.chunk_by(|a, b| a.0 == b.0) {
            let at = positions[own[0].0 as usize];
            let ridges: Vec<(Vec3, EdgeFeature)> = own
                .iter()
                .map(|(_, to, ridge)| (positions[*to as usize], features.ridges[*ridge]))
                .collect();
            features.add_corner(at, ridges.into_iter());
        }
        let numbers = features.numbers_after([0; 2]);
        let bounds: Vec<Aabb> = numbers.map(|number| features.bounds(number)).collect();
        let tree = (!bounds.is_empty()).then(|| Bvh::over(&bounds));
        Self { features, tree, steps }
    }

    /// The numbers of ridges and, after them all, corners that may be in a place.
    pub fn near(&self, place: Aabb) -> impl Iterator<Item = u32> + '_ {
        self.tree.iter().flat_map(move |tree| tree.near(place))
    }
}

/// For each point the first in the same place.
fn join_places(positions: &[Vec3]) -> Vec<u32> {
    // Minus zero is zero.
    let bits = |i: u32| (positions[i as usize] + Vec3::ZERO).to_array().map(f32::to_bits);
    let mut order: Vec<u32> = (0..positions.len() as u32).collect();
    sort_by(&mut order, |p, q| (bits(*p), p).cmp(&(bits(*q), q)));
    let mut same = vec![0; positions.len()];
    for places in order.chunk_by(|a, b| bits(*a) == bits(*b)) {
        places.iter().for_each(|i| same[*i as usize] = places[0]);
    }
    same
}

/// The bends of a shape, sorted roughly by how much they fold: the most in each of some steps.
#[derive(Clone, Debug)]
pub(crate) struct Steps([Bend; STEPS]);

/// Two steps an octave.
const STEPS: usize = 32;

/// Folds of less than two to the power of minus this are all in the first step.
const LEAST: u32 = 16;

impl Default for Steps {
    fn default() -> Self {
        Self([Bend::default(); STEPS])
    }
}

impl Steps {
    pub fn add(&mut self, bend: Bend) {
        // The exponent and the first bit after it.
        let step = (bend.fold.to_bits() >> 22).saturating_sub(2 * (127 - LEAST)) as usize;
        self.0[step.min(STEPS - 1)].merge(bend);
    }

    /// The most that what spans `length` may bend without getting in by more than `sag`.
    pub fn mild(&self, length: f32, sag: f32) -> Bend {
        let mut mild = Bend::default();
        let is_mild = |step: &&Bend| step.sag(length) <= sag;
        self.0.iter().filter(is_mild).for_each(|step| mild.merge(*step));
        mild
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn roof() -> ShapeFeatures {
        let positions = [
            Vec3::ZERO,
            Vec3::Z,
            Vec3::new(1.0, 1.0, 0.0),
            Vec3::new(1.0, 1.0, 1.0),
            Vec3::X * 2.0,
        ]
        .into_iter()
        .chain([Vec3::new(2.0, 0.0, 1.0), Vec3::new(1.0, 1.0, 1.0)]);
        let positions: Vec<Vec3> = positions.collect();
        // The last point is the same as the fourth.
        ShapeFeatures::build(&positions, &[[0, 1, 2], [1, 3, 2], [2, 6, 4], [6, 5, 4]], false)
    }

    #[test]
    fn a_roof_has_a_ridge_and_six_borders_and_its_slopes_have_none() {
        let Features { ridges, corners, .. } = roof().features;
        let folds: Vec<&EdgeFeature> =
            ridges.iter().filter(|ridge| ridge.sides == Sides::Fold).collect();
        assert_eq!((folds.len(), ridges.len(), corners.len()), (1, 7, 6));
        assert!((folds[0].out - Vec3::Y).length() < 1.0e-6, "{}", folds[0].out);
        assert!((folds[0].bend.fold - 2.0_f32.sqrt()).abs() < 1.0e-6);
        assert!(folds[0].is_outside(Vec3::new(0.0, 0.5, 0.5)));
        assert!(!folds[0].is_outside(Vec3::new(1.0, 0.5, 0.5)));
    }

    #[test]
    fn a_plane_lies_on_a_corner_from_where_all_goes_down() {
        let positions = [Vec3::Y, Vec3::X, Vec3::Z, -Vec3::X, -Vec3::Z];
        let triangles = [[0, 2, 1], [0, 3, 2], [0, 4, 3], [0, 1, 4]];
        let features = ShapeFeatures::build(&positions, &triangles, false).features;
        let tip = features.corners.iter().find(|corner| corner.at == Vec3::Y).unwrap();
        assert!((tip.out - Vec3::Y).length() < 1.0e-6 && tip.sides == Sides::Fold);
        assert!(features.is_tip(tip, Vec3::Y, 0.0) && !features.is_tip(tip, Vec3::X, 0.0));
        assert!(features.is_outside(tip, Vec3::Y * 1.1));
        assert!(!features.is_outside(tip, Vec3::Y * 0.5));
    }

    #[test]
    fn mild_bends_are_those_that_let_little_in() {
        let mut steps = Steps::default();
        for fold in [0.01, 0.1, 0.125, 0.5, 1.5] {
            steps.add(Bend { fold, per_metre: fold * 8.0 });
        }
        let mild = steps.mild(0.1, 0.004);
        assert_eq!((mild.fold, mild.per_metre), (0.125, 1.0));
        assert_eq!(steps.mild(0.1, 0.0001).fold, 0.0);
        // Many folds close together get in farther than one.
        steps.add(Bend { fold: 0.01, per_metre: 9.0 });
        assert_eq!(steps.mild(0.1, 0.004).fold, 0.125);
        assert_eq!(steps.mild(0.1, 0.004).per_metre, 1.0);
    }
}
