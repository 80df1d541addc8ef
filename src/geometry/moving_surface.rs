//! Triangle surfaces whose vertices move: the bodies of characters.
//!
//! ```text
//! vertex at time t of a tick     last + t (next − last)
//! tree                           boxes of both ends of the tick, refitted when the motion changes
//! triangles and features         posed where the cloth is, for the substep that asks
//! ```
//! All features of the mesh are kept, also those of flat places, which may bend later; a flat one
//! counts as smooth. In a search for pairs everything stands where it is then, and knows its motion
//! in the tick. The first search of a tick measures how much all edges near the cloth bend, then and
//! at the end of the tick, and poses those that are sharp; other features are posed only beside long
//! triangles.
//!
//! Reads vertices and the pairs near the cloth; writes its triangles and features.
//! Invariant: contacts depend only on the vertices at both ends of the tick, never on earlier poses.

use crate::geometry::aabb::Aabb;
use crate::geometry::bends::SurfaceBend;
use crate::geometry::collision_shape::CollisionShape;
use crate::geometry::features::{Features, ShapeFeatures};
use crate::geometry::moving_features::FeatureSources;
use crate::geometry::relative_motion::{PartMotion, RigidStep};
use crate::geometry::solid_mesh::ClosestPointQuery;
use crate::geometry::swept_box::MovingBox;
use crate::geometry::triangle_surface::TriangleSurface;
use crate::math::{lerp, max};
use glam::Vec3;

/// The first search of a tick measures edges in a space that is larger than it needs by this share of
/// its half size, so that later ones need not.
const MEASURED_MARGIN: f32 = 0.1;

/// A moving triangle surface.
#[derive(Clone, Debug)]
pub(crate) struct MovingSurface {
    /// A triangle surface.
    shape: CollisionShape,
    /// The vertices of each triangle.
    corners: Vec<[u32; 3]>,
    /// Scratch: the vertices at the end and at the start of the part of the tick that is posed [m].
    placed: [Vec<Vec3>; 2],
    sources: FeatureSources,
    /// What the first search of the tick found near the cloth: triangles, and sharp features with the
    /// edges that these need.
    near: ActiveParts,
    /// The number of its edges, from the first one on, that are sharp.
    sharp_edges: usize,
    /// Scratch: some parts near the cloth.
    some: ActiveParts,
    /// What can touch the cloth, of that.
    active: ActiveParts,
    /// The space in which the first search of the tick measured edges.
    measured: Option<Aabb>,
    /// Whether the tree of the features bounds their motion in this tick.
    is_feature_tree_current: bool,
    /// The part of the tick that is posed: its end and its length, in ticks.
    posed: Option<[f32; 2]>,
    /// Whether everything is posed, at rest.
    is_settled: bool,
}

/// Triangles, edges and vertices, each listed once.
#[derive(Clone, Debug, Default)]
struct ActiveParts {
    triangles: Marked,
    edges: Marked,
    vertices: Marked,
}

/// A list of numbers, each at most once.
#[derive(Clone, Debug, Default)]
struct Marked {
    list: Vec<u32>,
    is_listed: Vec<bool>,
}

impl Marked {
    /// Makes an empty list for numbers below `count`.
    fn new(count: usize) -> Self {
        Self { list: Vec::with_capacity(count), is_listed: vec![false; count] }
    }

    fn clear(&mut self) {
        self.list.iter().for_each(|i| self.is_listed[*i as usize] = false);
        self.list.clear();
    }

    fn insert(&mut self, i: u32) {
        if !core::mem::replace(&mut self.is_listed[i as usize], true) {
            self.list.push(i);
        }
    }
}

impl ActiveParts {
    fn new(counts: [usize; 3]) -> Self {
        let [triangles, edges, vertices] = counts.map(Marked::new);
        Self { triangles, edges, vertices }
    }

    fn clear(&mut self) {
        self.triangles.clear();
        self.edges.clear();
        self.vertices.clear();
    }

    /// Adds a vertex and the edges that its normal cone needs.
    fn insert_vertex(&mut self, vertex: u32, sources: &FeatureSources) {
        self.vertices.insert(vertex);
        sources.incident(vertex).iter().for_each(|[edge, _]| self.edges.insert(*edge));
    }
}

/// The vertices of a mesh at both ends of a tick.
#[derive(Clone, Copy, Debug)]
pub(crate) struct MovingVertices<'a> {
    pub last: &'a [Vec3],
    pub next: &'a [Vec3],
}

impl MovingVertices<'_> {
    /// Sets where the vertices are at the end and at the start of a part of the tick, given by its end
    /// and its length, in ticks.
    #[inline(never)]
    fn place(&self, [end, length]: [f32; 2], [now, before]: &mut [Vec<Vec3>; 2]) {
        let vertices = self.last.iter().zip(self.next);
        for ((now, before), (last, next)) in now.iter_mut().zip(before).zip(vertices) {
            *now = if end == 1.0 { *next } else { lerp(*last, *next, end) };
            *before = *now - (*next - *last) * length;
        }
    }

    fn motion(&self, vertex: u32) -> Vec3 {
        self.next[vertex as usize] - self.last[vertex as usize]
    }

    /// The boxes of some vertices at both ends of the tick.
    #[inline(never)]
    fn boxes<const COUNT: usize>(&self, corners: [u32; COUNT]) -> MovingBox {
        let at = |all: &[Vec3]| Aabb::from_points(corners.map(|v| all[v as usize]));
        MovingBox::new([at(self.last), at(self.next)])
    }

    /// The motion of a part with these corners in the whole tick.
    fn motion_of<const COUNT: usize>(&self, vertices: [u32; COUNT]) -> PartMotion {
        PartMotion::new(vertices.map(|v| self.motion(v)))
    }
}

impl MovingSurface {
    /// Makes a surface of `triangles`, which have an area. `None` if there are none.
    pub fn new(positions: &[Vec3], triangles: Vec<[u32; 3]>) -> Option<Self> {
        let mut surface = TriangleSurface::new(positions, &triangles)?;
        surface.make_movable();
        let (features, sources) = FeatureSources::build(positions, &triangles);
        let [edges, vertices] = features.features.counts();
        let counts = [triangles.len(), edges, vertices];
        Some(Self {
            shape: CollisionShape::TriangleSurface(surface, features),
            corners: triangles,
            placed: [positions.to_vec(), positions.to_vec()],
            sources,
            near: ActiveParts::new(counts),
            sharp_edges: 0,
            some: ActiveParts::new(counts),
            active: ActiveParts::new(counts),
            measured: None,
            is_feature_tree_current: false,
            posed: None,
            is_settled: false,
        })
    }

    /// The surface as it is posed.
    pub fn shape(&self) -> &CollisionShape {
        &self.shape
    }

    fn parts(&mut self) -> Option<(&mut TriangleSurface, &mut ShapeFeatures)> {
        match &mut self.shape {
            CollisionShape::TriangleSurface(surface, features) => Some((surface, features)),
            _ => None,
        }
    }

    /// Refits the tree of the triangles to the motion of the vertices in this tick.
    pub fn refit(&mut self, vertices: MovingVertices<'_>) {
        (self.measured, self.posed, self.is_settled) = (None, None, false);
        self.is_feature_tree_current = false;
        let corners = core::mem::take(&mut self.corners);
        if let Some((surface, _)) = self.parts() {
            surface.refit(&|triangle| vertices.boxes(corners[triangle as usize]));
        }
        self.corners = corners;
    }

    /// Refits the tree of the features likewise, once a tick.
    fn refit_features(&mut self, vertices: MovingVertices<'_>) {
        if core::mem::replace(&mut self.is_feature_tree_current, true) {
            return;
        }
        let sources = core::mem::take(&mut self.sources);
        if let Some((_, features)) = self.parts() {
            features.refit(&|id| match sources.edge_ends(id) {
                Some(ends) => vertices.boxes(ends).bounds(),
                None => vertices.boxes([sources.vertex(id)]).bounds(),
            });
        }
        self.sources = sources;
    }

    /// Poses everything near `bounds`, in the frame of the surface, for a search for pairs: where it is
    /// at `moment` of the tick. `is_sharp` says which bends the search asks for.
    pub fn pose_for_search(
        &mut self,
        vertices: MovingVertices<'_>,
        bounds: Aabb,
        moment: f32,
        is_sharp: &dyn Fn(&SurfaceBend) -> bool,
    ) {
        if self.is_settled {
            return;
        }
        let is_known = self.is_measured(&bounds);
        let mut near = core::mem::take(&mut self.near);
        if !is_known {
            let all = bounds.expanded(bounds.half_extents().max_element() * MEASURED_MARGIN);
            self.list_near(vertices, all, moment, is_sharp, &mut near);
            self.measured = Some(all);
        }
        self.pose_parts(vertices, &near, [moment, 0.0]);
        if !is_known {
            self.set_motions(vertices, &near);
        }
        self.near = near;
        self.posed = None;
    }

    /// Returns whether the first search of this tick measured all of `bounds`.
    pub fn is_measured(&self, bounds: &Aabb) -> bool {
        self.measured.is_some_and(|measured| measured.contains(bounds))
    }

    /// Poses the triangles near some boxes, which are measured, and all sharp features near the cloth,
    /// for a search for pairs at `moment` of a tick in which the surface moves.
    pub fn pose_some_for_search(
        &mut self,
        vertices: MovingVertices<'_>,
        boxes: impl Iterator<Item = Aabb>,
        moment: f32,
    ) {
        let (mut some, near) = (core::mem::take(&mut self.some), core::mem::take(&mut self.near));
        some.clear();
        if let CollisionShape::TriangleSurface(surface, _) = &self.shape {
            boxes.for_each(|bounds| {
                surface.overlapping(bounds).for_each(|triangle| some.triangles.insert(triangle));
            });
        }
        near.edges.list.iter().for_each(|edge| some.edges.insert(*edge));
        near.vertices.list.iter().for_each(|vertex| some.vertices.insert(*vertex));
        self.pose_parts(vertices, &some, [moment, 0.0]);
        (self.some, self.near, self.posed) = (some, near, None);
    }

    /// Returns the ids of the sharp features near the cloth.
    pub fn sharp_features(&self) -> impl Iterator<Item = u32> + '_ {
        let edge_count = self.sources.counts()[0];
        let vertices = self.near.vertices.list.iter().map(move |vertex| vertex + edge_count);
        self.near.edges.list[..self.sharp_edges].iter().copied().chain(vertices)
    }

    /// Sets what can touch the cloth, as a search found it: triangles, edge features and vertex
    /// features by their indices.
    pub fn activate(
        &mut self,
        triangles: impl Iterator<Item = u32>,
        edges: impl Iterator<Item = u32>,
        vertices: impl Iterator<Item = u32>,
    ) {
        let Self { active, sources, .. } = self;
        active.clear();
        triangles.for_each(|triangle| active.triangles.insert(triangle));
        edges.for_each(|edge| active.edges.insert(edge));
        vertices.for_each(|vertex| active.insert_vertex(vertex, sources));
        self.posed = None;
    }

    /// Poses what can touch the cloth at the end of a part of the tick, with the motion in it. `part`
    /// is its end and its length, in ticks.
    pub fn pose(&mut self, vertices: MovingVertices<'_>, part: [f32; 2]) {
        if self.is_settled || self.posed == Some(part) {
            return;
        }
        let active = core::mem::take(&mut self.active);
        self.pose_parts(vertices, &active, part);
        (self.active, self.posed) = (active, Some(part));
    }

    /// Poses all features in some boxes likewise, also smooth ones.
    pub fn pose_features(
        &mut self,
        vertices: MovingVertices<'_>,
        boxes: impl Iterator<Item = Aabb>,
        part: [f32; 2],
    ) {
        if self.is_settled {
            return;
        }
        self.refit_features(vertices);
        let mut some = core::mem::take(&mut self.some);
        some.clear();
        if let CollisionShape::TriangleSurface(_, features) = &self.shape {
            let edge_count = self.sources.counts()[0];
            for id in boxes.flat_map(|bounds| features.overlapping(bounds)) {
                match id.checked_sub(edge_count) {
                    Some(vertex) => some.insert_vertex(vertex, &self.sources),
                    None => some.edges.insert(id),
                }
            }
        }
        self.pose_parts(vertices, &some, part);
        self.some = some;
    }

    /// Lists the triangles that overlap `bounds` in the tick, and the features that are sharp at `moment`
    /// or at the end of the tick.
    fn list_near(
        &mut self,
        vertices: MovingVertices<'_>,
        bounds: Aabb,
        moment: f32,
        is_sharp: &dyn Fn(&SurfaceBend) -> bool,
        near: &mut ActiveParts,
    ) {
        vertices.place([moment, 0.0], &mut self.placed);
        let CollisionShape::TriangleSurface(surface, _) = &self.shape else { return };
        near.clear();
        let ActiveParts { triangles, edges, vertices: ends } = near;
        surface.overlapping(bounds).for_each(|triangle| triangles.insert(triangle));
        self.sources.visit_sharp_edges(
            [&self.placed[0], vertices.next],
            |triangle| triangles.is_listed[triangle as usize],
            is_sharp,
            |edge, both| {
                edges.insert(edge);
                both.iter().for_each(|end| ends.insert(*end));
            },
        );
        self.sharp_edges = edges.list.len();
        for vertex in &ends.list {
            self.sources.incident(*vertex).iter().for_each(|[edge, _]| edges.insert(*edge));
        }
    }

    /// Poses everything where it is at rest.
    pub fn settle(&mut self, vertices: MovingVertices<'_>) {
        if self.is_settled {
            return;
        }
        self.near.clear();
        (0..self.corners.len() as u32).for_each(|triangle| self.near.triangles.insert(triangle));
        let [edges, features] = self.sources.counts();
        (0..edges).for_each(|edge| self.near.edges.insert(edge));
        (0..features).for_each(|vertex| self.near.vertices.insert(vertex));
        self.sharp_edges = edges as usize;
        let near = core::mem::take(&mut self.near);
        self.pose_parts(vertices, &near, [1.0, 0.0]);
        self.set_motions(vertices, &near);
        self.near = near;
        self.refit_features(vertices);
        self.is_settled = true;
    }

    /// Poses parts at the time `end` of the tick, with the motion in the part of length `length` that
    /// ends then.
    #[inline(never)]
    fn pose_parts(
        &mut self,
        vertices: MovingVertices<'_>,
        parts: &ActiveParts,
        [end, length]: [f32; 2],
    ) {
        vertices.place([end, length], &mut self.placed);
        let Self {
            shape: CollisionShape::TriangleSurface(surface, features),
            corners,
            placed: [now, before],
            sources,
            ..
        } = self
        else {
            return;
        };
        for triangle in &parts.triangles.list {
            let own = corners[*triangle as usize];
            let posed = [&*now, before].map(|at| own.map(|v| at[v as usize]));
            surface.pose(*triangle, posed[0], posed[1]);
        }
        let features: &mut Features = &mut features.features;
        for edge in &parts.edges.list {
            let ends = sources.pose_edge(features, *edge, now);
            if length == 0.0 {
                features.motions[*edge as usize].step = RigidStep::NONE;
                continue;
            }
            let middle = |at: &[Vec3]| (at[ends[0] as usize] + at[ends[1] as usize]) * 0.5;
            features.motions[*edge as usize].step = RigidStep::new(
                [middle(before), middle(now)],
                sources.edge_directions(*edge, before),
                sources.edge_directions(*edge, now),
            );
        }
        let edge_count = features.edges.len();
        for vertex in &parts.vertices.list {
            let own = sources.pose_vertex(features, *vertex, now) as usize;
            features.motions[edge_count + *vertex as usize].step = if length == 0.0 {
                RigidStep::NONE
            } else {
                RigidStep::new(
                    [before[own], now[own]],
                    sources.vertex_directions(*vertex, before),
                    sources.vertex_directions(*vertex, now),
                )
            };
        }
        parts.vertices.list.iter().for_each(|vertex| sources.widen_at_pole(features, *vertex));
    }

    /// Sets the motion of parts in the tick.
    fn set_motions(&mut self, vertices: MovingVertices<'_>, parts: &ActiveParts) {
        let Self {
            shape: CollisionShape::TriangleSurface(surface, features),
            corners,
            sources,
            ..
        } = self
        else {
            return;
        };
        for triangle in &parts.triangles.list {
            surface.set_motion(*triangle, vertices.motion_of(corners[*triangle as usize]));
        }
        let edge_count = features.features.edges.len() as u32;
        let motions = &mut features.features.motions;
        for edge in &parts.edges.list {
            if let Some(ends) = sources.edge_ends(*edge) {
                motions[*edge as usize].whole = vertices.motion_of(ends);
            }
        }
        for vertex in &parts.vertices.list {
            let id = edge_count + *vertex;
            motions[id as usize].whole = vertices.motion_of([sources.vertex(id)]);
        }
    }

    /// Visits the triangles near the point of a query, where they are at the start of the tick.
    pub fn visit_near(&self, vertices: MovingVertices<'_>, query: &mut ClosestPointQuery) {
        if let CollisionShape::TriangleSurface(surface, _) = &self.shape {
            let at = |v: u32| vertices.last[v as usize];
            surface.visit_near(query, Some(&|triangle| self.corners[triangle as usize].map(at)));
        }
    }

    /// Returns the largest distance that a point which moves along `path` from `at` moves relative to
    /// triangles near it in the tick, and at least `least` [m].
    pub fn longest_relative_path(
        &self,
        vertices: MovingVertices<'_>,
        [at, path]: [Vec3; 2],
        margin: f32,
        least: f32,
    ) -> f32 {
        let CollisionShape::TriangleSurface(surface, _) = &self.shape else { return least };
        let bounds = Aabb::from_points([at, at + path]).expanded(margin);
        let mut longest2 = least * least;
        for triangle in surface.overlapping(bounds) {
            let own = self.corners[triangle as usize];
            let [a, b, c] = own.map(|v| vertices.motion(v));
            let relative2 = (path - (a + b + c) * (1.0 / 3.0)).length_squared();
            if relative2 > longest2 && vertices.boxes(own).bounds().overlaps(&bounds) {
                longest2 = relative2;
            }
        }
        max(longest2.sqrt(), least)
    }

    /// Returns the box of the displacements of the triangles that may overlap `bounds` in the tick [m];
    /// `None` if there are none.
    pub fn motions_near(&self, vertices: MovingVertices<'_>, bounds: Aabb) -> Option<Aabb> {
        let CollisionShape::TriangleSurface(surface, _) = &self.shape else { return None };
        let mut motions = None;
        for triangle in surface.overlapping(bounds) {
            let all: &mut Aabb = motions.get_or_insert(Aabb::EMPTY);
            self.corners[triangle as usize].iter().for_each(|v| all.include(vertices.motion(*v)));
        }
        motions
    }
}
