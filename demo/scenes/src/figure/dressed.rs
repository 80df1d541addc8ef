//! The body of the figure with its clothes: colliders, attachments, and what is drawn.
//!
//! Method: tapered capsules around the bones are colliders; waist and shoulder seams are attached;
//! each garment has a fine skin.
//!
//! Reads the pose of a tick; writes colliders and attachments of the cloth, skins and body mesh.
//!
//! Invariant: before each tick colliders and attachments get the pose at the end of that tick.

use super::body::Body;
use super::garments::{Panel, SKIN_DETAIL, shirt, skirt};
use super::motion::pose_at;
use super::skeleton::{Bone, Pose, SHOULDER, SIDES};
use glam::{Quat, Vec3};
use muslin::{
    Attachment, Cloth, Collider, ColliderDesc, Material, MeshDesc, Result, Settings, Shape, Skin,
    SkinDesc,
};

/// Gap between body and cloth [m].
const GAP: f32 = 0.006;
/// Friction of the body.
const FRICTION: f32 = 0.25;
/// A tapered capsule that a bone carries: both ends in the rest pose, on the left side, and their
/// radii [m].
struct BodyCapsule {
    bone: fn(usize) -> Bone,
    ends: [[f32; 3]; 2],
    radii: [f32; 2],
}

/// The capsules of one side of the body, from the top down. Two beside each other make the oval
/// cross-section of the trunk.
const CAPSULES: [BodyCapsule; 7] = [
    BodyCapsule {
        bone: |_| Bone::Chest,
        ends: [[0.045, 1.375, -0.009], [0.118, 1.362, -0.008]],
        radii: [0.063, 0.060],
    },
    BodyCapsule {
        bone: |_| Bone::Chest,
        ends: [[0.040, 1.285, 0.009], [0.030, 1.135, 0.002]],
        radii: [0.108, 0.088],
    },
    BodyCapsule {
        bone: |_| Bone::Pelvis,
        ends: [[0.030, 1.055, -0.002], [0.046, 0.915, -0.013]],
        radii: [0.091, 0.114],
    },
    BodyCapsule {
        bone: Bone::UpperArm,
        ends: [[SHOULDER, 1.385, 0.0], [SHOULDER, 1.105, 0.0]],
        radii: [0.047, 0.034],
    },
    BodyCapsule {
        bone: Bone::Forearm,
        ends: [[SHOULDER, 1.105, 0.0], [SHOULDER, 0.725, 0.006]],
        radii: [0.034, 0.036],
    },
    BodyCapsule {
        bone: Bone::Thigh,
        ends: [[0.088, 0.885, 0.002], [0.088, 0.490, 0.004]],
        radii: [0.097, 0.063],
    },
    BodyCapsule {
        bone: Bone::Shin,
        ends: [[0.088, 0.440, -0.004], [0.088, 0.110, -0.002]],
        radii: [0.062, 0.036],
    },
];

/// The body of a running scene, and what is drawn of its clothes.
#[derive(Debug)]
pub struct DressedBody {
    pose: Pose,
    /// Number of ticks that the figure has moved for.
    ticks: u32,
    drawn: Body,
    /// The colliders of [`capsules`].
    capsules: Vec<Collider>,
    waist: Attachment,
    shoulders: Attachment,
    /// Skirt and shirt.
    skins: [Skin; 2],
}

/// Returns the capsules of the body in a pose.
fn capsules(pose: &Pose) -> impl Iterator<Item = ColliderDesc> + '_ {
    CAPSULES.iter().flat_map(|capsule| [(capsule, 0), (capsule, 1)]).map(|(capsule, side)| {
        let bone = (capsule.bone)(side);
        let [top, bottom] = capsule.ends.map(|[x, y, z]| Vec3::new(SIDES[side] * x, y, z));
        let [top_radius, radius] = capsule.radii;
        let along = Quat::from_rotation_arc(Vec3::Y, (top - bottom).normalize());
        ColliderDesc {
            shape: Shape::Capsule,
            position: pose.carry(bone, 0.5 * (top + bottom)),
            rotation: pose.bone(bone).rotation * along,
            radius,
            top_radius,
            half_height: 0.5 * top.distance(bottom),
            thickness: GAP,
            friction: FRICTION,
            ..ColliderDesc::default()
        }
    })
}

impl DressedBody {
    /// Creates the clothes, and the body that wears them.
    ///
    /// # Errors
    /// As [`Cloth::mesh`]: a wrong material.
    pub(crate) fn dress(material: Material, settings: Settings) -> Result<(Cloth, Self)> {
        let pose = pose_at(0);
        let worn = |panel: &Panel, bone: Bone| -> Vec<Vec3> {
            panel.positions.iter().map(|x| pose.carry(bone, *x)).collect()
        };
        let (lower, upper) = (skirt(1), shirt(1));
        let first = lower.positions.len() as u32;
        let mut desc = MeshDesc { material, settings, ..MeshDesc::default() };
        desc.positions = [worn(&lower, Bone::Pelvis), worn(&upper, Bone::Chest)].concat();
        desc.uvs = [lower.uvs, upper.uvs].concat();
        desc.indices = lower.indices;
        desc.indices.extend(upper.indices.iter().map(|vertex| first + vertex));
        let mut cloth = Cloth::mesh(&desc)?;
        let seams: Vec<u32> = upper.held.iter().map(|vertex| first + vertex).collect();
        let attach = |cloth: &mut Cloth, particles: &[u32], bone: Bone| {
            let pose = pose.bone(bone);
            cloth.attach(particles, pose.position, pose.rotation)
        };
        let waist = attach(&mut cloth, &lower.held, Bone::Pelvis)?;
        let shoulders = attach(&mut cloth, &seams, Bone::Chest)?;

        let mut colliders = Vec::new();
        for desc in capsules(&pose) {
            colliders.push(cloth.add_collider(&desc)?);
        }
        let skin = |panel: &Panel, bone: Bone| {
            let positions = worn(panel, bone);
            let (indices, uvs) = (panel.indices.clone(), panel.uvs.clone());
            Skin::new(&cloth, &SkinDesc { positions, indices, uvs, ..SkinDesc::default() })
        };
        let skins =
            [skin(&skirt(SKIN_DETAIL), Bone::Pelvis)?, skin(&shirt(SKIN_DETAIL), Bone::Chest)?];
        let mut drawn = Body::new();
        drawn.pose(&pose);
        drawn.update_normals();
        let capsules = colliders;
        let body = Self { pose, ticks: 0, drawn, capsules, waist, shoulders, skins };
        Ok((cloth, body))
    }

    /// Moves colliders and attachments to the pose at the end of the next tick.
    pub(crate) fn set_targets(&mut self, cloth: &mut Cloth) {
        self.pose = pose_at(self.ticks.wrapping_add(1));
        let result = self.move_all(cloth);
        debug_assert!(result.is_ok(), "the figure does not move: {result:?}");
    }

    fn move_all(&self, cloth: &mut Cloth) -> Result<()> {
        for (collider, desc) in self.capsules.iter().zip(capsules(&self.pose)) {
            cloth.move_collider(*collider, desc.position, desc.rotation)?;
        }
        for (attachment, bone) in [(self.waist, Bone::Pelvis), (self.shoulders, Bone::Chest)] {
            let pose = self.pose.bone(bone);
            cloth.move_attachment(attachment, pose.position, pose.rotation)?;
        }
        Ok(())
    }

    /// Counts ticks that have run.
    pub(crate) fn add_ticks(&mut self, ticks: u32) {
        self.ticks = self.ticks.wrapping_add(ticks);
    }

    /// Updates what is drawn: the skins of the garments, and the mesh of the body.
    ///
    /// # Errors
    /// As [`Skin::update`].
    pub fn update_drawn(&mut self, cloth: &Cloth) -> Result<()> {
        self.drawn.pose(&pose_at(self.ticks));
        self.drawn.update_normals();
        self.skins.iter_mut().try_for_each(|skin| skin.update(cloth))
    }

    /// Returns the skins of skirt and shirt, as of the last [`DressedBody::update_drawn`].
    pub fn skins(&self) -> &[Skin; 2] {
        &self.skins
    }

    /// Returns the mesh of the body that is drawn.
    pub fn drawn(&self) -> &Body {
        &self.drawn
    }

    /// Returns the depth of a point inside the capsules of the body [m]; negative outside.
    pub fn depth_inside(&self, point: Vec3) -> f32 {
        let depths = capsules(&self.pose).map(|capsule| {
            let axis = capsule.rotation * Vec3::Y;
            let along = (point - capsule.position).dot(axis) / capsule.half_height;
            let along = along.clamp(-1.0, 1.0);
            let radius =
                capsule.radius + (0.5 + 0.5 * along) * (capsule.top_radius - capsule.radius);
            let centre = capsule.position + axis * (along * capsule.half_height);
            radius - point.distance(centre)
        });
        depths.fold(f32::MIN, f32::max)
    }
}
