//! Stand-in for `surface` in builds without the feature `self-collision`: the stages do nothing.
//!
//! [`surface_collision::SurfaceCollision`] has no values, so the compiler removes every branch that
//! handles it.

use crate::solver::world::World;

pub(crate) mod surface_collision {
    use crate::math::heap_bytes::HeapBytes;

    #[derive(Clone, Debug)]
    pub(crate) enum SurfaceCollision {}

    impl SurfaceCollision {
        pub fn gap(&self) -> f32 {
            match *self {}
        }

        pub fn invalidate(&mut self) {
            match *self {}
        }

        pub fn has_contacts(&self) -> bool {
            match *self {}
        }
    }

    impl HeapBytes for SurfaceCollision {
        fn heap_bytes(&self) -> usize {
            match *self {}
        }
    }
}

pub(crate) mod surface_stages {
    use super::World;

    impl World {
        pub fn rebuild_surface_collision(&mut self) {}
    }

    pub(crate) fn begin_tick(_: &mut World) {}

    pub(crate) fn detect_contacts(_: &mut World) {}

    pub(crate) fn solve_contacts(_: &mut World) {}

    pub(crate) fn enforce_non_crossing(_: &mut World, _: Option<u32>) {}

    pub(crate) fn enforce_non_crossing_at_tick_end(_: &mut World) {}

    pub(crate) fn separate_splits(_: &mut World, _: impl Iterator<Item = u32>) {}
}

pub(crate) mod contact_damping {
    use super::World;

    pub(crate) fn damp_velocities(_: &mut World) {}
}

pub(crate) mod crossing_report {
    use super::World;

    pub(crate) fn report(_: &mut World) {}
}
