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

use super::links::is_rigid;
use super::{World, seats};
use crate::fabric::abreast::{self, Abreast};
use crate::fabric::links::{LinkKind, Links};
use crate::math::simd::{LANES, Lanes, Number, Scalar, Simd, turn, turn_back, vectored};
use crate::math::{TINY, max};
use crate::mesh::NONE;

/// What a taut line gives way by, as a share of its weight: pulled from both ends its system has no
/// solution.
const GIVE: f32 = 1.0e-6;

/// The share of what a link was too long or too short by that a substep puts right.
const MEND: f32 = 0.3;

/// Loads are at least as on earth [m/s²]: wind and hands pull where there is no gravity.
const EARTH: f32 = 9.81;

/// Three columns of eight.
type Lanes3 = [Lanes; 3];

/// Room to work in.
#[derive(Clone, Debug, Default)]
pub(crate) struct Scratch {
    /// Each particle's position and inverse mass, after a seat that is nobody's.
    pub points: Vec<[f32; 4]>,
    /// Where each particle was when the substep began.
    pub starts: Vec<[f32; 4]>,
    /// What is known of each step of a block.
    steps: Vec<Step>,
}

/// Eight links side by side, and the particles that they run to.
#[derive(Clone, Copy, Debug, Default)]
struct Step {
    to: Lanes3,
    /// Inverse mass of the particles.
    w: Lanes,
    /// The links' directions, …
    n: Lanes3,
    /// … their lengths as a share of what they are to be, and one over the latter.
    ratio: Lanes,
    over: Lanes,
    /// How each link hangs on the one before: less what it has to do with it in the system.
    before: Lanes,
    /// One over its pivot, and the right side of the system.
    inverse: Lanes,
    right: Lanes,
    /// How a particle moves: by `share` of what the one before does, and by `own`.
    share: Lanes,
    own: Lanes3,
}

impl Scratch {
    /// Room for blocks of so many steps, and so many particles.
    pub fn new(steps: usize, particles: usize) -> Self {
        Self {
            points: Vec::with_capacity(particles + 1),
            starts: Vec::with_capacity(particles + 1),
            steps: vec![Step::default(); steps],
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
    let left = load * h * h * world.weave.lines.longest as f32 / (2.0 * sweeps * world.spacing);
    settings.tethers && settings.iterations > 1 && left > LITTLE
}

/// Solves all lines.
pub(crate) fn solve(world: &mut World) {
    let is_rigid = is_rigid(world, LinkKind::Stretch);
    seats::take(world, is_rigid);
    let step = world.settings.scheme().step;
    let (lines, links) = (&mut world.weave.lines.abreast, &mut world.weave.links);
    lines.lay(links);
    let s = &mut world.scratch.lines;
    if is_rigid {
        solve_rigid(world.level, lines, links, s, 0.0);
    } else {
        solve_soft(world.level, lines, links, s, 1.0 / (step * step));
    }
    seats::leave(world);
}

vectored! {
    fn solve_rigid(lines: &Abreast, links: &mut Links, room: &mut Scratch, scale: f32)
        = solve_all::<_, false>, Avx2, solve_apart::<false>
}

vectored! {
    fn solve_soft(lines: &Abreast, links: &mut Links, room: &mut Scratch, scale: f32)
        = solve_all::<_, true>, Avx2, solve_apart::<true>
}

/// Line by line.
fn solve_apart<const SOFT: bool>(
    lines: &Abreast,
    links: &mut Links,
    room: &mut Scratch,
    scale: f32,
) {
    solve_all::<_, SOFT>(Scalar, lines, links, room, scale);
}

#[inline(always)]
fn solve_all<S: Simd, const SOFT: bool>(
    s: S,
    lines: &Abreast,
    links: &mut Links,
    room: &mut Scratch,
    scale: f32,
) {
    for steps in lines.blocks() {
        for first in (0..LANES).step_by(2 * S::LANES) {
            let runs = [first, first + S::LANES].map(|first| Run { s, first });
            solve_lanes::<_, SOFT>(runs, steps, links, room, scale);
        }
    }
}

/// Two runs through a block go side by side, if it has lanes for both: each step waits for the one before, so that
/// one run by itself leaves the processor idle.
#[inline(always)]
fn solve_lanes<S: Simd, const SOFT: bool>(
    [run, other]: [Run<S>; 2],
    steps: &[abreast::Step],
    links: &mut Links,
    room: &mut Scratch,
    scale: f32,
) {
    let is_double = 2 * S::LANES <= LANES;
    let [mut there, mut other_there] = [run.begin(), other.begin()];
    let Scratch { points, starts, steps: room } = room;
    let starts = if SOFT { &[][..] } else { &starts[..points.len()] };
    for (laid, step) in steps.iter().zip(&mut *room) {
        run.eliminate::<SOFT>(&mut there, [&*points, starts], (laid, step), links, scale);
        if is_double {
            other.eliminate::<SOFT>(
                &mut other_there,
                [&*points, starts],
                (laid, step),
                links,
                scale,
            );
        }
    }
    let [mut back, mut other_back] = [run.turn(), other.turn()];
    for (laid, step) in steps.iter().zip(&mut *room).rev() {
        run.pull::<SOFT>(&mut back, (laid, step), links);
        if is_double {
            other.pull::<SOFT>(&mut other_back, (laid, step), links);
        }
    }
    let mut ways = [[run.s.splat(0.0); 3]; 2];
    for (laid, step) in steps.iter().zip(&*room) {
        run.go(&mut ways[0], (laid, step), points);
        if is_double {
            other.go(&mut ways[1], (laid, step), points);
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

/// What a step needs of the one before, on the way there.
struct There<F> {
    last: [F; 4],
    start: [F; 4],
    n: [F; 3],
    inverse: F,
    right: F,
}

/// What a step needs of the one after, on the way back.
struct Back<F> {
    after: F,
    coupling: F,
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
    fn load(&self, lanes: &Lanes) -> S::F {
        self.s.load(lanes, self.first)
    }

    #[inline(always)]
    fn store(&self, lanes: &mut Lanes, v: S::F) {
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
        There { last: [zero; 4], start: [zero; 4], n: [zero; 3], inverse: zero, right: zero }
    }

    /// Behind the last step.
    #[inline(always)]
    fn turn(&self) -> Back<S::F> {
        let zero = self.s.splat(0.0);
        Back { after: zero, coupling: zero, m: [zero; 3], hold: zero }
    }

    /// A step there: what each link has to do with the one before goes out of the first system. Where a
    /// piece begins, and behind the last, there is a link that neither pulls nor is pulled.
    #[inline(always)]
    fn eliminate<const SOFT: bool>(
        &self,
        there: &mut There<S::F>,
        [points, starts]: [&[[f32; 4]]; 2],
        (laid, step): (&abreast::Step, &mut Step),
        links: &Links,
        scale: f32,
    ) {
        let s = self.s;
        let (one, tiny) = (s.splat(1.0), s.splat(TINY));
        let (to, rest) = (self.own(&laid.to), self.load(&laid.rest));
        let next = turn(s, points, to);
        let mut aim = rest;
        if !SOFT {
            // What they were when the substep began, mended a little.
            let was = turn(s, starts, to);
            aim = rest + (length(s, &there.start, &was) - rest) * s.splat(1.0 - MEND);
            there.start = was;
        }
        let last = there.last;
        let (dx, dy, dz) = (next[0] - last[0], next[1] - last[1], next[2] - last[2]);
        let length = (dx * dx + dy * dy + dz * dz).sqrt().max(tiny);
        let over = one / length;
        let (nx, ny, nz) = (dx * over, dy * over, dz * over);
        let along = nx * there.n[0] + ny * there.n[1] + nz * there.n[2];
        there.n = [nx, ny, nz];
        let before = s.keep(rest, last[3] * along);
        let both = last[3] + next[3];
        let mut weight = both * s.splat(1.0 + GIVE);
        if SOFT {
            weight = weight + self.softness(links, self.own(&laid.links), scale);
        }
        let share = before * there.inverse;
        let pivot = (weight - share * before).max(both * s.splat(GIVE));
        // Between two that are held there is nothing to solve.
        there.inverse = s.keep(both.min(rest), one / pivot);
        there.right = length - aim + share * there.right;
        there.last = next;
        let over = one / aim;
        self.store(&mut step.before, before);
        self.store(&mut step.over, over);
        self.store(&mut step.ratio, length * over);
        self.store3(&mut step.to, [next[0], next[1], next[2]]);
        self.store(&mut step.w, next[3]);
        self.store3(&mut step.n, there.n);
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
        (laid, step): (&abreast::Step, &mut Step),
        links: &mut Links,
    ) {
        let s = self.s;
        let (zero, one) = (s.splat(0.0), s.splat(1.0));
        let after =
            (self.load(&step.right) + back.coupling * back.after) * self.load(&step.inverse);
        let q = s.keep(after, after * self.load(&step.over));
        let tension = s.pick(after, after * self.load(&step.ratio), after);
        let w = self.load(&step.w);
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
        back.after = after;
        back.coupling = self.load(&step.before);
        self.store3(&mut step.own, own);
        self.store(&mut step.share, share);
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

    /// A step there again: the particles go.
    #[inline(always)]
    fn go(
        &self,
        way: &mut [S::F; 3],
        (laid, step): (&abreast::Step, &Step),
        points: &mut [[f32; 4]],
    ) {
        let (share, own) = (self.load(&step.share), self.load3(&step.own));
        *way = [share * way[0] + own[0], share * way[1] + own[1], share * way[2] + own[2]];
        let moved = self.limited(*way, &laid.rest);
        let [x, y, z] = self.load3(&step.to);
        let there = [moved[0] + x, moved[1] + y, moved[2] + z, self.load(&step.w)];
        turn_back(self.s, points, self.own(&laid.to), there);
    }

    /// Ways that are no longer than `most`, see `limit`.
    #[inline(always)]
    fn limited(&self, way: [S::F; 3], most: &Lanes) -> [S::F; 3] {
        let at_most = self.load(most);
        let length2 = way[0] * way[0] + way[1] * way[1] + way[2] * way[2];
        if !self.s.is_any_positive(length2 - at_most * at_most) {
            return way;
        }
        let mut ways = self.spread(way);
        for lane in 0..S::LANES {
            let one = [ways[0][lane], ways[1][lane], ways[2][lane]];
            let limited = limit(one, most[self.first + lane].abs());
            (0..3).for_each(|axis| ways[axis][lane] = limited[axis]);
        }
        self.take_up(&ways)
    }

    /// Lanes as lists, and back.
    #[inline(always)]
    fn spread(&self, v: [S::F; 3]) -> Lanes3 {
        let mut lists = [[0.0; LANES]; 3];
        for (list, v) in lists.iter_mut().zip(v) {
            self.s.store(list, 0, v);
        }
        lists
    }

    #[inline(always)]
    fn take_up(&self, [x, y, z]: &Lanes3) -> [S::F; 3] {
        [self.s.load(x, 0), self.s.load(y, 0), self.s.load(z, 0)]
    }
}

/// How far it is from some points to others.
#[inline(always)]
fn length<S: Simd>(_: S, from: &[S::F; 4], to: &[S::F; 4]) -> S::F {
    let (dx, dy, dz) = (to[0] - from[0], to[1] - from[1], to[2] - from[2]);
    (dx * dx + dy * dy + dz * dz).sqrt()
}

/// A way that is no longer than `most`: lines that cannot be right would fling their particles.
#[inline(always)]
fn limit([x, y, z]: [f32; 3], most: f32) -> [f32; 3] {
    let length2 = x * x + y * y + z * z;
    let share = if length2 > most * most { most / length2.sqrt() } else { 1.0 };
    [x * share, y * share, z * share]
}
