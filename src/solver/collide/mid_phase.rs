//! The mid phase, for shapes with flat faces: candidate pairs of cloth primitives and shape
//! features.
//!
//! ```text
//! particle  – face             (convex hulls and triangle surfaces only)
//! edge      – edge feature
//! triangle  – vertex feature
//! ```
//! Each particle is bounded by a ball around its local positions now and at the start of the
//! substep, in the frames of the collider at both ends of the tick (a motion bound). Blocks of 32
//! triangles query the BVH of features; the rest is tested by distance. Features at which the
//! surface bends little count as smooth and are left out; particles keep a margin there instead.
//!
//! Reads the mesh and local positions; writes [`ColliderPairs`].
//! Invariant: until a particle moves farther than the search allowed for, every pair that can touch
//! is listed.

use crate::geometry::aabb::Aabb;
use crate::geometry::bends::SurfaceBend;
use crate::geometry::closest_points::{interpolate, segment_to_segment, triangle_to_origin};
use crate::geometry::collision_shape::CollisionShape;
use crate::geometry::features::{EdgeFeature, Feature, Features, ShapeFeatures};
use crate::geometry::swept_box::SweptBox;
use crate::math::max;
use crate::math::reserve::ReserveTotal;
use crate::mesh::{Mesh, NONE};
use crate::solver::collide::particle_motions::MotionBound;

/// Triangles that query the features together; on a grid they are mostly neighbours.
const BLOCK: usize = 32;

/// Given features whose bounds are tested together.
const GROUP: usize = 16;

/// The candidate pairs of all colliders.
#[derive(Clone, Debug, Default)]
pub(crate) struct ColliderPairs {
    edges: Vec<EdgeEdgePair>,
    vertices: Vec<VertexTrianglePair>,
    /// For each particle the index of its first entry in `faces`.
    face_starts: Vec<u32>,
    faces: Vec<u32>,
    /// The features of heightfields near the cloth, which are made on the fly.
    terrain_features: Features,
    motion_bounds: Vec<MotionBound>,
    /// Features that a search tests, with their boxes, and the box of each group of them.
    given: Vec<(u32, SweptBox)>,
    given_groups: Vec<SweptBox>,
    /// The motion of each particle likewise, and the numbers of the groups near a block of triangles.
    swept_particles: Vec<SweptBox>,
    near_groups: Vec<u32>,
    /// For each triangle, and the end, the numbers of edges and vertices before its own; only of
    /// colliders that deform.
    pair_starts: Vec<[u32; 2]>,
}

/// An edge feature of a collider and an edge of the cloth.
#[derive(Clone, Copy, Debug)]
pub(crate) struct EdgeEdgePair {
    /// The index of the edge feature.
    pub edge: u32,
    /// The particles of the cloth edge.
    pub particles: [u32; 2],
}

/// A vertex feature of a collider and a triangle of the cloth.
#[derive(Clone, Copy, Debug)]
pub(crate) struct VertexTrianglePair {
    /// The index of the vertex feature.
    pub vertex: u32,
    /// The particles of the cloth triangle.
    pub particles: [u32; 3],
}

/// The part of [`ColliderPairs`] that belongs to one collider.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct CandidateRange {
    edges: [u32; 2],
    vertices: [u32; 2],
    first_face_start: u32,
    first_pair_start: u32,
}

/// The candidate pairs of one collider.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Candidates<'a> {
    pub edges: &'a [EdgeEdgePair],
    pub vertices: &'a [VertexTrianglePair],
    face_starts: &'a [u32],
    faces: &'a [u32],
    terrain_features: &'a Features,
}

impl<'a> Candidates<'a> {
    /// Returns the faces near a particle.
    pub fn faces(&self, i: usize) -> &'a [u32] {
        match self.face_starts.get(i..i + 2) {
            Some(range) => &self.faces[range[0] as usize..range[1] as usize],
            None => &[],
        }
    }

    /// Returns the faces near all of `count` particles, some more than once.
    pub fn all_faces(&self, count: usize) -> &'a [u32] {
        match (self.face_starts.first(), self.face_starts.get(count)) {
            (Some(first), Some(end)) => &self.faces[*first as usize..*end as usize],
            _ => &[],
        }
    }

    /// Returns the features that the indices of pairs refer to.
    pub fn features(&self, shape: &'a CollisionShape) -> &'a Features {
        features_of(shape).map_or(self.terrain_features, |own| &own.features)
    }
}

/// Returns the features that a shape stores; `None` for smooth shapes, and for heightfields, whose
/// features are made on the fly.
pub(super) fn features_of(shape: &CollisionShape) -> Option<&ShapeFeatures> {
    match shape {
        CollisionShape::Cuboid(_, features)
        | CollisionShape::ConvexHull(_, features)
        | CollisionShape::TriangleSurface(_, features) => Some(features),
        _ => None,
    }
}

/// The parameters of a search for pairs.
#[derive(Clone, Copy, Debug)]
pub(super) struct PairSearch {
    /// Pairs that are this near [m] are candidates.
    pub distance: f32,
    /// Features that bend no more than this count as smooth.
    pub smooth: SurfaceBend,
}

/// What a search for the pairs of a collider that deforms starts from.
#[derive(Clone, Copy, Debug)]
pub(super) struct Earlier<'a> {
    /// The pairs of the search before, and the range of the collider in them.
    pub pairs: &'a ColliderPairs,
    pub range: CandidateRange,
    /// The particles to search for anew.
    pub moved: &'a [bool],
}

impl Earlier<'_> {
    /// Pushes the pairs that a triangle had.
    fn copy_pairs(
        &self,
        triangle: usize,
        (edges, vertices): (&mut Vec<EdgeEdgePair>, &mut Vec<VertexTrianglePair>),
    ) {
        let starts = &self.pairs.pair_starts[self.range.first_pair_start as usize + triangle..];
        let range = |k: usize| starts[0][k] as usize..starts[1][k] as usize;
        edges.extend_from_slice(&self.pairs.edges[range(0)]);
        vertices.extend_from_slice(&self.pairs.vertices[range(1)]);
    }

    fn has_moved(&self, corners: &[u32; 3]) -> bool {
        corners.iter().any(|i| self.moved[*i as usize])
    }
}

impl PairSearch {
    pub fn is_smooth(&self, bend: &SurfaceBend) -> bool {
        bend.angle <= self.smooth.angle && bend.curvature <= self.smooth.curvature
    }
}

impl ColliderPairs {
    /// Allocates for the usual number of pairs: up to four colliders with flat faces, each near
    /// much of the cloth. More pairs allocate when they are first found.
    pub fn reserve(&mut self, bodies: usize, particles: usize, triangles: usize) {
        let few = bodies.min(4);
        self.edges.reserve_total(4 * few * triangles);
        self.vertices.reserve_total(few * triangles);
        self.face_starts.reserve_total(bodies * (particles + 1));
        self.faces.reserve_total(8 * few * particles);
        self.given.reserve_total(triangles);
        self.given_groups.reserve_total(triangles.div_ceil(GROUP));
        self.near_groups.reserve_total(triangles.div_ceil(GROUP));
        self.swept_particles.reserve_total(particles);
        self.terrain_features.reserve(triangles);
        self.motion_bounds.reserve_total(particles);
    }

    /// Allocates likewise what only colliders that deform need.
    pub fn reserve_for_deforming(&mut self, bodies: usize, triangles: usize) {
        self.pair_starts.reserve_total(bodies * (triangles + 1));
    }

    pub fn clear(&mut self) {
        self.edges.clear();
        self.vertices.clear();
        self.face_starts.clear();
        self.faces.clear();
        self.terrain_features.clear();
        self.pair_starts.clear();
    }

    /// Sets the boxes of particles for a search.
    #[inline(never)]
    fn set_particles(&mut self, distance: f32) {
        self.swept_particles.clear();
        let boxes = self.motion_bounds.iter().map(|one| one.swept_box(distance));
        self.swept_particles.extend(boxes);
    }

    /// Returns the pairs of a collider.
    pub(super) fn of_range(&self, range: &CandidateRange) -> Candidates<'_> {
        Candidates {
            edges: &self.edges[range.edges[0] as usize..range.edges[1] as usize],
            vertices: &self.vertices[range.vertices[0] as usize..range.vertices[1] as usize],
            face_starts: &self.face_starts[range.first_face_start as usize..],
            faces: &self.faces,
            terrain_features: &self.terrain_features,
        }
    }

    /// Pushes the candidate pairs of a shape and returns their range. `motion_bound` bounds each
    /// of `count` particles.
    pub(super) fn push_pairs(
        &mut self,
        shape: &CollisionShape,
        mesh: &Mesh,
        count: usize,
        motion_bound: impl Fn(usize) -> MotionBound,
        search: PairSearch,
    ) -> CandidateRange {
        self.motion_bounds.clear();
        self.motion_bounds.extend((0..count).map(motion_bound));
        let range = self.begin_range();
        self.push_faces(shape, (search.distance, 1.0), None);
        self.push_feature_pairs(shape, mesh, search);
        self.end_range(range)
    }

    /// Pushes the candidate pairs of a collider that deforms and returns their range, as
    /// [`ColliderPairs::push_pairs`] does. It takes the motion bounds. With `earlier` it searches only
    /// for some particles, and copies the pairs of the others from there. `shares` are the parts of a
    /// tick that are left and that the substep has taken, at `moment` of it.
    pub(super) fn push_pairs_of_deforming(
        &mut self,
        (shape, sharp): (&CollisionShape, &mut dyn Iterator<Item = u32>),
        mesh: &Mesh,
        motion_bounds: &mut Vec<MotionBound>,
        (search, shares, moment): (PairSearch, [f32; 2], f32),
        earlier: Option<Earlier<'_>>,
    ) -> CandidateRange {
        let Some(own) = features_of(shape) else { return CandidateRange::default() };
        core::mem::swap(&mut self.motion_bounds, motion_bounds);
        set_given((&mut self.given, &mut self.given_groups), &own.features, sharp, shares);
        self.set_particles(search.distance);
        let range = self.begin_range();
        self.push_faces(shape, (search.distance, moment), earlier);
        for (number, block) in mesh.triangles.chunks(BLOCK).enumerate() {
            let parts = (&own.features, mesh);
            self.push_block(parts, search.distance, (number * BLOCK, block), (true, earlier));
        }
        self.pair_starts.push([self.edges.len() as u32, self.vertices.len() as u32]);
        self.end_range(range)
    }

    /// Pushes the pairs of a block of triangles and the given features. With `has_starts` it also stores
    /// where the pairs of each triangle start.
    #[inline(never)]
    fn push_block(
        &mut self,
        (features, mesh): (&Features, &Mesh),
        distance: f32,
        (first, block): (usize, &[[u32; 3]]),
        (has_starts, earlier): (bool, Option<Earlier<'_>>),
    ) {
        let is_searched =
            |corners: &&[u32; 3]| earlier.is_none_or(|earlier| earlier.has_moved(corners));
        let swept = |corners: &[u32]| {
            let mut all = SweptBox::EMPTY;
            corners.iter().for_each(|i| all.merge(&self.swept_particles[*i as usize]));
            all
        };
        let mut all = SweptBox::EMPTY;
        block.iter().filter(is_searched).for_each(|corners| all.merge(&swept(corners)));
        self.near_groups.clear();
        let groups = (0..).zip(&self.given_groups).filter(|(_, group)| group.may_meet(&all));
        self.near_groups.extend(groups.map(|(number, _)| number));
        let motion_bounds = &self.motion_bounds;
        let searched = TriangleBlock { features, motion_bounds, distance };
        for (triangle, corners) in (first..).zip(block) {
            if has_starts {
                self.pair_starts.push([self.edges.len() as u32, self.vertices.len() as u32]);
            }
            let pairs = (&mut self.edges, &mut self.vertices);
            if let Some(earlier) = earlier.filter(|earlier| !earlier.has_moved(corners)) {
                earlier.copy_pairs(triangle, pairs);
                continue;
            }
            if self.near_groups.is_empty() {
                continue;
            }
            let own = swept(corners);
            let groups = self.near_groups.iter().map(|group| *group as usize);
            let near = groups.filter(|group| self.given_groups[*group].may_meet(&own));
            let near = near.flat_map(|group| {
                let first = group * GROUP;
                &self.given[first..(first + GROUP).min(self.given.len())]
            });
            let near = near.filter(|(_, one)| one.may_meet(&own)).map(|(id, _)| *id);
            searched.push_pairs_of(mesh, triangle, near, pairs);
        }
    }

    fn begin_range(&self) -> CandidateRange {
        CandidateRange {
            edges: [self.edges.len() as u32; 2],
            vertices: [self.vertices.len() as u32; 2],
            first_face_start: self.face_starts.len() as u32,
            first_pair_start: self.pair_starts.len() as u32,
        }
    }

    fn end_range(&self, mut range: CandidateRange) -> CandidateRange {
        range.edges[1] = self.edges.len() as u32;
        range.vertices[1] = self.vertices.len() as u32;
        range
    }

    /// Pushes the faces within `distance` [m] of each particle.
    fn push_faces(
        &mut self,
        shape: &CollisionShape,
        (distance, moment): (f32, f32),
        earlier: Option<Earlier<'_>>,
    ) {
        let bounds = shape.bounds();
        let has_faces =
            matches!(shape, CollisionShape::ConvexHull(..) | CollisionShape::TriangleSurface(..));
        if !has_faces {
            return;
        }
        for (i, particle) in self.motion_bounds.iter().enumerate() {
            self.face_starts.push(self.faces.len() as u32);
            if let Some(earlier) = earlier.filter(|earlier| !earlier.moved[i]) {
                self.faces.extend_from_slice(earlier.pairs.of_range(&earlier.range).faces(i));
                continue;
            }
            if !particle.bounds.overlaps(&bounds) {
                continue;
            }
            let radius = particle.radius + distance;
            match shape {
                CollisionShape::ConvexHull(body, _) => {
                    body.push_candidate_faces(particle.center, radius, &mut self.faces);
                }
                CollisionShape::TriangleSurface(surface, _) => {
                    let point = (particle.center, &particle.motion);
                    let space = (particle.bounds, moment);
                    surface.push_triangles_near(point, radius, space, &mut self.faces);
                }
                _ => {}
            }
        }
        self.face_starts.push(self.faces.len() as u32);
    }

    /// Pushes the pairs of cloth edges with edge features and of cloth triangles with vertex
    /// features.
    fn push_feature_pairs(&mut self, shape: &CollisionShape, mesh: &Mesh, search: PairSearch) {
        let bounds = shape.bounds();
        self.set_particles(search.distance);
        let earlier = self.terrain_features.counts();
        if let CollisionShape::Heightfield(terrain) = shape {
            let mut all = Aabb::EMPTY;
            self.motion_bounds.iter().for_each(|particle| all.merge(&particle.bounds));
            let is_smooth = |edge: &EdgeFeature| search.is_smooth(&edge.bend);
            terrain.push_features(&all, is_smooth, &mut self.terrain_features);
        }
        for (number, block) in mesh.triangles.chunks(BLOCK).enumerate() {
            let mut block_bounds = Aabb::EMPTY;
            let corners = block.as_flattened().iter();
            corners.for_each(|i| block_bounds.merge(&self.motion_bounds[*i as usize].bounds));
            if !block_bounds.overlaps(&bounds) {
                continue;
            }
            let given = (&mut self.given, &mut self.given_groups);
            let terrain = core::mem::take(&mut self.terrain_features);
            let features = match features_of(shape) {
                Some(own) => {
                    let all = own.overlapping(block_bounds);
                    let sharp = all.filter(|id| !search.is_smooth(&own.features.bend(*id)));
                    set_given(given, &own.features, &mut { sharp }, [0.0; 2]);
                    &own.features
                }
                None => {
                    set_given(given, &terrain, &mut terrain.ids_since(earlier), [0.0; 2]);
                    &terrain
                }
            };
            let block = (number * BLOCK, block);
            self.push_block((features, mesh), search.distance, block, (false, None));
            self.terrain_features = terrain;
        }
    }
}

/// Sets the features that a search tests, with their swept boxes and those of their groups. `shares` are
/// the parts of the tick after and before now.
#[inline(never)]
fn set_given(
    (given, groups): (&mut Vec<(u32, SweptBox)>, &mut Vec<SweptBox>),
    features: &Features,
    ids: &mut dyn Iterator<Item = u32>,
    shares: [f32; 2],
) {
    given.clear();
    given.extend(ids.map(|id| (id, features.swept_box(id, shares))));
    groups.clear();
    groups.extend(given.chunks(GROUP).map(|group| {
        let mut all = SweptBox::EMPTY;
        group.iter().for_each(|(_, one)| all.merge(one));
        all
    }));
}

/// A block of cloth triangles and the features of one shape.
struct TriangleBlock<'a> {
    features: &'a Features,
    motion_bounds: &'a [MotionBound],
    /// [m]
    distance: f32,
}

impl TriangleBlock<'_> {
    /// Pushes the pairs of a triangle and of those of its edges that no triangle with a lower index
    /// has, with some features.
    fn push_pairs_of(
        &self,
        mesh: &Mesh,
        triangle: usize,
        near: impl Iterator<Item = u32>,
        (edges, vertices): (&mut Vec<EdgeEdgePair>, &mut Vec<VertexTrianglePair>),
    ) {
        let corners = mesh.triangles[triangle];
        let [a, b, c] = corners.map(|i| self.motion_bounds[i as usize]);
        let across = mesh.across[triangle];
        for feature in near {
            match self.features.get(feature) {
                Feature::Edge(edge) => {
                    for (k, ends) in [[a, b], [b, c], [c, a]].into_iter().enumerate() {
                        let is_own = across[k] == NONE || across[k] as usize > triangle;
                        if is_own && self.is_edge_near((edge, feature), ends) {
                            let particles = [corners[k], corners[(k + 1) % 3]];
                            edges.push(EdgeEdgePair { edge: feature, particles });
                        }
                    }
                }
                Feature::Vertex(index, vertex) => {
                    let relative = [a, b, c].map(|corner| corner.center - vertex.position);
                    let closest = interpolate(relative, triangle_to_origin(relative));
                    let distance2 = closest.length_squared();
                    let radius = max(max(a.radius, b.radius), c.radius);
                    let motions = [&a.motion, &b.motion, &c.motion];
                    let reach = self.features.reach(feature, motions);
                    let most = self.distance + radius + reach;
                    if distance2.is_nan() || distance2 <= most * most {
                        vertices.push(VertexTrianglePair { vertex: index, particles: corners });
                    }
                }
            }
        }
    }

    /// Returns whether a cloth edge may come near an edge feature; true for NaN.
    fn is_edge_near(&self, (edge, id): (&EdgeFeature, u32), [a, b]: [MotionBound; 2]) -> bool {
        let mut bounds = a.bounds;
        bounds.merge(&b.bounds);
        if !self.features.bounds(id).overlaps(&bounds) {
            return false;
        }
        let (s, t) = segment_to_segment(edge.ends, [a.center, b.center]);
        let on_feature = edge.ends[0] + (edge.ends[1] - edge.ends[0]) * s;
        let on_cloth = a.center + (b.center - a.center) * t;
        let distance2 = (on_cloth - on_feature).length_squared();
        let reach = self.features.reach(id, [&a.motion, &b.motion]);
        let most = self.distance + max(a.radius, b.radius) + reach;
        distance2.is_nan() || distance2 <= most * most
    }
}
