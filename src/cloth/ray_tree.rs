//! Cached tree over the triangles, and the searches along rays that walk it.
//!
//! The tree (`geometry::bvh`) is built over the rest shape by the first ray, so that its shape is
//! good in any pose, and refitted to the positions by the first ray after they changed. A cut, which
//! adds triangles, builds it again.
//!
//! ```text
//! ray ──▶ boxes of nodes ──▶ box of a triangle ──▶ triangle (Möller and Trumbore)
//! ```
//! Reads `World`; writes only the cache, behind a lock, so that rays need no `&mut Cloth`: one ray
//! updates it, and then rays on several threads share it. No tick locks.
//! Invariant: the result is that of a search through all triangles or particles in order. A hit lies
//! in the box of its triangle, and bounds of nodes contain these boxes also after rounding, so no
//! node is skipped that holds the result.

use crate::geometry::aabb::Aabb;
use crate::geometry::bvh::{Bvh, Visitor};
use crate::geometry::ray::{BoxRay, Ray, RayHit};
use crate::math::{max, min};
use crate::solver::world::World;
use glam::Vec3;
use std::sync::{PoisonError, RwLock};

/// Share of its largest half extent by which the box of a triangle is larger than the triangle, so
/// that rounding takes no hit on a border out of it.
const BOX_MARGIN: f32 = 1.0 / 32.0;

/// Bound of the relative rounding errors of the distance between a point and a ray.
const ROUNDING: f32 = 1.0e-6;

/// The cached tree of one cloth.
#[derive(Debug, Default)]
pub(super) struct RayTree(RwLock<CachedTree>);

#[derive(Debug, Default)]
struct CachedTree {
    /// Over the triangles; `None` before the first ray.
    tree: Option<Bvh>,
    triangle_count: usize,
    /// Particles that no triangle uses.
    loose: Vec<u32>,
    /// Topology and state revision of the bounds.
    revisions: [u32; 2],
}

/// A search through the tree and through particles without triangles.
pub(super) trait RaySearch: Visitor {
    /// Visits a particle that no triangle uses.
    fn visit_loose(&mut self, particle: u32);
}

impl RayTree {
    /// Runs a search over the tree of the current `revisions`, which it updates before if necessary.
    pub fn visit(&self, world: &World, revisions: [u32; 2], search: &mut dyn RaySearch) {
        let cached = self.0.read().unwrap_or_else(PoisonError::into_inner);
        if cached.tree.is_some() && cached.revisions == revisions {
            return cached.visit(search);
        }
        drop(cached);
        let mut cached = self.0.write().unwrap_or_else(PoisonError::into_inner);
        cached.update(world);
        cached.revisions = revisions;
        cached.visit(search);
    }

    /// Memory use [bytes].
    pub fn bytes(&self) -> usize {
        let cached = self.0.read().unwrap_or_else(PoisonError::into_inner);
        cached.tree.as_ref().map_or(0, Bvh::bytes) + size_of::<u32>() * cached.loose.capacity()
    }
}

impl CachedTree {
    #[inline(never)]
    fn update(&mut self, world: &World) {
        let triangles = &world.mesh.triangles;
        if self.tree.is_none() || self.triangle_count != triangles.len() {
            let site = |v: u32| world.rest[world.mesh.source[v as usize] as usize];
            let rest = triangles.iter().map(|triangle| Aabb::from_points(triangle.map(site)));
            self.tree = Some(Bvh::build(&Vec::from_iter(rest)));
            self.triangle_count = triangles.len();
            let mut is_used = vec![false; world.particles.len()];
            triangles.as_flattened().iter().for_each(|v| is_used[*v as usize] = true);
            self.loose =
                (0..).zip(is_used).filter(|(_, is_used)| !is_used).map(|(i, _)| i).collect();
        }
        if let Some(tree) = &mut self.tree {
            tree.refit(&|triangle| triangle_bounds(corners(world, triangle)));
        }
    }

    fn visit(&self, search: &mut dyn RaySearch) {
        if let Some(tree) = &self.tree {
            tree.visit(search);
        }
        self.loose.iter().for_each(|particle| search.visit_loose(*particle));
    }
}

fn corners(world: &World, triangle: u32) -> [Vec3; 3] {
    world.mesh.triangles[triangle as usize].map(|v| world.particles.x.get(v as usize))
}

/// The box that a hit of a triangle lies in.
#[inline(always)]
fn triangle_bounds(corners: [Vec3; 3]) -> Aabb {
    let tight = Aabb::from_points(corners);
    let Vec3 { x, y, z } = tight.half_extents();
    tight.expanded(max(max(x, y), z) * BOX_MARGIN)
}

/// Search for the first triangle along a ray.
pub(super) struct HitSearch<'a> {
    world: &'a World,
    ray: Ray,
    box_ray: BoxRay,
    /// Distance of the first hit so far; before it, the largest distance [m].
    limit: f32,
    /// The first hit so far and its triangle.
    pub first: Option<(u32, RayHit)>,
}

impl<'a> HitSearch<'a> {
    pub fn new(world: &'a World, ray: &Ray, max_distance: f32) -> Self {
        Self { world, ray: *ray, box_ray: BoxRay::new(ray), limit: max_distance, first: None }
    }

    /// Returns the hit on a triangle. Its distance is within the box, also where the ray grazes the
    /// triangle, so that its rounding errors are large.
    fn hit(&self, triangle: u32) -> Option<RayHit> {
        let corners = corners(self.world, triangle);
        let hit = self.ray.intersect_triangle(corners)?;
        let [enter, leave] = self.box_ray.range(&triangle_bounds(corners))?;
        Some(RayHit { distance: min(max(hit.distance, enter), leave), ..hit })
    }
}

impl Visitor for HitSearch<'_> {
    fn least_distance(&self, bounds: &Aabb) -> Option<f32> {
        self.box_ray.range(bounds).map(|[enter, _]| enter)
    }

    fn limit(&self) -> f32 {
        self.limit
    }

    fn visit(&mut self, triangle: u32) {
        let Some(hit) = self.hit(triangle) else { return };
        let is_nearer = match &self.first {
            None => hit.distance <= self.limit,
            Some((first, _)) => {
                hit.distance < self.limit || hit.distance == self.limit && triangle < *first
            }
        };
        if is_nearer {
            self.limit = hit.distance;
            self.first = Some((triangle, hit));
        }
    }
}

impl RaySearch for HitSearch<'_> {
    fn visit_loose(&mut self, _: u32) {}
}

/// Search for the particle nearest to a ray.
pub(super) struct ParticleSearch<'a> {
    world: &'a World,
    ray: Ray,
    /// Distance of the nearest particle so far; before it, the largest distance [m].
    least: f32,
    /// The nearest particle so far.
    pub nearest: Option<u32>,
}

impl<'a> ParticleSearch<'a> {
    pub fn new(world: &'a World, ray: &Ray, radius: f32) -> Self {
        Self { world, ray: *ray, least: radius, nearest: None }
    }
}

impl Visitor for ParticleSearch<'_> {
    /// The distance of the center, less the rounding errors and half of the diagonal.
    fn least_distance(&self, bounds: &Aabb) -> Option<f32> {
        let (center, half) = (bounds.center(), bounds.half_extents());
        let coordinates = center.abs() + half + self.ray.origin.abs();
        let rounding = ROUNDING * (coordinates.x + coordinates.y + coordinates.z);
        Some(self.ray.distance_to_point(center) - half.length() - rounding)
    }

    fn limit(&self) -> f32 {
        self.least
    }

    fn visit(&mut self, triangle: u32) {
        let vertices = self.world.mesh.triangles[triangle as usize];
        vertices.into_iter().for_each(|particle| self.visit_loose(particle));
    }
}

impl RaySearch for ParticleSearch<'_> {
    fn visit_loose(&mut self, particle: u32) {
        let distance = self.ray.distance_to_point(self.world.particles.x.get(particle as usize));
        let is_nearer = match self.nearest {
            None => distance <= self.least,
            Some(nearest) => distance < self.least || distance == self.least && particle < nearest,
        };
        if is_nearer {
            (self.nearest, self.least) = (Some(particle), distance);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::cloth::Cloth;
    use crate::cloth::desc::{GridDesc, MeshDesc, PinMode};
    use crate::state::collider_desc::{ColliderDesc, Shape};
    use proptest::prelude::*;

    /// The same searches through all triangles and particles in order.
    fn scan(cloth: &Cloth, ray: &Ray, reach: f32) -> (Option<(u32, f32)>, Option<u32>) {
        let world = &cloth.world;
        let mut hits = HitSearch::new(world, ray, reach);
        (0..world.mesh.triangles.len() as u32).for_each(|triangle| hits.visit(triangle));
        let mut particles = ParticleSearch::new(world, ray, reach);
        (0..world.particles.len() as u32).for_each(|particle| particles.visit_loose(particle));
        (hits.first.map(|(triangle, hit)| (triangle, hit.distance)), particles.nearest)
    }

    fn compare(cloth: &Cloth, ray: &Ray, reach: f32) -> bool {
        let hit = cloth.first_hit(ray, reach).map(|hit| (hit.triangle, hit.distance));
        let (expected, nearest) = scan(cloth, ray, reach);
        assert_eq!(hit, expected, "{ray:?} {reach}");
        assert_eq!(cloth.nearest_to(ray, reach), nearest, "{ray:?} {reach}");
        hit.is_some()
    }

    /// A cloth of two sheets and a loose particle, that lies on a ball.
    fn crumpled() -> Cloth {
        let grid = Cloth::grid(&GridDesc { columns: 14, rows: 11, ..GridDesc::default() }).unwrap();
        let mut desc = MeshDesc {
            positions: grid.positions().iter().map(|x| Vec3::new(x.x, 0.0, x.y)).collect(),
            indices: grid.indices().to_vec(),
            ..MeshDesc::default()
        };
        let count = desc.positions.len() as u32;
        desc.positions.extend(desc.positions.clone().iter().map(|x| *x + Vec3::Y * 0.02));
        desc.indices.extend(desc.indices.clone().iter().map(|v| v + count));
        desc.positions.push(Vec3::new(0.3, 0.9, -0.2));
        desc.settings.tearing = true;
        let mut cloth = Cloth::mesh(&desc).unwrap();
        let ball = ColliderDesc {
            shape: Shape::Sphere,
            position: Vec3::new(0.3, -0.25, -0.25),
            radius: 0.2,
            ..ColliderDesc::default()
        };
        cloth.add_collider(&ball).unwrap();
        cloth
    }

    fn direction() -> impl Strategy<Value = Vec3> {
        let axis = prop_oneof![Just(0.0_f32), Just(1.0), Just(-1.0), -1.0_f32..1.0];
        let vector = (axis.clone(), axis.clone(), axis).prop_map(|(x, y, z)| Vec3::new(x, y, z));
        vector.prop_filter("zero", |v| v.length() > 1e-3).prop_map(Vec3::normalize)
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(64))]

        #[test]
        fn rays_hit_what_a_scan_hits_also_after_ticks_tears_and_cuts(
            rays in proptest::collection::vec((direction(), direction(), 0..308_usize, 0.0_f32..2.0), 24),
            edit in 0..4_u32,
            shift in prop_oneof![Just(Vec3::ZERO), Just(Vec3::new(700.3, -2.0, 5.0))],
        ) {
            let mut cloth = crumpled();
            cloth.teleport(shift, glam::Quat::IDENTITY).unwrap();
            let mut hits = 0;
            for stage in 0..4 {
                match (stage, edit) {
                    (0, _) => {}
                    (_, 0) => { cloth.cut(shift + Vec3::new(0.1 * stage as f32, 1.0, -2.0), shift + Vec3::new(0.1 * stage as f32, 1.0, 2.0), Vec3::Y * -3.0).unwrap(); }
                    (_, 1) => { let triangle = cloth.world.mesh.triangles[70 * stage]; cloth.tear_edge(triangle[0], triangle[1]).unwrap(); }
                    (3, 2) => cloth.reset(),
                    _ => cloth.step(8),
                }
                for (aside, direction, towards, reach) in &rays {
                    let x = cloth.world.particles.x.get(*towards);
                    let origin = x - *direction + *aside * 0.02 * stage as f32;
                    hits += usize::from(compare(&cloth, &Ray { origin, direction: *direction }, *reach));
                    hits += usize::from(compare(&cloth, &Ray { origin, direction: *direction }, f32::INFINITY));
                }
            }
            prop_assert!(hits > 0);
        }
    }

    #[test]
    fn of_equal_hits_the_lowest_index_is_returned() {
        // The diagonals of a flat sheet belong to two triangles; its nodes to up to six.
        let desc = GridDesc { columns: 9, rows: 9, pin_mode: PinMode::None, ..GridDesc::default() };
        let cloth = Cloth::grid(&desc).unwrap();
        for particle in 0..81 {
            let origin = cloth.world.particles.x.get(particle) + Vec3::Z;
            let ray = Ray { origin, direction: Vec3::NEG_Z };
            assert!(compare(&cloth, &ray, 2.0));
            let triangle = cloth.first_hit(&ray, 2.0).unwrap().triangle;
            let lowest = cloth.indices().iter().position(|v| *v as usize == particle).unwrap() / 3;
            assert_eq!(triangle as usize, lowest);
        }
    }

    #[test]
    fn a_ray_in_the_plane_of_a_tilted_sheet_hits_nothing_beside_it() {
        let tilted = Vec3::new(1.0, 0.37, 0.21).normalize();
        let down = tilted.cross(Vec3::new(0.2, 0.1, 1.0)).normalize();
        let desc = GridDesc { right: tilted, down, ..GridDesc::default() };
        let cloth = Cloth::grid(&desc).unwrap();
        for i in 1..400 {
            let origin = tilted * (-2.0 - 0.01 * i as f32) - down * (0.05 * i as f32);
            let ray = Ray { origin, direction: tilted };
            assert_eq!(cloth.first_hit(&ray, f32::INFINITY), None, "{i}");
            compare(&cloth, &ray, f32::INFINITY);
        }
    }

    #[test]
    fn only_rays_make_the_tree_and_clones_make_their_own() {
        fn is_shared<T: Send + Sync>(_: &T) {}
        let cloth = crumpled();
        is_shared(&cloth);
        let bytes = |cloth: &Cloth| cloth.stats().bytes;
        let before = [bytes(&cloth), bytes(&cloth.clone())];
        let ray =
            |cloth: &Cloth| cloth.raycast(Vec3::new(0.3, 2.0, -0.2), Vec3::NEG_Y, 9.0).unwrap();
        let hit = ray(&cloth);
        assert!(hit.is_some() && bytes(&cloth) > before[0]);
        assert_eq!(bytes(&cloth.clone()), before[1]);
        std::thread::scope(|scope| {
            let threads = [0; 4].map(|_| scope.spawn(|| ray(&cloth)));
            threads.into_iter().for_each(|one| assert_eq!(one.join().unwrap(), hit));
        });
    }
}
