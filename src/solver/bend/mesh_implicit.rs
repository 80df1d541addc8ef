//! Bending of any mesh by its hinges: one implicit step for all hinges at once.
//!
//! ```text
//! M d = −h² K (x + d)        d: displacement by bending, K: stiffness matrix (`stiffness_matrix`)
//! ```
//! Method: K is symmetric and, since hinges are quadratic, independent of the positions. A soft
//! mesh takes a few explicit Chebyshev steps (`chebyshev`), a stiff one conjugate gradients with
//! Jacobi preconditioner (Hestenes and Stiefel 1952). Each step is one product with K. The number
//! of steps grows with the square root of the stiffness over mass, where Gauss–Seidel sweeps over
//! hinges would grow linearly.
//!
//! Reads hinges, elements, folds and positions; writes positions and `MeshBendScratch`.
//! Invariant: matrix and coefficients are recomputed exactly when links, stiffness, masses or held
//! particles change. Dot products sum in a fixed order, so the bits are the same on every platform.

use crate::math::TINY;
use crate::model::bend_elements::{PAIRS, TriangleStiffness};
use crate::model::bend_scale::{BendScale, BendScaleKey};
use crate::model::hinge::{Hinge, hinge_normal};
use crate::model::hinges::Hinges;
use crate::solver::bend::chebyshev::ChebyshevSteps;
use crate::solver::bend::hinge::HingeStep;
use crate::solver::bend::stiffness_matrix::StiffnessMatrix;
use crate::solver::particle_stage::access::ParticleAccess;
use glam::{Vec3, Vec4};

/// Largest number of conjugate gradient steps per solve.
const MAX_STEPS: f32 = 48.0;

/// Stiffness over mass from which the second solve of a substep pays.
const MIN_SECOND_SOLVE: f32 = 0.25;

/// Safety factor on the bound of the Chebyshev steps: they leave a residual of the stiffest shapes
/// in each substep, and with factor 1 discs of cotton did not come to rest.
const BOUND_FACTOR: f32 = 2.0;

/// Conjugate gradients end at this ratio of the squared residual to the initial one.
const RESIDUAL_RATIO: f32 = 1.0e-8;

/// Buffers with an entry per particle, and the cached matrix.
#[derive(Clone, Debug, Default)]
pub(crate) struct MeshBendScratch {
    /// Element energies and stiffness matrix; valid until links or held particles change.
    elements: Vec<TriangleStiffness>,
    stiffness: StiffnessMatrix,
    /// Area of each particle at rest [m²]; 0 for held particles.
    area: Vec<f32>,
    revision: u32,
    /// Key of the scales for which the matrix was assembled.
    scale_key: BendScaleKey,
    /// Chebyshev steps, valid until masses or `assembled_stiffness` change too; `None` if too
    /// stiff.
    chebyshev: Option<ChebyshevSteps>,
    assembled_stiffness: f32,
    /// Force of the rest curvature of each hinge, times h² [kg m³]; used if some hinges are bent.
    rest_force: Vec<Vec4>,
    w: Vec<f32>,
    /// Mass, and inverse of the diagonal of M + h² K; 0 for held particles.
    mass: Vec<f32>,
    inverse_diagonal: Vec<f32>,
    /// Positions less the damping share of the start positions. This and all below hold x, y, z, 0,
    /// which fit a SIMD register.
    x: Vec<Vec4>,
    /// Displacement by bending in this substep [m].
    total: Vec<Vec4>,
    /// Displacement by the current solve [m].
    change: Vec<Vec4>,
    /// Residual of the system [kg m].
    residual: Vec<Vec4>,
    /// Search direction, and its product with −(M + h² K).
    direction: Vec<Vec4>,
    product: Vec<Vec4>,
}

impl MeshBendScratch {
    /// Allocates buffers for these numbers of triangles and hinges, and at most `capacity`
    /// particles.
    pub fn new(triangles: usize, hinges: usize, capacity: usize) -> Self {
        let numbers = || Vec::with_capacity(capacity);
        let vectors = || Vec::with_capacity(capacity);
        Self {
            elements: Vec::with_capacity(triangles),
            stiffness: StiffnessMatrix::with_capacity(capacity),
            area: numbers(),
            revision: 0,
            scale_key: BendScaleKey::default(),
            chebyshev: None,
            assembled_stiffness: 0.0,
            rest_force: Vec::with_capacity(hinges),
            w: numbers(),
            mass: numbers(),
            inverse_diagonal: numbers(),
            x: vectors(),
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
        if !self.is_first
            && (self.stiffness_over_mass < MIN_SECOND_SOLVE || scratch.chebyshev.is_some())
        {
            return;
        }
        let is_resized = self.resize(scratch, count);
        if self.load(scratch, start, particles) || is_resized {
            self.assemble(scratch, count);
        }
        scratch.stiffness.add_forces(&scratch.x, &mut scratch.residual);
        self.add_rest_forces(scratch, particles);
        match scratch.chebyshev {
            Some(chebyshev) => solve_chebyshev(scratch, &chebyshev),
            None => self.solve_conjugate_gradients(scratch),
        }
        for (i, (total, change)) in scratch.total.iter_mut().zip(&scratch.change).enumerate() {
            let (x, w) = particles.particle(i);
            if w > 0.0 {
                particles.set_position(i, x + change.truncate());
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
        for numbers in [&mut scratch.w, &mut scratch.mass, &mut scratch.inverse_diagonal] {
            numbers.resize(count, 0.0);
        }
        let vectors = [&mut scratch.x, &mut scratch.total, &mut scratch.residual];
        let more = [&mut scratch.change, &mut scratch.direction, &mut scratch.product];
        vectors.into_iter().chain(more).for_each(|vectors| vectors.resize(count, Vec4::ZERO));
        scratch.rest_force.resize(self.hinges.all.len(), Vec4::ZERO);
        (scratch.revision, scratch.assembled_stiffness, scratch.scale_key) =
            (revision, stiffness, scale_key);
        true
    }

    /// Assembles the matrix for the current links, stiffness and held particles.
    fn assemble(&self, scratch: &mut MeshBendScratch, count: usize) {
        let MeshBendScratch { elements, stiffness, area, w, mass, inverse_diagonal, .. } = scratch;
        let all = &self.hinges.all;
        let holds = |hinge: usize| self.active[self.hinges.links[hinge] as usize];
        let scale = |element: usize, corners: [u32; 3]| self.scale.of_element(element, &corners);
        let is_held = |vertex: u32| w[vertex as usize] == 0.0;
        self.hinges.elements.compute_stiffness(all, holds, is_held, scale, elements);
        area.clear();
        area.resize(count, 0.0);
        for (triangle, areas) in self.triangles.iter().zip(self.corner_area) {
            for (vertex, corner_area) in triangle.iter().zip(areas).filter(|(v, _)| !is_held(**v)) {
                area[*vertex as usize] += corner_area;
            }
        }
        stiffness.assemble(all, elements, self.step.stiffness, area);
        let each = inverse_diagonal.iter_mut().zip(&*w).zip(&*mass).zip(stiffness.diagonal());
        for (((inverse_diagonal, w), mass), diagonal) in each {
            *inverse_diagonal = if *w > 0.0 { 1.0 / (mass + diagonal) } else { 0.0 };
        }
        scratch.chebyshev = ChebyshevSteps::new(BOUND_FACTOR * stiffness.bound(w));
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
        for (i, (slot, (known, mass))) in scratch.x.iter_mut().zip(known).enumerate() {
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
        for element in &scratch.elements {
            add_element_forces(hinges, element, &scratch.rest_force, &mut scratch.residual);
        }
    }

    /// Solves (M + h² K) change = residual by preconditioned conjugate gradients.
    fn solve_conjugate_gradients(&self, scratch: &mut MeshBendScratch) {
        let MeshBendScratch {
            stiffness,
            mass,
            inverse_diagonal,
            change,
            residual,
            direction,
            product,
            ..
        } = scratch;
        let steps = (2.0 * (1.0 + 64.0 * self.stiffness_over_mass).sqrt()).min(MAX_STEPS) as u32;
        change.fill(Vec4::ZERO);
        direction.fill(Vec4::ZERO);
        update_direction(direction, residual, inverse_diagonal, 0.0);
        let mut residual2 = dot(direction, residual);
        let tolerance = residual2 * RESIDUAL_RATIO;
        for _ in 0..steps {
            if residual2 <= tolerance || residual2 <= TINY * TINY {
                return;
            }
            for ((product, direction), mass) in product.iter_mut().zip(&*direction).zip(&*mass) {
                *product = -*direction * *mass;
            }
            stiffness.add_forces(direction, product);
            let step_length = residual2 / -dot(direction, product);
            let next_residual2 =
                advance(step_length, [change, residual], [direction, product], inverse_diagonal);
            update_direction(direction, residual, inverse_diagonal, next_residual2 / residual2);
            residual2 = next_residual2;
        }
    }
}

/// Approximates the solution by Chebyshev steps.
fn solve_chebyshev(scratch: &mut MeshBendScratch, chebyshev: &ChebyshevSteps) {
    let MeshBendScratch { stiffness, w, mass, change, residual, direction, .. } = scratch;
    change.fill(Vec4::ZERO);
    for (at, [keep, gain]) in chebyshev.steps().iter().enumerate() {
        if at > 0 {
            stiffness.add_forces(direction, residual);
        }
        let of_particles = residual.iter_mut().zip(&*w).zip(&*mass);
        for ((change, direction), ((residual, w), mass)) in
            change.iter_mut().zip(&mut *direction).zip(of_particles)
        {
            let last = if at == 0 { Vec4::ZERO } else { *direction * *keep };
            *direction = last + *residual * (w * gain);
            *change += *direction;
            *residual -= *direction * *mass;
        }
    }
}

/// Adds the rest forces of the three hinges of an element to the residual; they sum to zero.
fn add_element_forces(
    hinges: &[Hinge],
    element: &TriangleStiffness,
    rest_force: &[Vec4],
    residual: &mut [Vec4],
) {
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
            let Hinge { particles: at, weight: [_, q, a, b], .. } =
                hinges[element.hinges[slot] as usize];
            let mut sum = Vec4::ZERO;
            for (vertex, weight) in at[1..].iter().zip([q, a, b]) {
                let force = force * weight;
                residual[*vertex as usize] += force;
                sum += force;
            }
            residual[at[0] as usize] -= sum;
        }
    }
}

/// Updates the search direction: preconditioned residual plus `keep` times the last direction.
fn update_direction(
    direction: &mut [Vec4],
    residual: &[Vec4],
    inverse_diagonal: &[f32],
    keep: f32,
) {
    for ((direction, residual), inverse_diagonal) in
        direction.iter_mut().zip(residual).zip(inverse_diagonal)
    {
        *direction = *residual * *inverse_diagonal + *direction * keep;
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

/// Moves `step_length` along the search direction, updates the residual, and returns its squared
/// norm under the preconditioner.
fn advance(
    step_length: f32,
    [change, residual]: [&mut [Vec4]; 2],
    [direction, product]: [&[Vec4]; 2],
    inverse_diagonal: &[f32],
) -> f32 {
    let mut sums = [Vec4::ZERO; 2];
    for (at, (change, residual)) in change.iter_mut().zip(residual).enumerate() {
        *change += direction[at] * step_length;
        *residual += product[at] * step_length;
        sums[at % 2] += *residual * *residual * inverse_diagonal[at];
    }
    sum(sums)
}

fn sum([even, odd]: [Vec4; 2]) -> f32 {
    let [x, y, z, _] = (even + odd).to_array();
    (x + y) + z
}
