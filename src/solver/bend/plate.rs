//! The plates of a grid: one implicit step of bending for all at once.
//!
//! With K the matrix of the bending energy, a substep of length h is to end at M d = −h² K x, where d is
//! what bending moves the particles by and x is where they are then. K couples so widely that sweeps
//! element by element would take thousands of rounds on paper. But its parts along the rows and along the
//! columns are five diagonals each, which are factored once and then solved from end to end, so that
//!
//! ```text
//! (µM + h² K_weft) (µM)⁻¹ (µM + h² K_warp) Δ = −h² K x − M d
//! ```
//! takes most of what is left, in all directions and whatever the stiffness: this is the alternating
//! direction method (Peaceman and Rachford 1955; Wachspress on the shifts µ). Where particles come to
//! rest the right side is naught, so that they rest where the elements say, however few the rounds. The
//! twist goes by itself, see `twist`. For a soft sheet a few explicit steps do for all, see `descent`.

use crate::math::columns::Columns;
use crate::math::same_bits;
use crate::math::simd::{Level, leveled};
use crate::model::hardening::Softening;
use crate::model::plate_elements::{PerKind, PlateElements};
use crate::solver::bend::banded::{GridLine, PentadiagonalFactor, VectorColumns};
use crate::solver::bend::chebyshev::ChebyshevSteps;
use crate::solver::bend::spectral_bound;
use crate::solver::bend::twist::{Twist, TwistOffset};

/// From this one on the second round has a shift of its own, which is this many times its root.
const SHIFTED: f32 = 0.25;
const SHIFT: f32 = 4.0;

/// The most stiffness over mass that numbers of 24 bits can tell from a rigid sheet.
const MOST: f32 = 3.0e4;

/// Room to work in, and what is known as long as pins, masses and stiffness stay.
#[derive(Clone, Debug, Default)]
pub(crate) struct PlateScratch {
    /// How stiff each element is, over one inside.
    weight: PerKind<Vec<f32>>,
    /// The curvature of each element in one direction, with room around it.
    curve: PerKind<Vec<f32>>,
    /// Where particles are taken to be, if that is not where they are; then what pulls them back.
    seen: Vec<f32>,
    force: VectorColumns,
    /// The most stiffness over mass that any shape has, over that of one element inside [1/kg].
    most: f32,
    /// What bending has moved each particle by in this substep [m].
    given: VectorColumns,
    rounds: [Round; 2],
    twist: Twist,
    w: Vec<f32>,
    mass: Vec<f32>,
    revision: u32,
    /// Of what made elements softer.
    softer: Option<(u32, f32)>,
}

/// Factors for one shift.
#[derive(Clone, Debug, Default)]
struct Round {
    stiffness: f32,
    shift: f32,
    weft: PentadiagonalFactor,
    warp: PentadiagonalFactor,
}

/// What a substep of bending works with.
#[derive(Clone, Copy, Debug)]
pub(crate) struct PlateStep<'a> {
    pub level: Level,
    /// Stiffness of an element times the square of the substep [kg].
    pub stiffness: f32,
    /// The mass that an element's particles have at least, but at borders [kg].
    pub mass: f32,
    /// The share of where particles were that is taken off where they are, for damping.
    pub start_share: f32,
    /// Whether it is the first round of the substep.
    pub is_first: bool,
    /// Where the substep began: where particles were led to, and by which way.
    pub predicted: &'a Columns,
    pub displacement: &'a Columns,
    /// What each element is curved by at rest [m], and which way.
    pub rest: Option<(&'a PerKind<Vec<f32>>, &'a PerKind<Columns>)>,
    /// How much softer elements are by what gave way, if they are.
    pub softening: Option<Softening<'a>>,
}

impl PlateScratch {
    pub fn new(plates: &PlateElements) -> Self {
        let count = plates.count();
        let list = || vec![0.0; count];
        let around = || vec![0.0; count + 2 * (plates.columns + 1)];
        Self {
            weight: [list(), list(), list()],
            curve: [around(), around(), around()],
            seen: list(),
            force: [list(), list(), list()],
            most: 0.0,
            given: [list(), list(), list()],
            rounds: [Round::new(count), Round::new(count)],
            twist: Twist::new(plates),
            w: vec![-1.0; count],
            mass: list(),
            revision: plates.revision,
            softer: None,
        }
    }

    /// Whether pins, masses or elements have changed; then takes them up.
    fn take_up(
        &mut self,
        plates: &PlateElements,
        softening: Option<Softening<'_>>,
        w: &[f32],
        mass: &[f32],
    ) -> bool {
        let count = plates.count();
        let is_torn = w.len() > count;
        let (w, mass) = (&w[..count], &mass[..count]);
        let softer = softening.map(|softening| softening.key());
        let is_same = (self.revision, self.softer) == (plates.revision, softer);
        if is_same && same_bits(&self.w, w) && same_bits(&self.mass, mass) {
            return false;
        }
        (self.revision, self.softer) = (plates.revision, softer);
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
        if let Some(softening) = softening {
            softening.apply(plates.columns, &mut self.weight);
        }
        self.most = if is_torn {
            let room = (&mut self.seen[..], &mut self.curve);
            spectral_bound::of_torn(plates.columns, &self.weight, &self.w, room)
        } else {
            spectral_bound::of_whole(plates.columns, &self.weight, &self.w)
        };
        true
    }

    /// Finds what pushes particles along an axis, times the square of the substep.
    fn look(
        &mut self,
        step: PlateStep<'_>,
        stiffness: f32,
        columns: usize,
        axis: usize,
        x: &[f32],
        has_twist: bool,
    ) {
        let Self { weight, curve, seen, force, .. } = self;
        let count = seen.len();
        let x = &x[..count];
        let seen = if step.start_share == 0.0 {
            x
        } else {
            let start =
                [&step.predicted.all()[axis][..count], &step.displacement.all()[axis][..count]];
            look_back(step.level, seen, x, start, step.start_share);
            &seen[..]
        };
        find_curves(step.level, seen, weight, curve, columns);
        if has_twist {
            find_twists(step.level, seen, &weight[2], &mut curve[2], columns);
        }
        if let Some((rest, ways)) = step.rest {
            let share = 1.0 - step.start_share;
            for kind in 0..if has_twist { 3 } else { 2 } {
                let (weight, rest) = (&weight[kind], &rest[kind]);
                let way = &ways[kind].all()[axis][..count];
                take_rest(step.level, weight, rest, way, share, &mut curve[kind][columns + 1..]);
            }
        }
        gather(step.level, curve, stiffness, &mut force[axis], columns);
    }
}

/// Bends a soft sheet: all the steps of a descent.
fn descend(
    room: &mut PlateScratch,
    step: PlateStep<'_>,
    stiffness: f32,
    columns: usize,
    descent: &ChebyshevSteps,
    x: &mut Columns,
) {
    for (axis, x) in x.all_mut().into_iter().enumerate() {
        room.look(step, stiffness, columns, axis, x, true);
        let PlateScratch { weight, curve, seen: pull, force, given, w, mass, .. } = &mut *room;
        let (force, way) = (&mut force[axis][..], &mut given[axis][..]);
        let x = &mut x[..way.len()];
        let [[_, take], rest @ ..] = descent.steps() else {
            way.fill(0.0);
            continue;
        };
        set_out(step.level, *take, w, force, way, x);
        for share in rest {
            find_curves(step.level, way, weight, curve, columns);
            find_twists(step.level, way, &weight[2], &mut curve[2], columns);
            gather(step.level, curve, stiffness, pull, columns);
            step_down(step.level, *share, [&pull[..], &w[..], &mass[..]], force, way, x);
        }
    }
}

/// How many times as stiff an element is whose middle is held: where the cloth goes on into a clamp, only
/// the half of it that is outside bends.
pub(crate) fn clamped(wa: f32, wb: f32) -> f32 {
    if (wa == 0.0) == (wb == 0.0) { 1.0 } else { 2.0 }
}

/// Bends the sheet for one round; the second one only where it pays.
pub(crate) fn solve(
    plates: &PlateElements,
    room: &mut PlateScratch,
    step: PlateStep<'_>,
    x: &mut Columns,
    w: &[f32],
    mass: &[f32],
) {
    let (count, columns) = (plates.count(), plates.columns);
    let stiffness =
        if step.stiffness < MOST * step.mass { step.stiffness } else { MOST * step.mass };
    let has_changed = step.is_first && room.take_up(plates, step.softening, w, mass);
    if let Some(descent) = ChebyshevSteps::new(room.most * stiffness) {
        if step.is_first {
            // What was factored may be of other pins and masses.
            room.rounds.iter_mut().for_each(|round| round.stiffness = -1.0);
            descend(room, step, stiffness, columns, &descent, x);
        }
        return;
    }
    let over_mass = stiffness / step.mass;
    if !step.is_first && over_mass < SHIFTED {
        return;
    }
    if step.is_first {
        room.curve[2].fill(0.0);
        if has_changed || room.rounds[0].stiffness != stiffness {
            room.twist.factor(plates, &room.weight[2], w, stiffness);
        }
        let own = SHIFT * over_mass.sqrt();
        for (round, shift) in room.rounds.iter_mut().zip([1.0, own]) {
            if has_changed || round.stiffness != stiffness || round.shift != shift {
                (round.stiffness, round.shift) = (stiffness, shift);
                round.factor(plates, &room.weight, &room.w, &room.mass);
            }
        }
    }
    let from = TwistOffset {
        start_share: step.start_share,
        predicted: step.predicted,
        displacement: step.displacement,
        rest: step.rest.map(|(rest, ways)| (&rest[2][..], &ways[2])),
    };
    if !step.is_first {
        room.twist.solve(step.level, columns, x, w, from, false);
    }
    for axis in 0..3 {
        room.look(step, stiffness, columns, axis, x.all()[axis], false);
        if !step.is_first {
            for ((force, given), mass) in
                room.force[axis].iter_mut().zip(&room.given[axis]).zip(mass)
            {
                *force -= given * mass;
            }
        }
    }
    let PlateScratch { force, given, rounds, twist, .. } = room;
    let round = &rounds[if step.is_first { 0 } else { 1 }];
    if step.is_first {
        round.weft.solve_rows(columns, force);
        round.lift(step.level, &mass[..count], force);
        round.warp.solve_columns(step.level, columns, force);
    } else {
        round.warp.solve_columns(step.level, columns, force);
        round.lift(step.level, &mass[..count], force);
        round.weft.solve_rows(columns, force);
    }
    for ((x, way), given) in x.all_mut().into_iter().zip(&*force).zip(given) {
        move_on(step.level, &mut x[..count], way, given, step.is_first);
    }
    if step.is_first {
        twist.solve(step.level, columns, x, w, from, true);
    }
}

impl Round {
    fn new(count: usize) -> Self {
        let (weft, warp) = (PentadiagonalFactor::new(count), PentadiagonalFactor::new(count));
        Self { stiffness: -1.0, shift: 0.0, weft, warp }
    }

    fn factor(
        &mut self,
        plates: &PlateElements,
        weight: &PerKind<Vec<f32>>,
        w: &[f32],
        mass: &[f32],
    ) {
        let (columns, rows) = (plates.columns, plates.rows);
        let (stiffness, shift) = (self.stiffness, self.shift);
        for row in 0..rows {
            let line = GridLine { first: row * columns, step: 1, count: columns };
            self.weft.factor(line, &weight[0], w, mass, stiffness, shift);
        }
        for column in 0..columns {
            let line = GridLine { first: column, step: columns, count: rows };
            self.warp.factor(line, &weight[1], w, mass, stiffness, shift);
        }
    }

    /// Between the two halves: times µM.
    fn lift(&self, level: Level, mass: &[f32], force: &mut VectorColumns) {
        force.iter_mut().for_each(|force| weigh(level, force, mass, self.shift));
    }
}

leveled! {
    /// Where particles are, less a share of where they were.
    fn look_back(seen: &mut [f32], x: &[f32], start: [&[f32]; 2], before: f32) = look_back_lanes
}

#[inline(always)]
fn look_back_lanes(seen: &mut [f32], x: &[f32], [predicted, way]: [&[f32]; 2], before: f32) {
    for (((seen, x), predicted), way) in seen.iter_mut().zip(x).zip(predicted).zip(way) {
        *seen = x - (predicted - way) * before;
    }
}

leveled! {
    /// The curvature of each element, times how stiff it is.
    fn find_curves(
        x: &[f32],
        weight: &PerKind<Vec<f32>>,
        curve: &mut PerKind<Vec<f32>>,
        columns: usize,
    ) = find_curves_lanes
}

#[inline(always)]
fn find_curves_lanes(
    x: &[f32],
    [weft, warp, _]: &PerKind<Vec<f32>>,
    [to_weft, to_warp, _]: &mut PerKind<Vec<f32>>,
    columns: usize,
) {
    let (count, edge) = (x.len(), columns + 1);
    let out = to_weft[edge + 1..edge + count - 1].iter_mut().zip(&weft[1..count - 1]);
    // Windows: what lies side by side is found by one address.
    for ((out, weight), x) in out.zip(x.windows(3)) {
        *out = ((x[0] + x[2]) - 2.0 * x[1]) * weight;
    }
    let inner = columns..count - columns;
    let out = to_warp[edge + columns..edge + count - columns].iter_mut().zip(&warp[inner.clone()]);
    let ends = x[..count - 2 * columns].iter().zip(&x[2 * columns..]);
    for (((out, weight), (a, b)), m) in out.zip(ends).zip(&x[inner]) {
        *out = ((a + b) - 2.0 * m) * weight;
    }
}

leveled! {
    /// The twist of each cell, times how stiff it is.
    fn find_twists(x: &[f32], weight: &[f32], twist: &mut [f32], columns: usize) = find_twists_lanes
}

#[inline(always)]
fn find_twists_lanes(x: &[f32], weight: &[f32], twist: &mut [f32], columns: usize) {
    let cells = x.len() - columns - 1;
    let edge = columns + 1;
    let out = twist[edge..edge + cells].iter_mut().zip(&weight[..cells]);
    for (((out, weight), upper), lower) in out.zip(x.windows(2)).zip(x[columns..].windows(2)) {
        *out = ((upper[0] - upper[1]) - (lower[0] - lower[1])) * weight;
    }
}

leveled! {
    /// Takes off the curvature that elements have at rest.
    fn take_rest(
        weight: &[f32],
        rest: &[f32],
        way: &[f32],
        share: f32,
        curve: &mut [f32],
    ) = take_rest_lanes
}

#[inline(always)]
fn take_rest_lanes(weight: &[f32], rest: &[f32], way: &[f32], share: f32, curve: &mut [f32]) {
    for (((curve, weight), rest), way) in curve.iter_mut().zip(weight).zip(rest).zip(way) {
        *curve -= rest * share * way * weight;
    }
}

leveled! {
    /// What pushes each particle, times the square of the substep.
    fn gather(
        curve: &PerKind<Vec<f32>>,
        stiffness: f32,
        force: &mut [f32],
        columns: usize,
    ) = gather_lanes
}

#[inline(always)]
fn gather_lanes(
    [weft, warp, twist]: &PerKind<Vec<f32>>,
    stiffness: f32,
    force: &mut [f32],
    columns: usize,
) {
    let (count, edge) = (force.len(), columns + 1);
    let weft = weft[edge - 1..].windows(3);
    let warp = warp[1..][..count].iter().zip(&warp[edge..]).zip(&warp[edge + columns..]);
    let twist = twist[..count + 1].windows(2).zip(twist[columns..].windows(2));
    for (((force, weft), ((above, warp), below)), (upper, lower)) in
        force.iter_mut().zip(weft).zip(warp).zip(twist)
    {
        let along = (2.0 * weft[1] - weft[0]) - weft[2];
        let down = (2.0 * warp - above) - below;
        let turn = (lower[1] - lower[0]) - (upper[1] - upper[0]);
        *force = ((along + down) - turn) * stiffness;
    }
}

leveled! {
    /// The first step of a descent, which has no way behind it.
    fn set_out(take: f32, w: &[f32], force: &mut [f32], way: &mut [f32], x: &mut [f32])
        = set_out_lanes
}

#[inline(always)]
fn set_out_lanes(take: f32, w: &[f32], force: &mut [f32], way: &mut [f32], x: &mut [f32]) {
    for (((x, way), force), w) in x.iter_mut().zip(way).zip(force).zip(w) {
        // As `step_down` would with no way: naught and less than naught are told apart.
        *force += 0.0;
        *way = 0.0 + *force * w * take;
        *x += *way;
    }
}

leveled! {
    /// One step of a descent: the force that is left, the way, and where that leads.
    fn step_down(
        share: [f32; 2],
        given: [&[f32]; 3],
        force: &mut [f32],
        way: &mut [f32],
        x: &mut [f32],
    ) = step_down_lanes
}

#[inline(always)]
fn step_down_lanes(
    [keep, take]: [f32; 2],
    [pull, w, mass]: [&[f32]; 3],
    force: &mut [f32],
    way: &mut [f32],
    x: &mut [f32],
) {
    let given = pull.iter().zip(w).zip(mass);
    for (((x, way), force), ((pull, w), mass)) in x.iter_mut().zip(way).zip(force).zip(given) {
        *force += pull - mass * *way;
        *way = *way * keep + *force * w * take;
        *x += *way;
    }
}

leveled! {
    fn weigh(force: &mut [f32], mass: &[f32], shift: f32) = weigh_lanes
}

#[inline(always)]
fn weigh_lanes(force: &mut [f32], mass: &[f32], shift: f32) {
    for (force, mass) in force.iter_mut().zip(mass) {
        *force *= mass * shift;
    }
}

leveled! {
    fn move_on(x: &mut [f32], way: &[f32], given: &mut [f32], is_first: bool) = move_on_lanes
}

#[inline(always)]
fn move_on_lanes(x: &mut [f32], way: &[f32], given: &mut [f32], is_first: bool) {
    for ((x, way), given) in x.iter_mut().zip(way).zip(given) {
        *x += way;
        *given = if is_first { *way } else { *given + way };
    }
}
