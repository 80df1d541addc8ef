//! Contact solver: non-penetration, friction and damping of self-contacts.
//!
//! ```text
//! sweep 1 ─▶ contact 0 1 2 … n       normal     C = target − n·Σ weightₖ xₖ
//! sweep 2 ◀─ contact n … 2 1 0                  Δλ = C / Σ wₖ weightₖ²,   λ ≥ 0
//! …                                  friction   |λt| ≤ friction · λ           (Coulomb cone)
//! ```
//! Sequential impulses on positions (projected Gauss–Seidel; Catto, "Iterative Dynamics with
//! Temporal Coherence", GDC 2005), warm-started, with accumulated impulses. Normals and weights are
//! constant in the substep. Impulses have the unit kg·m: an impulse of 1 displaces 1 kg by 1 m in
//! the substep.
//!
//! Before each sweep colliders push the particles that touch them back ([`ColliderContact::hold`]),
//! so a heap of layers rests on its collider.
//!
//! The target of a contact is the smaller of its distance at the start and its gap. So the solver
//! only stops the approach of both sides; [`correct_penetration`] moves sides that are nearer than
//! the gap apart, slowly and without velocity. After velocities were derived,
//! [`remove_rebound`] and [`remove_impact_velocities`] make impacts inelastic, and [`damp_contacts`]
//! damps relative motion at contacts.
//!
//! Reads contacts and masses; writes positions, velocities and contact forces.
//!
//! Invariant: each impulse acts on both sides with opposite sign, weighted by the same weights, so
//! positions keep the linear momentum up to rounding, except for what colliders push.

use crate::math::columns::Columns;
use crate::math::wide4::{Float4, Wide4};
use crate::math::{max, min};
use crate::solver::collide::collider_contact::ColliderContact;
use crate::solver::particle_stage::interleaved::translate_wide;
use crate::solver::self_collide::contact_forces::{ContactForce, WarmStart};
use crate::solver::self_collide::surface::contact::{Contact, distance_along_normal};
use crate::solver::self_collide::surface::warm_start::WarmStartIndex;
use glam::Vec3;

/// Gauss–Seidel sweeps per substep, in alternating directions.
const SWEEPS: usize = 6;

/// Pairs farther apart than this, at the start and now, do not enter the solver [gaps]: for
/// vertex–triangle, then for edge–edge, which matters little between flat layers.
pub(crate) const ACTIVE_DISTANCE: [f32; 2] = [1.1, 1.02];

/// Share of the penetration (gap minus distance) that is corrected per substep, and the largest
/// speed of the correction [m/s].
const CORRECTION_SHARE: f32 = 0.05;
const MAX_CORRECTION_SPEED: f32 = 0.25;

/// Time constant of the damping at contacts [s].
const DAMPING_TIME: f32 = 0.01;

/// Lower bound of the inverse effective mass, as a share of the largest inverse mass in the
/// contact. It limits the displacement of particles with small weights beside fixed ones.
const MIN_INVERSE_MASS_SHARE: f32 = 0.005;

/// Coulomb friction between layers.
#[derive(Clone, Copy)]
pub(crate) struct LayerFriction<'a> {
    /// Coefficient of the material.
    pub coefficient: f32,
    /// Painted scale of each particle; `None` if all are 1.
    pub scales: Option<&'a [f32]>,
}

impl LayerFriction<'_> {
    /// The coefficient at a contact.
    #[inline(always)]
    fn at(&self, contact: &Contact) -> f32 {
        self.scales.map_or(self.coefficient, |scales| self.coefficient * mean_at(contact, scales))
    }
}

/// The mean of the scales at both closest points.
#[inline(never)]
fn mean_at(contact: &Contact, scales: &[f32]) -> f32 {
    let each = contact.ids.iter().zip(contact.weights);
    0.5 * each.map(|(id, weight)| scales[*id as usize] * weight.abs()).sum::<f32>()
}

/// A contact that the solver works on in this substep.
#[derive(Clone, Copy, Debug)]
pub(crate) struct ActiveContact {
    /// Index of the contact.
    pub contact: u32,
    /// Distance of the closest points along the normal that the solver keeps [m].
    target: f32,
    /// Displacement of each particle per unit of impulse, negative on the second side [1/kg].
    response: [f32; 4],
    /// Effective mass [kg]; 0 if all particles are fixed.
    effective_mass: f32,
    /// Accumulated impulses along the normal and along the surface [kg·m].
    pub normal_impulse: f32,
    pub tangent_impulse: Vec3,
    /// Whether the contact had no force in the last substep.
    is_new: bool,
    /// Whether static friction holds both sides.
    sticks: bool,
}

impl ActiveContact {
    #[inline(always)]
    fn new(index: u32, contact: &Contact, target: f32, inverse_masses: &[f32]) -> Self {
        let mut state = Self {
            contact: index,
            target,
            response: [0.0; 4],
            effective_mass: 0.0,
            normal_impulse: 0.0,
            tangent_impulse: Vec3::ZERO,
            is_new: true,
            sticks: false,
        };
        state.set_masses(contact, inverse_masses, [1.0; 2]);
        state
    }

    /// Reduces the inverse masses of the side that colliders support more.
    fn count_support(&mut self, contact: &Contact, mobility: &[f32], inverse_masses: &[f32]) {
        let mut sides = [0.0; 2];
        for (k, (weight, id)) in contact.weights.iter().zip(contact.ids).enumerate() {
            sides[usize::from(k >= contact.kind as usize)] += weight.abs() * mobility[id as usize];
        }
        if sides[0] != sides[1] {
            let most = max(sides[0], sides[1]);
            self.set_masses(contact, inverse_masses, sides.map(|side| side / most));
        }
    }

    /// Computes response and effective mass from the inverse masses of all particles [1/kg], of
    /// which each side counts a share.
    #[inline(always)]
    fn set_masses(&mut self, contact: &Contact, inverse_masses: &[f32], shares: [f32; 2]) {
        let (mut sum, mut largest) = (0.0, 0.0);
        for (k, (id, weight)) in contact.ids.into_iter().zip(contact.weights).enumerate() {
            let w = inverse_masses[id as usize] * shares[usize::from(k >= contact.kind as usize)];
            self.response[k] = weight * w;
            sum += w * weight * weight;
            largest = max(largest, w);
        }
        let least = largest * MIN_INVERSE_MASS_SHARE;
        self.effective_mass = if sum > 0.0 { 1.0 / max(sum, least) } else { 0.0 };
    }

    /// Displaces the particles of the contact by an impulse.
    #[inline(always)]
    fn apply_impulse(&self, contact: &Contact, x: &mut [Float4], impulse: Wide4) {
        for (id, response) in contact.ids.into_iter().zip(self.response) {
            translate_wide(&mut x[id as usize], impulse.scale(response));
        }
    }
}

/// Lets colliders support contacts from now on, after positions were solved: damping against a
/// supported side damps against the collider. `mobility` has the share of the inverse mass of each
/// particle that counts.
pub(crate) fn count_support(
    contacts: &[Contact],
    active: &mut [ActiveContact],
    mobility: &[f32],
    inverse_masses: &[f32],
) {
    for state in active {
        state.count_support(&contacts[state.contact as usize], mobility, inverse_masses);
    }
}

/// Fills `active` with the contacts that are near enough to need the solver.
///
/// Skips a pair of edges if a closest point is an end of its edge: the contact of that vertex with a
/// triangle at the other edge is at least as near. The normal of the pair would be tilted, and would
/// push stacked sheets sideways.
pub(crate) fn collect_active(
    contacts: &[Contact],
    active: &mut Vec<ActiveContact>,
    inverse_masses: &[f32],
    start: &[Float4],
    x: &[Float4],
) {
    active.clear();
    for (i, contact) in contacts.iter().enumerate() {
        if contact.is_at_end_of_edge() {
            continue;
        }
        let near = contact.gap * ACTIVE_DISTANCE[contact.kind as usize - 1];
        let before = distance_along_normal(start, contact);
        if min(before, distance_along_normal(x, contact)) < near {
            let target = min(before, contact.gap);
            active.push(ActiveContact::new(i as u32, contact, target, inverse_masses));
        }
    }
}

/// Solves all active contacts: warm start, normal impulses, then friction. Replaces the contact
/// forces. Colliders hold the particles of `supports`, so that these carry what lies on them.
///
/// `force_scale` turns an impulse into a force [1/s²].
pub(crate) fn solve(
    contacts: &[Contact],
    active: &mut [ActiveContact],
    (forces, index): (&mut WarmStart, &mut WarmStartIndex),
    supports: &mut [ColliderContact],
    start: &[Float4],
    x: &mut [Float4],
    friction: LayerFriction<'_>,
    force_scale: f32,
) {
    index.rebuild(forces);
    for state in &mut *active {
        let contact = &contacts[state.contact as usize];
        if let Some(force) = index.find_force(contact, forces) {
            let tangent = force.tangent - contact.n * force.tangent.dot(contact.n);
            state.normal_impulse = force.normal / force_scale;
            state.tangent_impulse = tangent * (1.0 / force_scale);
            state.is_new = false;
            let impulse = contact.n * state.normal_impulse + state.tangent_impulse;
            state.apply_impulse(contact, x, Wide4::from_vec3(impulse));
        }
    }
    solve_normals(contacts, active, supports, x);
    for state in &mut *active {
        let contact = &contacts[state.contact as usize];
        solve_friction(contact, state, start, x, friction.at(contact));
    }
    forces.replace(active.iter().map(|state| {
        let Contact { ids, kind, .. } = contacts[state.contact as usize];
        ContactForce {
            ids,
            kind,
            normal: state.normal_impulse * force_scale,
            tangent: state.tangent_impulse * force_scale,
        }
    }));
}

/// Solves the normal impulses of all active contacts.
fn solve_normals(
    contacts: &[Contact],
    active: &mut [ActiveContact],
    supports: &mut [ColliderContact],
    x: &mut [Float4],
) {
    for _ in 0..SWEEPS / 2 {
        supports.iter_mut().for_each(|support| support.hold(x));
        for state in &mut *active {
            solve_normal(&contacts[state.contact as usize], state, x);
        }
        supports.iter_mut().for_each(|support| support.hold(x));
        for state in active.iter_mut().rev() {
            solve_normal(&contacts[state.contact as usize], state, x);
        }
    }
}

#[inline(always)]
fn solve_normal(contact: &Contact, state: &mut ActiveContact, x: &mut [Float4]) {
    let missing = state.target - distance_along_normal(x, contact);
    let new = max(state.normal_impulse + missing * state.effective_mass, 0.0);
    let change = new - state.normal_impulse;
    if change != 0.0 {
        state.normal_impulse = new;
        state.apply_impulse(contact, x, Wide4::from_vec3(contact.n).scale(change));
    }
}

/// Coulomb friction: cancels the slip of the substep, up to `friction` times the normal impulse.
#[inline(always)]
fn solve_friction(
    contact: &Contact,
    state: &mut ActiveContact,
    start: &[Float4],
    x: &mut [Float4],
    friction: f32,
) {
    if state.normal_impulse <= 0.0 && state.tangent_impulse == Vec3::ZERO {
        return;
    }
    let wanted = state.tangent_impulse - slip(contact, start, x) * state.effective_mass;
    let (length, most) = (wanted.length(), friction * state.normal_impulse);
    state.sticks = length <= most;
    let new = if state.sticks { wanted } else { wanted * (most / length) };
    let change = new - state.tangent_impulse;
    state.tangent_impulse = new;
    state.apply_impulse(contact, x, Wide4::from_vec3(change));
}

/// The relative displacement of the closest points along the surface since the start [m].
#[inline(always)]
fn slip(contact: &Contact, start: &[Float4], x: &[Float4]) -> Vec3 {
    let mut relative = Wide4::splat(0.0);
    for (id, weight) in contact.ids.iter().zip(contact.weights) {
        let [x, start] = [x, start].map(|all| Wide4::load(&all[*id as usize]));
        relative = relative + (x - start).scale(weight);
    }
    let relative = relative.xyz();
    relative - contact.n * relative.dot(contact.n)
}

/// Separates sides that are nearer than their gap. Predicted positions move along, so no velocity
/// results.
///
/// `h` is the length of the substep [s].
pub(crate) fn correct_penetration(
    contacts: &[Contact],
    active: &[ActiveContact],
    x: &mut [Float4],
    predicted: &mut Columns,
    h: f32,
) {
    for ActiveContact { contact, response, effective_mass, .. } in active {
        let contact = &contacts[*contact as usize];
        let missing = contact.gap - distance_along_normal(x, contact);
        if missing <= 0.0 {
            continue;
        }
        let impulse = min(missing * CORRECTION_SHARE, MAX_CORRECTION_SPEED * h) * effective_mass;
        for (id, response) in contact.ids.iter().zip(response) {
            let by = contact.n * (impulse * response);
            translate_wide(&mut x[*id as usize], Wide4::from_vec3(by));
            predicted.add(*id as usize, by);
        }
    }
}

/// Fills `impacts` with the indices of active contacts that are impacts: new contacts that push.
///
/// Slow ones count too: if a side stops within one substep, BDF2 gives it half of its former velocity
/// in the opposite direction. A stack of sheets would bounce for ever.
pub(crate) fn detect_impacts(active: &[ActiveContact], impacts: &mut Vec<u32>) {
    let is_impact = |state: &ActiveContact| state.normal_impulse > 0.0 && state.is_new;
    impacts.clear();
    impacts.extend((0..).zip(active).filter(|(_, state)| is_impact(state)).map(|(i, _)| i));
}

/// The relative velocity of the closest points.
#[inline(always)]
fn relative_velocity(contact: &Contact, velocities: &Columns) -> Vec3 {
    let mut v = Vec3::ZERO;
    for (id, weight) in contact.ids.iter().zip(contact.weights) {
        v += velocities.get(*id as usize) * weight;
    }
    v
}

/// Makes impacts inelastic: removes the relative velocity along the normal, and all of it where
/// friction sticks. `velocities` may be velocities or displacements.
pub(crate) fn remove_impact_velocities(
    contacts: &[Contact],
    active: &[ActiveContact],
    impacts: &[u32],
    velocities: &mut Columns,
) {
    for state in impacts.iter().map(|i| &active[*i as usize]) {
        let contact = &contacts[state.contact as usize];
        let v = relative_velocity(contact, velocities);
        let v = if state.sticks { v } else { contact.n * v.dot(contact.n) };
        let impulse = v * -state.effective_mass;
        for (id, response) in contact.ids.iter().zip(state.response) {
            velocities.add(*id as usize, impulse * response);
        }
    }
}

/// Removes the rebound of contacts that push. If two sides approach and stop within one substep, BDF2
/// gives them half of their former velocity in the opposite direction. The velocity at which they
/// separate is limited to that of this substep's displacement. If a collider supports the cloth, it is
/// limited to zero: otherwise a stack of many layers would bounce on its collider for ever.
///
/// `displacement` has the displacement of each particle in this substep [m]; it is `None` if a collider
/// supports the cloth. `h` is the length of the substep [s]. The contacts are visited in both
/// directions, so that the rebound of a stack is passed on to its collider.
pub(crate) fn remove_rebound(
    contacts: &[Contact],
    active: &[ActiveContact],
    displacement: Option<&Columns>,
    velocities: [&mut Columns; 2],
    h: f32,
) {
    let [v, v_extrapolated] = velocities;
    for state in active.iter().chain(active.iter().rev()) {
        if state.normal_impulse <= 0.0 {
            continue;
        }
        let contact = &contacts[state.contact as usize];
        let along = |columns: &Columns| relative_velocity(contact, columns).dot(contact.n);
        let moved = displacement.map_or(0.0, |displacement| max(along(displacement), 0.0));
        let rebound = along(v) - moved / h;
        if rebound > 0.0 {
            let impulse = contact.n * (-rebound * state.effective_mass);
            for (id, response) in contact.ids.iter().zip(state.response) {
                v.add(*id as usize, impulse * response);
                v_extrapolated.add(*id as usize, impulse * response);
            }
        }
    }
}

/// Damps relative motion at contacts that push: along the normal, and in all directions where
/// friction sticks. Cloth dissipates energy at contacts, by the air between layers and by the
/// friction of fibres.
///
/// With `damp_spin`, each side loses spin as well. That does not conserve angular momentum, so it
/// is for cloth that is held or touches a collider. `v` has the velocity (or displacement) of each
/// particle relative to the rigid motion of the cloth, `h` is the length of the substep [s].
pub(crate) fn damp_contacts(
    contacts: &[Contact],
    active: &[ActiveContact],
    inverse_masses: &[f32],
    v: &mut [Float4],
    h: f32,
    damp_spin: bool,
) {
    let share = h / (h + DAMPING_TIME);
    for state in active {
        if state.normal_impulse <= 0.0 {
            continue;
        }
        let contact = &contacts[state.contact as usize];
        if damp_spin {
            let (one, other) = contact.ids.split_at(contact.kind as usize);
            [one, other].into_iter().for_each(|side| blend_to_mean(side, inverse_masses, v, share));
        }
        let relative = relative_velocity_wide(contact, v);
        let n = Wide4::from_vec3(contact.n);
        let relative = if state.sticks { relative } else { n.scale(relative.dot3(n)) };
        state.apply_impulse(contact, v, relative.scale(-state.effective_mass * share));
    }
}

/// Moves the velocities of a side towards that of its centre of mass by `share`. Does nothing if a
/// particle is fixed.
#[inline(always)]
fn blend_to_mean(side: &[u32], inverse_masses: &[f32], v: &mut [Float4], share: f32) {
    let (mut sum, mut mass) = (Wide4::splat(0.0), 0.0);
    for id in side {
        let w = inverse_masses[*id as usize];
        if w <= 0.0 {
            return;
        }
        sum = sum + Wide4::load(&v[*id as usize]).scale(1.0 / w);
        mass += 1.0 / w;
    }
    let mean = sum.scale(1.0 / mass);
    for id in side {
        let v = &mut v[*id as usize];
        translate_wide(v, (mean - Wide4::load(v)).scale(share));
    }
}

/// As [`relative_velocity`], from the interleaved layout.
#[inline(always)]
fn relative_velocity_wide(contact: &Contact, v: &[Float4]) -> Wide4 {
    let mut relative = Wide4::splat(0.0);
    for (id, weight) in contact.ids.iter().zip(contact.weights) {
        relative = relative + Wide4::load(&v[*id as usize]).scale(weight);
    }
    relative
}
