//! Stage `Stretch`, once a substep: every line of links is solved as a whole.
//!
//! The links of a line are coupled only to their neighbours in it, so their multipliers are those of
//! a tridiagonal system, which is solved in one way there and one back (Thomas):
//!
//! ```text
//! (w₋ + w₊ + α̃) λ − w₋ (n₋·n) λ₋ − w₊ (n·n₊) λ₊ = C
//! ```
//! So a load at one end is borne by the whole line at once.
//!
//! What pulls then turns with the line: taut links pull along where their ends will be, not along
//! where prediction left them. With q = λ / length for those, and all else of the pull in p, the
//! particles move by the solution of a second tridiagonal system,
//!
//! ```text
//! (1 + w (q₋ + q₊)) u − w q₋ u₋ − w q₊ u₊ = w p
//! ```
//! for without it a long line whose sideways swing is faster than a substep would chatter. What a link
//! was too long or too short by when the substep began is not all put right at once: in a tangle
//! lines cannot be right, and those that insist never come to rest.
//!
//! Eight lines lie side by side; each lane is a line of its own, so that lanes change no bits.

use crate::solver::stretch::line_gather::Seats;
use crate::solver::stretch::link_projection::is_rigid;
use crate::solver::stretch::{line_gather, line_strided};

use crate::math::columns::Columns;
use crate::math::simd::{Float, LANES, LaneArray, Level, Scalar, Simd, vectored};
use crate::math::{TINY, max};
use crate::mesh::NONE;
use crate::model::line_blocks;
use crate::model::links::{LinkKind, Links};
use crate::solver::world::World;

/// What a taut line gives way by, as a share of its weight: pulled from both ends its system has no
/// solution.
const GIVE: f32 = 1.0e-6;

/// The share of what a link was too long or too short by that a substep puts right.
const MEND: f32 = 0.3;

/// Loads are at least as on earth [m/s²]: wind and hands pull where there is no gravity.
const EARTH: f32 = 9.81;

/// Three columns of eight.
type Lanes3 = [LaneArray; 3];

/// Room to work in.
#[derive(Clone, Debug, Default)]
pub(crate) struct LineScratch {
    /// Each particle's position and inverse mass, after a seat that is nobody's.
    pub points: Vec<[f32; 4]>,
    /// Where each particle was when the substep began.
    pub starts: Vec<[f32; 4]>,
    /// The same in columns, for strips, after one that is nobody's.
    pub columns: Columns,
    /// What is known of each step of a block, after one that is none.
    steps: Vec<Step>,
}

/// Eight links side by side, and the particles that they run to. What is not needed any more makes room: the
/// nearest memory holds a block just so.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Step {
    /// Where the particles are, and their inverse mass.
    pub to: [LaneArray; 4],
    /// What the links are to be long; then how long they are as a share of that.
    pub aim: LaneArray,
    /// One over what they are to be long.
    pub over: LaneArray,
    /// Their directions; then how the particles move beside what those before do.
    n: Lanes3,
    /// How each link hangs on the one before: less what it has to do with it in the system.
    before: LaneArray,
    /// One over its pivot.
    inverse: LaneArray,
    /// The right side of the system; then the share that the particles move by of what those before do.
    right: LaneArray,
}

impl LineScratch {
    /// Room for blocks of so many steps, and so many particles, which strips may run over.
    pub fn new(steps: usize, particles: usize, has_strips: bool) -> Self {
        Self {
            points: Vec::with_capacity(particles + 1),
            starts: Vec::with_capacity(particles + 1),
            columns: Columns::with_capacity(if has_strips { particles + 1 } else { 0 }),
            steps: vec![Step::default(); steps + 1],
        }
    }
}

/// What sweeps may leave of a line's weight as stretch before lines are solved as wholes.
const LITTLE: f32 = 1.0e-3;

/// Whether lines are solved at all. The plain scheme is sweeps and nothing else, and where substeps are
/// short enough sweeps do by themselves: n of them leave a hanging line of N links stretched by
/// g h² N / (2 n rest) on average.
pub(crate) fn are_used(world: &World) -> bool {
    let settings = &world.settings;
    let (h, sweeps) = (settings.scheme().h, settings.iterations as f32);
    let load = max(settings.gravity.length(), EARTH);
    let left =
        load * h * h * world.constraints.lines.longest as f32 / (2.0 * sweeps * world.mean_edge);
    settings.tethers && settings.iterations > 1 && left > LITTLE
}

/// Solves all lines.
pub(crate) fn solve(world: &mut World) {
    let is_rigid = is_rigid(&world.material, LinkKind::Stretch);
    let step = world.settings.scheme().step;
    let scale = if is_rigid { None } else { Some(1.0 / (step * step)) };
    world.constraints.lines.abreast.lay(&world.constraints.links);
    let are_in_columns = world.level != Level::Scalar && !world.scratch.interleaved.is_current;
    if are_in_columns && world.constraints.lines.abreast.are_strips() {
        solve_strips(world, scale);
    } else {
        line_gather::take(world, is_rigid);
        solve_blocks(world, scale);
        line_gather::leave(world);
    }
}

/// Whether what a block asks of its particles is fetched before it is solved: engines run out of registers in long
/// loops. Elsewhere it is fetched step by step, while the step before is waited for.
const IS_FETCHED_FIRST: bool = cfg!(target_arch = "wasm32");

/// By seats, wherever the particles of a line are.
fn solve_blocks(world: &mut World, scale: Option<f32>) {
    let (level, lines) = (world.level, &world.constraints.lines.abreast);
    let links = &mut world.constraints.links;
    let LineScratch { points, starts, steps: room, .. } = &mut world.scratch.lines;
    for laid in lines.blocks() {
        let room = &mut room[..=laid.len()];
        let seats = Seats { points, starts };
        match scale {
            None if IS_FETCHED_FIRST => {
                line_gather::fetch_rigid(level, laid, seats, &mut room[1..])
            }
            Some(_) if IS_FETCHED_FIRST => {
                line_gather::fetch_soft(level, laid, seats, &mut room[1..])
            }
            None => solve_rigid_seats(level, laid, seats, room, links, 0.0),
            Some(scale) => solve_soft_seats(level, laid, seats, room, links, scale),
        }
        if IS_FETCHED_FIRST {
            solve_block(level, laid, room, links, scale);
        }
        line_gather::put(level, laid, &room[1..], points);
    }
}

/// Straight from the columns.
fn solve_strips(world: &mut World, scale: Option<f32>) {
    let (level, scratch, p) = (world.level, &mut world.scratch, &mut world.particles);
    let (lines, links) = (&world.constraints.lines.abreast, &mut world.constraints.links);
    let LineScratch { columns: starts, steps: room, .. } = &mut scratch.lines;
    if scale.is_none() {
        line_strided::find_starts(level, &scratch.predicted, &scratch.displacement, starts);
    }
    for (strip, laid) in lines.strips() {
        let room = &mut room[..=laid.len()];
        line_strided::fetch(strip, &p.x, &p.w, &mut room[1..]);
        if scale.is_none() {
            line_strided::aim(strip, starts, laid, &mut room[1..]);
        } else {
            aim_at_rest(laid, &mut room[1..]);
        }
        solve_block(level, laid, room, links, scale);
        line_strided::put(strip, laid, &room[1..], &mut p.x);
    }
}

/// Links that give way are to be as long as at rest.
fn aim_at_rest(laid: &[line_blocks::Step], room: &mut [Step]) {
    for (step, laid) in room.iter_mut().zip(laid) {
        (0..LANES).for_each(|lane| step.rest(Scalar, lane, &laid.rest));
    }
}

/// Solves the lines of a block that was fetched: finds how its particles move. Links that give way have a scale of
/// their compliance.
fn solve_block(
    level: Level,
    laid: &[line_blocks::Step],
    room: &mut [Step],
    links: &mut Links,
    scale: Option<f32>,
) {
    let nobody = Seats { points: &[], starts: &[] };
    match scale {
        None => solve_rigid(level, laid, nobody, room, links, 0.0),
        Some(scale) => solve_soft(level, laid, nobody, room, links, scale),
    }
}

/// Names what solves a block, with links that give way or not, fetched before or from its seats.
macro_rules! solving {
    ($name:ident, $soft:literal, $seated:literal) => {
        vectored! {
            fn $name(
                laid: &[line_blocks::Step],
                seats: Seats<'_>,
                room: &mut [Step],
                links: &mut Links,
                scale: f32,
            ) = solve_lanes::<_, $soft, $seated>, Avx2, solve_apart::<$soft, $seated>
        }
    };
}

solving!(solve_rigid, false, false);
solving!(solve_soft, true, false);
solving!(solve_rigid_seats, false, true);
solving!(solve_soft_seats, true, true);

/// Line by line.
fn solve_apart<const SOFT: bool, const SEATED: bool>(
    laid: &[line_blocks::Step],
    seats: Seats<'_>,
    room: &mut [Step],
    links: &mut Links,
    scale: f32,
) {
    solve_lanes::<_, SOFT, SEATED>(Scalar, laid, seats, room, links, scale);
}

/// Two runs through a block go side by side, if it has lanes for both: each step waits for the one before, so that
/// one run by itself leaves the processor idle.
#[inline(always)]
fn solve_lanes<S: Simd, const SOFT: bool, const SEATED: bool>(
    s: S,
    laid: &[line_blocks::Step],
    seats: Seats<'_>,
    room: &mut [Step],
    links: &mut Links,
    scale: f32,
) {
    let Some((none, room)) = room.split_first_mut() else { return };
    let is_double = 2 * S::LANES <= LANES;
    for first in (0..LANES).step_by(2 * S::LANES) {
        let (run, other) = (Run { s, first }, Run { s, first: first + S::LANES });
        let (mut there, mut other_there) = (run.begin(), run.begin());
        let (mut was, mut other_was) = ([s.splat(0.0); 4], [s.splat(0.0); 4]);
        let mut last = &*none;
        for (laid, step) in laid.iter().zip(&mut *room) {
            if SEATED {
                seats.bring::<S, SOFT>(s, run.first, &mut was, laid, step);
            }
            run.eliminate::<SOFT>(&mut there, last, (laid, step), links, scale);
            if is_double {
                if SEATED {
                    seats.bring::<S, SOFT>(s, other.first, &mut other_was, laid, step);
                }
                other.eliminate::<SOFT>(&mut other_there, last, (laid, step), links, scale);
            }
            last = step;
        }
        let (mut back, mut other_back) = (run.turn(), run.turn());
        for (laid, step) in laid.iter().zip(&mut *room).rev() {
            run.pull::<SOFT>(&mut back, (laid, step), links);
            if is_double {
                other.pull::<SOFT>(&mut other_back, (laid, step), links);
            }
        }
    }
}

/// As many lanes of a block as go at once.
#[derive(Clone, Copy)]
struct Run<S> {
    s: S,
    /// The first one's number in the block.
    first: usize,
}

/// What a step needs of the one before, on the way there, beside what that one keeps: registers are few.
struct There<F> {
    inverse: F,
    right: F,
}

/// What a step needs of the one after, on the way back.
struct Back<F> {
    /// What the link after adds to the right side.
    after: F,
    /// What the link after pulls with at its beginning: of itself, …
    m: [F; 3],
    /// … and against going there.
    hold: F,
}

impl<S: Simd> Run<S> {
    /// What these lanes have of a step of the block.
    #[inline(always)]
    fn own<'b, T>(&self, step: &'b [T; LANES]) -> &'b [T] {
        &step[self.first..self.first + S::LANES]
    }

    #[inline(always)]
    fn load(&self, lanes: &LaneArray) -> S::F {
        self.s.load(lanes, self.first)
    }

    #[inline(always)]
    fn store(&self, lanes: &mut LaneArray, v: S::F) {
        self.s.store(lanes, self.first, v);
    }

    #[inline(always)]
    fn load3(&self, [x, y, z]: &Lanes3) -> [S::F; 3] {
        [self.load(x), self.load(y), self.load(z)]
    }

    #[inline(always)]
    fn store3(&self, lanes: &mut Lanes3, [x, y, z]: [S::F; 3]) {
        self.store(&mut lanes[0], x);
        self.store(&mut lanes[1], y);
        self.store(&mut lanes[2], z);
    }

    /// In front of the first step.
    #[inline(always)]
    fn begin(&self) -> There<S::F> {
        let zero = self.s.splat(0.0);
        There { inverse: zero, right: zero }
    }

    /// Behind the last step.
    #[inline(always)]
    fn turn(&self) -> Back<S::F> {
        let zero = self.s.splat(0.0);
        Back { after: zero, m: [zero; 3], hold: zero }
    }

    /// A step there: what each link has to do with the one before goes out of the first system. Where a
    /// piece begins, and behind the last, there is a link that neither pulls nor is pulled.
    #[inline(always)]
    fn eliminate<const SOFT: bool>(
        &self,
        there: &mut There<S::F>,
        last: &Step,
        (laid, step): (&line_blocks::Step, &mut Step),
        links: &Links,
        scale: f32,
    ) {
        let s = self.s;
        let (one, tiny) = (s.splat(1.0), s.splat(TINY));
        let [to_x, to_y, to_z, to_w] = &step.to;
        let [from_x, from_y, from_z, from_w] = &last.to;
        let dx = self.load(to_x) - self.load(from_x);
        let dy = self.load(to_y) - self.load(from_y);
        let dz = self.load(to_z) - self.load(from_z);
        let length = (dx * dx + dy * dy + dz * dz).sqrt().max(tiny);
        let over = one / length;
        let n = [dx * over, dy * over, dz * over];
        self.store3(&mut step.n, n);
        let before = self.load3(&last.n);
        let along = n[0] * before[0] + n[1] * before[1] + n[2] * before[2];
        let short = length - self.load(&step.aim);
        self.store(&mut step.aim, length * self.load(&step.over));
        let (rest, last_w) = (self.load(&laid.rest), self.load(from_w));
        let before = s.select_or_zero(rest, last_w * along);
        self.store(&mut step.before, before);
        let both = last_w + self.load(to_w);
        let mut weight = both * s.splat(1.0 + GIVE);
        if SOFT {
            weight = weight + self.softness(links, self.own(&laid.links), scale);
        }
        let share = before * there.inverse;
        let pivot = (weight - share * before).max(both * s.splat(GIVE));
        // Between two that are held there is nothing to solve.
        there.inverse = s.select_or_zero(both.min(rest), one / pivot);
        there.right = short + share * there.right;
        self.store(&mut step.inverse, there.inverse);
        self.store(&mut step.right, there.right);
    }

    #[inline(always)]
    fn softness(&self, links: &Links, own: &[u32], scale: f32) -> S::F {
        let mut softness = [0.0; LANES];
        for (softness, link) in softness.iter_mut().zip(own) {
            if *link != NONE {
                *softness = links.compliance[*link as usize] * scale;
            }
        }
        self.s.load(&softness, 0)
    }

    /// A step back: the multipliers, and with them what each particle has to do with the one after goes
    /// out of the second system.
    #[inline(always)]
    fn pull<const SOFT: bool>(
        &self,
        back: &mut Back<S::F>,
        (laid, step): (&line_blocks::Step, &mut Step),
        links: &mut Links,
    ) {
        let s = self.s;
        let (zero, one) = (s.splat(0.0), s.splat(1.0));
        let after = (self.load(&step.right) + back.after) * self.load(&step.inverse);
        let q = s.select_or_zero(after, after * self.load(&step.over));
        let tension = s.select(after, after * self.load(&step.aim), after);
        let w = self.load(&step.to[3]);
        let give = w / (one + w * (q + back.hold));
        let share = give * q;
        let n = self.load3(&step.n);
        let mut own = [zero; 3];
        for axis in 0..3 {
            let pull = n[axis] * tension;
            own[axis] = (back.m[axis] - pull) * give;
            back.m[axis] = pull + q * own[axis];
        }
        back.hold = q * (one - share);
        back.after = self.load(&step.before) * after;
        self.store3(&mut step.n, own);
        self.store(&mut step.right, share);
        if SOFT {
            let mut lambda = [0.0; LANES];
            s.store(&mut lambda, 0, after);
            for (link, lambda) in self.own(&laid.links).iter().zip(lambda) {
                if *link != NONE {
                    links.lambda[*link as usize] = -lambda;
                }
            }
        }
    }
}

impl Step {
    /// Sets what links are to be long that give way: as long as at rest.
    #[inline(always)]
    pub fn rest<S: Simd>(&mut self, s: S, first: usize, rest: &LaneArray) {
        let aim = s.load(rest, first);
        s.store(&mut self.aim, first, aim);
        s.store(&mut self.over, first, s.splat(1.0) / aim);
    }

    /// Sets what links are to be long that were so long when the substep began: a little of it mended.
    #[inline(always)]
    pub fn mend<S: Simd>(&mut self, s: S, first: usize, was: S::F, rest: &LaneArray) {
        let rest = s.load(rest, first);
        let aim = rest + (was - rest) * s.splat(1.0 - MEND);
        s.store(&mut self.aim, first, aim);
        s.store(&mut self.over, first, s.splat(1.0) / aim);
    }

    /// The way that particles go, from that of those before. It leads no farther than `limited` says.
    #[inline(always)]
    pub fn way<S: Simd>(&self, s: S, first: usize, [x, y, z]: [S::F; 3]) -> [S::F; 3] {
        [
            self.way_along(s, 0, first, x),
            self.way_along(s, 1, first, y),
            self.way_along(s, 2, first, z),
        ]
    }

    /// The same along one axis.
    #[inline(always)]
    pub fn way_along<S: Simd>(&self, s: S, axis: usize, first: usize, before: S::F) -> S::F {
        s.load(&self.right, first) * before + s.load(&self.n[axis], first)
    }

    /// Where particles get to that go a way.
    #[inline(always)]
    pub fn there<S: Simd>(&self, s: S, first: usize, [x, y, z]: [S::F; 3]) -> [S::F; 3] {
        let [to_x, to_y, to_z, _] = &self.to;
        [x + s.load(to_x, first), y + s.load(to_y, first), z + s.load(to_z, first)]
    }
}

/// The size of a number.
#[inline(always)]
pub(crate) fn size<S: Simd>(s: S, v: S::F) -> S::F {
    v.max(s.splat(0.0) - v)
}

/// Above 0 if a way may be too long whose longest component this is: one that is too long has a component longer
/// than 0.577 of what it may be. Squares would tell for sure, but where the cloth rests they are so small that
/// processors take long for them.
#[inline(always)]
pub(crate) fn excess<S: Simd>(s: S, longest: S::F, most: &LaneArray, first: usize) -> S::F {
    longest - size(s, s.load(most, first)) * s.splat(0.577)
}

/// The longest component of a way.
#[inline(always)]
pub(crate) fn longest<S: Simd>(s: S, [x, y, z]: [S::F; 3]) -> S::F {
    size(s, x).max(size(s, y)).max(size(s, z))
}

#[inline(always)]
pub(crate) fn length<S: Simd>(_: S, [x, y, z]: [S::F; 3]) -> S::F {
    (x * x + y * y + z * z).sqrt()
}

/// A way that is no longer than `most`: lines that cannot be right would fling their particles.
#[inline(always)]
pub(crate) fn limited([x, y, z]: [f32; 3], most: f32) -> [f32; 3] {
    let length2 = x * x + y * y + z * z;
    let share = if length2 > most * most { most / length2.sqrt() } else { 1.0 };
    [x * share, y * share, z * share]
}
