//! Public calls for settings, material and wind.
//!
//! Reads the caller's values; writes them to `World`, with all that is derived from them
//! (compliances, masses, time integration scheme, self-collision structures).
//! Invariant: values are checked first, and a change wakes a sleeping cloth.

use crate::cloth::Cloth;
use crate::error::Result;
use crate::math::float_env::with_float_env;
use crate::model::material::Material;
use crate::solver::collide;
use crate::solver::scratch_pool;
use crate::solver::self_collide::surface::surface_stages;
use crate::state::settings::Settings;
use crate::state::wind::Wind;

impl Cloth {
    /// Returns the current settings.
    pub fn settings(&self) -> &Settings {
        &self.world.settings
    }

    /// Replaces the settings; they take effect with the next tick. Velocities stay as they are.
    ///
    /// A change wakes a sleeping cloth.
    ///
    /// # Errors
    /// [`Error::BadValue`](crate::Error::BadValue) names the field and its rule. The cloth is
    /// unchanged.
    pub fn set_settings(&mut self, settings: Settings) -> Result<()> {
        settings.check()?;
        let world = &mut *self.world;
        world.check_self_distance(&settings)?;
        let self_collision =
            |settings: &Settings| (settings.self_collision, settings.self_distance);
        let changes_self_collision = self_collision(&settings) != self_collision(&world.settings);
        let had_no_surface_collision = world.scratch.surface_collision.is_none();
        let was_unlimited = world.settings.max_stretch == 0.0;
        if settings != world.settings {
            world.wake();
        }
        let before = world.regular_scheme();
        world.settings = settings;
        // A new number of substeps takes effect when the next tick begins.
        let after = world.regular_scheme();
        if world.has_tear_reserve {
            world.scratch.tear.reserve(world.settings.max_tears(world.triangle_capacity));
        }
        world.reserve_for_parameters();
        if was_unlimited {
            world.rebuild_pin_order();
        }
        if changes_self_collision {
            with_float_env(|| {
                world.rebuild_particle_collision();
                world.rebuild_surface_collision();
                if had_no_surface_collision {
                    world.is_tangled = true;
                    let count = world.particles.len() as u32;
                    scratch_pool::with_lent(world, |world| {
                        collide::begin_between_ticks(world);
                        surface_stages::separate_splits(world, 0..count);
                    });
                }
            });
        }
        if after != before {
            with_float_env(|| {
                if after.extrapolation == before.extrapolation {
                    world.drop_history();
                } else {
                    world.reset_history();
                }
                world.warm_start.change_step(before.h, after.h);
                world.refresh_soft_pin_masses();
            });
        }
        if self.world.settings.tearing {
            self.reserve_for_tears();
        }
        if had_no_surface_collision && self.world.scratch.surface_collision.is_some() {
            self.update_state();
        }
        Ok(())
    }

    /// Returns the current material.
    pub fn material(&self) -> &Material {
        &self.world.material
    }

    /// Replaces the material; it takes effect with the next tick. Velocities stay as they are.
    ///
    /// A change wakes a sleeping cloth. A new density changes the mass of every particle; mass
    /// scales ([`Cloth::set_mass_scales`]) and painted maps ([`Cloth::set_map`]) still apply.
    ///
    /// # Errors
    /// [`Error::BadValue`](crate::Error::BadValue) names the field and its rule. The cloth is
    /// unchanged.
    pub fn set_material(&mut self, material: Material) -> Result<()> {
        material.check()?;
        let world = &mut *self.world;
        if material != world.material {
            world.wake();
        }
        let changes_density = material.density != world.material.density;
        world.scratch.contacts.nearby.invalidate();
        world.material = material;
        world.reserve_for_parameters();
        with_float_env(|| {
            world.constraints.update_compliances(&world.material, &world.maps);
            if changes_density {
                world.compute_masses();
            }
        });
        Ok(())
    }

    /// Returns the current wind.
    pub fn wind(&self) -> &Wind {
        &self.world.wind
    }

    /// Replaces the wind; it takes effect with the next tick. A change wakes a sleeping cloth.
    ///
    /// # Errors
    /// [`Error::BadValue`](crate::Error::BadValue) names the field and its rule. The cloth is
    /// unchanged.
    pub fn set_wind(&mut self, wind: Wind) -> Result<()> {
        wind.check()?;
        if wind != self.world.wind {
            self.world.wake();
        }
        self.world.wind = wind;
        Ok(())
    }
}
