//! Public call for cuts: divides triangles along a blade and opens the mesh there.
//!
//! Reads the blade (a segment swept along a vector); `solver::topology::cut` plans the whole cut
//! and then applies it.
//! Invariant: the plan is checked against the reserve before anything changes.

use crate::cloth::Cloth;
use crate::error::{Error, Result, check, check_finite};
use crate::geometry::blade::Blade;
use crate::math::float_env::with_float_env;
use crate::solver::collide;
use crate::solver::scratch_pool;
use crate::solver::self_collide::surface::surface_stages;
use crate::solver::topology::cut;
use glam::Vec3;

impl Cloth {
    /// Cuts the cloth with a blade: the segment from `from` to `to` [m], swept along `sweep` [m].
    /// Returns the number of opened edges; 0 means that the blade missed and nothing changed.
    ///
    /// - Triangles that the blade crosses are divided along it: new vertices lie on the crossed
    ///   edges, with attributes interpolated between the edge's ends, and the mesh opens along
    ///   them.
    /// - The cut goes through an existing vertex instead if it would pass closer than an eighth of
    ///   an edge, or would leave a triangle with an angle below 5° or with less than 1/200 of the
    ///   area of a square of the mean edge. It does not snap to a pinned vertex; it passes it at an
    ///   eighth of the edge.
    /// - Where the blade ends inside a triangle, the cut ends at the edge before it.
    /// - New vertices are free; a pinned vertex that the cut goes through is pinned on both sides.
    /// - Mass and rest area are conserved.
    /// - Each crossed edge uses one particle of the reserve (`extra_particles`), and one more if it
    ///   opens.
    ///
    /// ```
    /// use muslin::glam::Vec3;
    /// use muslin::{Cloth, GridDesc};
    ///
    /// let mut cloth = Cloth::grid(&GridDesc::default())?; // 1.95 m x 1.95 m, in the plane z = 0
    /// let opened = cloth.cut(
    ///     Vec3::new(0.52, -0.5, -1.0),
    ///     Vec3::new(0.52, -1.5, -1.0),
    ///     Vec3::new(0.0, 0.0, 2.0),
    /// )?;
    /// assert!(opened > 0);
    /// # Ok::<(), muslin::Error>(())
    /// ```
    ///
    /// # Errors
    /// [`Error::BadValue`] if a number is not finite, `to` equals `from`, or `sweep` is zero or
    /// parallel to the segment; [`Error::Full`] if the reserve cannot hold the whole cut. The cloth
    /// is unchanged.
    pub fn cut(&mut self, from: Vec3, to: Vec3, sweep: Vec3) -> Result<u32> {
        check_finite(from, "from")?;
        check_finite(to, "to")?;
        check_finite(sweep, "sweep")?;
        check(from != to, "to", "differ from `from`")?;
        check(sweep != Vec3::ZERO, "sweep", "not be zero")?;
        let [from, to] = [from, to].map(|point| self.world.to_relative(point));
        let blade = with_float_env(|| Blade::new(from, to, sweep));
        let Some(blade) = blade else {
            return Err(Error::BadValue {
                field: "sweep",
                must: "not be parallel to the line through `from` and `to`",
            });
        };
        let plan = with_float_env(|| cut::plan(&self.world, &blade));
        if plan.opened_count() == 0 {
            return Ok(0);
        }
        if !plan.fits(self.world.capacity(), self.world.triangle_capacity) {
            return Err(Error::Full { what: "the whole cut" });
        }
        self.reserve_for_tears();
        with_float_env(|| {
            scratch_pool::with_lent(&mut self.world, |world| {
                cut::cut(world, &plan);
                world.rebuild_particle_collision();
                world.rebuild_surface_collision();
                let count = world.particles.len() as u32;
                collide::begin_between_ticks(world);
                surface_stages::separate_splits(world, 0..count);
            });
        });
        self.update_topology();
        self.update_state();
        Ok(plan.opened_count())
    }
}
