//! Public call for painted maps: scales per particle of what the material says.
//!
//! Reads the caller's scales; writes `World::maps` and what follows from it: compliances, distances
//! of self-collision.
//! Invariant: a stored map has one scale per particle, each in the valid range.

use crate::cloth::Cloth;
use crate::error::{Error, Result};
use crate::math::float_env::with_float_env;
use crate::model::maps::{Map, is_valid_map_scale};
use crate::solver::world::World;

/// Makes the next tick search for contacts again, at new distances.
fn refresh_contact_distances(world: &mut World) {
    world.scratch.contacts.nearby.invalidate();
    world.rebuild_particle_collision();
    if let Some(surface) = &mut world.scratch.surface_collision {
        surface.invalidate();
    }
}

impl Cloth {
    /// Paints a property: multiplies what the material says by one scale per particle, from 0 to
    /// 1000; 1 is as the material says. `None` takes the map away.
    ///
    /// [`Map`] says what each map scales, and what scale 0 means. A link, a hinge or a triangle
    /// takes the mean of the scales at its corners; a contact interpolates them at its point, and two
    /// layers take the mean of both sides. Own values of a collider
    /// ([`ColliderDesc`](crate::ColliderDesc)) are scaled too.
    ///
    /// Maps stay when the material changes and when the cloth is reset. A particle that a tear splits
    /// off takes the scale of its source; one that a cut adds to an edge takes the scale between those
    /// of its ends. Scales take effect with the next tick, and setting a map wakes a sleeping cloth.
    /// A map takes memory only while it is set.
    ///
    /// ```
    /// use muslin::{Cloth, GridDesc, Map};
    ///
    /// let mut cloth = Cloth::grid(&GridDesc::default())?;
    /// // A seam that tears at a quarter of the usual strain: row 20 of 40.
    /// let scale = |particle: u32| if particle / 40 == 20 { 0.25 } else { 1.0 };
    /// let scales: Vec<f32> = (0..cloth.particle_count()).map(scale).collect();
    /// cloth.set_map(Map::Tear, Some(&scales))?;
    /// cloth.set_map(Map::Tear, None)?;
    /// # Ok::<(), muslin::Error>(())
    /// ```
    ///
    /// # Errors
    /// [`Error::BadCount`] unless there is one scale per particle;
    /// [`Error::BadEntry`] names the first scale that is not from 0 to 1000.
    /// The cloth is unchanged.
    pub fn set_map(&mut self, map: Map, scales: Option<&[f32]>) -> Result<()> {
        let world = &mut *self.world;
        let count = world.particles.len();
        if let Some(scales) = scales {
            if scales.len() != count {
                let [count, needed] = [scales.len(), count].map(|count| count as u32);
                return Err(Error::BadCount { field: "scales", count, needed });
            }
            if let Some(index) = scales.iter().position(|scale| !is_valid_map_scale(scale)) {
                let (index, must) = (index as u32, "be from 0 to 1000");
                return Err(Error::BadEntry { field: "scales", index, must });
            }
        }
        world.wake();
        world.maps.set(map, scales.unwrap_or_default(), world.allocated_particles());
        with_float_env(|| match map {
            Map::Stretch => world.constraints.update_compliances(&world.material, &world.maps),
            Map::Thickness => refresh_contact_distances(world),
            _ => {}
        });
        Ok(())
    }
    /// Returns the scales of a painted map, one per particle; `None` if it is not set. Particles that
    /// tears and cuts added are at the end.
    pub fn map(&self, map: Map) -> Option<&[f32]> {
        self.world.maps.get(map)
    }
}
