//! Edge and vertex features of collision shapes with flat faces, and their normal cones.
//!
//! ```text
//!      outward                    A contact normal n belongs to
//!         ▲                       - an edge if it lies in the normal cone of the edge, between the
//!   n₀ ↖  │  ↗ n₁                   normals of its two faces:  n · inwardₖ ≤ 0 for both k;
//!       ╲ │ ╱                     - a vertex if it lies in the normal cone of the vertex:
//!        ╲│╱                        n · direction ≤ 0 for all of its edges.
//!  ───────●───────
//!  inward₀  inward₁               The cone holds the directions of the feature's Voronoi region.
//! ```
//! The normal cones of all features tile the sphere of directions (the Gauss map of a polyhedron).
//! Edge and vertex contacts are accepted only inside the cone of their feature, so every contact
//! normal lies between the normals of the adjacent faces. Compare Mirtich, "V-Clip: Fast and robust
//! polyhedral collision detection", ACM TOG 1998, for Voronoi regions, and Gregorius, "The
//! separating axis test between convex polyhedra", GDC 2013, for the Gauss map.
//!
//! Reads triangles once, at construction, or heightfield cells on the fly; writes only its own
//! lists. Invariant: features are numbered edges first, then vertices, in an order that depends
//! only on the triangles.

use crate::geometry::aabb::Aabb;
use crate::geometry::bends::{BendHistogram, POLE_EDGES, SurfaceBend};
use crate::geometry::bvh::Bvh;
use crate::geometry::relative_motion::{PartMotion, PointMotion, RigidStep};
use crate::geometry::swept_box::SweptBox;
use crate::math::max;
use crate::math::reserve::ReserveTotal;
use crate::math::sort::{sort_by, sort_groups};
use glam::Vec3;

/// The sides of a feature that are free space.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum FeatureSides {
    /// Free space on the side of `outward`; the solid is behind it.
    Solid,
    /// Free space on both sides of a surface. Contacts count only on the side of `outward`.
    TwoSided,
    /// Free space everywhere except in the face: the feature lies on the boundary of a surface.
    Boundary,
}

/// Whether there are colliders whose features are not those of a solid, or move.
const HAS_SURFACES: bool = cfg!(feature = "facet-colliders");

impl FeatureSides {
    /// Returns whether there is free space on both sides of the surface.
    pub fn is_two_sided(self) -> bool {
        HAS_SURFACES && self == Self::TwoSided
    }

    /// Returns whether the feature lies on the boundary of a surface.
    pub fn is_boundary(self) -> bool {
        HAS_SURFACES && self == Self::Boundary
    }
}

/// An edge feature: the segment where two faces meet at an angle, or where one face ends.
#[derive(Clone, Copy, Debug)]
pub(crate) struct EdgeFeature {
    /// [m]
    pub ends: [Vec3; 2],
    /// From the edge into each face, perpendicular to the edge, of length one.
    pub inward: [Vec3; 2],
    /// The normals of the faces, on the side of `outward`, of length one.
    pub normals: [Vec3; 2],
    /// The middle of the normal cone, of length one.
    pub outward: Vec3,
    pub sides: FeatureSides,
    pub bend: SurfaceBend,
}

impl EdgeFeature {
    /// Makes the edge `ends` of two faces, each given by any other point of its plane (`opposite`);
    /// a boundary edge gives the same point twice. `None` if the faces lie in one plane.
    pub fn new(ends: [Vec3; 2], opposite: [Vec3; 2], sides: FeatureSides) -> Option<Self> {
        let (along, inward, bend) = bend_at_edge(ends, opposite)?;
        let outward = (inward[0] + inward[1]) * (-1.0 / bend.angle);
        let normals = inward.map(|inward| {
            let normal = along.cross(inward);
            if normal.dot(outward) < 0.0 { -normal } else { normal }
        });
        Some(Self { ends, inward, normals, outward, sides, bend })
    }

    /// Makes an edge of two faces in one plane, which counts as smooth.
    pub(super) fn flat(ends: [Vec3; 2], sides: FeatureSides) -> Self {
        let (inward, normals) = ([Vec3::ZERO; 2], [Vec3::ZERO; 2]);
        Self { ends, inward, normals, outward: Vec3::Y, sides, bend: SurfaceBend::default() }
    }

    /// Returns whether a point lies in front of at least one of the two faces.
    pub fn is_outside(&self, p: Vec3) -> bool {
        self.normals.iter().any(|normal| (p - self.ends[0]).dot(*normal) > 0.0)
    }
}

/// Returns the direction of the edge `ends` of two faces, the directions from it into both, of length
/// one, and how much they bend there; each face is given by any other point of its plane. `None` if
/// they lie in one plane.
#[inline(always)]
pub(super) fn bend_at_edge(
    ends: [Vec3; 2],
    opposite: [Vec3; 2],
) -> Option<(Vec3, [Vec3; 2], SurfaceBend)> {
    let span = ends[1] - ends[0];
    let length = span.length();
    let along = span * (1.0 / length);
    let heights = opposite.map(|point| {
        let side = point - ends[0];
        side - along * side.dot(along)
    });
    let width = heights.map(Vec3::length);
    let inward = [heights[0] * (1.0 / width[0]), heights[1] * (1.0 / width[1])];
    let angle = (inward[0] + inward[1]).length();
    let narrow = if width[0] < width[1] { width[0] } else { width[1] };
    let bend = SurfaceBend { angle, curvature: angle / narrow };
    (angle > MIN_ANGLE && length > 0.0).then_some((along, inward, bend))
}

/// Faces that meet at a smaller angle than this [rad] count as one plane.
const MIN_ANGLE: f32 = 5.0e-3;

/// A vertex feature: the point where edge features meet.
#[derive(Clone, Copy, Debug)]
pub(crate) struct VertexFeature {
    /// [m]
    pub position: Vec3,
    /// The mean outward direction of its edges, of length one.
    pub outward: Vec3,
    pub sides: FeatureSides,
    /// The largest bend of its edges; at the pole of a fan the bend between opposite faces.
    pub bend: SurfaceBend,
    /// Its range in `Features::incident_edges`.
    pub(super) first_edge: u32,
    pub(super) end_edge: u32,
}

impl VertexFeature {
    /// Makes a vertex in a flat place, which counts as smooth, with a range of incident edges.
    pub(super) fn flat(position: Vec3, [first_edge, end_edge]: [u32; 2]) -> Self {
        let (outward, sides, bend) = (Vec3::Y, FeatureSides::Solid, SurfaceBend::default());
        Self { position, outward, sides, bend, first_edge, end_edge }
    }
}

/// One feature; a vertex with its index in `Features::vertices`.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Feature<'a> {
    Edge(&'a EdgeFeature),
    Vertex(u32, &'a VertexFeature),
}

/// Edge and vertex features.
#[derive(Clone, Debug, Default)]
pub(crate) struct Features {
    pub edges: Vec<EdgeFeature>,
    pub vertices: Vec<VertexFeature>,
    /// The edges at each vertex, vertex by vertex.
    pub(super) incident_edges: Vec<IncidentEdge>,
    /// The motion of each feature, by its id; empty if they do not move.
    pub(super) motions: Vec<FeatureMotion>,
}

/// The motion of a feature of a moving mesh.
#[derive(Clone, Copy, Debug)]
pub(super) struct FeatureMotion {
    /// In the substep.
    pub step: RigidStep,
    /// The motion in the tick.
    pub whole: PartMotion,
}

/// An edge as seen from one of its ends.
#[derive(Clone, Copy, Debug)]
pub(super) struct IncidentEdge {
    /// Along the edge, away from the vertex, of length one.
    pub direction: Vec3,
    /// The normals of its faces.
    pub normals: [Vec3; 2],
}

impl Features {
    /// Allocates for `count` edges in all and as many vertices.
    pub fn reserve(&mut self, count: usize) {
        self.edges.reserve_total(count);
        self.vertices.reserve_total(count);
        self.incident_edges.reserve_total(2 * count);
    }

    pub fn clear(&mut self) {
        self.edges.clear();
        self.vertices.clear();
        self.incident_edges.clear();
    }

    /// Appends the vertex where `edges` end, each given with its other end, and returns how much the
    /// surface bends there. Without edges it appends nothing.
    pub fn push_vertex(
        &mut self,
        at: Vec3,
        edges: impl Iterator<Item = (Vec3, EdgeFeature)>,
    ) -> SurfaceBend {
        let (first_edge, mut outward) = (self.incident_edges.len() as u32, Vec3::ZERO);
        let (mut bend, mut sides) = (SurfaceBend::default(), FeatureSides::Solid);
        for (to, edge) in edges {
            let along = to - at;
            let direction = along * (1.0 / along.length());
            self.incident_edges.push(IncidentEdge { direction, normals: edge.normals });
            outward += edge.outward;
            bend.merge(edge.bend);
            if sides == FeatureSides::Solid || edge.sides == FeatureSides::Boundary {
                sides = edge.sides;
            }
        }
        let (end_edge, length) = (self.incident_edges.len() as u32, outward.length());
        if length > 0.0 {
            let outward = outward * (1.0 / length);
            let own = self.incident_edges[first_edge as usize..].iter();
            bend.widen_at_pole(outward, own.map(|edge| edge.normals[0]));
            let position = at;
            let vertex = VertexFeature { position, outward, sides, bend, first_edge, end_edge };
            self.vertices.push(vertex);
        } else {
            self.incident_edges.truncate(first_edge as usize);
        }
        bend
    }

    /// Returns the numbers of edges and of vertices.
    pub fn counts(&self) -> [usize; 2] {
        [self.edges.len(), self.vertices.len()]
    }

    /// Returns the ids of all features that were appended since [`Features::counts`] returned these
    /// numbers. The id of a vertex is its index plus the number of edges.
    pub fn ids_since(&self, [edges, vertices]: [usize; 2]) -> impl Iterator<Item = u32> + use<> {
        let [edge_count, vertex_count] = self.counts();
        let vertices = edge_count + vertices..edge_count + vertex_count;
        (edges..edge_count).chain(vertices).map(|id| id as u32)
    }

    /// Returns the feature with this id.
    pub fn get(&self, id: u32) -> Feature<'_> {
        match self.edges.get(id as usize) {
            Some(edge) => Feature::Edge(edge),
            None => {
                let own = id as usize - self.edges.len();
                Feature::Vertex(own as u32, &self.vertices[own])
            }
        }
    }

    /// Returns the bounds of a feature, wherever it may be in the tick [m].
    pub fn bounds(&self, id: u32) -> Aabb {
        let bounds = match self.get(id) {
            Feature::Edge(edge) => Aabb::from_points(edge.ends),
            Feature::Vertex(_, vertex) => Aabb { low: vertex.position, high: vertex.position },
        };
        match self.motion(id) {
            Some(motion) => bounds.expanded(motion.whole.longest()),
            None => bounds,
        }
    }

    /// Returns the swept box of a feature. `shares` are the parts of the tick after and before now.
    pub fn swept_box(&self, id: u32, shares: [f32; 2]) -> SweptBox {
        let now = match self.get(id) {
            Feature::Edge(edge) => Aabb::from_points(edge.ends),
            Feature::Vertex(_, vertex) => Aabb { low: vertex.position, high: vertex.position },
        };
        let whole = self.motion(id).map_or(PartMotion::default(), |one| one.whole);
        SweptBox::new(
            now,
            shares.map(|share| whole.mean * share),
            shares.map(|share| whole.spread * share),
        )
    }

    /// Returns how far points move relative to a feature, at most [m]; 0 if features do not move.
    pub fn reach<const COUNT: usize>(&self, id: u32, points: [&PointMotion; COUNT]) -> f32 {
        match self.motion(id) {
            Some(motion) => points.iter().fold(0.0, |most, p| max(p.reach(&motion.whole), most)),
            None => 0.0,
        }
    }

    fn motion(&self, id: u32) -> Option<&FeatureMotion> {
        if HAS_SURFACES { self.motions.get(id as usize) } else { None }
    }

    /// Returns the motion of an edge in the substep; `None` if features do not move.
    pub fn edge_step(&self, edge: u32) -> Option<&RigidStep> {
        self.motion(edge).map(|motion| &motion.step)
    }

    /// Returns the motion of a vertex in the substep; `None` if features do not move.
    pub fn vertex_step(&self, vertex: u32) -> Option<&RigidStep> {
        self.edge_step(vertex + self.edges.len() as u32)
    }

    /// Returns how much the surface bends at a feature.
    pub fn bend(&self, id: u32) -> SurfaceBend {
        match self.get(id) {
            Feature::Edge(edge) => edge.bend,
            Feature::Vertex(_, vertex) => vertex.bend,
        }
    }

    fn incident_edges(&self, vertex: &VertexFeature) -> &[IncidentEdge] {
        &self.incident_edges[vertex.first_edge as usize..vertex.end_edge as usize]
    }

    /// Returns whether `normal` lies in the normal cone of a vertex: no edge rises above the plane
    /// through the vertex by more than `tolerance`, the sine of an angle.
    pub fn is_in_normal_cone(&self, vertex: &VertexFeature, normal: Vec3, tolerance: f32) -> bool {
        let mut edges = self.incident_edges(vertex).iter();
        edges.all(|edge| edge.direction.dot(normal) <= tolerance)
    }

    /// Returns whether a point lies in front of at least one face at a vertex.
    pub fn is_outside_vertex(&self, vertex: &VertexFeature, p: Vec3) -> bool {
        let is_in_front = |normal: &Vec3| {
            let side = (p - vertex.position).dot(*normal);
            if normal.dot(vertex.outward) > 0.0 { side > 0.0 } else { side < 0.0 }
        };
        self.incident_edges(vertex).iter().any(|edge| edge.normals.iter().any(is_in_front))
    }
}

/// All features of a static shape, with a BVH over them.
#[derive(Clone, Debug)]
pub(crate) struct ShapeFeatures {
    pub features: Features,
    /// BVH over feature ids; `None` if the shape is one plane.
    pub(super) tree: Option<Bvh>,
    pub bends: BendHistogram,
}

impl ShapeFeatures {
    /// Builds the features of triangles, each with an area. Corners in the same place count as one
    /// vertex. `is_solid` says that the triangles enclose a solid.
    pub fn build(positions: &[Vec3], triangles: &[[u32; 3]], is_solid: bool) -> Self {
        let (mut features, mut bends) = (Features::default(), BendHistogram::default());
        let at = |i: u32| positions[i as usize];
        let interior = if is_solid { FeatureSides::Solid } else { FeatureSides::TwoSided };
        let mut bent = Vec::new();
        for MeshEdge { ends, opposite, is_interior, .. } in edges_of(positions, triangles) {
            let sides = if is_interior { interior } else { FeatureSides::Boundary };
            if let Some(feature) = EdgeFeature::new(ends.map(at), opposite.map(at), sides) {
                bends.insert(feature.bend);
                bent.push(ends);
                features.edges.push(feature);
            }
        }
        let (ends, mut poles) = (ends_by_vertex(&bent), Vec::new());
        for own in ends.chunk_by(|a, b| a.vertex == b.vertex) {
            let edges: Vec<(Vec3, EdgeFeature)> =
                own.iter().map(|end| (at(end.other), features.edges[end.edge as usize])).collect();
            let bend = features.push_vertex(at(own[0].vertex), edges.into_iter());
            if own.len() >= POLE_EDGES {
                poles.push((bend, own));
            }
        }
        for (bend, own) in poles {
            own.iter().for_each(|end| features.edges[end.edge as usize].bend.widen_to(bend));
        }
        let ids = features.ids_since([0; 2]);
        let bounds: Vec<Aabb> = ids.map(|id| features.bounds(id)).collect();
        let tree = (!bounds.is_empty()).then(|| Bvh::build(&bounds));
        Self { features, tree, bends }
    }

    /// Recomputes the tree from boxes of the features.
    pub(super) fn refit(&mut self, bounds: &dyn Fn(u32) -> Aabb) {
        if let Some(tree) = &mut self.tree {
            tree.refit(bounds);
        }
    }

    /// Returns the ids of the features that may overlap `bounds`, in the order of the BVH.
    pub fn overlapping(&self, bounds: Aabb) -> impl Iterator<Item = u32> + '_ {
        self.tree.iter().flat_map(move |tree| tree.overlapping(bounds))
    }
}

/// An edge of a mesh: its two ends, and the opposite corners of its first two triangles.
#[derive(Clone, Copy, Debug)]
pub(super) struct MeshEdge {
    pub ends: [u32; 2],
    pub opposite: [u32; 2],
    /// Its first triangle.
    pub triangle: u32,
    /// Whether exactly two triangles have it.
    pub is_interior: bool,
}

/// Returns the edges of triangles, by their ends. Vertices in the same place count as the first one.
#[inline(never)]
pub(super) fn edges_of(positions: &[Vec3], triangles: &[[u32; 3]]) -> Vec<MeshEdge> {
    let welded = weld_positions(positions);
    let mut sides = Vec::new();
    for (number, triangle) in (0..).zip(triangles) {
        let [a, b, c] = triangle.map(|i| welded[i as usize]);
        for [from, to, opposite] in [[a, b, c], [b, c, a], [c, a, b]] {
            sides.push(([from.min(to), from.max(to)], opposite, number));
        }
    }
    sort_groups(&mut sides, |([low, _], ..)| *low);
    let edge = |same: &[([u32; 2], u32, u32)]| MeshEdge {
        ends: same[0].0,
        opposite: [same[0].1, same[same.len().min(2) - 1].1],
        triangle: same[0].2,
        is_interior: same.len() == 2,
    };
    sides.chunk_by(|a, b| a.0 == b.0).map(edge).collect()
}

/// An end of an edge.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) struct EdgeEnd {
    pub vertex: u32,
    /// The other end.
    pub other: u32,
    /// The index of the edge.
    pub edge: u32,
}

/// Returns the ends of edges, vertex by vertex.
#[inline(never)]
pub(super) fn ends_by_vertex(edges: &[[u32; 2]]) -> Vec<EdgeEnd> {
    let mut ends = Vec::new();
    for (edge, [from, to]) in (0..).zip(edges) {
        ends.push(EdgeEnd { vertex: *from, other: *to, edge });
        ends.push(EdgeEnd { vertex: *to, other: *from, edge });
    }
    sort_groups(&mut ends, |end| end.vertex);
    ends
}

/// Returns, for each point, the first point in the same place.
pub(super) fn weld_positions(positions: &[Vec3]) -> Vec<u32> {
    // Adding zero turns minus zero into zero.
    let bits = |i: u32| (positions[i as usize] + Vec3::ZERO).to_array().map(f32::to_bits);
    let mut order: Vec<u32> = (0..positions.len() as u32).collect();
    sort_by(&mut order, |p, q| (bits(*p), p).cmp(&(bits(*q), q)));
    let mut welded = vec![0; positions.len()];
    for same in order.chunk_by(|a, b| bits(*a) == bits(*b)) {
        same.iter().for_each(|i| welded[*i as usize] = same[0]);
    }
    welded
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
        // The last point is in the same place as the fourth.
        ShapeFeatures::build(&positions, &[[0, 1, 2], [1, 3, 2], [2, 6, 4], [6, 5, 4]], false)
    }

    #[test]
    fn a_roof_has_one_interior_edge_and_six_boundary_edges() {
        let Features { edges, vertices, .. } = roof().features;
        let is_interior = |edge: &&EdgeFeature| edge.sides == FeatureSides::TwoSided;
        let interior: Vec<&EdgeFeature> = edges.iter().filter(is_interior).collect();
        assert_eq!((interior.len(), edges.len(), vertices.len()), (1, 7, 6));
        assert!((interior[0].outward - Vec3::Y).length() < 1.0e-6, "{}", interior[0].outward);
        assert!((interior[0].bend.angle - 2.0_f32.sqrt()).abs() < 1.0e-6);
        assert!(interior[0].is_outside(Vec3::new(0.0, 0.5, 0.5)));
        assert!(!interior[0].is_outside(Vec3::new(1.0, 0.5, 0.5)));
    }

    #[test]
    fn the_normal_cone_of_a_pyramid_tip_contains_only_normals_above_all_its_edges() {
        let positions = [Vec3::Y, Vec3::X, Vec3::Z, -Vec3::X, -Vec3::Z];
        let triangles = [[0, 2, 1], [0, 3, 2], [0, 4, 3], [0, 1, 4]];
        let features = ShapeFeatures::build(&positions, &triangles, false).features;
        let tip = features.vertices.iter().find(|vertex| vertex.position == Vec3::Y).unwrap();
        assert!((tip.outward - Vec3::Y).length() < 1.0e-6 && tip.sides == FeatureSides::TwoSided);
        assert!(features.is_in_normal_cone(tip, Vec3::Y, 0.0));
        assert!(!features.is_in_normal_cone(tip, Vec3::X, 0.0));
        assert!(features.is_outside_vertex(tip, Vec3::Y * 1.1));
        assert!(!features.is_outside_vertex(tip, Vec3::Y * 0.5));
    }
}
