//! Folding along a line.

use crate::cloth::Cloth;
use crate::error::{Result, check, check_finite};
use crate::math::float_env::with_float_env;
use crate::mesh::grid::GridFrame;
use glam::Vec3;

impl Cloth {
    /// Gives the cloth a fold of `angle` [rad] along a line, from `from` to `to` [m], both where they are
    /// in the cloth as it was made. From then on the cloth rests folded by so much more along it: towards its
    /// front, where the triangles are counter-clockwise, if `angle` is above 0, and else away from it.
    ///
    /// The line need not follow the mesh: the fold is shared out over the cells beside it. It bends no more
    /// than `bend_stiffness` can make it, and stays until [`Cloth::reset`]; folding by −`angle` along the
    /// same line takes it away, but not what `yield_hardening` and `yield_weakening` count. Where the line is not on the cloth nothing is folded.
    ///
    /// # Errors
    /// [`Error::BadValue`](crate::Error::BadValue) for a number that is not finite, for `to` equal to
    /// `from`, and unless `angle` is from −3 to 3.
    pub fn crease(&mut self, from: Vec3, to: Vec3, angle: f32) -> Result<()> {
        check_finite(from, "from")?;
        check_finite(to, "to")?;
        check(from != to, "to", "be apart from `from`")?;
        check((-3.0..=3.0).contains(&angle), "angle", "be from -3 to 3")?;
        self.world.wake();
        with_float_env(|| match self.world.grid_frame {
            Some(GridFrame { origin, right, down, .. }) => {
                let flat = |p: Vec3| [(p - origin).dot(right), (p - origin).dot(down)];
                self.world.crease_grid(flat(from), flat(to), angle);
            }
            None => self.world.crease_mesh([from, to], angle),
        });
        self.changed_state();
        Ok(())
    }
}
