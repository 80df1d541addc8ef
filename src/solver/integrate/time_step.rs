//! The time step: number and length of the substeps of a tick, and what a change of the length
//! does to history and stiffness.
//!
//! ```text
//! substeps = settings.substeps · factor     factor = max(⌈substeps needed / settings.substeps⌉,
//!                                                         factor of the last tick − 1)
//! ```
//! A tick in which cloth and colliders move fast relative to each other runs more substeps (see
//! `collide::relative_motion`); the number falls slowly, so that a body that shakes does not change
//! it in every tick, which would drive vibrations. After a change of the length the history of the
//! second-order scheme (BDF2) is dropped, so the next substep is one of BDF1, and velocities stay as
//! they are.
//!
//! Reads settings, colliders and velocities; writes `world.substeps`, the history, `stiffness_step`
//! and the inverse masses of soft pins.
//! Invariant: `world.substeps` is at least `settings.substeps` in a tick, and at most
//! [`MAX_FACTOR`] times that.

use crate::math::max;
use crate::model::links::LinkKind;
use crate::model::material::Material;
use crate::solver::collide::relative_motion;
use crate::solver::stretch::link_projection::is_rigid;
use crate::solver::world::World;
use crate::state::colliders::Impulse;
use crate::state::settings::BdfScheme;

/// Most substeps of a tick, as a multiple of those that the settings ask for.
const MAX_FACTOR: u32 = 8;

/// Most substeps of a tick if the settings ask for fewer.
const MAX_SUBSTEPS: u32 = 64;

/// Share of `stiffness_step` that a tick keeps.
const STIFFNESS_STEP_DECAY: f32 = 0.9;

/// Shortest substep whose stiffness links take on [s].
const MIN_STIFFNESS_STEP: f32 = 2.5e-5;

/// Ends of a link that move when it is corrected.
const LINK_ENDS: f32 = 2.0;

/// Ratio of the stiffness of a fold over a few cells, for which bending is solved well, to
/// `bend_stiffness` over the fourth power of the edge length.
const BEND_FACTOR: f32 = 8.0;

/// Sets the number of substeps of the tick that starts.
pub(crate) fn begin_tick(world: &mut World) {
    let least = world.settings.substeps;
    let needed = relative_motion::needed_substeps(world, least as f32);
    let most = (MAX_SUBSTEPS / least).clamp(1, MAX_FACTOR);
    // The conversion saturates; NaN becomes 0.
    let factor = ((needed / least as f32).ceil() as u32).clamp(1, most);
    let last_factor = (world.substeps / least).min(most);
    let factor = factor.max(last_factor.saturating_sub(1));
    let substeps = least * factor;
    if substeps != world.substeps {
        world.substeps = substeps;
        world.drop_history();
        world.refresh_soft_pin_masses();
    }
    world.raise_stiffness_step();
}

/// Ends a substep: after a fast impact the links take on the stiffness of short substeps at once,
/// because their pull must carry the cloth along with the body. Elsewhere they take it on as slowly
/// as after a change of the settings.
pub(crate) fn end_substep(world: &mut World) {
    let h = world.regular_scheme().h;
    if world.substeps > world.settings.substeps
        && world.stiffness_step > h
        && relative_motion::has_fast_impact(world)
    {
        world.stiffness_step = h;
    }
}

impl World {
    /// The time integration scheme of a substep that has a history.
    pub fn regular_scheme(&self) -> BdfScheme {
        self.settings.scheme(self.substeps)
    }

    /// The time integration scheme of the next substep.
    pub fn scheme(&self) -> BdfScheme {
        let scheme = self.regular_scheme();
        if self.has_no_history { scheme.without_history() } else { scheme }
    }

    /// Drops the history of every particle after the substep length changed: the next substep is
    /// one of BDF1. Positions and velocities stay.
    pub fn drop_history(&mut self) {
        self.particles.drop_history();
        self.drop_pending_impulses();
        self.has_no_history = true;
    }

    /// Forgets the impulses of colliders that a dropped history will not deliver.
    pub fn drop_pending_impulses(&mut self) {
        self.colliders.iter_mut().for_each(|body| body.pending = Impulse::default());
    }

    /// Share of a position correction that counts as velocity; 1 while ticks have one length.
    ///
    /// A rigid link that stops before it converges acts like a spring whose stiffness grows with
    /// 1 / h². Where h jumps down and up again, so does that stiffness, and it pumps energy into
    /// every vibration. So after a jump down the corrections count as those of a spring of the old
    /// stiffness, which approaches the new one tick by tick. Substeps below
    /// [`MIN_STIFFNESS_STEP`] count as if they had that length for ever: they would turn the
    /// rounding of positions into velocities.
    ///
    /// ```text
    /// share = (h / H)² = [1 / H²] / [1 / h²]                       H: `stiffness_step`
    /// compliant: [λ(H) / (1 + λ(H)) / H²] / [λ(h) / (1 + λ(h)) / h²] = (1 + λ(h)) / (1 + λ(H))
    /// λ(h) = stiffness h² / mass: one correction removes the share λ / (1 + λ) of a strain
    /// ```
    /// So soft links, whose stiffness does not depend on h, count in full.
    pub fn correction_share(&self) -> f32 {
        let (h, longest) = self.stiffness_steps();
        if is_rigid(&self.material, LinkKind::Stretch) {
            return (h / longest) * (h / longest);
        }
        let Material { stretch_stiffness_warp, stretch_stiffness_weft, density, .. } =
            self.material;
        let stiffness = max(stretch_stiffness_warp, stretch_stiffness_weft);
        let rate = LINK_ENDS * stiffness / (density * self.mean_edge * self.mean_edge);
        (1.0 + rate * h * h) / (1.0 + rate * longest * longest)
    }

    /// Share of the correction by bending that counts as velocity: as for compliant links.
    pub fn bending_share(&self) -> f32 {
        let (h, longest) = self.stiffness_steps();
        let area = self.mean_edge * self.mean_edge;
        let rate =
            BEND_FACTOR * self.material.bend_stiffness / (self.material.density * area * area);
        (1.0 + rate * h * h) / (1.0 + rate * longest * longest)
    }

    /// Whether corrections have the stiffness of the current substep length: all count in full.
    pub fn has_regular_stiffness(&self) -> bool {
        let (h, longest) = self.stiffness_steps();
        longest <= h
    }

    /// Substep length, and that whose stiffness the corrections have [s].
    fn stiffness_steps(&self) -> (f32, f32) {
        (self.regular_scheme().h, max(self.stiffness_step, MIN_STIFFNESS_STEP))
    }

    /// Starts a tick: longer substeps make the links softer at once.
    pub fn raise_stiffness_step(&mut self) {
        self.stiffness_step = max(self.stiffness_step, self.regular_scheme().h);
    }

    /// Ends a tick: the stiffness approaches that of the current substep length.
    pub fn relax_stiffness_step(&mut self) {
        let h = self.regular_scheme().h;
        self.stiffness_step = max(h, self.stiffness_step * STIFFNESS_STEP_DECAY);
    }
}
