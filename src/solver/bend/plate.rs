//! Bending of a grid by plate elements: one implicit step for the whole sheet.
//!
//! ```text
//! M d = −h² K (x + d)          K = K_weft + K_warp + K_twist,  d: displacement by bending
//!
//! weft ▶ warp ▶ twist          first solve: (M + h² K_i) Δ_i = −h² K_i x − M d_i
//! twist ▶ warp ▶ weft          second solve: (µ M + h² K_i) Δ_i, with the same right side
//! ```
//! Method: K couples so widely that Gauss–Seidel sweeps over elements would take thousands of
//! iterations for a sheet as stiff as paper. K_weft and K_warp are pentadiagonal along rows and
//! columns, so their factors are cheap (`banded`). Each of the three parts is solved by itself, with
//! the forces of the others as they are: block Gauss–Seidel for the multipliers of XPBD (Macklin,
//! Müller, Chentanez, MIG 2016). d_i is what part i has done so far. At equilibrium the right side is
//! zero, so the rest shape does not depend on the number of solves. `twist` solves the twist, and
//! `chebyshev` soft sheets.
//!
//! Each solve is a projection in the norm of the energy, or part of one for µ > 1, and the second
//! solve mirrors the first. So x + d is x times a symmetric matrix with eigenvalues from 0 to 1,
//! which no time integration scheme turns into growth. A product of both directions (ADI; Peaceman
//! and Rachford 1955) is not: where pins and cuts keep K_weft and K_warp from commuting it has
//! complex eigenvalues, which add energy. µ leaves to the links what they did in between. With one
//! iteration there is no second solve: the scheme of such settings, BDF1, damps what one order adds.
//!
//! Reads plate elements, folds, masses and positions; writes positions and `PlateScratch`.
//! Invariant: factors and bound are recomputed when pins, masses, elements or stiffness change.

use crate::math::columns::Columns;
use crate::math::heap_bytes::heap_bytes;
use crate::math::reserve::zeros;
use crate::math::simd::Level;
use crate::math::swap::swap;
use crate::math::{max, same_bits};
use crate::model::bend_scale::{BendScale, BendScaleKey};
use crate::model::plate_elements::{PerKind, PlateElements};
use crate::solver::bend::banded::VectorColumns;
use crate::solver::bend::chebyshev::ChebyshevSteps;
use crate::solver::bend::line_factors::LineFactors;
use crate::solver::bend::plate_kernels::{
    apply_displacement, compute_curvature, compute_line_curvature, compute_twist, first_step,
    gather_forces, gather_line_forces, next_step, subtract_momentum, subtract_rest, subtract_start,
};
use crate::solver::bend::spectral_bound;
use crate::solver::bend::twist::{Twist, TwistOffset, resize};

/// Stiffness over mass from which the second solve runs.
const MIN_SECOND_SOLVE: f32 = 0.25;
/// Factor of the shift of the second solve: µ = `SHIFT_FACTOR` · √(stiffness over mass).
const SHIFT_FACTOR: f32 = 4.0;

/// Largest stiffness over mass; beyond it f32 cannot distinguish the sheet from a rigid one.
pub(crate) const MAX_STIFFNESS_OVER_MASS: f32 = 3.0e4;

/// Buffers of one tick.
#[derive(Clone, Debug, Default)]
struct PlateBuffers {
    /// Weighted curvature of each element for one axis, with a margin on both sides.
    curve: PerKind<Vec<f32>>,
    /// Positions less the damping share of the start positions; later a force buffer.
    shifted: Vec<f32>,
    force: VectorColumns,
    /// Displacement by the weft and by the warp elements in this substep [m].
    total: [VectorColumns; 2],
}

/// Buffers, and factors that are valid until pins, masses or stiffness change.
#[derive(Clone, Debug, Default)]
pub(crate) struct PlateScratch {
    buffers: PlateBuffers,
    /// Stiffness of each element relative to an interior one.
    weight: PerKind<Vec<f32>>,
    /// Upper bound of the stiffness over mass of any shape, relative to an interior element [1/kg].
    bound: f32,
    factors: [LineFactors; 2],
    twist: Twist,
    w: Vec<f32>,
    mass: Vec<f32>,
    revision: u32,
    /// Key of the scales for which the weights were computed.
    scale_key: BendScaleKey,
}

heap_bytes!(
    PlateScratch {
        weight, factors, twist, w, mass,
    } plain { buffers, bound, revision, scale_key }
);

/// Parameters of one solve.
#[derive(Clone, Copy, Debug)]
pub(crate) struct PlateStep<'a> {
    pub level: Level,
    /// Stiffness of an element times the squared substep [kg].
    pub stiffness: f32,
    /// Smallest mass of a particle that is not on a border [kg].
    pub mass: f32,
    /// Share of the start positions to subtract, for damping; see `HingeStep`.
    pub start_share: f32,
    /// Whether this is the first solve of the substep.
    pub is_first: bool,
    /// Predicted positions and displacements; their difference is the start position.
    pub predicted: &'a Columns,
    pub displacement: &'a Columns,
    /// Rest curvature of each element [m] and its direction; `None` without folds.
    pub rest: Option<(&'a PerKind<Vec<f32>>, &'a PerKind<Columns>)>,
    pub scale: BendScale<'a>,
}

impl PlateScratch {
    pub fn new(plates: &PlateElements) -> Self {
        let count = plates.count();
        let list = || zeros(count);
        Self {
            buffers: PlateBuffers::default(),
            weight: [list(), list(), list()],
            bound: 0.0,
            factors: [LineFactors::new(count), LineFactors::new(count)],
            twist: Twist::new(plates),
            w: vec![-1.0; count],
            mass: list(),
            revision: plates.revision,
            scale_key: BendScaleKey::default(),
        }
    }

    /// Exchanges the buffers of one tick with those of `other`.
    pub fn swap_lent(&mut self, other: &mut Self) {
        swap(&mut self.buffers, &mut other.buffers);
        self.twist.swap_lent(&mut other.twist);
    }

    fn lists_of_tick(&mut self) -> impl Iterator<Item = &mut Vec<f32>> {
        let PlateBuffers { curve, shifted, force, total } = &mut self.buffers;
        let lists = force.iter_mut().chain(total.as_flattened_mut()).chain([shifted]);
        curve.iter_mut().chain(lists)
    }

    /// Empties the buffers of one tick.
    pub fn clear_lent(&mut self) {
        self.lists_of_tick().for_each(Vec::clear);
        self.twist.clear_lent();
    }

    /// Gives the buffers of one tick the lengths for `plates`. New entries are zero.
    #[inline(never)]
    pub fn resize_lent(&mut self, plates: &PlateElements) {
        let (count, margin) = (plates.count(), plates.columns + 1);
        for (at, list) in self.lists_of_tick().enumerate() {
            resize(list, if at < 3 { count + 2 * margin } else { count });
        }
        self.twist.resize_lent(plates);
    }

    /// Updates weights and bound if pins, masses or elements changed, and returns whether they did.
    fn refresh(
        &mut self,
        plates: &PlateElements,
        scale: BendScale<'_>,
        w: &[f32],
        mass: &[f32],
    ) -> bool {
        let count = plates.count();
        let is_torn = w.len() > count;
        let (w, mass) = (&w[..count], &mass[..count]);
        let scale_key = scale.key();
        let is_unchanged = (self.revision, self.scale_key) == (plates.revision, scale_key);
        if is_unchanged && same_bits(&self.w, w) && same_bits(&self.mass, mass) {
            return false;
        }
        (self.revision, self.scale_key) = (plates.revision, scale_key);
        self.w.copy_from_slice(w);
        self.mass.copy_from_slice(mass);
        for (weight, share) in self.weight.iter_mut().zip(&plates.area_fraction) {
            weight.copy_from_slice(share);
        }
        let steps = [1, plates.columns];
        for (weight, step) in self.weight.iter_mut().zip(steps) {
            for at in step..count - step {
                if weight[at] > 0.0 && w[at] == 0.0 {
                    weight[at] *= clamped(w[at - step], w[at + step]);
                }
            }
        }
        scale.apply(plates.columns, &mut self.weight);
        self.bound = if is_torn {
            let buffers = (&mut self.buffers.shifted[..], &mut self.buffers.curve);
            spectral_bound::of_torn(plates.columns, &self.weight, &self.w, buffers)
        } else {
            spectral_bound::of_whole(plates.columns, &self.weight, &self.w)
        };
        true
    }

    /// Computes the bending force along one axis, times h² [kg m].
    fn compute_force(
        &mut self,
        step: PlateStep<'_>,
        stiffness: f32,
        columns: usize,
        axis: usize,
        x: &[f32],
    ) {
        let Self { weight, buffers, .. } = self;
        let PlateBuffers { curve, shifted, force, .. } = buffers;
        let x = shift_positions(step, axis, x, shifted);
        compute_curvature(step.level, x, weight, curve, columns);
        compute_twist(step.level, x, &weight[2], &mut curve[2], columns);
        for kind in 0..3 {
            subtract_rest_of(step, kind, axis, &weight[kind], &mut curve[kind][columns + 1..]);
        }
        gather_forces(step.level, curve, stiffness, &mut force[axis], columns);
    }

    /// Solves the elements of one direction exactly, given what all others have done so far, and
    /// moves the particles: (M + h² K) Δ = −h² K x − M d, d: what this direction has done so far.
    fn solve_direction(
        &mut self,
        step: PlateStep<'_>,
        direction: Direction,
        columns: usize,
        x: &mut Columns,
        mass: &[f32],
        is_first: bool,
    ) {
        let Self { weight, buffers, factors, .. } = self;
        let PlateBuffers { curve, shifted, force, total } = buffers;
        let (kind, stride) = match direction {
            Direction::Weft => (0, 1),
            Direction::Warp => (1, columns),
        };
        let factors = &factors[if is_first { 0 } else { 1 }];
        let (weight, curve, total) = (&weight[kind], &mut curve[kind], &mut total[kind]);
        let inside = columns + 1..columns + 1 + weight.len();
        for (axis, (force, total)) in force.iter_mut().zip(&*total).enumerate() {
            let x = shift_positions(step, axis, x.slices()[axis], shifted);
            compute_line_curvature(step.level, x, weight, &mut curve[inside.clone()], stride);
            subtract_rest_of(step, kind, axis, weight, &mut curve[inside.clone()]);
            gather_line_forces(step.level, curve, factors.stiffness, force, [columns + 1, stride]);
            if !is_first {
                subtract_momentum(step.level, force, total, mass);
            }
        }
        match direction {
            Direction::Weft => factors.weft.solve_rows(columns, force),
            Direction::Warp => factors.warp.solve_columns(step.level, columns, force),
        }
        for ((x, displacement), total) in x.slices_mut().into_iter().zip(&*force).zip(total) {
            let x = &mut x[..total.len()];
            apply_displacement(step.level, x, displacement, total, is_first);
        }
    }
}

/// Direction of second differences.
#[derive(Clone, Copy, Debug)]
enum Direction {
    Weft,
    Warp,
}

/// Positions along one axis less the damping share of the start positions, which are stored in
/// `shifted`; without damping the positions themselves.
fn shift_positions<'a>(
    step: PlateStep<'_>,
    axis: usize,
    x: &'a [f32],
    shifted: &'a mut [f32],
) -> &'a [f32] {
    let count = shifted.len();
    let x = &x[..count];
    if step.start_share == 0.0 {
        return x;
    }
    let start =
        [&step.predicted.slices()[axis][..count], &step.displacement.slices()[axis][..count]];
    subtract_start(step.level, shifted, x, start, step.start_share);
    shifted
}

/// Subtracts the rest curvature of the elements of one kind along one axis, if there are folds.
fn subtract_rest_of(
    step: PlateStep<'_>,
    kind: usize,
    axis: usize,
    weight: &[f32],
    curve: &mut [f32],
) {
    if let Some((rest, directions)) = step.rest {
        let direction = &directions[kind].slices()[axis][..weight.len()];
        let share = 1.0 - step.start_share;
        subtract_rest(step.level, weight, &rest[kind], direction, share, curve);
    }
}

/// Bends a soft sheet by explicit Chebyshev steps, axis by axis.
fn solve_chebyshev(
    scratch: &mut PlateScratch,
    step: PlateStep<'_>,
    stiffness: f32,
    columns: usize,
    chebyshev: &ChebyshevSteps,
    x: &mut Columns,
) {
    for (axis, x) in x.slices_mut().into_iter().enumerate() {
        scratch.compute_force(step, stiffness, columns, axis, x);
        let PlateScratch { weight, buffers, w, mass, .. } = &mut *scratch;
        let PlateBuffers { curve, shifted: force_change, force, total } = buffers;
        let (force, displacement) = (&mut force[axis][..], &mut total[0][axis][..]);
        let x = &mut x[..displacement.len()];
        let [[_, gain], rest @ ..] = chebyshev.steps() else {
            displacement.fill(0.0);
            continue;
        };
        first_step(step.level, *gain, w, force, displacement, x);
        for share in rest {
            compute_curvature(step.level, displacement, weight, curve, columns);
            compute_twist(step.level, displacement, &weight[2], &mut curve[2], columns);
            gather_forces(step.level, curve, stiffness, force_change, columns);
            next_step(
                step.level,
                *share,
                [&force_change[..], &w[..], &mass[..]],
                force,
                displacement,
                x,
            );
        }
    }
}

/// Stiffness factor of an element with a held middle particle: 2 where the cloth enters a clamp,
/// because only the half outside the clamp bends.
fn clamped(wa: f32, wb: f32) -> f32 {
    if (wa == 0.0) == (wb == 0.0) { 1.0 } else { 2.0 }
}

/// Runs one solve of the sheet; skips the second one of a substep if it does not pay.
pub(crate) fn solve(
    plates: &PlateElements,
    scratch: &mut PlateScratch,
    step: PlateStep<'_>,
    x: &mut Columns,
    w: &[f32],
    mass: &[f32],
) {
    let (count, columns) = (plates.count(), plates.columns);
    let max_stiffness = MAX_STIFFNESS_OVER_MASS * step.mass;
    let stiffness = if step.stiffness < max_stiffness { step.stiffness } else { max_stiffness };
    let has_changed = step.is_first && scratch.refresh(plates, step.scale, w, mass);
    if let Some(chebyshev) = ChebyshevSteps::new(scratch.bound * stiffness) {
        if step.is_first {
            // Invalidate the factors, because `refresh` may have changed pins and masses.
            scratch.factors.iter_mut().for_each(|factors| factors.stiffness = -1.0);
            solve_chebyshev(scratch, step, stiffness, columns, &chebyshev, x);
        }
        return;
    }
    let stiffness_over_mass = stiffness * step.scale.largest() / step.mass;
    if !step.is_first && stiffness_over_mass < MIN_SECOND_SOLVE {
        return;
    }
    if step.is_first {
        if has_changed || scratch.factors[0].stiffness != stiffness {
            scratch.twist.factor(plates, &scratch.weight[2], w, stiffness);
        }
        let shift = max(1.0, SHIFT_FACTOR * stiffness_over_mass.sqrt());
        for (factors, shift) in scratch.factors.iter_mut().zip([1.0, shift]) {
            if has_changed || factors.stiffness != stiffness || factors.shift != shift {
                (factors.stiffness, factors.shift) = (stiffness, shift);
                factors.factor(plates, &scratch.weight, &scratch.w, &scratch.mass);
            }
        }
    }
    let offset = TwistOffset {
        start_share: step.start_share,
        predicted: step.predicted,
        displacement: step.displacement,
        rest: step.rest.map(|(rest, directions)| (&rest[2][..], &directions[2])),
    };
    let mass = &mass[..count];
    if step.is_first {
        for direction in [Direction::Weft, Direction::Warp] {
            scratch.solve_direction(step, direction, columns, x, mass, true);
        }
        scratch.twist.solve(step.level, columns, x, w, offset, true);
    }
    if !step.is_first {
        scratch.twist.solve(step.level, columns, x, w, offset, false);
        for direction in [Direction::Warp, Direction::Weft] {
            scratch.solve_direction(step, direction, columns, x, mass, false);
        }
    }
}
