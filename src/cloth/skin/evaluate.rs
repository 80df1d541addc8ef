//! Kernel of skins: the position, normal and tangent of each bound vertex.
//!
//! ```text
//! flat point     p = Σ wᵢ xᵢ                                   xᵢ, nᵢ: corners of the cloth triangle
//! curved point   s = p − share · Σ wᵢ ((p − xᵢ) · nᵢ) nᵢ       and their unit normals
//! frame          n = Σ wᵢ nᵢ normalised;  t = direction in the triangle, orthogonal to n;  b = n × t
//! vertex         s + o.x t + o.y b + o.z n      normal, tangent: constant vectors in the frame
//! ```
//! Method: Phong tessellation (Boubekeur and Alexa, "Phong Tessellation", SIGGRAPH Asia 2008,
//! eq. 4): p moves a share of the way to the mean of its projections onto the tangent planes at the
//! corners. For a share of a half, the middle of an edge between two particles on a circle lies on
//! the circle, up to terms of fourth order of the angle between them; so `smoothness` 1 is that
//! share. The paper uses 3/4, which bulges beyond. The frame is orthonormal, so offsets keep their
//! lengths and normals are unit vectors.
//!
//! Reads positions and normals of particles and `BoundColumns`; writes one block of vertices.
//! Invariant: a vertex with one weight of 1 and no offset has the bits of its particle, for any
//! smoothness. Every instruction set gives the same bits.

// Without SIMD only the scalar fallback runs.
#![cfg_attr(
    not(any(target_arch = "x86_64", target_arch = "aarch64", target_feature = "simd128")),
    allow(dead_code)
)]

use crate::math::column::Column;
use crate::math::columns::Columns;
use crate::math::pack::BLOCK;
use crate::math::simd::{Float, Scalar, Simd, gather_transpose, vectored};
use crate::solver::output::vertex_transform::VertexBlock;

/// Share of the projections at a `smoothness` of 1.
const FULL_SHARE: f32 = 0.5;

/// Squared lengths of sums of unit normals, and of areas [m⁴], below these give no direction.
const MIN_NORMAL: f32 = 1.0e-6;
const MIN_AREA: f32 = 1.0e-30;

/// Share of a squared length below which its part orthogonal to the normal is rounding error.
const ROUNDING: f32 = 1.0e-10;

/// What binds each vertex to the cloth, as columns that are padded to whole blocks.
#[derive(Clone, Debug, Default)]
pub(super) struct BoundColumns {
    /// Particles at the corners of the cloth triangle.
    pub corners: [Vec<u32>; 3],
    /// Barycentric weights of these corners.
    pub weights: Columns,
    /// Direction t: multiples of the edges from corner 0 to corner 1 and to corner 2.
    pub direction: [Column; 2],
    /// Offset in the frame [m].
    pub offset: Columns,
    /// Unit normal in the frame.
    pub normal: Columns,
    /// Unit tangent in the frame.
    pub tangent: Columns,
}

/// The particles that a skin is evaluated on: `[x, y, z, 0]` each.
#[derive(Clone, Copy)]
pub(super) struct ParticlePoints<'a> {
    /// Positions relative to the origin of the cloth [m].
    pub positions: &'a [[f32; 4]],
    /// Unit normals.
    pub normals: &'a [[f32; 4]],
}

/// One block of evaluated vertices. Directions are unit vectors.
pub(super) struct SkinBlock {
    pub position: VertexBlock,
    pub normal: VertexBlock,
    pub tangent: VertexBlock,
}

impl Default for SkinBlock {
    fn default() -> Self {
        let [position, normal, tangent] = [[[0.0; BLOCK]; 3]; 3];
        Self { position, normal, tangent }
    }
}

/// Point of the curved surface over a cloth triangle, with its orthonormal frame t, b, n.
#[derive(Clone, Copy)]
pub(super) struct SurfaceFrame<F> {
    pub point: [F; 3],
    pub axes: [[F; 3]; 3],
}

#[inline(always)]
fn dot<F: Float>(a: [F; 3], b: [F; 3]) -> F {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

#[inline(always)]
fn minus<F: Float>(a: [F; 3], b: [F; 3]) -> [F; 3] {
    [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
}

#[inline(always)]
fn cross<F: Float>(a: [F; 3], b: [F; 3]) -> [F; 3] {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

#[inline(always)]
fn plus<F: Float>(a: [F; 3], b: [F; 3]) -> [F; 3] {
    [a[0] + b[0], a[1] + b[1], a[2] + b[2]]
}

#[inline(always)]
fn scaled<F: Float>(a: [F; 3], by: F) -> [F; 3] {
    [a[0] * by, a[1] * by, a[2] * by]
}

#[inline(always)]
fn weighted<F: Float>([a, b, c]: [[F; 3]; 3], w: [F; 3]) -> [F; 3] {
    [
        a[0] * w[0] + b[0] * w[1] + c[0] * w[2],
        a[1] * w[0] + b[1] * w[1] + c[1] * w[2],
        a[2] * w[0] + b[2] * w[1] + c[2] * w[2],
    ]
}

#[inline(always)]
fn select<S: Simd>(s: S, condition: S::F, new: [S::F; 3], old: [S::F; 3]) -> [S::F; 3] {
    [
        s.select(condition, new[0], old[0]),
        s.select(condition, new[1], old[1]),
        s.select(condition, new[2], old[2]),
    ]
}

/// Evaluates the curved surface over the triangle with corners `x` and unit normals `normals`.
#[inline(always)]
pub(super) fn surface_frame<S: Simd>(
    s: S,
    x: [[S::F; 3]; 3],
    normals: [[S::F; 3]; 3],
    weights: [S::F; 3],
    direction: [S::F; 2],
    smoothness: S::F,
) -> SurfaceFrame<S::F> {
    let (zero, one) = (s.splat(0.0), s.splat(1.0));
    let flat = weighted(x, weights);
    let heights = [
        dot(minus(flat, x[0]), normals[0]) * weights[0],
        dot(minus(flat, x[1]), normals[1]) * weights[1],
        dot(minus(flat, x[2]), normals[2]) * weights[2],
    ];
    let lift = weighted(normals, heights);
    let point = minus(flat, scaled(lift, smoothness * s.splat(FULL_SHARE)));
    // The normal, or that of the triangle where the normals of its corners cancel.
    let (p, q) = (minus(x[1], x[0]), minus(x[2], x[0]));
    let (sum, face) = (weighted(normals, weights), cross(p, q));
    let (sum_squared, face_squared) = (dot(sum, sum), dot(face, face));
    let has_sum = sum_squared - s.splat(MIN_NORMAL);
    let n = select(s, has_sum, sum, face);
    let squared = s.select(has_sum, sum_squared, face_squared);
    let has_normal = squared - s.splat(MIN_AREA);
    let n = select(s, has_normal, n, [zero, zero, one]);
    let squared = s.select(has_normal, squared, one);
    let n = scaled(n, one / squared.sqrt());
    // The direction, or a coordinate axis where it is parallel to the normal.
    let whole = plus(scaled(p, direction[0]), scaled(q, direction[1]));
    let is_steep = s.splat(0.5) - n[0] * n[0];
    let axis = [s.select(is_steep, one, zero), zero, s.select(is_steep, zero, one)];
    let t = minus(whole, scaled(n, dot(whole, n)));
    let spare = minus(axis, scaled(n, dot(axis, n)));
    let is_known = dot(t, t) - dot(whole, whole) * s.splat(ROUNDING) - s.splat(MIN_AREA);
    let t = select(s, is_known, t, spare);
    let t = scaled(t, one / dot(t, t).sqrt());
    SurfaceFrame { point, axes: [t, cross(n, t), n] }
}

vectored! {
    /// Evaluates the block of vertices from `first` on; tangents only on request.
    pub(super) fn evaluate(
        particles: ParticlePoints<'_>,
        bound: &BoundColumns,
        first: usize,
        smoothness: f32,
        with_tangents: bool,
        out: &mut SkinBlock,
    ) = evaluate_lanes, evaluate_scalar
}

fn evaluate_scalar(
    particles: ParticlePoints<'_>,
    bound: &BoundColumns,
    first: usize,
    smoothness: f32,
    with_tangents: bool,
    out: &mut SkinBlock,
) {
    evaluate_lanes(Scalar, particles, bound, first, smoothness, with_tangents, out);
}

#[inline(always)]
fn evaluate_lanes<S: Simd>(
    s: S,
    particles: ParticlePoints<'_>,
    bound: &BoundColumns,
    first: usize,
    smoothness: f32,
    with_tangents: bool,
    out: &mut SkinBlock,
) {
    let smoothness = s.splat(smoothness);
    let ParticlePoints { positions, normals } = particles;
    let [a, b, c] = &bound.corners;
    let [u, v] = &bound.direction;
    for to in (0..BLOCK).step_by(S::LANES) {
        let at = first + to;
        let (a, b, c) = (&a[at..], &b[at..], &c[at..]);
        let x = [gather(s, positions, a), gather(s, positions, b), gather(s, positions, c)];
        let n = [gather(s, normals, a), gather(s, normals, b), gather(s, normals, c)];
        let (weights, direction) = (load(s, &bound.weights, at), [s.load(u, at), s.load(v, at)]);
        let SurfaceFrame { point, axes } = surface_frame(s, x, n, weights, direction, smoothness);
        let offset = weighted(axes, load(s, &bound.offset, at));
        store(s, &mut out.position, to, plus(point, offset));
        store(s, &mut out.normal, to, weighted(axes, load(s, &bound.normal, at)));
        if with_tangents {
            store(s, &mut out.tangent, to, weighted(axes, load(s, &bound.tangent, at)));
        }
    }
}

// Functions instead of closures: a closure that is not inlined lacks the instructions of the kernel.

#[inline(always)]
fn gather<S: Simd>(s: S, points: &[[f32; 4]], at: &[u32]) -> [S::F; 3] {
    let [x, y, z, _] = gather_transpose(s, points, at);
    [x, y, z]
}

#[inline(always)]
fn load<S: Simd>(s: S, columns: &Columns, at: usize) -> [S::F; 3] {
    [s.load(&columns.x, at), s.load(&columns.y, at), s.load(&columns.z, at)]
}

#[inline(always)]
fn store<S: Simd>(s: S, block: &mut VertexBlock, at: usize, v: [S::F; 3]) {
    s.store(&mut block[0], at, v[0]);
    s.store(&mut block[1], at, v[1]);
    s.store(&mut block[2], at, v[2]);
}
