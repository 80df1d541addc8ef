//! Stage `Pairs` for shapes of flat facets: which facets are near each particle, and which edges and
//! triangles of the cloth are near what sticks out.
//!
//! A particle, and so all of an edge or triangle, moves by `reach` at most before all is found anew; so
//! whatever is nearer than that now is all that may touch until then.

use crate::geometry::aabb::Aabb;
use crate::geometry::closest_points::{interpolate, segment_to_segment, triangle_to_origin};
use crate::geometry::features::{Bend, EdgeFeature, Feature, Features, ShapeFeatures};
use crate::geometry::shape::CollisionShape;
use crate::math::max;
use crate::mesh::{Mesh, NONE};
use glam::Vec3;

/// Triangles that are looked at together, which neighbours of a grid mostly share.
const BLOCK: usize = 32;

/// What was found, of all colliders.
#[derive(Clone, Debug, Default)]
pub(crate) struct Pairs {
    /// Ridges and edges of the cloth.
    edges: Vec<EdgePair>,
    /// Corners and triangles of the cloth.
    tips: Vec<TipPair>,
    /// Where the facets of each particle begin in `facets`.
    starts: Vec<u32>,
    facets: Vec<u32>,
    /// What sticks out of heightfields near the cloth.
    ground: Features,
    seen: Vec<Seen>,
    /// Features near a block, and where they are.
    around: Vec<(u32, Aabb)>,
}

/// A ridge, and an edge of the cloth.
#[derive(Clone, Copy, Debug)]
pub(crate) struct EdgePair {
    pub ridge: u32,
    pub ends: [u32; 2],
}

/// A corner, and a triangle of the cloth.
#[derive(Clone, Copy, Debug)]
pub(crate) struct TipPair {
    pub corner: u32,
    pub corners: [u32; 3],
}

/// The part of `Pairs` that is one collider's.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Span {
    edges: [u32; 2],
    tips: [u32; 2],
    start: u32,
}

/// What was found near one collider.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Sharp<'a> {
    pub edges: &'a [EdgePair],
    pub tips: &'a [TipPair],
    starts: &'a [u32],
    facets: &'a [u32],
    ground: &'a Features,
}

impl<'a> Sharp<'a> {
    /// The facets near a particle.
    pub fn facets(&self, i: usize) -> &'a [u32] {
        match self.starts.get(i..i + 2) {
            Some(range) => &self.facets[range[0] as usize..range[1] as usize],
            None => &[],
        }
    }

    /// What pairs speak of.
    pub fn features(&self, collision_shape: &'a CollisionShape) -> &'a Features {
        relief_of(collision_shape).map_or(self.ground, |relief| &relief.features)
    }
}

/// Where a particle is on its way, as a collider sees it: within `radius` of a place.
#[derive(Clone, Copy, Debug)]
struct Seen {
    at: Vec3,
    radius: f32,
    /// All that it may touch until all is found anew.
    bounds: Aabb,
}

impl Seen {
    fn new(places: [Vec3; 4], reach: f32) -> Self {
        let at = (places[0] + places[1] + places[2] + places[3]) * 0.25;
        let mut radius2 = 0.0;
        for place in places {
            radius2 = max((place - at).length_squared(), radius2);
        }
        let radius = radius2.sqrt();
        let far = Vec3::splat(radius + reach);
        Self { at, radius, bounds: Aabb { low: at - far, high: at + far } }
    }
}

fn relief_of(collision_shape: &CollisionShape) -> Option<&ShapeFeatures> {
    match collision_shape {
        CollisionShape::Cuboid(_, relief)
        | CollisionShape::ConvexHull(_, relief)
        | CollisionShape::TriangleSurface(_, relief) => Some(relief),
        _ => None,
    }
}

/// How near what is to be found is [m], and which bends nobody needs to look at.
#[derive(Clone, Copy, Debug)]
pub(super) struct Search {
    pub reach: f32,
    pub mild: Bend,
}

impl Search {
    fn is_mild(&self, bend: &Bend) -> bool {
        bend.fold <= self.mild.fold && bend.per_metre <= self.mild.per_metre
    }
}

impl Pairs {
    /// Room for what is usual: each of a few colliders of flat facets is near much of the cloth. What there is
    /// no room for yet is made room for when it is found first.
    pub fn reserve(&mut self, bodies: usize, particles: usize, triangles: usize) {
        let few = bodies.min(4);
        fn reserve<T>(list: &mut Vec<T>, count: usize) {
            list.reserve_exact(count.saturating_sub(list.len()));
        }
        reserve(&mut self.edges, 4 * few * triangles);
        reserve(&mut self.tips, few * triangles);
        reserve(&mut self.starts, bodies * (particles + 1));
        reserve(&mut self.facets, 8 * few * particles);
        reserve(&mut self.around, triangles);
        self.ground.reserve(triangles);
        reserve(&mut self.seen, particles);
    }

    pub fn clear(&mut self) {
        self.edges.clear();
        self.tips.clear();
        self.starts.clear();
        self.facets.clear();
        self.ground.clear();
    }

    /// What was found for a collider.
    pub fn of(&self, span: &Span) -> Sharp<'_> {
        Sharp {
            edges: &self.edges[span.edges[0] as usize..span.edges[1] as usize],
            tips: &self.tips[span.tips[0] as usize..span.tips[1] as usize],
            starts: &self.starts[span.start as usize..],
            facets: &self.facets,
            ground: &self.ground,
        }
    }

    /// Finds what is near a shape, which sees each of `count` particles in `places`.
    pub fn find(
        &mut self,
        collision_shape: &CollisionShape,
        mesh: &Mesh,
        count: usize,
        places: impl Fn(usize) -> [Vec3; 4],
        search: Search,
    ) -> Span {
        let (edges, tips) = (self.edges.len() as u32, self.tips.len() as u32);
        let start = self.starts.len() as u32;
        self.seen.clear();
        self.seen.extend((0..count).map(|i| Seen::new(places(i), search.reach)));
        self.find_facets(collision_shape, search.reach);
        self.find_features(collision_shape, mesh, search);
        let (edges, tips) = ([edges, self.edges.len() as u32], [tips, self.tips.len() as u32]);
        Span { edges, tips, start }
    }

    fn find_facets(&mut self, collision_shape: &CollisionShape, reach: f32) {
        let bounds = collision_shape.bounds();
        if !matches!(
            collision_shape,
            CollisionShape::ConvexHull(..) | CollisionShape::TriangleSurface(..)
        ) {
            return;
        }
        for seen in &self.seen {
            self.starts.push(self.facets.len() as u32);
            if !seen.bounds.overlaps(&bounds) {
                continue;
            }
            match collision_shape {
                CollisionShape::ConvexHull(body, _) => {
                    body.find_foremost(seen.at, seen.radius + reach, &mut self.facets);
                }
                CollisionShape::TriangleSurface(surface, _) => {
                    surface.find_near(seen.at, seen.radius + reach, &mut self.facets);
                }
                _ => {}
            }
        }
        self.starts.push(self.facets.len() as u32);
    }

    fn find_features(&mut self, collision_shape: &CollisionShape, mesh: &Mesh, search: Search) {
        let bounds = collision_shape.bounds();
        let ground = self.ground.counts();
        if let CollisionShape::Heightfield(terrain) = collision_shape {
            let mut all = Aabb::EMPTY;
            self.seen.iter().for_each(|seen| all.merge(&seen.bounds));
            terrain.find_under(&all, |ridge| search.is_mild(&ridge.bend), &mut self.ground);
        }
        for (number, block) in mesh.triangles.chunks(BLOCK).enumerate() {
            let mut place = Aabb::EMPTY;
            block.as_flattened().iter().for_each(|i| place.merge(&self.seen[*i as usize].bounds));
            if !place.overlaps(&bounds) {
                continue;
            }
            self.around.clear();
            let features = match relief_of(collision_shape) {
                Some(relief) => {
                    let all = relief.near(place);
                    let rough = all.filter(|at| !search.is_mild(&relief.features.bend(*at)));
                    self.around.extend(rough.map(|at| (at, relief.features.bounds(at))));
                    &relief.features
                }
                None => {
                    let own = self.ground.numbers_after(ground);
                    let placed = own.map(|at| (at, self.ground.bounds(at)));
                    self.around.extend(placed.filter(|(_, bounds)| bounds.overlaps(&place)));
                    &self.ground
                }
            };
            let first = number * BLOCK;
            let block = Block { features, seen: &self.seen, reach: search.reach };
            for triangle in first..(first + BLOCK).min(mesh.triangles.len()) {
                block.pair(mesh, triangle, &self.around, &mut self.edges, &mut self.tips);
            }
        }
    }
}

/// Triangles of the cloth and features in the same place.
struct Block<'a> {
    features: &'a Features,
    seen: &'a [Seen],
    reach: f32,
}

impl Block<'_> {
    /// Finds the pairs of a triangle and those of its edges that no triangle before it has.
    fn pair(
        &self,
        mesh: &Mesh,
        triangle: usize,
        around: &[(u32, Aabb)],
        edges: &mut Vec<EdgePair>,
        tips: &mut Vec<TipPair>,
    ) {
        let corners = mesh.triangles[triangle];
        let [a, b, c] = corners.map(|i| self.seen[i as usize]);
        let mut place = a.bounds;
        place.merge(&b.bounds);
        place.merge(&c.bounds);
        let across = mesh.across[triangle];
        for (feature, _) in around.iter().filter(|(_, bounds)| bounds.overlaps(&place)) {
            match self.features.at(*feature) {
                Feature::EdgeFeature(ridge) => {
                    for (k, ends) in [[a, b], [b, c], [c, a]].into_iter().enumerate() {
                        let is_own = across[k] == NONE || across[k] as usize > triangle;
                        if is_own && self.is_edge_near(ridge, ends) {
                            let ends = [corners[k], corners[(k + 1) % 3]];
                            edges.push(EdgePair { ridge: *feature, ends });
                        }
                    }
                }
                Feature::Corner(number, corner) => {
                    let now = [a, b, c].map(|seen| seen.at - corner.at);
                    let apart2 = interpolate(now, triangle_to_origin(now)).length_squared();
                    let most = self.reach + max(max(a.radius, b.radius), c.radius);
                    if apart2.is_nan() || apart2 <= most * most {
                        tips.push(TipPair { corner: number, corners });
                    }
                }
            }
        }
    }

    fn is_edge_near(&self, ridge: &EdgeFeature, [a, b]: [Seen; 2]) -> bool {
        let mut place = a.bounds;
        place.merge(&b.bounds);
        if !Aabb::from_points(ridge.ends).overlaps(&place) {
            return false;
        }
        let (s, t) = segment_to_segment(ridge.ends, [a.at, b.at]);
        let on_ridge = ridge.ends[0] + (ridge.ends[1] - ridge.ends[0]) * s;
        let apart2 = (a.at + (b.at - a.at) * t - on_ridge).length_squared();
        let most = self.reach + max(a.radius, b.radius);
        // What is not a number is near.
        apart2.is_nan() || apart2 <= most * most
    }
}
