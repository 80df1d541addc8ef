//! Patch grab: one pointer grabs a small patch of particles, so that a pull does not stretch the
//! cloth at a single particle.
//!
//! Method: picking by a ray, then breadth-first search along the links within a fingertip radius of
//! rest distance.
//!
//! Reads the cloth and a pick ray; writes grabs of the cloth.
//!
//! Invariant: the grabbed particles keep their offsets to each other while the patch moves.

use glam::{Vec2, Vec3};
use muslin::{Cloth, Error, Grab, LinkKind, Result};

/// Radius of the patch along the cloth, in drawn metres; at least one edge.
pub const FINGERTIP_RADIUS: f32 = 0.055;
/// Most particles of a patch: a cloth has a few dozen grabs for all pointers together.
const MAX_PARTICLES: usize = 9;

/// The grabs of one patch.
#[derive(Debug)]
pub struct PatchGrab {
    /// Each grab with its offset from the picked particle [m].
    held: Vec<(Grab, Vec3)>,
    /// Target of the picked particle [m].
    at: Vec3,
}

impl PatchGrab {
    /// Grabs the patch at the particle that the ray hits, or that is within `radius` [m] of the
    /// ray. `span` is the size of the sheet in texture space [m], `fingertip` the radius of the
    /// patch [m].
    ///
    /// # Errors
    /// As [`Cloth::grab_ray`].
    pub fn grab_ray(
        cloth: &mut Cloth,
        [eye, direction]: [Vec3; 2],
        radius: f32,
        span: Vec2,
        fingertip: f32,
    ) -> Result<Option<Self>> {
        let hit = cloth.raycast(eye, direction, f32::INFINITY)?;
        let Some((grab, at)) = cloth.grab_ray(eye, direction, radius)? else {
            return Ok(None);
        };
        let first = hit.map(|hit| hit.particle).or_else(|| {
            let found = cloth.positions().iter().position(|x| *x == at)?;
            Some(found as u32)
        });
        let mut hand = Self { held: vec![(grab, Vec3::ZERO)], at };
        for particle in first.map_or_else(Vec::new, |first| patch(cloth, first, span, fingertip)) {
            let beside = cloth.positions()[particle as usize] - at;
            match cloth.grab_particle(particle) {
                Ok(grab) => hand.held.push((grab, beside)),
                // Other pointers use all grabs of the cloth.
                Err(Error::Full { .. }) => break,
                Err(error) => return Err(error),
            }
        }
        Ok(Some(hand))
    }

    /// Returns the target of the picked particle [m].
    pub fn at(&self) -> Vec3 {
        self.at
    }

    /// Moves the patch; `at` is the new target of the picked particle [m].
    ///
    /// # Errors
    /// As [`Cloth::move_grab`].
    pub fn move_to(&mut self, at: Vec3, cloth: &mut Cloth) -> Result<()> {
        self.at = at;
        self.held.iter().try_for_each(|(grab, beside)| cloth.move_grab(*grab, at + *beside))
    }

    /// Releases all grabs of the patch.
    ///
    /// # Errors
    /// As [`Cloth::release`].
    pub fn release(self, cloth: &mut Cloth) -> Result<()> {
        self.held.into_iter().try_for_each(|(grab, _)| cloth.release(grab))
    }
}

/// Returns the particles within `fingertip` [m] of `first` that links connect with it, nearest
/// first, without `first`.
fn patch(cloth: &Cloth, first: u32, span: Vec2, fingertip: f32) -> Vec<u32> {
    let place = |particle: u32| cloth.uvs()[particle as usize] * span;
    let threads: Vec<_> = cloth.links().filter(|link| link.2 != LinkKind::Bend).collect();
    let edge = threads.iter().filter(|link| link.2 == LinkKind::Stretch);
    let edge = edge.map(|(a, b, _)| place(*a).distance(place(*b))).fold(f32::INFINITY, f32::min);
    let reach = fingertip.max(1.05 * edge);
    let near = |particle: u32| place(particle).distance(place(first)) <= reach;
    let mut patch = vec![first];
    let mut next = 0;
    while next < patch.len() {
        let from = patch[next];
        for (a, b, _) in &threads {
            let other = if *a == from { *b } else { *a };
            if (*a == from || *b == from) && near(other) && !patch.contains(&other) {
                patch.push(other);
            }
        }
        next += 1;
    }
    patch.remove(0);
    let far = |particle: &u32| place(*particle).distance(place(first));
    patch.sort_by(|a, b| far(a).total_cmp(&far(b)).then(a.cmp(b)));
    patch.truncate(MAX_PARTICLES - 1);
    patch
}

#[cfg(test)]
mod tests {
    use super::*;
    use muslin::GridDesc;

    const AHEAD: Vec3 = Vec3::NEG_Z;

    fn sheet() -> Cloth {
        let desc = GridDesc { columns: 21, rows: 21, spacing: 0.05, ..GridDesc::default() };
        Cloth::grid(&desc).unwrap()
    }

    #[test]
    fn a_patch_grabs_a_particle_with_its_neighbours_and_releases_all() {
        let mut cloth = sheet();
        let eye = Vec3::new(0.5, -0.5, 1.0);
        let mut hand =
            PatchGrab::grab_ray(&mut cloth, [eye, AHEAD], 0.0, Vec2::ONE, FINGERTIP_RADIUS)
                .unwrap()
                .unwrap();
        assert_eq!(hand.held.len(), 5);
        let to = hand.at() + Vec3::new(0.1, 0.1, 0.3);
        hand.move_to(to, &mut cloth).unwrap();
        cloth.step(30);
        let middle = 10 * 21 + 10;
        assert!(cloth.positions()[middle].distance(to) < 1.0e-4);
        assert!(cloth.positions()[middle + 1].distance(to + Vec3::X * 0.05) < 1.0e-4);
        hand.release(&mut cloth).unwrap();
        cloth.step(30);
        assert!(cloth.positions()[middle].distance(to) > 0.05);
    }

    #[test]
    fn a_patch_does_not_cross_a_cut() {
        let mut cloth = sheet();
        let (from, to) = (Vec3::new(0.475, 0.1, -0.2), Vec3::new(0.475, -0.9, -0.2));
        assert!(cloth.cut(from, to, Vec3::Z * 0.4).unwrap() > 0);
        let left = 10 * 21 + 9;
        for particle in patch(&cloth, left, Vec2::ONE, FINGERTIP_RADIUS) {
            assert!(cloth.positions()[particle as usize].x < 0.476);
        }
    }

    #[test]
    fn a_ray_beside_the_cloth_grabs_nothing() {
        let eye = Vec3::new(3.0, 3.0, 1.0);
        assert!(
            PatchGrab::grab_ray(&mut sheet(), [eye, AHEAD], 0.05, Vec2::ONE, FINGERTIP_RADIUS)
                .unwrap()
                .is_none()
        );
    }
}
