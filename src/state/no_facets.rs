//! Stand-in for `facet_desc` and `deformation` in builds without the feature `facet-colliders`:
//! shapes with facets are refused, and no collider deforms.
//!
//! [`deformation::Deformation`] has no values, so the compiler removes every branch that handles
//! one.

use crate::error::{Error, Result};
use crate::geometry::collision_shape::CollisionShape;
use crate::state::collider_desc::ColliderDesc;
use glam::Vec3;
use serde::{Deserialize, Deserializer};

const REFUSAL: Error = Error::MissingFeature {
    what: "a convex, mesh or heightfield collider",
    feature: "facet-colliders",
};

impl ColliderDesc {
    pub(super) fn check_facets(&self) -> Result<()> {
        Err(REFUSAL)
    }

    pub(super) fn facet_shape(&self) -> Result<CollisionShape> {
        Err(REFUSAL)
    }

    pub(crate) fn mesh_surface(&self) -> (Vec<Vec3>, Vec<[u32; 3]>) {
        (Vec::new(), Vec::new())
    }

    pub(crate) fn orientation(&self) -> Result<f32> {
        Ok(0.0)
    }

    pub(crate) fn shape_center(&self) -> Vec3 {
        Vec3::ZERO
    }
}

/// Reads the deformation of a saved collider and drops it: `check_facets` refuses that collider.
pub(super) fn skip_deformation<'a, D: Deserializer<'a>>(
    saved: D,
) -> core::result::Result<Option<Box<deformation::Deformation>>, D::Error> {
    Option::<[Vec<Vec3>; 2]>::deserialize(saved).map(|_| None)
}

pub(crate) mod deformation {
    use crate::error::Result;
    use crate::geometry::aabb::Aabb;
    use crate::geometry::bends::SurfaceBend;
    use crate::geometry::collision_shape::CollisionShape;
    use crate::geometry::solid_mesh::ClosestPointQuery;
    use crate::math::hasher::StateHasher;
    use glam::Vec3;
    use serde::Serialize;

    #[derive(Clone, Debug, Serialize)]
    pub(crate) enum Deformation {}

    impl Deformation {
        pub fn new(_: &[Vec3], _: Vec<[u32; 3]>) -> Option<Self> {
            None
        }

        pub fn restore(&mut self, _: &[Vec3], _: Vec<[u32; 3]>) -> Result<()> {
            match *self {}
        }

        pub fn shape(&self) -> Option<&CollisionShape> {
            match *self {}
        }

        pub fn vertex(&self, _: usize) -> Vec3 {
            match *self {}
        }

        pub fn is_moving(&self) -> bool {
            match *self {}
        }

        pub fn longest(&self) -> f32 {
            match *self {}
        }

        pub fn set_target(&mut self, _: &dyn Fn(usize) -> Vec3) {
            match *self {}
        }

        pub fn translate(&mut self, _: Vec3) {
            match *self {}
        }

        pub fn place(&mut self, _: &dyn Fn(usize) -> Vec3) {
            match *self {}
        }

        pub fn first_step(&mut self, _: u32) {
            match *self {}
        }

        pub fn prepare(&mut self) {
            match *self {}
        }

        pub fn pose_for_search(&mut self, _: Aabb, _: f32, _: &dyn Fn(&SurfaceBend) -> bool) {
            match *self {}
        }

        pub fn is_measured(&self, _: &Aabb) -> bool {
            match *self {}
        }

        pub fn pose_some_for_search(&mut self, _: impl Iterator<Item = Aabb>, _: f32) {
            match *self {}
        }

        pub fn sharp_features(&self) -> Option<core::iter::Empty<u32>> {
            match *self {}
        }

        pub fn activate(
            &mut self,
            _: impl Iterator<Item = u32>,
            _: impl Iterator<Item = u32>,
            _: impl Iterator<Item = u32>,
        ) {
            match *self {}
        }

        pub fn pose(&mut self, _: [f32; 2]) {
            match *self {}
        }

        pub fn pose_features(&mut self, _: impl Iterator<Item = Aabb>, _: [f32; 2]) {
            match *self {}
        }

        pub fn visit_near(&self, _: &mut ClosestPointQuery) {
            match *self {}
        }

        pub fn longest_relative_path(&self, _: [Vec3; 2], _: f32, _: f32) -> f32 {
            match *self {}
        }

        pub fn motions_near(&self, _: Aabb) -> Option<Aabb> {
            match *self {}
        }

        pub fn hash(&self, _: &mut StateHasher) {
            match *self {}
        }

        pub fn finish_tick(&mut self) {
            match *self {}
        }
    }
}
