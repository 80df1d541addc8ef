//! Cache of the surface to draw: normals and tangents at an interpolated time between two ticks.
//!
//! `x(blend) = blend · x + (1 − blend) · x_last`, then area-weighted normals and tangents of that
//! surface.
//!
//! Reads `World::particles` and the triangles; writes its own columns, which `write_vertices`
//! packs.
//! Invariant: `normals` belong to `blend_of_normals` and the current positions, or
//! `blend_of_normals` is `None`.

use crate::math::columns::Columns;
use crate::math::heap_bytes::heap_bytes;
use crate::solver::output::normals;
use crate::solver::output::tangents::Tangents;
use crate::solver::world::World;
use glam::Vec2;

/// Normals and tangents of the drawn surface, kept until positions or triangles change.
#[derive(Debug)]
pub(crate) struct InterpolatedSurface {
    /// Number of particles to reserve for.
    particle_capacity: usize,
    /// One unit normal per particle.
    pub normals: Columns,
    /// The blend factor that `normals` were computed for; `None` if they are out of date.
    blend_of_normals: Option<f32>,
    /// Interpolated positions; allocated at the first request with a blend below 1.
    positions: Columns,
    /// One tangent per vertex; allocated at the first request.
    pub tangents: Option<Box<Tangents>>,
}

heap_bytes!(
    InterpolatedSurface {
        normals, positions, tangents,
    } plain { particle_capacity, blend_of_normals }
);

impl InterpolatedSurface {
    /// Makes an empty surface for `capacity` particles, whose lists are allocated when they are
    /// first asked for.
    pub fn with_capacity(capacity: usize) -> Self {
        Self {
            particle_capacity: capacity,
            normals: Columns::default(),
            blend_of_normals: None,
            positions: Columns::default(),
            tangents: None,
        }
    }

    /// Allocates for `particles` particles and `vertices` vertices in all.
    pub fn reserve(&mut self, particles: usize, vertices: usize) {
        self.particle_capacity = particles;
        self.normals.reserve(particles);
        if !self.positions.x.is_empty() {
            self.positions.reserve(particles);
        }
        if let Some(tangents) = &mut self.tangents {
            tangents.reserve(vertices);
        }
    }

    /// Makes an empty surface with room for as many particles.
    pub fn with_same_capacity(&self) -> Self {
        Self::with_capacity(self.particle_capacity)
    }

    /// Marks normals and tangents as out of date after positions changed.
    pub fn invalidate_positions(&mut self) {
        self.blend_of_normals = None;
        if let Some(tangents) = &mut self.tangents {
            tangents.invalidate_positions();
        }
    }

    /// Marks normals and tangents as out of date after triangles changed.
    pub fn invalidate_topology(&mut self) {
        self.blend_of_normals = None;
        if let Some(tangents) = &mut self.tangents {
            tangents.invalidate_triangles();
        }
    }

    /// Returns the positions of the particles at `blend`, for which `update` was called last,
    /// relative to the origin [m].
    pub fn positions<'a>(&'a self, world: &'a World, blend: f32) -> &'a Columns {
        if blend == 1.0 { &world.particles.x } else { &self.positions }
    }

    /// Computes the normals at `blend` (0: last tick, 1: current tick), and the tangents if `uvs`
    /// are given. Skips what is already up to date.
    pub fn update(&mut self, world: &World, blend: f32, uvs: Option<&[Vec2]>) {
        let needs_normals = self.blend_of_normals != Some(blend);
        let are_tangents_current =
            self.tangents.as_ref().is_some_and(|tangents| tangents.is_current(blend));
        let uvs = uvs.filter(|_| !are_tangents_current);
        if blend != 1.0 && (needs_normals || uvs.is_some()) {
            self.positions.reserve(self.particle_capacity);
            normals::blend_positions(world, blend, &mut self.positions);
        }
        let x = if blend == 1.0 { &world.particles.x } else { &self.positions };
        if needs_normals {
            self.normals.reserve(self.particle_capacity);
            normals::compute(world, x, &mut self.normals);
            self.blend_of_normals = Some(blend);
        }
        if let Some(uvs) = uvs {
            let new_tangents = || Box::new(Tangents::with_capacity(world.allocated_vertices()));
            self.tangents.get_or_insert_with(new_tangents).update(world, uvs, x, blend);
        }
    }
}
