//! Frayed edges: loose warp and weft threads at torn and cut edges. Hems have none.
//!
//! ```text
//!   cloth  ───┬──┬─┬──┬───  edge        root + along · s, then droop, lift and curl · s²
//!             │  ╲ │  ╰╮    threads     along follows the thread that crosses the edge
//! ```
//! Method: threads are placed by a hash of the edge position whenever the topology changes; each
//! frame computes their roots from the current triangle, so they follow every fold.
//!
//! Reads a [`ClothSurface`]; writes a texture of thread parameters, and the current colour target.
//!
//! Invariant: the same tear gives the same threads.

use std::collections::HashMap;
use std::f32::consts::TAU;

use glam::{Mat2, Vec2};
use three_d::{
    Blend, Context, CoreError, Interpolation, RenderStates, Texture2D, VertexBuffer, Wrapping,
    WriteMask,
};

use super::cloth_material::ClothAlbedo;
use super::glsl::glsl;
use super::lazy_program::LazyProgram;
use super::mesh::ClothSurface;
use super::pass::{RenderPass, to_gl_matrix, to_gl_vector};
use super::shadow::ShadowMap;

/// Density of short fibres along an edge [1/m].
const FUZZ: f32 = 420.0;
/// Density of long loose threads along an edge [1/m].
const STRANDS: f32 = 75.0;
/// Approximate limit of threads per cloth; a cloth with many torn edges gets a lower density.
const MAX_THREADS: f32 = 9000.0;
/// Straight segments of a thread.
const SEGMENTS: u32 = 4;

/// A thread, relative to its triangle.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Thread {
    /// The two ends of the edge, and the third corner of its triangle.
    corners: [u32; 3],
    /// Position of the root along the edge, 0 to 1.
    at: f32,
    /// Direction, as coefficients of the edge and of the side from its start to the third corner.
    direction: [f32; 2],
    /// Length [m].
    length: f32,
    /// Half width [m], lean, phase of the curl, and colour: see `fringe.vert`.
    traits: [f32; 4],
}

/// Shader program of the threads.
pub struct Fringe {
    pub(super) program: LazyProgram,
}

/// Threads of one cloth.
///
/// The shader reads their parameters from a texture. Instancing would be slow on software
/// rasterisers, where each instance costs a draw call.
pub struct FrayedThreads {
    context: Context,
    /// Side, position along the thread (0 root, 1 tip), and index of the thread.
    ribbons: VertexBuffer<[f32; 3]>,
    thread_texture: Option<Texture2D>,
    threads: Vec<Thread>,
    revision: Option<u64>,
    staging: Vec<[f32; 4]>,
}

/// Texels per thread, and threads per row of the texture.
const TEXELS: usize = 4;
const ROW: usize = 64;

impl Fringe {
    /// Creates what draws the threads.
    pub fn new(context: &Context) -> Self {
        let fragment = glsl!("light.glsl", "fringe.frag");
        let vertex = glsl!("fringe.vert");
        Self { program: LazyProgram::new(context, vertex, fragment) }
    }

    pub(super) fn draw(
        &self,
        pass: &RenderPass,
        threads: &FrayedThreads,
        shadow: &ShadowMap,
        albedo: &ClothAlbedo,
        dim: f32,
    ) -> Result<(), CoreError> {
        let Some(thread_texture) = &threads.thread_texture else {
            return Ok(());
        };
        let p = self.program.get()?;
        let pixels = Vec2::new(pass.viewport.width as f32, pass.viewport.height as f32);
        p.use_uniform("clipFromWorld", to_gl_matrix(pass.clip_from_world));
        p.use_uniform("pixels", three_d::Vec2::new(pixels.x, pixels.y));
        p.use_uniform("lens", pass.view.focal_length_pixels(pixels.y));
        p.use_uniform("eye", to_gl_vector(pass.view.eye));
        p.use_uniform("dim", dim);
        p.use_uniform("fillTowards", to_gl_vector(pass.lights.fill.towards));
        p.use_uniform("fillColour", to_gl_vector(pass.lights.fill.colour));
        p.use_uniform("rimTowards", to_gl_vector(pass.lights.rim.towards));
        p.use_uniform("rimColour", to_gl_vector(pass.lights.rim.colour));
        p.use_uniform("warp", to_gl_vector(albedo.warp));
        p.use_uniform("weft", to_gl_vector(albedo.weft));
        shadow.bind(p, &pass.lights);
        p.use_texture("threads", thread_texture);
        p.use_vertex_attribute("corner", &threads.ribbons);
        let states = RenderStates {
            blend: Blend::TRANSPARENCY,
            write_mask: WriteMask::COLOR,
            ..RenderStates::default()
        };
        let corners = CORNERS * threads.threads.len() as u32;
        p.draw_arrays(states, pass.viewport, corners);
        Ok(())
    }
}

impl FrayedThreads {
    /// Creates an empty list of threads.
    pub fn new(context: &Context) -> Self {
        Self {
            context: context.clone(),
            ribbons: VertexBuffer::new(context),
            thread_texture: None,
            threads: Vec::new(),
            revision: None,
            staging: Vec::new(),
        }
    }

    /// Rebuilds the threads if the topology has changed, and uploads their parameters.
    pub fn update(&mut self, surface: &ClothSurface<'_>) {
        if self.revision != Some(surface.revision) {
            self.revision = Some(surface.revision);
            rebuild_threads(surface, &mut self.threads);
            self.resize_buffers();
        }
        let Some(thread_texture) = &mut self.thread_texture else {
            return;
        };
        let scale = surface.unit.recip();
        self.staging.clear();
        for thread in &self.threads {
            let [a, b, c] = thread.corners.map(|corner| surface.positions[corner as usize] * scale);
            let [na, nb] = [0, 1].map(|i| surface.normals[thread.corners[i] as usize]);
            let direction = (b - a) * thread.direction[0] + (c - a) * thread.direction[1];
            let along = direction.normalize_or_zero() * thread.length;
            let [width, lean, curl, shade] = thread.traits;
            self.staging.extend([
                a.lerp(b, thread.at).extend(width).to_array(),
                along.extend(lean).to_array(),
                na.lerp(nb, thread.at).extend(curl).to_array(),
                [shade, 0.0, 0.0, 0.0],
            ]);
        }
        let texels = (thread_texture.width() * thread_texture.height()) as usize;
        self.staging.resize(texels, [0.0; 4]);
        thread_texture.fill(&self.staging);
    }

    /// Resizes the texture and the ribbons to the number of threads.
    fn resize_buffers(&mut self) {
        let rows = self.threads.len().div_ceil(ROW) as u32;
        if rows == 0 {
            self.thread_texture = None;
        } else if self
            .thread_texture
            .as_ref()
            .is_none_or(|thread_texture| thread_texture.height() != rows)
        {
            // The old texture is dropped first, to save GPU memory.
            self.thread_texture = None;
            self.thread_texture = Some(Texture2D::new_empty::<[f32; 4]>(
                &self.context,
                (TEXELS * ROW) as u32,
                rows,
                Interpolation::Nearest,
                Interpolation::Nearest,
                None,
                Wrapping::ClampToEdge,
                Wrapping::ClampToEdge,
            ));
            let ribbons: Vec<_> = (0..rows * ROW as u32).flat_map(ribbon).collect();
            self.ribbons.fill(&ribbons);
        }
    }
}

/// Vertices of a ribbon: two triangles per segment.
const CORNERS: u32 = 6 * SEGMENTS;

/// Returns the vertices of a thread: side (−1 or 1), position along it (0 to 1), index.
fn ribbon(thread: u32) -> impl Iterator<Item = [f32; 3]> {
    (0..SEGMENTS).flat_map(move |segment| {
        let [near, far] = [segment, segment + 1].map(|i| i as f32 / SEGMENTS as f32);
        let corners =
            [[-1.0, near], [1.0, near], [1.0, far], [-1.0, near], [1.0, far], [-1.0, far]];
        corners.map(|[side, share]| [side, share, thread as f32])
    })
}

/// Rebuilds the threads of all torn and cut edges.
fn rebuild_threads(surface: &ClothSurface<'_>, threads: &mut Vec<Thread>) {
    threads.clear();
    let borders = borders(surface);
    let uv = |corner: u32| surface.uvs[corner as usize] * surface.span;
    let long: f32 = borders.iter().map(|[a, b, _]| uv(*a).distance(uv(*b))).sum();
    let share = (MAX_THREADS / (long * (FUZZ + STRANDS))).min(1.0);
    for corners in borders {
        let [a, b, c] = corners.map(uv);
        let plane = Mat2::from_cols(b - a, c - a);
        if plane.determinant().abs() < 1.0e-12 {
            continue;
        }
        let into_triangle = plane.inverse();
        let outward = outward(a, b, c);
        let mut random = HashRandom::of(a + b);
        // The number of weft threads that cross an edge is proportional to its extent along the
        // warp, and the other way round.
        let run = (b - a).abs();
        for (axis, extent) in [(Vec2::X, run.y), (Vec2::Y, run.x)] {
            let along = axis * if axis.dot(outward) < 0.0 { -1.0 } else { 1.0 };
            for (density, is_strand) in [(FUZZ, false), (STRANDS, true)] {
                let wanted = extent * density * share;
                let count =
                    wanted.floor() + f32::from(u8::from(random.next_unit() < wanted.fract()));
                for i in 0..count as u32 {
                    let lean = (random.next_unit() - 0.5) * if is_strand { 0.7 } else { 1.5 };
                    let direction = into_triangle * Vec2::from_angle(lean).rotate(along);
                    let long = random.next_unit();
                    // The square makes long threads rare.
                    let length =
                        if is_strand { 0.012 + 0.052 * long * long } else { 0.004 + 0.008 * long };
                    let width = if is_strand { 0.00055 } else { 0.0004 };
                    let lift = random.next_unit() - 0.5;
                    let shade = if axis == Vec2::X { 0.0 } else { 1.0 };
                    threads.push(Thread {
                        corners,
                        at: (i as f32 + random.next_unit()) / count,
                        direction: direction.to_array(),
                        length,
                        traits: [
                            width,
                            lift,
                            TAU * random.next_unit(),
                            shade + 0.9 * random.next_unit(),
                        ],
                    });
                }
            }
        }
    }
}

/// Returns the torn or cut border edges: edges of one triangle only that lie on no hem, each with
/// the third corner.
fn borders(surface: &ClothSurface<'_>) -> Vec<[u32; 3]> {
    let torn = |corner: u32| surface.frayed[corner as usize];
    let mut open: HashMap<[u32; 2], [u32; 3]> = HashMap::new();
    for triangle in surface.indices.chunks_exact(3) {
        for i in 0..3 {
            let [a, b, c] = [0, 1, 2].map(|j| triangle[(i + j) % 3]);
            if torn(a) && torn(b) && open.remove(&[b, a]).is_none() {
                open.insert([a, b], [a, b, c]);
            }
        }
    }
    let hem = |a: Vec2, b: Vec2| {
        let on = |side: f32, of: fn(Vec2) -> f32| of(a) == side && of(b) == side;
        if surface.is_round {
            return [a, b].iter().all(|uv| (*uv - 0.5).length() > 0.5 - 1.0e-4);
        }
        [0.0, 1.0].iter().any(|side| on(*side, |uv| uv.x) || on(*side, |uv| uv.y))
    };
    let mut borders: Vec<_> = open
        .into_values()
        .filter(|[a, b, _]| !hem(surface.uvs[*a as usize], surface.uvs[*b as usize]))
        .collect();
    // A `HashMap` has no fixed order, so the edges are sorted.
    borders.sort_unstable();
    borders
}

/// Returns the unit normal of the edge from `a` to `b` in texture space that points away from `c`.
fn outward(a: Vec2, b: Vec2, c: Vec2) -> Vec2 {
    let square = (b - a).perp().normalize_or_zero();
    if square.dot(c - a) > 0.0 { -square } else { square }
}

/// Pseudo-random numbers in 0 to 1, seeded by a position in texture space.
struct HashRandom(u32);

impl HashRandom {
    fn of(place: Vec2) -> Self {
        let [x, y] = place.to_array().map(f32::to_bits);
        Self(x.wrapping_mul(0x9e37_79b1) ^ y.rotate_left(13).wrapping_mul(0x85eb_ca77) | 1)
    }

    fn next_unit(&mut self) -> f32 {
        // Marsaglia, "Xorshift RNGs" (2003).
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 17;
        self.0 ^= self.0 << 5;
        (self.0 >> 8) as f32 / 16_777_216.0
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::Vec3;
    use muslin::{Cloth, GridDesc};

    fn threads_of(cloth: &mut Cloth) -> Vec<Thread> {
        let view = cloth.view();
        let surface = ClothSurface {
            positions: view.positions,
            unit: 1.0,
            normals: view.normals,
            uvs: view.uvs,
            frayed: view.frayed,
            hollows: &[],
            indices: view.indices,
            coarse_indices: &[],
            lines: &[],
            span: Vec2::ONE,
            is_round: false,
            revision: 1,
        };
        let mut threads = Vec::new();
        rebuild_threads(&surface, &mut threads);
        threads
    }

    fn sheet() -> Cloth {
        let desc = GridDesc { columns: 9, rows: 9, spacing: 0.125, ..GridDesc::default() };
        Cloth::grid(&desc).unwrap()
    }

    #[test]
    fn hems_have_no_threads_and_a_cut_has_threads_on_both_sides() {
        let mut cloth = sheet();
        assert_eq!(threads_of(&mut cloth), []);
        // The cut runs from the left hem across the sheet, between two rows.
        let (from, to) = (Vec3::new(-0.1, -0.55, -0.2), Vec3::new(0.7, -0.55, -0.2));
        assert!(cloth.cut(from, to, Vec3::Z * 0.4).unwrap() > 0);
        let threads = threads_of(&mut cloth);
        let (mut up, mut down) = (0, 0);
        for thread in &threads {
            let [a, b, c] = thread.corners.map(|corner| cloth.positions()[corner as usize]);
            let root = a.lerp(b, thread.at);
            assert!((root.y + 0.55).abs() < 1.0e-3, "a thread grows at {root}");
            let direction = (b - a) * thread.direction[0] + (c - a) * thread.direction[1];
            // Threads point away from their triangle.
            assert!(direction.y * (c.y - root.y) < 0.0, "a thread goes {direction} at {root}");
            if direction.y > 0.0 { up += 1 } else { down += 1 }
        }
        let wanted = (0.6 * (FUZZ + STRANDS)) as usize;
        assert!(up > wanted / 2 && down > wanted / 2, "{up} up, {down} down");
    }

    #[test]
    fn the_number_of_threads_is_limited() {
        let desc = GridDesc { columns: 40, rows: 40, spacing: 1.0 / 39.0, ..GridDesc::default() };
        let mut cloth = Cloth::grid(&GridDesc { extra_particles: 4000, ..desc }).unwrap();
        for i in 1..16 {
            let x = i as f32 / 16.0 + 0.003;
            let (from, to) = (Vec3::new(x, 0.1, -0.2), Vec3::new(x, -1.1, -0.2));
            assert!(cloth.cut(from, to, Vec3::Z * 0.4).unwrap() > 0);
        }
        let count = threads_of(&mut cloth).len() as f32;
        assert!(count > 0.8 * MAX_THREADS && count < 1.05 * MAX_THREADS, "{count} threads");
    }

    #[test]
    fn the_same_tear_gives_the_same_threads() {
        let torn = || {
            let mut cloth = sheet();
            cloth.tear_edge(40, 41).unwrap();
            threads_of(&mut cloth)
        };
        assert!(!torn().is_empty());
        assert_eq!(torn(), torn());
    }
}
