//! Public call for sewing: draws pairs of particles together and joins them.
//!
//! Reads the caller's pairs; writes `World::sewing`, which `solver::stretch::sewn_pairs` acts on.
//! Invariant: all pairs are checked before the first is added.

#[cfg(feature = "sewing")]
use crate::cloth::Cloth;
use crate::error::{Error, Result};
use crate::math::columns::Columns;
use crate::math::float_env::with_float_env;
use crate::mesh::NONE;
use crate::solver::world::World;
use crate::state::sewing::{SewDesc, SewKind, SewState, SewnPair};

#[cfg(feature = "sewing")]
impl Cloth {
    /// Sews pairs of particles together: draws each pair together at `desc.speed` [m/s], and joins
    /// it when its distance is zero.
    ///
    /// Joined particles have one position and one velocity after every tick, and move as one
    /// particle with the mass of both. Particles may be in several pairs, as where three panels
    /// meet. Pairs do not collide with each other ([`SelfCollision`](crate::SelfCollision)), and a
    /// held particle draws the other one to it. Particles, vertices and triangles stay as they are:
    /// a weld is invisible, since normals are smooth across it, but the texture may change there.
    ///
    /// - Two held particles of a pair stay where they are; [`Stats::over_stretched`](crate::Stats)
    ///   counts the pair and one event `HeldApart` reports it.
    /// - Where a sewn particle tears off its triangles, the pair keeps the part that has its number.
    /// - [`Cloth::reset`] keeps the pairs and draws them together again from the rest shape.
    ///
    /// ```
    /// use muslin::{Cloth, GridDesc, PinMode, SewDesc};
    ///
    /// // A tube: the left and the right border of one sheet, sewn together.
    /// let desc = GridDesc { columns: 40, rows: 20, pin_mode: PinMode::None, ..GridDesc::default() };
    /// let mut cloth = Cloth::grid(&desc)?;
    /// let pairs: Vec<[u32; 2]> = (0..20).map(|row| [row * 40, row * 40 + 39]).collect();
    /// cloth.sew(&pairs, &SewDesc { speed: 2.0, ..SewDesc::default() })?;
    /// cloth.step(120);
    /// assert_eq!(cloth.position(0), cloth.position(39));
    /// # Ok::<(), muslin::Error>(())
    /// ```
    ///
    /// # Errors
    /// [`Error::BadEntry`] names the first pair whose particles are equal, do not exist or have no
    /// triangle; [`Error::BadValue`] names the invalid field of `desc`. The cloth is unchanged.
    pub fn sew(&mut self, pairs: &[[u32; 2]], desc: &SewDesc) -> Result<()> {
        desc.check()?;
        let world = &mut *self.world;
        for (index, [a, b]) in (0..).zip(pairs) {
            let refuse = |must| Err(Error::BadEntry { field: "pairs", index, must });
            let corner = |particle: &u32| world.mesh.corner_of.get(*particle as usize);
            let corners = [corner(a), corner(b)];
            if corners.contains(&None) {
                return refuse("name particles of the cloth");
            }
            if corners.contains(&Some(&NONE)) {
                return refuse("name particles that have a triangle");
            }
            if a == b {
                return refuse("name two different particles");
            }
        }
        if pairs.is_empty() {
            return Ok(());
        }
        let SewDesc { speed, kind, tear_force } = *desc;
        let x = &world.particles.x;
        let sewn = pairs.iter().map(|particles| {
            let length = with_float_env(|| distance(x, *particles));
            SewnPair {
                particles: *particles,
                kind,
                state: SewState::Drawn,
                length,
                speed,
                tear_force,
            }
        });
        world.sewing.pairs.extend(sewn);
        world.sewing.rebuild();
        if kind == SewKind::Stitch {
            // Each stitch may tear.
            world.events.reserve();
        }
        world.forget_collision_pairs();
        world.wake();
        Ok(())
    }
}

/// Distance of the particles of a pair [m].
fn distance(x: &Columns, particles: [u32; 2]) -> f32 {
    let [a, b] = particles.map(|particle| x.get(particle as usize));
    (b - a).length()
}

impl World {
    /// Opens all sewn pairs again, to be drawn together from where their particles are. Pairs of
    /// particles that do not exist are dropped.
    pub(super) fn restart_sewing(&mut self) {
        if self.sewing.is_empty() {
            return;
        }
        let (x, count) = (&self.particles.x, self.particles.len() as u32);
        self.sewing.pairs.retain(|pair| pair.particles.iter().all(|particle| *particle < count));
        for pair in &mut self.sewing.pairs {
            pair.length = distance(x, pair.particles);
            pair.state = SewState::Drawn;
        }
        self.sewing.rebuild();
    }
}
