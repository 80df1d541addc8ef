//! Cutting with a blade.

use crate::cloth::Cloth;
use crate::error::{Error, Result, check, check_finite};
use crate::geometry::blade::Blade;
use crate::math::float_env::with_float_env;
use crate::solver::self_collide::surface::split_separation;
use crate::solver::topology::cut;
use glam::Vec3;

impl Cloth {
    /// Cuts the cloth with a blade: the segment from `from` to `to` [m], swept along `sweep` [m]. Says
    /// how many edges opened; 0 leaves the cloth as it was.
    ///
    /// Triangles that the blade goes through are divided along it: vertices come to be on the edges that
    /// it crosses, between their ends in all that they have, and the mesh opens along them. Where it
    /// would come nearer to a vertex than an eighth of an edge, or leave a triangle with an angle below 5°
    /// or less area than one in 200 of a square of the mean edge, the cut goes through the nearer vertex
    /// instead; past a pinned one it goes at an eighth of the edge. Where the blade ends inside a
    /// triangle, the cut ends at the edge before. Vertices that a cut makes are free; a pinned one that it
    /// goes through is pinned on both sides. Mass and area at rest stay.
    ///
    /// Each edge that is crossed takes one particle of the reserve, and one more where it opens.
    ///
    /// # Errors
    /// [`Error::BadValue`] for a number that is not finite, or unless `to` is apart from `from` and
    /// `sweep` leads away from the line through both; [`Error::Full`] if the reserve cannot take the whole
    /// cut.
    pub fn cut(&mut self, from: Vec3, to: Vec3, sweep: Vec3) -> Result<u32> {
        check_finite(from, "from")?;
        check_finite(to, "to")?;
        check_finite(sweep, "sweep")?;
        check(from != to, "to", "be apart from `from`")?;
        check(sweep != Vec3::ZERO, "sweep", "not be zero")?;
        let blade = with_float_env(|| Blade::new(from, to, sweep));
        let Some(blade) = blade else {
            return Err(Error::BadValue {
                field: "sweep",
                must: "lead away from the line through `from` and `to`",
            });
        };
        let plan = with_float_env(|| cut::plan(&self.world, &blade));
        if plan.opened() == 0 {
            return Ok(0);
        }
        if !plan.fits(self.world.capacity(), self.world.triangle_capacity) {
            return Err(Error::Full { what: "the whole cut" });
        }
        with_float_env(|| {
            cut::cut(&mut self.world, &plan);
            self.world.see_to_crowd();
            self.world.see_to_layers();
            let count = self.world.particles.len() as u32;
            split_separation::part(&mut self.world, 0..count);
        });
        self.changed_topology();
        self.changed_state();
        Ok(plan.opened())
    }
}
