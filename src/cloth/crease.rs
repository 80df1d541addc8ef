//! Public call for creases: adds a permanent fold along a line of the rest shape.
//!
//! Reads the rest shape; writes the rest angles in `World::folds`.
//! Invariant: nothing changes unless all arguments are valid.

use crate::cloth::Cloth;
use crate::error::{Result, check, check_finite};
use crate::math::float_env::with_float_env;
use crate::mesh::grid::GridFrame;
use glam::Vec3;

impl Cloth {
    /// Adds a fold of `angle` [rad] to the rest shape, along the line from `from` to `to` [m]. Both
    /// points are given on the cloth as it was made.
    ///
    /// A positive angle folds towards the front of the cloth (the side from which triangles are
    /// counter-clockwise), a negative one away from it. The line need not follow the mesh: the fold
    /// is distributed over the cells beside it. A line that misses the cloth has no effect.
    ///
    /// The cloth bends only as far as `bend_stiffness` can turn it. The fold lasts until
    /// [`Cloth::reset`]. A second crease of −`angle` along the same line removes it, except for the
    /// accumulated folding that `yield_hardening` and `yield_weakening` count.
    ///
    /// # Errors
    /// [`Error::BadValue`](crate::Error::BadValue) if a number is not finite, `to` equals `from`,
    /// or `angle` is not from −3 to 3. The cloth is unchanged.
    pub fn crease(&mut self, from: Vec3, to: Vec3, angle: f32) -> Result<()> {
        check_finite(from, "from")?;
        check_finite(to, "to")?;
        check(from != to, "to", "differ from `from`")?;
        check((-3.0..=3.0).contains(&angle), "angle", "be from -3 to 3")?;
        self.world.wake();
        let [from, to] = [from, to].map(|point| point - self.world.rest_origin);
        with_float_env(|| match self.world.grid_frame {
            Some(GridFrame { origin, right, down, .. }) => {
                let flat = |p: Vec3| [(p - origin).dot(right), (p - origin).dot(down)];
                self.world.crease_grid(flat(from), flat(to), angle);
            }
            None => self.world.crease_mesh([from, to], angle),
        });
        self.update_state();
        Ok(())
    }
}
