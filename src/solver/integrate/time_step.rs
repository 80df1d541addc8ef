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
        let before = world.regular_scheme().h;
        world.substeps = substeps;
        world.drop_history();
        let after = world.regular_scheme().h;
        world.warm_start.change_step(before, after);
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
    /// ```
    /// Links of a soft material count more, see [`World::compliant_share`]. Substeps that a fast
    /// motion adds give all links the share of rigid ones, so that links carry the cloth along with
    /// a body.
    pub fn correction_share(&self) -> f32 {
        if is_rigid(&self.material, LinkKind::Stretch) || self.has_regular_stiffness() {
            let ratio = self.regular_scheme().h / max(self.stiffness_step, MIN_STIFFNESS_STEP);
            return ratio * ratio;
        }
        let Material { stretch_stiffness_warp, stretch_stiffness_weft, density, .. } =
            self.material;
        let stiffness = max(stretch_stiffness_warp, stretch_stiffness_weft);
        self.compliant_share(LINK_ENDS * stiffness / (density * self.mean_edge * self.mean_edge))
    }

    /// Share of the correction by bending that counts as velocity.
    pub fn bending_share(&self) -> f32 {
        let area = self.mean_edge * self.mean_edge;
        self.compliant_share(
            BEND_FACTOR * self.material.bend_stiffness / (self.material.density * area * area),
        )
    }

    /// Whether no change of the settings is left in the stiffness of corrections. Substeps that a
    /// fast motion adds are no such change.
    pub fn has_regular_stiffness(&self) -> bool {
        self.stiffness_step <= self.settings.scheme(self.settings.substeps).h
    }

    /// Share of the correction of a compliant constraint that counts as velocity. `rate` is its
    /// stiffness over mass [1/s²].
    ///
    /// ```text
    /// [λ(H) / (1 + λ(H)) / H²] / [λ(h) / (1 + λ(h)) / h²] = (1 + λ(h)) / (1 + λ(H))
    /// λ(h) = rate h²: one correction removes the share λ / (1 + λ) of a strain
    /// ```
    /// So soft constraints, whose stiffness does not depend on h, count in full.
    fn compliant_share(&self, rate: f32) -> f32 {
        let h = self.regular_scheme().h;
        let [least, longest] = [h, self.stiffness_step].map(|step| max(step, MIN_STIFFNESS_STEP));
        let short = h / least;
        short * short * (1.0 + rate * least * least) / (1.0 + rate * longest * longest)
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
