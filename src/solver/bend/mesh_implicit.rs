//! Bending of any mesh by its hinges: one implicit step for all hinges at once.
//!
//! ```text
//! M d = −h² K (x + d)        d: displacement by bending, K: stiffness matrix (`stiffness_matrix`)
//! ```
//! Method: K is symmetric and, since hinges are quadratic, independent of the positions. An
//! incomplete factorisation (`incomplete_cholesky`) solves the system. Where it is not accurate
//! enough, it preconditions conjugate gradients (Hestenes and Stiefel 1952), each step of which is
//! one product with K; few are needed, however stiff or fine the mesh is.
//!
//! The particles are sorted along the longest axis of the mesh at rest, so that narrow meshes have
//! an exact factorisation and all memory access is local.
//!
//! Reads hinges, elements, folds and positions; writes positions and `MeshBendScratch`.
//! Invariant: matrix and factors are recomputed exactly when links, stiffness, masses or held
//! particles change. Dot products sum in a fixed order, so the bits are the same on every platform.

use crate::math::TINY;
use crate::math::heap_bytes::heap_bytes;
use crate::math::sort::sort_by;
use crate::model::bend_elements::{PAIRS, TriangleStiffness};
use crate::model::bend_scale::{BendScale, BendScaleKey};
use crate::model::hinge::hinge_normal;
use crate::model::hinges::Hinges;
use crate::solver::bend::hinge::HingeStep;
use crate::solver::bend::incomplete_cholesky::IncompleteCholesky;
use crate::solver::bend::stiffness_matrix::StiffnessMatrix;
use crate::solver::particle_stage::access::ParticleAccess;
use glam::{DVec3, Vec3, Vec4};

/// Largest number of conjugate gradient steps per solve.
const MAX_STEPS: u32 = 48;

/// Stiffness over mass from which the second solve of a substep pays.
const MIN_SECOND_SOLVE: f32 = 0.25;

/// Stiffness over mass above which the forces are summed in double precision.
const MIN_PRECISE: f32 = 100.0;

/// Bound of the relative error up to which the factorisation alone solves the system.
const MAX_ERROR: f32 = 0.05;

/// Conjugate gradients end at this ratio of the squared residual under the preconditioner to the
/// initial one; a last step by the preconditioner alone then divides the error by ten or so.
const RESIDUAL_RATIO: f32 = 3.0e-3;

/// Buffers with an entry per particle, and the cached matrix. All but `area` and `rank` are sorted
/// by rank.
#[derive(Clone, Debug, Default)]
pub(crate) struct MeshBendScratch {
    /// Element energies, stiffness matrix and factors; valid until links, masses, stiffness or held
    /// particles change.
    elements: Vec<TriangleStiffness>,
    stiffness: StiffnessMatrix,
    factors: IncompleteCholesky,
    /// Area of each particle at rest [m²]; 0 for held particles.
    area: Vec<f32>,
    /// Particle of each rank, and rank of each particle.
    order: Vec<u32>,
    rank: Vec<u32>,
    revision: u32,
    /// Key of the scales for which the matrix was assembled.
    scale_key: BendScaleKey,
    assembled_stiffness: f32,
    /// Force of the rest curvature of each hinge, times h² [kg m³]; used if some hinges are bent.
    rest_force: Vec<Vec4>,
    /// The same, coupled by the elements.
    coupled_force: Vec<Vec4>,
    w: Vec<f32>,
    /// Mass; 0 for held particles.
    mass: Vec<f32>,
    /// Positions less the damping share of the start positions. This and all below hold x, y, z, 0,
    /// which fit a SIMD register.
    x: Vec<Vec4>,
    /// Sums of forces in double precision.
    sums: Vec<DVec3>,
    /// Displacement by bending in this substep [m].
    total: Vec<Vec4>,
    /// Displacement by the current solve [m].
    change: Vec<Vec4>,
    /// Residual of the system [kg m].
    residual: Vec<Vec4>,
    /// Search direction, and its product with −(M + h² K) or the preconditioned residual.
    direction: Vec<Vec4>,
    product: Vec<Vec4>,
}

heap_bytes!(
    MeshBendScratch {
        elements, stiffness, factors, area, order, rank, rest_force, coupled_force, w, mass, x,
        sums, total, change, residual, direction, product,
    } plain { revision, scale_key, assembled_stiffness }
);

impl MeshBendScratch {
    /// Allocates buffers for these numbers of triangles and hinges, and at most `capacity`
    /// particles.
    pub fn new(triangles: usize, hinges: usize, capacity: usize) -> Self {
        let numbers = || Vec::with_capacity(capacity);
        let indices = || Vec::with_capacity(capacity);
        let vectors = || Vec::with_capacity(capacity);
        Self {
            elements: Vec::with_capacity(triangles),
            stiffness: StiffnessMatrix::with_capacity(capacity),
            factors: IncompleteCholesky::with_capacity(capacity),
            area: numbers(),
            order: indices(),
            rank: indices(),
            revision: 0,
            scale_key: BendScaleKey::default(),
            assembled_stiffness: 0.0,
            rest_force: Vec::with_capacity(hinges),
            coupled_force: Vec::with_capacity(hinges),
            w: numbers(),
            mass: numbers(),
            x: vectors(),
            sums: Vec::with_capacity(capacity),
            total: vectors(),
            change: vectors(),
            residual: vectors(),
            direction: vectors(),
            product: vectors(),
        }
    }
}

/// Hinges and parameters of one solve.
#[derive(Clone, Copy)]
pub(crate) struct MeshBend<'a> {
    pub hinges: &'a Hinges,
    /// Whether each link is active.
    pub active: &'a [bool],
    /// Rest curvature that folds add to each hinge [m]; `None` without folds.
    pub folds: Option<&'a [f32]>,
    pub scale: BendScale<'a>,
    pub step: HingeStep,
    /// Stiffness over mass of hinges that are one mean edge apart.
    pub stiffness_over_mass: f32,
    /// Triangles, and the area of each corner at rest [m²].
    pub triangles: &'a [[u32; 3]],
    pub corner_area: &'a [[f32; 3]],
    /// Rest position of each site [m], and site of each particle.
    pub rest: &'a [Vec3],
    pub site: &'a [u32],
    /// Whether this is the first solve of the substep.
    pub is_first: bool,
}

impl MeshBend<'_> {
    /// Runs one solve for `count` particles; skips the second one of a substep if it does not pay.
    ///
    /// `start` gives the position of a particle at the start of the substep [m].
    pub fn solve<S: ParticleAccess>(
        &self,
        scratch: &mut MeshBendScratch,
        count: usize,
        start: impl Fn(usize) -> Vec3,
        particles: &mut S,
    ) {
        if !self.is_first && self.stiffness_over_mass < MIN_SECOND_SOLVE {
            return;
        }
        let is_resized = self.resize(scratch, count);
        if self.load(scratch, start, particles) || is_resized {
            self.assemble(scratch, count);
        }
        let MeshBendScratch { stiffness, x, sums, residual, .. } = &mut *scratch;
        if self.stiffness_over_mass > MIN_PRECISE {
            stiffness.add_precise_forces(x, sums, residual);
        } else {
            stiffness.add_forces(x, residual);
        }
        self.add_rest_forces(scratch, particles);
        if scratch.factors.error() <= MAX_ERROR {
            scratch.factors.solve(&scratch.residual, &mut scratch.change);
        } else {
            solve_conjugate_gradients(scratch);
        }
        let each = scratch.order.iter().zip(&mut scratch.total).zip(&scratch.change);
        for ((i, total), change) in each {
            let (x, w) = particles.particle(*i as usize);
            if w > 0.0 {
                particles.set_position(*i as usize, x + change.truncate());
                *total += *change;
            }
        }
    }

    /// Resizes the buffers for `count` particles, and returns whether count, links or stiffness
    /// changed.
    fn resize(&self, scratch: &mut MeshBendScratch, count: usize) -> bool {
        let (revision, stiffness) = (self.hinges.revision, self.step.stiffness);
        let scale_key = self.scale.key();
        let known = (scratch.revision, scratch.assembled_stiffness, scratch.scale_key);
        if known == (revision, stiffness, scale_key) && scratch.w.len() == count {
            return false;
        }
        for numbers in [&mut scratch.w, &mut scratch.mass] {
            numbers.resize(count, 0.0);
        }
        let vectors = [&mut scratch.x, &mut scratch.total, &mut scratch.residual];
        let more = [&mut scratch.change, &mut scratch.direction, &mut scratch.product];
        vectors.into_iter().chain(more).for_each(|vectors| vectors.resize(count, Vec4::ZERO));
        for forces in [&mut scratch.rest_force, &mut scratch.coupled_force] {
            forces.resize(self.hinges.all.len(), Vec4::ZERO);
        }
        self.sort_particles(scratch, count);
        (scratch.revision, scratch.assembled_stiffness, scratch.scale_key) =
            (revision, stiffness, scale_key);
        true
    }

    /// Sorts the particles along the longest axis of the mesh at rest.
    fn sort_particles(&self, scratch: &mut MeshBendScratch, count: usize) {
        let MeshBendScratch { order, rank, .. } = scratch;
        let rest = |i: u32| self.rest[self.site[i as usize] as usize];
        let empty = [Vec3::INFINITY, Vec3::NEG_INFINITY];
        let [low, high] =
            (0..count as u32).map(rest).fold(empty, |[low, high], x| [low.min(x), high.max(x)]);
        let size = high - low;
        let axis = (1..3).fold(0, |most, axis| if size[axis] > size[most] { axis } else { most });
        if order.len() != count {
            order.clear();
            order.extend(0..count as u32);
        }
        sort_by(order, |p, q| rest(*p)[axis].total_cmp(&rest(*q)[axis]).then(p.cmp(q)));
        rank.resize(count, 0);
        for (at, i) in (0..).zip(&*order) {
            rank[*i as usize] = at;
        }
    }

    /// Assembles and factorises the matrix for the current links, stiffness and held particles.
    #[inline(never)]
    fn assemble(&self, scratch: &mut MeshBendScratch, count: usize) {
        let MeshBendScratch { elements, stiffness, factors, area, rank, w, mass, .. } = scratch;
        let all = &self.hinges.all;
        let holds = |hinge: usize| self.active[self.hinges.links[hinge] as usize];
        let scale = |element: usize, corners: [u32; 3]| self.scale.of_element(element, &corners);
        let is_held = |vertex: u32| w[rank[vertex as usize] as usize] == 0.0;
        self.hinges.elements.compute_stiffness(all, holds, is_held, scale, elements);
        area.clear();
        area.resize(count, 0.0);
        for (triangle, areas) in self.triangles.iter().zip(self.corner_area) {
            for (vertex, corner_area) in triangle.iter().zip(areas).filter(|(v, _)| !is_held(**v)) {
                area[*vertex as usize] += corner_area;
            }
        }
        stiffness.assemble(all, elements, self.step.stiffness, area, rank);
        factors.factorise(stiffness, mass);
    }

    /// Loads positions and masses, initialises the residual, and returns whether a mass changed.
    fn load<S: ParticleAccess>(
        &self,
        scratch: &mut MeshBendScratch,
        start: impl Fn(usize) -> Vec3,
        particles: &S,
    ) -> bool {
        let start_share = self.step.start_share;
        let mut has_changed = false;
        let known = scratch.w.iter_mut().zip(&mut scratch.mass);
        let each = scratch.order.iter().zip(scratch.x.iter_mut().zip(known));
        for (i, (slot, (known, mass))) in each {
            let i = *i as usize;
            let (x, w) = particles.particle(i);
            let shifted = if start_share > 0.0 { x - start(i) * start_share } else { x };
            *slot = shifted.extend(0.0);
            if *known != w {
                (*known, *mass) = (w, if w > 0.0 { 1.0 / w } else { 0.0 });
                has_changed = true;
            }
        }
        if self.is_first {
            scratch.total.fill(Vec4::ZERO);
        }
        for ((residual, total), mass) in
            scratch.residual.iter_mut().zip(&scratch.total).zip(&scratch.mass)
        {
            *residual = -*total * *mass;
        }
        has_changed
    }

    /// Adds the forces of the rest curvature to the residual.
    fn add_rest_forces<S: ParticleAccess>(&self, scratch: &mut MeshBendScratch, particles: &S) {
        if !self.hinges.are_bent && self.folds.is_none() {
            return;
        }
        let hinges = &self.hinges.all;
        for (at, (hinge, rest_force)) in hinges.iter().zip(&mut scratch.rest_force).enumerate() {
            let rest = hinge.rest + self.folds.map_or(0.0, |folds| folds[at]);
            *rest_force = if rest == 0.0 {
                Vec4::ZERO
            } else {
                let corners = hinge.particles.map(|vertex| particles.particle(vertex as usize).0);
                let rest = rest * (1.0 - self.step.start_share) * self.step.stiffness;
                (hinge_normal(corners) * rest).extend(0.0)
            };
        }
        let MeshBendScratch { elements, rest_force, coupled_force, residual, rank, .. } = scratch;
        coupled_force.fill(Vec4::ZERO);
        for element in elements {
            couple_rest_forces(element, rest_force, coupled_force);
        }
        for (hinge, force) in hinges.iter().zip(coupled_force) {
            if *force != Vec4::ZERO {
                let ([p, others @ ..], [_, weights @ ..]) = (hinge.particles, hinge.weight);
                let mut sum = Vec4::ZERO;
                for (vertex, weight) in others.into_iter().zip(weights) {
                    let force = *force * weight;
                    residual[rank[vertex as usize] as usize] += force;
                    sum += force;
                }
                residual[rank[p as usize] as usize] -= sum;
            }
        }
    }
}

/// Solves (M + h² K) change = residual by preconditioned conjugate gradients.
#[inline(never)]
fn solve_conjugate_gradients(scratch: &mut MeshBendScratch) {
    let MeshBendScratch { stiffness, factors, mass, change, residual, direction, product, .. } =
        scratch;
    change.fill(Vec4::ZERO);
    direction.fill(Vec4::ZERO);
    let (mut squared, mut initial) = (1.0, 0.0);
    for step in 0..=MAX_STEPS {
        factors.solve(residual, product);
        let next_squared = dot(product, residual);
        // False for invalid numbers, which end the loop too.
        let is_above = |limit: f32| next_squared > limit;
        let has_converged = step > 0 && !is_above(initial * RESIDUAL_RATIO);
        if has_converged || step == MAX_STEPS || !is_above(TINY * TINY) {
            change.iter_mut().zip(product).for_each(|(change, last)| *change += *last);
            return;
        }
        if step == 0 {
            initial = next_squared;
        }
        let keep = if step == 0 { 0.0 } else { next_squared / squared };
        squared = next_squared;
        for ((direction, product), mass) in direction.iter_mut().zip(&mut *product).zip(&*mass) {
            *direction = *product + *direction * keep;
            *product = -*direction * *mass;
        }
        stiffness.add_forces(direction, product);
        let step_length = squared / -dot(direction, product);
        let moved = change.iter_mut().zip(&mut *residual).zip(&*direction).zip(&*product);
        for (((change, residual), direction), product) in moved {
            *change += *direction * step_length;
            *residual += *product * step_length;
        }
    }
}

/// Adds the rest forces of the three hinges of an element, coupled by its stiffness, to `coupled`.
#[inline(always)]
fn couple_rest_forces(element: &TriangleStiffness, rest_force: &[Vec4], coupled: &mut [Vec4]) {
    let own = [0, 1, 2].map(|slot| {
        if element.own[slot] > 0.0 { rest_force[element.hinges[slot] as usize] } else { Vec4::ZERO }
    });
    if own == [Vec4::ZERO; 3] {
        return;
    }
    let mut force = own;
    for (force, by) in force.iter_mut().zip(element.own) {
        *force *= by;
    }
    for ([p, q], by) in PAIRS.into_iter().zip(element.between) {
        force[p] += own[q] * by;
        force[q] += own[p] * by;
    }
    for (slot, force) in force.into_iter().enumerate() {
        if element.own[slot] > 0.0 {
            coupled[element.hinges[slot] as usize] += force;
        }
    }
}

/// Dot product with eight partial sums, which give the same bits on every platform.
fn dot(a: &[Vec4], b: &[Vec4]) -> f32 {
    let mut sums = [Vec4::ZERO; 2];
    for (a, b) in a.chunks(2).zip(b.chunks(2)) {
        for (sum, (a, b)) in sums.iter_mut().zip(a.iter().zip(b)) {
            *sum += *a * *b;
        }
    }
    sum(sums)
}

fn sum([even, odd]: [Vec4; 2]) -> f32 {
    let [x, y, z, _] = (even + odd).to_array();
    (x + y) + z
}
