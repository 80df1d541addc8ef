//! Skinned mesh of the figure: rings of vertices around its bones, a mannequin without a face.
//!
//! Method: a loft through elliptic cross-sections (Catmull-Rom) for the trunk with neck and head,
//! each leg, foot and arm; every vertex follows one or two bones.
//!
//! Reads a [`Pose`]; writes positions and normals.
//!
//! Invariant: every part is closed, and its triangles face outwards.

use super::motion::smooth;
use super::skeleton::{Bone, Pose, SHOULDER, SIDES};
use glam::{Vec2, Vec3};
use std::f32::consts::TAU;

/// A cross-section: place along the axis, half width, half depth, and the offset of its centre
/// along the direction of the depth [m].
type Section = [f32; 4];

/// Trunk: heights above the sole.
const TRUNK: [Section; 18] = [
    [0.806, 0.002, 0.002, -0.01],
    [0.812, 0.070, 0.055, -0.01],
    [0.850, 0.145, 0.098, -0.012],
    [0.915, 0.164, 0.110, -0.014],
    [0.985, 0.150, 0.100, -0.009],
    [1.045, 0.127, 0.088, -0.002],
    [1.090, 0.121, 0.084, 0.001],
    [1.160, 0.130, 0.091, 0.004],
    [1.235, 0.144, 0.104, 0.009],
    [1.305, 0.150, 0.098, 0.003],
    [1.370, 0.150, 0.079, -0.008],
    [1.412, 0.124, 0.065, -0.013],
    [1.438, 0.080, 0.055, -0.014],
    [1.460, 0.056, 0.049, -0.011],
    [1.492, 0.047, 0.046, -0.006],
    [1.530, 0.043, 0.044, -0.002],
    [1.560, 0.034, 0.034, 0.002],
    [1.575, 0.002, 0.002, 0.003],
];
/// Head; its lower end is inside the neck.
const HEAD: [Section; 9] = [
    [1.508, 0.002, 0.002, 0.028],
    [1.513, 0.024, 0.036, 0.025],
    [1.536, 0.046, 0.068, 0.014],
    [1.582, 0.064, 0.085, 0.010],
    [1.632, 0.071, 0.092, 0.008],
    [1.680, 0.067, 0.087, 0.004],
    [1.714, 0.050, 0.065, 0.001],
    [1.732, 0.026, 0.034, 0.0],
    [1.737, 0.002, 0.002, 0.0],
];
/// Leg, around the axis through hip, knee and ankle.
const LEG: [Section; 17] = [
    [0.988, 0.002, 0.002, 0.0],
    [0.978, 0.034, 0.036, 0.0],
    [0.945, 0.070, 0.074, 0.0],
    [0.895, 0.086, 0.090, 0.0],
    [0.820, 0.085, 0.091, 0.002],
    [0.730, 0.077, 0.084, 0.004],
    [0.640, 0.066, 0.073, 0.004],
    [0.555, 0.055, 0.061, 0.004],
    [0.490, 0.051, 0.056, 0.004],
    [0.435, 0.048, 0.054, -0.004],
    [0.360, 0.049, 0.057, -0.013],
    [0.280, 0.042, 0.048, -0.012],
    [0.190, 0.031, 0.036, -0.006],
    [0.110, 0.027, 0.032, 0.0],
    [0.070, 0.026, 0.032, 0.0],
    [0.050, 0.018, 0.022, 0.0],
    [0.045, 0.002, 0.002, 0.0],
];
/// Foot, from heel to toes; its depth is vertical, and its centre is above the sole.
const FOOT: [Section; 9] = [
    [-0.062, 0.002, 0.002, 0.030],
    [-0.056, 0.020, 0.020, 0.030],
    [-0.032, 0.030, 0.034, 0.036],
    [0.005, 0.031, 0.044, 0.046],
    [0.055, 0.034, 0.033, 0.034],
    [0.105, 0.040, 0.022, 0.023],
    [0.145, 0.037, 0.015, 0.016],
    [0.170, 0.022, 0.010, 0.012],
    [0.177, 0.002, 0.002, 0.011],
];
/// Arm and hand, around the axis through shoulder, elbow and wrist.
const ARM: [Section; 18] = [
    [1.437, 0.002, 0.002, 0.0],
    [1.432, 0.024, 0.024, 0.0],
    [1.412, 0.041, 0.043, 0.0],
    [1.375, 0.045, 0.047, 0.0],
    [1.320, 0.040, 0.043, 0.0],
    [1.240, 0.035, 0.039, 0.0],
    [1.160, 0.031, 0.035, 0.0],
    [1.105, 0.029, 0.033, 0.0],
    [1.050, 0.031, 0.034, 0.001],
    [0.970, 0.027, 0.029, 0.001],
    [0.890, 0.020, 0.023, 0.0],
    [0.862, 0.019, 0.025, 0.001],
    [0.825, 0.018, 0.036, 0.006],
    [0.785, 0.017, 0.038, 0.008],
    [0.740, 0.014, 0.033, 0.006],
    [0.705, 0.010, 0.022, 0.004],
    [0.692, 0.006, 0.012, 0.003],
    [0.689, 0.002, 0.002, 0.003],
];

/// A vertex of the rest pose with its two bones and the weight of the second one.
#[derive(Clone, Copy, Debug)]
struct SkinVertex {
    position: Vec3,
    bones: [Bone; 2],
    weight: f32,
}

/// A skinned mesh in its present pose.
#[derive(Clone, Debug, Default)]
pub struct Body {
    rest: Vec<SkinVertex>,
    positions: Vec<Vec3>,
    normals: Vec<Vec3>,
    indices: Vec<u32>,
}

/// Parts of a body, and their fineness.
#[derive(Clone, Copy, Debug)]
struct Loft<'a> {
    sections: &'a [Section],
    columns: u32,
    /// Rings between two sections.
    rings: u32,
}

impl Body {
    /// Creates the mesh in the rest pose, without normals.
    pub fn new() -> Self {
        let mut body = Self::default();
        body.add_trunk();
        body.add_legs();
        let head = Loft { sections: &HEAD, columns: 32, rings: 3 };
        body.add(head, |p| p, |_| ([Bone::Head; 2], 0.0));
        for side in 0..2 {
            let sign = SIDES[side];
            let x = Bone::Foot(side).joint().x;
            let foot = Loft { sections: &FOOT, columns: 20, rings: 3 };
            // Along z, with the depth along y. Swapping axes mirrors the loft.
            let turn = |p: Vec3| Vec3::new(x + p.x, p.z, p.y);
            body.add_rings(foot, true, turn, |z| {
                ([Bone::Foot(side), Bone::Toes(side)], smooth(0.085, 0.125, z))
            });
            let arm = Loft { sections: &ARM, columns: 24, rings: 3 };
            let place = move |p: Vec3| p + Vec3::X * (sign * SHOULDER);
            body.add(arm, place, |y| {
                let elbow = 1.0 - smooth(1.06, 1.15, y);
                ([Bone::UpperArm(side), Bone::Forearm(side)], elbow)
            });
        }
        body
    }

    fn add_trunk(&mut self) {
        let trunk = Loft { sections: &TRUNK, columns: 40, rings: 3 };
        self.add(
            trunk,
            |p| p,
            |y| {
                if y > 1.35 {
                    ([Bone::Chest, Bone::Head], smooth(1.45, 1.53, y))
                } else {
                    ([Bone::Pelvis, Bone::Chest], smooth(1.06, 1.20, y))
                }
            },
        );
    }

    fn add_legs(&mut self) {
        for side in 0..2 {
            let x = Bone::Thigh(side).joint().x;
            let leg = Loft { sections: &LEG, columns: 28, rings: 3 };
            self.add(
                leg,
                move |p| p + Vec3::X * x,
                |y| ([Bone::Thigh(side), Bone::Shin(side)], 1.0 - smooth(0.41, 0.57, y)),
            );
        }
    }

    /// Adds a loft along y.
    fn add(
        &mut self,
        loft: Loft<'_>,
        place: impl Fn(Vec3) -> Vec3,
        bones: impl Fn(f32) -> ([Bone; 2], f32),
    ) {
        let descends = loft.sections[0][0] > loft.sections[1][0];
        self.add_rings(loft, descends, place, bones);
    }

    fn add_rings(
        &mut self,
        loft: Loft<'_>,
        flip: bool,
        place: impl Fn(Vec3) -> Vec3,
        bones: impl Fn(f32) -> ([Bone; 2], f32),
    ) {
        let Loft { sections, columns, rings } = loft;
        let first = self.rest.len() as u32;
        let last_section = sections.len() as u32 - 1;
        let count = last_section * rings + 1;
        for ring in 0..count {
            let [along, wide, deep, centre] = section_at(sections, ring as f32 / rings as f32);
            let (bones, weight) = bones(along);
            for column in 0..columns {
                let around = Vec2::from_angle(TAU * column as f32 / columns as f32);
                let at = Vec3::new(wide * around.y, along, centre + deep * around.x);
                self.rest.push(SkinVertex { position: place(at), bones, weight });
            }
        }
        let mut triangle = |[a, b, c]: [u32; 3]| {
            self.indices.extend(if flip { [a, c, b] } else { [a, b, c] });
        };
        for ring in 0..count - 1 {
            for column in 0..columns {
                let next = (column + 1) % columns;
                let [a, b] = [column, next].map(|column| first + ring * columns + column);
                triangle([a, b, a + columns]);
                triangle([b, b + columns, a + columns]);
            }
        }
        // The end rings have a radius of 2 mm; fans close them.
        for column in 1..columns - 1 {
            triangle([first, first + column + 1, first + column]);
            let top = first + (count - 1) * columns;
            triangle([top, top + column, top + column + 1]);
        }
    }

    /// Moves all vertices to a pose.
    pub fn pose(&mut self, pose: &Pose) {
        self.positions.clear();
        self.positions.extend(self.rest.iter().map(|vertex| {
            let [a, b] = vertex.bones.map(|bone| pose.carry(bone, vertex.position));
            a.lerp(b, vertex.weight)
        }));
    }

    /// Computes the normals of the present pose.
    pub fn update_normals(&mut self) {
        self.normals.clear();
        self.normals.resize(self.positions.len(), Vec3::ZERO);
        for t in self.indices.chunks_exact(3) {
            let [a, b, c] = [t[0], t[1], t[2]].map(|i| self.positions[i as usize]);
            let normal = (b - a).cross(c - a);
            t.iter().for_each(|i| self.normals[*i as usize] += normal);
        }
        self.normals.iter_mut().for_each(|normal| *normal = normal.normalize_or(Vec3::Y));
    }

    /// Returns the positions [m].
    pub fn positions(&self) -> &[Vec3] {
        &self.positions
    }

    /// Returns the unit normals of the last [`Body::update_normals`].
    pub fn normals(&self) -> &[Vec3] {
        &self.normals
    }

    /// Returns three vertices per triangle.
    pub fn indices(&self) -> &[u32] {
        &self.indices
    }
}

/// Interpolates the sections with a Catmull-Rom spline; sizes stay above 2 mm.
fn section_at(sections: &[Section], place: f32) -> Section {
    let last = sections.len() - 1;
    let i = (place as usize).min(last - 1);
    let t = place - i as f32;
    let at = |i: usize| sections[i.min(last)];
    let [p, a, b, n] = [at(i.saturating_sub(1)), at(i), at(i + 1), at(i + 2)];
    core::array::from_fn(|k| {
        let (m0, m1) = (0.5 * (b[k] - p[k]), 0.5 * (n[k] - a[k]));
        let (t2, t3) = (t * t, t * t * t);
        let value = a[k] * (2.0 * t3 - 3.0 * t2 + 1.0)
            + m0 * (t3 - 2.0 * t2 + t)
            + b[k] * (3.0 * t2 - 2.0 * t3)
            + m1 * (t3 - t2);
        if k == 1 || k == 2 { value.max(0.002) } else { value }
    })
}

/// Returns how often the surface winds around a point: about 0 outside, 1 or more inside (van
/// Oosterom and Strackee, 1983).
#[cfg(test)]
pub(super) fn winding_number(body: &Body, point: Vec3) -> f32 {
    let angle = |t: &[u32]| {
        let [a, b, c] = [t[0], t[1], t[2]].map(|i| body.positions[i as usize] - point);
        let [la, lb, lc] = [a, b, c].map(Vec3::length);
        let below = la * lb * lc + a.dot(b) * lc + b.dot(c) * la + c.dot(a) * lb;
        2.0 * a.dot(b.cross(c)).atan2(below)
    };
    body.indices.chunks_exact(3).map(angle).sum::<f32>() / (2.0 * TAU)
}

#[cfg(test)]
mod tests {
    use super::super::motion::pose_at;
    use super::*;

    #[test]
    fn every_part_is_closed_and_faces_outwards() {
        {
            let mut body = Body::new();
            body.pose(&pose_at(0));
            let edges: Vec<[u32; 2]> = body
                .indices
                .chunks_exact(3)
                .flat_map(|t| [[t[0], t[1]], [t[1], t[2]], [t[2], t[0]]])
                .collect();
            let mut sorted = edges.clone();
            sorted.sort_unstable();
            sorted.dedup();
            assert_eq!(sorted.len(), edges.len(), "an edge is used twice in one direction");
            for [a, b] in edges {
                assert!(sorted.binary_search(&[b, a]).is_ok(), "the edge {a}-{b} is open");
            }
            let chest = pose_at(0).carry(Bone::Chest, Vec3::new(0.0, 1.2, 0.0));
            assert!((winding_number(&body, chest) - 1.0).abs() < 1.0e-3);
            assert!(winding_number(&body, chest + Vec3::Y).abs() < 1.0e-3);
            let knee = pose_at(0).bone(Bone::Shin(0)).position;
            assert!((winding_number(&body, knee) - 1.0).abs() < 1.0e-3);
        }
    }
}
