//! The surface as it is drawn: its normals and tangents at a share of the way between two ticks.

use crate::math::columns::Columns;
use crate::solver::output::normals;
use crate::solver::output::tangents::Tangents;

use crate::solver::world::World;
use glam::Vec2;

/// What was last found of the surface, kept until it moves.
#[derive(Debug)]
pub(crate) struct BlendedSurface {
    /// Of particles, …
    capacity: usize,
    /// … one for each; …
    pub normals: Columns,
    /// The share that `normals` are of.
    share: Option<f32>,
    /// Where the particles are between two ticks, once somebody asked.
    between: Columns,
    /// … and of vertices, which have their own; once somebody asked.
    pub tangents: Option<Box<Tangents>>,
}

impl BlendedSurface {
    /// Room for the normals of `capacity` particles.
    pub fn with_capacity(capacity: usize) -> Self {
        let normals = Columns::with_capacity(capacity);
        Self { capacity, normals, share: None, between: Columns::default(), tangents: None }
    }

    /// Bytes of what somebody asked for.
    pub fn bytes(&self) -> usize {
        let between = if self.between.x.capacity() == 0 { 0 } else { size_of::<[f32; 3]>() };
        self.capacity * between + self.tangents.as_ref().map_or(0, |tangents| tangents.bytes())
    }

    /// Tells of a change of positions.
    pub fn moved(&mut self) {
        self.share = None;
        if let Some(tangents) = &mut self.tangents {
            tangents.invalidate_positions();
        }
    }

    /// Tells of a change of triangles.
    pub fn retied(&mut self) {
        self.share = None;
        if let Some(tangents) = &mut self.tangents {
            tangents.invalidate_triangles();
        }
    }

    /// Finds normals at a share of the way between the last tick and this one, and tangents if there are
    /// texture coordinates for them; unless it has.
    pub fn follow(&mut self, world: &World, share: f32, uvs: Option<&[Vec2]>) {
        let needs_normals = self.share != Some(share);
        let has_tangents =
            self.tangents.as_ref().is_some_and(|tangents| tangents.is_current(share));
        let uvs = uvs.filter(|_| !has_tangents);
        if share != 1.0 && (needs_normals || uvs.is_some()) {
            self.between.reserve(self.capacity);
            normals::blend_positions(world, share, &mut self.between);
        }
        let x = if share == 1.0 { &world.particles.x } else { &self.between };
        if needs_normals {
            normals::compute(world, x, &mut self.normals);
            self.share = Some(share);
        }
        if let Some(uvs) = uvs {
            let make = || Box::new(Tangents::with_capacity(world.vertex_capacity()));
            self.tangents.get_or_insert_with(make).update(world, uvs, x, share);
        }
    }
}
