//! Solids: supports and obstacles of the cloth, drawn as capsules, spheres and cylinders with
//! bevelled edges.
//!
//! Method: one shared mesh of two hemispheres that `capsule.glsl` places; a sphere is a capsule of
//! length zero, a cylinder a capsule with flattened ends.
//!
//! Reads [`Solid`]s, the shadow map and the lights; writes colour and depth of the current target.
//!
//! Invariant: the mesh is closed, and its triangles face outwards.

use std::f32::consts::{PI, TAU};

use glam::{Mat4, Vec3};
use three_d::{
    Context, CoreError, ElementBuffer, Program, RenderStates, VertexBuffer, Viewport, WriteMask,
};

use super::glsl::glsl;
use super::light::{FLOOR, linear};
use super::pass::{ALPHA_BLEND, RenderPass, to_gl_matrix, to_gl_vector};
use super::shadow::ShadowMap;

/// A capsule, or a cylinder with bevelled edges.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Solid {
    /// Centre of the first end [m].
    pub from: Vec3,
    /// Centre of the second end [m].
    pub to: Vec3,
    /// Radius [m].
    pub radius: f32,
    /// Radius of the bevelled edges of a cylinder [m]; `None` for a capsule.
    pub bevel: Option<f32>,
    /// Colour, `0xrrggbb`.
    pub colour: u32,
    /// Whether it is a ball of clear glass, which has no colour.
    pub is_glass: bool,
}

impl Solid {
    /// Creates a sphere.
    pub fn sphere(centre: Vec3, radius: f32, colour: u32) -> Self {
        Self::capsule(centre, centre, radius, colour)
    }

    /// Creates a ball of glass.
    pub fn glass_ball(centre: Vec3, radius: f32) -> Self {
        Self { is_glass: true, ..Self::sphere(centre, radius, 0xb9cfe0) }
    }

    /// Creates a capsule: a rod with round ends.
    pub fn capsule(from: Vec3, to: Vec3, radius: f32, colour: u32) -> Self {
        Self { from, to, radius, bevel: None, colour, is_glass: false }
    }

    /// Creates a cylinder whose edges are rounded by `bevel` [m].
    pub fn cylinder(from: Vec3, to: Vec3, radius: f32, bevel: f32, colour: u32) -> Self {
        // The rounded edges are part of the length.
        let round = (to - from).normalize_or(Vec3::Y) * bevel;
        let (from, to) = (from + round, to - round);
        Self { from, to, radius, bevel: Some(bevel), colour, is_glass: false }
    }
}

/// The mesh, and the programs that draw it.
pub struct Solids {
    program: Program,
    depth: Program,
    fine: Shell,
    /// For thin solids, which cover few pixels.
    coarse: Shell,
}

/// The mesh at one level of detail.
struct Shell {
    /// Unit direction from the centre of an end, and the index of this end (0 or 1).
    corners: VertexBuffer<[f32; 4]>,
    triangles: ElementBuffer<u32>,
}

/// Vertices around the axis, and rings per hemisphere.
const FINE: [u32; 2] = [48, 12];
const COARSE: [u32; 2] = [12, 3];
/// Height over the floor up to which solids are reflected [m].
const REFLECTED: f32 = 1.6;
/// A solid with a smaller radius gets the coarse mesh [m].
const THIN: f32 = 0.03;
/// Least radius that a capsule is drawn with [px]: thinner wires would break into dots. It is drawn the
/// more transparent for that.
const LEAST_PIXELS: f32 = 0.6;

impl Solids {
    /// Creates the mesh and compiles the shaders.
    ///
    /// # Errors
    /// [`CoreError`] if the driver refuses a shader.
    pub fn new(context: &Context) -> Result<Self, CoreError> {
        let shell = |detail| {
            let (corners, triangles) = shell(detail);
            Shell {
                corners: VertexBuffer::new_with_data(context, &corners),
                triangles: ElementBuffer::new_with_data(context, &triangles),
            }
        };
        let vertex = glsl!("capsule.glsl", "solid.vert");
        let depth = glsl!("capsule.glsl", "solid_depth.vert");
        let fragment = glsl!("light.glsl", "solid.frag");
        Ok(Self {
            program: Program::from_source(context, vertex, fragment)?,
            depth: Program::from_source(context, depth, glsl!("depth.frag"))?,
            fine: shell(FINE),
            coarse: shell(COARSE),
        })
    }

    pub(super) fn draw(&self, pass: &RenderPass, shadow: &ShadowMap, solids: &[Solid], dim: f32) {
        self.draw_with(pass, shadow, pass.lights.key.clip_from_world(), solids, dim);
    }

    /// Draws the mirror images below the floor; the floor is blended over them later.
    pub(super) fn draw_reflection(&self, pass: &RenderPass, shadow: &ShadowMap, solids: &[Solid]) {
        let states = RenderStates { blend: ALPHA_BLEND, ..RenderStates::default() };
        let eye = pass.view.eye.with_y(2.0 * FLOOR - pass.view.eye.y);
        let clip = pass.lights.key.clip_from_world();
        let near: Vec<_> = solids.iter().copied().filter(is_reflected).collect();
        self.draw_from(eye, pass, shadow, clip, &near, states, [0.45, 1.0]);
    }

    /// Draws the solids with a shadow map that was drawn with the light matrix `clip`.
    pub(super) fn draw_with(
        &self,
        pass: &RenderPass,
        shadow: &ShadowMap,
        clip: Mat4,
        solids: &[Solid],
        dim: f32,
    ) {
        let states = RenderStates::default();
        let opaque: Vec<_> = solids.iter().copied().filter(|solid| !solid.is_glass).collect();
        self.draw_from(pass.view.eye, pass, shadow, clip, &opaque, states, [dim, 0.0]);
    }

    fn draw_from(
        &self,
        eye: Vec3,
        pass: &RenderPass,
        shadow: &ShadowMap,
        clip: Mat4,
        solids: &[Solid],
        states: RenderStates,
        [dim, mirrored]: [f32; 2],
    ) {
        let p = &self.program;
        let least = least_radius(pass);
        for solid in solids {
            let triangles = self.place(p, pass.clip_from_world, solid, least);
            let is_thin = solid.radius < THIN;
            let states =
                if is_thin { RenderStates { blend: ALPHA_BLEND, ..states } } else { states };
            p.use_uniform("eye", to_gl_vector(eye));
            p.use_uniform("dim", dim);
            p.use_uniform("mirrored", mirrored);
            p.use_uniform("floorHeight", FLOOR);
            p.use_uniform("albedo", to_gl_vector(linear(solid.colour)));
            p.use_uniform("fillTowards", to_gl_vector(pass.lights.fill.towards));
            p.use_uniform("fillColour", to_gl_vector(pass.lights.fill.colour));
            p.use_uniform("rimTowards", to_gl_vector(pass.lights.rim.towards));
            p.use_uniform("rimColour", to_gl_vector(pass.lights.rim.colour));
            shadow.bind_with_clip(p, &pass.lights.key, clip);
            p.draw_elements(states, pass.viewport, triangles);
        }
    }

    /// Draws the solids that are not of glass into a depth map.
    pub(super) fn draw_depth(&self, clip_from_world: Mat4, viewport: Viewport, solids: &[Solid]) {
        let states = RenderStates { write_mask: WriteMask::DEPTH, ..RenderStates::default() };
        for solid in solids.iter().filter(|solid| !solid.is_glass) {
            let triangles = self.place(&self.depth, clip_from_world, solid, 0.0);
            self.depth.draw_elements(states, viewport, triangles);
        }
    }

    /// Sets the uniforms of a solid, and returns the triangles to draw. A capsule is drawn with a
    /// radius of at least `least` [m] times its distance.
    pub(super) fn place(
        &self,
        program: &Program,
        clip_from_world: Mat4,
        solid: &Solid,
        least: f32,
    ) -> &ElementBuffer<u32> {
        let along = (solid.to - solid.from).normalize_or(Vec3::Y);
        let across = along.any_orthonormal_vector();
        program.use_uniform("clipFromWorld", to_gl_matrix(clip_from_world));
        program.use_uniform("from", to_gl_vector(solid.from));
        program.use_uniform("to", to_gl_vector(solid.to));
        program.use_uniform("radius", solid.radius);
        program.use_uniform("leastRadius", least);
        program.use_uniform("bevel", solid.bevel.unwrap_or(-1.0));
        program.use_uniform("across", to_gl_vector(across));
        program.use_uniform("along", to_gl_vector(along));
        let shell = if solid.radius < THIN { &self.coarse } else { &self.fine };
        program.use_vertex_attribute("place", &shell.corners);
        &shell.triangles
    }
}

/// Returns the radius of [`LEAST_PIXELS`] at a distance of 1 m [m].
fn least_radius(pass: &RenderPass) -> f32 {
    LEAST_PIXELS / pass.view.focal_length_pixels(pass.viewport.height as f32)
}

/// Whether any of a solid is near enough to the floor to be seen in it.
fn is_reflected(solid: &Solid) -> bool {
    solid.from.y.min(solid.to.y) - solid.radius < FLOOR + REFLECTED
}

/// Returns vertices and triangles of two hemispheres with joined rims, with so many vertices around
/// the axis and rings per hemisphere.
fn shell([around, up]: [u32; 2]) -> (Vec<[f32; 4]>, Vec<u32>) {
    let mut corners = Vec::new();
    for ring in 0..2 * (up + 1) {
        // Both rims lie on the equator.
        let (end, step) = (ring / (up + 1), ring % (up + 1));
        let height = step as f32 / up as f32 - (1 - end) as f32;
        let (y, wide) = (0.5 * PI * height).sin_cos();
        for i in 0..around {
            let (z, x) = (TAU * i as f32 / around as f32).sin_cos();
            corners.push([x * wide, y, z * wide, end as f32]);
        }
    }
    let mut triangles = Vec::new();
    for ring in 0..2 * up + 1 {
        for i in 0..around {
            let j = (i + 1) % around;
            let [a, b] = [ring * around + i, ring * around + j];
            let [c, d] = [a + around, b + around];
            triangles.extend([a, c, b, b, c, d]);
        }
    }
    (corners, triangles)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_capsule_mesh_is_round_and_closed() {
        let (corners, triangles) = shell(FINE);
        for [x, y, z, end] in &corners {
            assert!((x * x + y * y + z * z - 1.0).abs() < 1.0e-5);
            assert!(y * (end - 0.5) >= -1.0e-6, "height {y} at end {end}");
        }
        for triangle in triangles.chunks_exact(3) {
            let [a, b, c] = [0, 1, 2].map(|i| {
                let [x, y, z, _] = corners[triangle[i] as usize];
                Vec3::new(x, y, z)
            });
            // Triangles face outwards; those at the poles and between the rims are degenerate.
            let normal = (b - a).cross(c - a);
            assert!(normal.dot(a + b + c) > -1.0e-6);
        }
        assert_eq!(triangles.iter().max(), Some(&(corners.len() as u32 - 1)));
    }
}
