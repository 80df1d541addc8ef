//! The vertices that the edge and vertex features of a moving mesh are made of, by which they are
//! posed anew.
//!
//! Reads triangles once, at construction, and positions when it poses; writes `Features`.
//! Invariant: a posed feature is the one that a mesh with these positions would have; only features
//! of flat places, which such a mesh lacks, are kept, without a bend.

use crate::geometry::aabb::Aabb;
use crate::geometry::bends::{BendHistogram, POLE_EDGES, SurfaceBend};
use crate::geometry::bvh::Bvh;
use crate::geometry::features::{
    EdgeFeature, FeatureMotion, FeatureSides, Features, IncidentEdge, MeshEdge, ShapeFeatures,
    VertexFeature, bend_at_edge, edges_of, ends_by_vertex,
};
use crate::geometry::relative_motion::{PartMotion, RigidStep};
use glam::Vec3;

/// An edge: its two ends, the opposite vertices of its two triangles, and the first of these.
#[derive(Clone, Copy, Debug)]
struct EdgeSource {
    ends: [u32; 2],
    opposite: [u32; 2],
    triangle: u32,
    sides: FeatureSides,
    /// Whether one of its ends is the pole of a fan.
    is_at_pole: bool,
}

/// The vertices of all features of a mesh.
#[derive(Clone, Debug, Default)]
pub(super) struct FeatureSources {
    edges: Vec<EdgeSource>,
    vertices: Vec<u32>,
    /// For each entry of `Features::incident_edges` the edge and its other end.
    incident: Vec<[u32; 2]>,
    /// For each vertex the index of its first entry of `incident`, and the number of all.
    starts: Vec<u32>,
}

impl FeatureSources {
    /// Builds all features of triangles, each with an area, and what they are made of. Vertices in
    /// the same place count as one.
    pub fn build(positions: &[Vec3], triangles: &[[u32; 3]]) -> (ShapeFeatures, Self) {
        let mut sources = Self::default();
        let source = |MeshEdge { ends, opposite, triangle, is_interior }| {
            let sides = if is_interior { FeatureSides::TwoSided } else { FeatureSides::Boundary };
            EdgeSource { ends, opposite, triangle, sides, is_at_pole: false }
        };
        sources.edges.extend(edges_of(positions, triangles).into_iter().map(source));
        let ends: Vec<[u32; 2]> = sources.edges.iter().map(|edge| edge.ends).collect();
        for own in ends_by_vertex(&ends).chunk_by(|a, b| a.vertex == b.vertex) {
            sources.starts.push(sources.incident.len() as u32);
            sources.vertices.push(own[0].vertex);
            sources.incident.extend(own.iter().map(|end| [end.edge, end.other]));
            if own.len() >= POLE_EDGES {
                own.iter().for_each(|end| sources.edges[end.edge as usize].is_at_pole = true);
            }
        }
        sources.starts.push(sources.incident.len() as u32);
        let features = sources.features(positions);
        (features, sources)
    }

    fn features(&self, positions: &[Vec3]) -> ShapeFeatures {
        let (mut features, mut bends) = (Features::default(), BendHistogram::default());
        for (number, source) in (0..).zip(&self.edges) {
            let ends = source.ends.map(|v| positions[v as usize]);
            features.edges.push(EdgeFeature::flat(ends, source.sides));
            self.pose_edge(&mut features, number, positions);
            let bend = features.edges[number as usize].bend;
            if bend.angle > 0.0 {
                bends.insert(bend);
            }
        }
        let none = IncidentEdge { direction: Vec3::ZERO, normals: [Vec3::ZERO; 2] };
        features.incident_edges = vec![none; self.incident.len()];
        for (number, vertex) in (0..).zip(&self.vertices) {
            let range = &self.starts[number as usize..];
            features
                .vertices
                .push(VertexFeature::flat(positions[*vertex as usize], [range[0], range[1]]));
            self.pose_vertex(&mut features, number, positions);
        }
        (0..self.vertices.len()).for_each(|one| self.widen_at_pole(&mut features, one as u32));
        features.motions =
            vec![
                FeatureMotion { step: RigidStep::NONE, whole: PartMotion::default() };
                self.edges.len() + self.vertices.len()
            ];
        let ids = features.ids_since([0; 2]);
        let bounds: Vec<Aabb> = ids.map(|id| features.bounds(id)).collect();
        ShapeFeatures { tree: Some(Bvh::build(&bounds)), features, bends }
    }

    /// Returns the numbers of edges and vertices.
    pub fn counts(&self) -> [u32; 2] {
        [self.edges.len(), self.vertices.len()].map(|count| count as u32)
    }

    /// Calls `visit` with every edge whose first triangle fulfils `is_near` and whose bend fulfils
    /// `is_sharp` at one of two moments, and with both its ends as vertex features. `moments` are the
    /// positions of all vertices then [m]. At the pole of a fan any bend counts as sharp, because the
    /// one between opposite faces is not known here.
    pub fn visit_sharp_edges(
        &self,
        moments: [&[Vec3]; 2],
        is_near: impl Fn(u32) -> bool,
        is_sharp: impl Fn(&SurfaceBend) -> bool,
        mut visit: impl FnMut(u32, [u32; 2]),
    ) {
        for (number, edge) in (0..).zip(&self.edges) {
            let bends_at = |at: &[Vec3]| {
                let place = |v: u32| at[v as usize];
                let bend = bend_at_edge(edge.ends.map(place), edge.opposite.map(place));
                bend.is_some_and(|(_, _, bend)| edge.is_at_pole || is_sharp(&bend))
            };
            if is_near(edge.triangle) && moments.into_iter().any(bends_at) {
                visit(number, edge.ends.map(|v| self.vertex_feature(v)));
            }
        }
    }

    /// Returns the feature of a vertex that has edges. Features are in the order of their vertices.
    fn vertex_feature(&self, vertex: u32) -> u32 {
        self.vertices.partition_point(|other| *other < vertex) as u32
    }

    /// Returns the ends of the edge with this feature id; `None` if it is a vertex.
    pub fn edge_ends(&self, id: u32) -> Option<[u32; 2]> {
        self.edges.get(id as usize).map(|edge| edge.ends)
    }

    /// Returns the vertex with this feature id.
    pub fn vertex(&self, id: u32) -> u32 {
        self.vertices[id as usize - self.edges.len()]
    }

    /// Returns the edges at a vertex feature, each with its other end.
    pub fn incident(&self, vertex: u32) -> &[[u32; 2]] {
        let [first, end] = [0, 1].map(|k| self.starts[vertex as usize + k] as usize);
        &self.incident[first..end]
    }

    /// Poses an edge, with the vertices `at` their positions, and returns its ends.
    pub fn pose_edge(&self, to: &mut Features, edge: u32, at: &[Vec3]) -> [u32; 2] {
        let EdgeSource { ends, opposite, sides, .. } = self.edges[edge as usize];
        let place = |v: u32| at[v as usize];
        let positions = ends.map(place);
        to.edges[edge as usize] = EdgeFeature::new(positions, opposite.map(place), sides)
            .unwrap_or(EdgeFeature::flat(positions, sides));
        ends
    }

    /// Returns the direction of an edge and the normal of its first face, with the vertices `at` their
    /// positions; zero where there is none. The outward direction of a nearly flat edge would turn over
    /// when it bends the other way.
    pub fn edge_directions(&self, edge: u32, at: &[Vec3]) -> [Vec3; 2] {
        let EdgeSource { ends: [from, to], opposite: [third, _], .. } = self.edges[edge as usize];
        let [from, to, third] = [from, to, third].map(|v| at[v as usize]);
        let along = to - from;
        [along, along.cross(third - from)].map(Vec3::normalize_or_zero)
    }

    /// Returns the directions of the first edge at a vertex.
    pub fn vertex_directions(&self, vertex: u32, at: &[Vec3]) -> [Vec3; 2] {
        self.edge_directions(self.incident(vertex)[0][0], at)
    }

    /// Widens the bends of the edges at a pole. Call it after all vertices are posed.
    pub fn widen_at_pole(&self, to: &mut Features, vertex: u32) {
        let (bend, own) = (to.vertices[vertex as usize].bend, self.incident(vertex));
        if own.len() >= POLE_EDGES {
            own.iter().for_each(|[edge, _]| to.edges[*edge as usize].bend.widen_to(bend));
        }
    }

    /// Poses a vertex whose edges are posed, and returns its number in the mesh.
    pub fn pose_vertex(&self, to: &mut Features, vertex: u32, at: &[Vec3]) -> u32 {
        let own = self.vertices[vertex as usize];
        let first = self.starts[vertex as usize];
        let mut posed = VertexFeature::flat(at[own as usize], [first; 2]);
        let mut outward = Vec3::ZERO;
        for (place, [edge, end]) in (first as usize..).zip(self.incident(vertex)) {
            let edge = &to.edges[*edge as usize];
            let along = at[*end as usize] - posed.position;
            let length = along.length();
            let direction = along * if length > 0.0 { 1.0 / length } else { 0.0 };
            to.incident_edges[place] = IncidentEdge { direction, normals: edge.normals };
            if edge.bend.angle > 0.0 {
                outward += edge.outward;
                posed.bend.merge(edge.bend);
            }
            if posed.sides == FeatureSides::Solid || edge.sides == FeatureSides::Boundary {
                posed.sides = edge.sides;
            }
            posed.end_edge = place as u32 + 1;
        }
        let length = outward.length();
        if length > 0.0 {
            posed.outward = outward * (1.0 / length);
            let own = to.incident_edges[first as usize..posed.end_edge as usize].iter();
            posed.bend.widen_at_pole(posed.outward, own.map(|edge| edge.normals[0]));
        } else {
            posed.bend = SurfaceBend::default();
        }
        to.vertices[vertex as usize] = posed;
        own
    }
}
