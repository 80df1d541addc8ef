//! What cloth hangs on and lies over: rods, balls and pedestals, which are one shape. A ball is a rod without
//! length, a pedestal a rod with flat ends.

use std::f32::consts::{PI, TAU};

use glam::{Mat4, Vec3};
use three_d::{
    Context, CoreError, ElementBuffer, Program, RenderStates, VertexBuffer, Viewport, WriteMask,
};

use super::light::{FLOOR, linear};
use super::pass::{REFLECTION_BLEND, RenderPass, to_gl_matrix, to_gl_vector};
use super::shadow::ShadowMap;

/// A rod with round or flat ends.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Solid {
    /// The middle of one end [m].
    pub from: Vec3,
    /// The middle of the other [m].
    pub to: Vec3,
    /// Its radius [m].
    pub radius: f32,
    /// Flat ends, whose edges are round by this radius [m]; round ends if none.
    pub bevel: Option<f32>,
    /// Its colour, `0xrrggbb`.
    pub colour: u32,
}

impl Solid {
    /// A ball.
    pub fn sphere(centre: Vec3, radius: f32, colour: u32) -> Self {
        Self::capsule(centre, centre, radius, colour)
    }

    /// A rod with round ends.
    pub fn capsule(from: Vec3, to: Vec3, radius: f32, colour: u32) -> Self {
        Self { from, to, radius, bevel: None, colour }
    }

    /// A rod with flat ends, whose edges are round by a radius of `bevel`.
    pub fn cylinder(from: Vec3, to: Vec3, radius: f32, bevel: f32, colour: u32) -> Self {
        // What is round of the edges lies within its length.
        let round = (to - from).normalize_or(Vec3::Y) * bevel;
        Self { from: from + round, to: to - round, radius, bevel: Some(bevel), colour }
    }
}

/// The shape, and the programs that draw it.
pub struct Solids {
    program: Program,
    depth: Program,
    /// Direction from the middle of its end, and which end: 0 or 1.
    shell: VertexBuffer<[f32; 4]>,
    triangles: ElementBuffer<u32>,
}

/// UnitQuad around, and from the middle to a pole.
const AROUND: u32 = 48;
const UP: u32 = 12;

impl Solids {
    /// Makes the shape.
    ///
    /// # Errors
    /// [`CoreError`] if the driver refuses a shader.
    pub fn new(context: &Context) -> Result<Self, CoreError> {
        let (shell, triangles) = shell();
        let vertex =
            concat!(include_str!("shaders/capsule.glsl"), include_str!("shaders/solid.vert"));
        let depth =
            concat!(include_str!("shaders/capsule.glsl"), include_str!("shaders/solid_depth.vert"));
        let fragment =
            concat!(include_str!("shaders/light.glsl"), include_str!("shaders/solid.frag"));
        Ok(Self {
            program: Program::from_source(context, vertex, fragment)?,
            depth: Program::from_source(context, depth, include_str!("shaders/depth.frag"))?,
            shell: VertexBuffer::new_with_data(context, &shell),
            triangles: ElementBuffer::new_with_data(context, &triangles),
        })
    }

    pub(super) fn draw(&self, pass: &RenderPass, shadow: &ShadowMap, solids: &[Solid], dim: f32) {
        self.draw_with(pass, shadow, pass.lights.key.clip_from_world(), solids, dim);
    }

    /// Draws them upside down below the floor; the floor is blended over them afterwards.
    pub(super) fn draw_reflection(&self, pass: &RenderPass, shadow: &ShadowMap, solids: &[Solid]) {
        let states = RenderStates { blend: REFLECTION_BLEND, ..RenderStates::default() };
        let eye = pass.view.eye.with_y(2.0 * FLOOR - pass.view.eye.y);
        let clip = pass.lights.key.clip_from_world();
        self.draw_from(eye, pass, shadow, clip, solids, states, [0.45, 1.0]);
    }

    /// The same where the shadow map was drawn in another clip space.
    pub(super) fn draw_with(
        &self,
        pass: &RenderPass,
        shadow: &ShadowMap,
        clip: Mat4,
        solids: &[Solid],
        dim: f32,
    ) {
        let states = RenderStates::default();
        self.draw_from(pass.view.eye, pass, shadow, clip, solids, states, [dim, 0.0]);
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
        for solid in solids {
            self.place(p, pass.clip_from_world, solid);
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
            p.draw_elements(states, pass.viewport, &self.triangles);
        }
    }

    /// Draws them into a shadow map.
    pub(super) fn draw_depth(&self, clip_from_world: Mat4, viewport: Viewport, solids: &[Solid]) {
        let states = RenderStates { write_mask: WriteMask::DEPTH, ..RenderStates::default() };
        for solid in solids {
            self.place(&self.depth, clip_from_world, solid);
            self.depth.draw_elements(states, viewport, &self.triangles);
        }
    }

    fn place(&self, program: &Program, clip_from_world: Mat4, solid: &Solid) {
        let along = (solid.to - solid.from).normalize_or(Vec3::Y);
        let across = along.any_orthonormal_vector();
        program.use_uniform("clipFromWorld", to_gl_matrix(clip_from_world));
        program.use_uniform("from", to_gl_vector(solid.from));
        program.use_uniform("to", to_gl_vector(solid.to));
        program.use_uniform("radius", solid.radius);
        program.use_uniform("bevel", solid.bevel.unwrap_or(-1.0));
        program.use_uniform("across", to_gl_vector(across));
        program.use_uniform("along", to_gl_vector(along));
        program.use_vertex_attribute("place", &self.shell);
    }
}

/// Two half balls, whose rims are joined.
fn shell() -> (Vec<[f32; 4]>, Vec<u32>) {
    let mut corners = Vec::new();
    for ring in 0..2 * (UP + 1) {
        // Both rims lie on the equator.
        let (end, step) = (ring / (UP + 1), ring % (UP + 1));
        let height = step as f32 / UP as f32 - (1 - end) as f32;
        let (y, wide) = (0.5 * PI * height).sin_cos();
        for i in 0..AROUND {
            let (z, x) = (TAU * i as f32 / AROUND as f32).sin_cos();
            corners.push([x * wide, y, z * wide, end as f32]);
        }
    }
    let mut triangles = Vec::new();
    for ring in 0..2 * UP + 1 {
        for i in 0..AROUND {
            let j = (i + 1) % AROUND;
            let [a, b] = [ring * AROUND + i, ring * AROUND + j];
            let [c, d] = [a + AROUND, b + AROUND];
            triangles.extend([a, c, b, b, c, d]);
        }
    }
    (corners, triangles)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_shell_is_round_and_closed() {
        let (corners, triangles) = shell();
        for [x, y, z, end] in &corners {
            assert!((x * x + y * y + z * z - 1.0).abs() < 1.0e-5);
            assert!(y * (end - 0.5) >= -1.0e-6, "height {y} at end {end}");
        }
        for triangle in triangles.chunks_exact(3) {
            let [a, b, c] = [0, 1, 2].map(|i| {
                let [x, y, z, _] = corners[triangle[i] as usize];
                Vec3::new(x, y, z)
            });
            // Seen from outside; at the poles and between the rims there is nothing to see.
            let normal = (b - a).cross(c - a);
            assert!(normal.dot(a + b + c) > -1.0e-6);
        }
        assert_eq!(triangles.iter().max(), Some(&(corners.len() as u32 - 1)));
    }
}
