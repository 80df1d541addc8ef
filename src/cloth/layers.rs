//! Public call for layers: the surface of another cloth as a collider that deforms.
//!
//! ```text
//! inner.advance ──▶ outer.collide_with(inner) ──▶ outer.advance
//! ```
//! A layer is a mesh collider over the particles of the other cloth, in a frame that stands at its
//! origin, so that coordinates stay small far from zero. Where the other cloth has other triangles
//! than before, the mesh is replaced; new particles start where their sources were, so that their
//! motion is swept too.
//!
//! Reads the other cloth; writes `World::colliders`.
//! Invariant: only a new layer and new triangles allocate.

use crate::cloth::Cloth;
use crate::error::{Result, check};
use crate::math::float_env::with_float_env;
use crate::solver::world::World;
use crate::state::collider_desc::{ColliderDesc, Shape, check_coordinates};
use crate::state::colliders::{Collider, ColliderBody};
use glam::{Quat, Vec3};

impl Cloth {
    /// Makes the surface of another cloth a collider of this one, or updates it: clothes in layers,
    /// the inner one first. Call it in each frame between the `advance` of the inner cloth and that
    /// of the outer one, with `None` in the first frame and then with the handle that it returned.
    ///
    /// The collider is at the present positions of `other` at first. After each later call it
    /// reaches them evenly over the ticks of the next [`Cloth::advance`], or in the next tick of
    /// [`Cloth::step`], and is swept on its way. It has two sides: this cloth stays on the side
    /// where it is. It keeps the mean of both thicknesses away, half of each, and has the mean of
    /// both coefficients of friction, as in the call; maps of `other` do not count. Where `other`
    /// has torn or been cut since, the collider takes its new triangles, which takes as long as
    /// adding it; the handle stays.
    ///
    /// The effect is one-way: `other` does not feel this cloth. Several pieces in one mesh, with
    /// [`SelfCollision::Surface`](crate::SelfCollision), bear on each other, and nothing passes through;
    /// a layer gives no such guarantee where both cloths crumple or are squeezed.
    ///
    /// The motion since the last call is swept. After a `reset` or `teleport` of both cloths, remove
    /// the collider ([`Cloth::remove_collider`]) and call this with `None` again. A save and a clone
    /// contain the collider, and the handle is valid for them too.
    ///
    /// ```
    /// use muslin::glam::Vec3;
    /// use muslin::{Cloth, GridDesc};
    ///
    /// let mut lining = Cloth::grid(&GridDesc::default())?;
    /// let mut coat = Cloth::grid(&GridDesc { origin: Vec3::Z * 0.02, ..GridDesc::default() })?;
    /// let mut layer = None;
    /// for _frame in 0..10 {
    ///     lining.advance(1.0 / 60.0)?;
    ///     layer = Some(coat.collide_with(&lining, layer)?);
    ///     coat.advance(1.0 / 60.0)?;
    /// }
    /// # Ok::<(), muslin::Error>(())
    /// ```
    ///
    /// # Errors
    /// [`Error::BadHandle`](crate::Error::BadHandle) if `collider` was removed or is that of another
    /// cloth; [`Error::BadValue`](crate::Error::BadValue) if this call did not return it, or no triangle
    /// of `other` has an area; [`Error::BadEntry`](crate::Error::BadEntry) if a particle of `other` is 1e6 m or
    /// more from its origin; [`Error::Full`](crate::Error::Full) if there are 1024 colliders already.
    /// The cloth is unchanged.
    pub fn collide_with(&mut self, other: &Self, collider: Option<Collider>) -> Result<Collider> {
        let (world, other) = (&mut *self.world, &other.world);
        let x = &other.particles.x;
        check_coordinates(x.x.len(), &|i| x.get(i), "other.positions")?;
        with_float_env(|| match collider {
            None => world.add_layer(other),
            Some(Collider(handle)) => world.update_layer(other, handle).map(|()| Collider(handle)),
        })
    }
}

impl World {
    fn add_layer(&mut self, other: &Self) -> Result<Collider> {
        let mut body = self.layer_body(other)?;
        body.update(&|i| other.particles.x.get(i));
        let handle = self.colliders.insert(Box::new(body), "another collider")?;
        self.reserve_contacts();
        self.wake();
        Ok(Collider(handle))
    }

    fn update_layer(&mut self, other: &Self, handle: u32) -> Result<()> {
        let body = self.colliders.get(handle, "collider")?;
        check(body.is_layer, "collider", "be one that `collide_with` returned")?;
        let is_same = body.desc.positions.len() == other.particles.len()
            && body.desc.indices == other.mesh.triangles.as_flattened();
        let replacement = if is_same { None } else { Some(self.layer_body(other)?) };
        let [thickness, friction] = self.layer_contact(other);
        let origin = self.origin;
        let body = self.colliders.get_mut(handle, "collider")?;
        let is_in_place =
            body.desc.position == other.origin && body.next.rotation == Quat::IDENTITY;
        let is_unchanged = is_same
            && is_in_place
            && [thickness, friction] == [body.desc.thickness, body.desc.friction];
        if !is_in_place {
            body.move_mesh_frame(other.origin, origin);
        }
        if let Some(new) = replacement {
            let start = other.layer_start(body);
            body.replace_mesh(new, &start);
        }
        (body.desc.thickness, body.desc.friction) = (thickness, friction);
        body.update(&|i| other.particles.x.get(i));
        if !is_unchanged {
            self.scratch.contacts.nearby.invalidate();
            self.wake();
        }
        Ok(())
    }

    /// Thickness [m] and friction between this cloth and a layer.
    fn layer_contact(&self, other: &Self) -> [f32; 2] {
        let (a, b) = (&self.material, &other.material);
        [(a.thickness + b.thickness) * 0.5, (a.friction + b.friction) * 0.5]
    }

    /// Makes the collider of another cloth where that is now.
    fn layer_body(&self, other: &Self) -> Result<ColliderBody> {
        let x = &other.particles.x;
        let [thickness, friction] = self.layer_contact(other);
        let desc = ColliderDesc {
            shape: Shape::Mesh,
            position: other.origin,
            positions: (0..x.x.len()).map(|i| x.get(i)).collect(),
            indices: other.mesh.triangles.as_flattened().to_vec(),
            thickness,
            friction,
            ..ColliderDesc::default()
        };
        let mut body = ColliderBody::new(desc, self.origin)?;
        body.is_layer = true;
        Ok(body)
    }

    /// Where the particles of a cloth that was torn or cut were when `body` was updated last, relative
    /// to the origin [m]. A particle that it does not have was at its source: of those that were
    /// split from the same one, at the one that is nearest now; else between the ends of the cut edge.
    #[inline(never)]
    fn layer_start(&self, body: &ColliderBody) -> Vec<Vec3> {
        let (x, sources) = (&self.particles.x, &self.mesh.source);
        let known = body.desc.positions.len();
        let mut start: Vec<Vec3> = Vec::with_capacity(sources.len());
        for (i, site) in sources.iter().enumerate() {
            let position =
                if i < known { body.vertex(i) } else { self.start_of(*site, x.get(i), &start) };
            start.push(position);
        }
        start
    }

    /// The start of a site at the particle that is nearest to `at` [m]; between the ends of the cut
    /// edge if it has none. `start` holds those of the first particles.
    fn start_of(&self, site: u32, at: Vec3, start: &[Vec3]) -> Vec3 {
        let x = &self.particles.x;
        let is_there = |i: &usize| self.mesh.source[*i] == site;
        let distance = |i: &usize| x.get(*i).distance_squared(at);
        let nearest =
            (0..start.len()).filter(is_there).min_by(|a, b| distance(a).total_cmp(&distance(b)));
        let cut = || site.checked_sub(self.mesh.original_count).map(|cut| cut as usize);
        match nearest {
            Some(i) => start[i],
            None => cut()
                .and_then(|cut| self.cut_sites.get(cut))
                .map_or(at, |cut| cut.interpolate(|end| self.start_of(end, at, start))),
        }
    }
}
