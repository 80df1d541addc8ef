//! Stand-ins for the shapes of feature `facet-colliders`, for builds without it.
//!
//! The types have no values, so the compiler removes every branch that handles them. Names and
//! signatures are those of the modules that they stand for.

#![allow(missing_docs)]

pub(crate) mod polyhedron {
    use crate::geometry::aabb::Aabb;
    use crate::geometry::signed_distance::SignedDistance;
    use glam::Vec3;

    #[derive(Clone, Debug)]
    pub(crate) enum Polyhedron {}

    impl Polyhedron {
        pub fn bounds(&self) -> Aabb {
            match *self {}
        }

        pub fn largest_distance(&self, _: Vec3) -> f32 {
            match *self {}
        }

        pub fn push_candidate_faces(&self, _: Vec3, _: f32, _: &mut Vec<u32>) {
            match *self {}
        }
    }

    pub(crate) struct CandidateFaces<'a> {
        pub body: &'a Polyhedron,
        pub faces: &'a [u32],
    }

    impl SignedDistance for CandidateFaces<'_> {
        fn signed_distance(&self, _: Vec3) -> (f32, Vec3) {
            match *self.body {}
        }
    }
}

pub(crate) mod heightfield {
    use crate::geometry::aabb::Aabb;
    use crate::geometry::bends::BendHistogram;
    use crate::geometry::features::{EdgeFeature, Features};
    use glam::Vec3;

    #[derive(Clone, Debug)]
    pub(crate) enum Heightfield {}

    impl Heightfield {
        pub fn bounds(&self) -> Aabb {
            match *self {}
        }

        pub fn bends(&self) -> &BendHistogram {
            match *self {}
        }

        pub fn spacing(&self) -> f32 {
            match *self {}
        }

        pub fn signed_distance(&self, _: Vec3) -> Option<(f32, Vec3)> {
            match *self {}
        }

        pub fn push_features(&self, _: &Aabb, _: impl Fn(&EdgeFeature) -> bool, _: &mut Features) {
            match *self {}
        }
    }
}

pub(crate) mod solid_mesh {
    use glam::Vec3;

    #[derive(Clone, Copy, Debug)]
    pub(crate) struct ClosestPointQuery;

    impl ClosestPointQuery {
        pub fn new(_: Vec3, _: f32) -> Self {
            Self
        }

        pub fn if_inside(&self, _: f32) -> Option<(Vec3, Vec3)> {
            None
        }
    }
}

pub(crate) mod triangle_surface {
    use crate::geometry::aabb::Aabb;
    use crate::geometry::relative_motion::PointMotion;
    use crate::geometry::solid_mesh::ClosestPointQuery;
    use glam::Vec3;

    #[derive(Clone, Debug)]
    pub(crate) enum TriangleSurface {}

    impl TriangleSurface {
        pub fn bounds(&self) -> Aabb {
            match *self {}
        }

        pub fn deforms(&self) -> bool {
            match *self {}
        }

        pub fn has_triangle_near(&self, _: Aabb) -> bool {
            match *self {}
        }

        pub fn push_triangles_near(
            &self,
            _: (Vec3, &PointMotion),
            _: f32,
            _: (Aabb, f32),
            _: &mut Vec<u32>,
        ) {
            match *self {}
        }

        pub fn visit_near(&self, _: &mut ClosestPointQuery, _: Option<&dyn Fn(u32) -> [Vec3; 3]>) {
            match *self {}
        }
    }

    #[derive(Clone, Copy, Debug)]
    pub(crate) struct SurfacePoint {
        pub at: Vec3,
        pub distance: f32,
        pub outward: Vec3,
        pub carry: Vec3,
    }

    pub(crate) struct CandidateTriangles<'a> {
        pub surface: &'a TriangleSurface,
        pub triangles: &'a [u32],
    }

    impl CandidateTriangles<'_> {
        pub fn first_crossing(&self, _: Vec3, _: Vec3) -> Option<SurfacePoint> {
            match *self.surface {}
        }

        pub fn closest(&self, _: Vec3, _: Vec3, _: f32) -> Option<SurfacePoint> {
            match *self.surface {}
        }
    }
}
