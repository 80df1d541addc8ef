//! Scene: a mannequin walks in a circle and kicks, in a skirt and a loose shirt.
//!
//! ```text
//! motion ─▶ pose ─┬─▶ skinned mesh (trunk, legs), capsules (arms) ─▶ colliders ┐
//!                 └─▶ waist, shoulder seams ─▶ attachments ────────────────────┴─▶ cloth ─▶ skins
//! ```
//! Method: both garments are pieces of one coarse cloth with surface collision, so that they also
//! collide with each other. The body is a skinned mesh that gets its new vertices before every
//! tick. What is drawn is a fine skin of each garment, and a finer mesh of the body.
//!
//! Reads nothing; writes a [`SceneInstance`].
//!
//! Invariant: before each tick colliders and attachments get the pose at the end of that tick.

pub mod body;
pub mod garments;
pub mod motion;
pub mod skeleton;

use crate::instance::SceneInstance;
use crate::scene::Scene;
use body::Body;
use garments::{Panel, SKIN_DETAIL, shirt, skirt};
use glam::{Quat, Vec3};
use motion::pose_at;
use muslin::{
    Attachment, Cloth, Collider, ColliderDesc, Material, MeshDesc, Preset, Result, SelfCollision,
    Settings, Shape, Skin, SkinDesc,
};
use skeleton::{Bone, Pose};

/// Gap between body and cloth [m].
const GAP: f32 = 0.006;
/// Friction of the body.
const FRICTION: f32 = 0.25;
/// Radii of the capsules of an arm at shoulder, elbow and hand [m].
const ARM_RADII: [f32; 3] = [0.044, 0.034, 0.030];
/// End of the hand below the elbow [m].
const HAND: f32 = 0.37;
/// Distance from a capsule's ends to those of the bone [m].
const INSET: f32 = 0.01;

/// A figure in a skirt and a shirt.
#[derive(Clone, Copy, Debug)]
pub struct Figure;

/// The body of a running scene, and what is drawn of its clothes.
#[derive(Debug)]
pub struct DressedBody {
    pose: Pose,
    /// Number of ticks that the figure has moved for.
    ticks: u32,
    collision: Body,
    drawn: Body,
    trunk: Collider,
    /// Upper arm and forearm of each side.
    arms: [[Collider; 2]; 2],
    waist: Attachment,
    shoulders: Attachment,
    /// Skirt and shirt.
    skins: [Skin; 2],
}

impl Figure {
    /// Returns the settings of the clothes.
    pub fn settings() -> Settings {
        Settings {
            self_collision: SelfCollision::Surface,
            self_distance: 0.005,
            max_stretch: 0.06,
            ..Settings::default()
        }
    }

    /// Creates the clothes, and the body that wears them.
    ///
    /// # Errors
    /// As [`Cloth::mesh`]: a wrong material.
    pub fn dress(material: Material, settings: Settings) -> Result<SceneInstance> {
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

        let [mut collision, mut drawn] = [Body::collision(), Body::drawn()];
        collision.pose(&pose);
        drawn.pose(&pose);
        drawn.update_normals();
        let trunk = cloth.add_collider(&ColliderDesc {
            shape: Shape::Mesh,
            positions: collision.positions().to_vec(),
            indices: collision.indices().to_vec(),
            thickness: GAP,
            friction: FRICTION,
            ..ColliderDesc::default()
        })?;
        let mut arm = |side: usize| -> Result<[Collider; 2]> {
            let [upper, lower] = arm_capsules(&pose, side);
            Ok([cloth.add_collider(&upper)?, cloth.add_collider(&lower)?])
        };
        let arms = [arm(0)?, arm(1)?];
        let skin = |panel: &Panel, bone: Bone| {
            let mut desc = SkinDesc::default();
            desc.positions = worn(panel, bone);
            desc.indices = panel.indices.clone();
            desc.uvs = panel.uvs.clone();
            Skin::new(&cloth, &desc)
        };
        let skins =
            [skin(&skirt(SKIN_DETAIL), Bone::Pelvis)?, skin(&shirt(SKIN_DETAIL), Bone::Chest)?];
        let body =
            DressedBody { pose, ticks: 0, collision, drawn, trunk, arms, waist, shoulders, skins };
        Ok(SceneInstance::with_figure(cloth, body))
    }
}

/// Returns the capsules around the upper arm and the forearm of a side.
fn arm_capsules(pose: &Pose, side: usize) -> [ColliderDesc; 2] {
    let length = Bone::UpperArm(side).joint().y - Bone::Forearm(side).joint().y;
    let ends = [(Bone::UpperArm(side), length), (Bone::Forearm(side), HAND - ARM_RADII[2])];
    let mut radii = ARM_RADII.windows(2);
    ends.map(|(bone, length)| {
        let [top, bottom] = radii.next().map_or([0.0; 2], |pair| [pair[0], pair[1]]);
        let (position, rotation) = capsule_pose(pose, bone, length);
        ColliderDesc {
            shape: Shape::Capsule,
            position,
            rotation,
            radius: bottom,
            top_radius: top,
            half_height: 0.5 * length - INSET,
            thickness: GAP,
            friction: FRICTION,
            ..ColliderDesc::default()
        }
    })
}

/// Returns the pose of a capsule along a bone of this length [m], which hangs down at rest.
fn capsule_pose(pose: &Pose, bone: Bone, length: f32) -> (Vec3, Quat) {
    let middle = bone.joint() - Vec3::Y * (0.5 * length);
    (pose.carry(bone, middle), pose.bone(bone).rotation)
}

impl DressedBody {
    /// Moves colliders and attachments to the pose at the end of the next tick.
    pub(crate) fn set_targets(&mut self, cloth: &mut Cloth) {
        self.pose = pose_at(self.ticks.wrapping_add(1));
        self.collision.pose(&self.pose);
        let result = self.move_all(cloth);
        debug_assert!(result.is_ok(), "the figure does not move: {result:?}");
    }

    fn move_all(&self, cloth: &mut Cloth) -> Result<()> {
        cloth.update_collider(self.trunk, self.collision.positions())?;
        for (side, arm) in self.arms.iter().enumerate() {
            for (collider, desc) in arm.iter().zip(arm_capsules(&self.pose, side)) {
                cloth.move_collider(*collider, desc.position, desc.rotation)?;
            }
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

    /// Returns the mesh that the cloth collides with.
    pub fn collision(&self) -> &Body {
        &self.collision
    }

    /// Returns the depth of a point inside the capsules of the arms [m]; negative outside.
    pub fn depth_in_arms(&self, point: Vec3) -> f32 {
        let capsules = (0..2).flat_map(|side| arm_capsules(&self.pose, side));
        let depths = capsules.map(|capsule| {
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

impl Scene for Figure {
    const NAME: &'static str = "figure in a skirt and a shirt";
    const ABOUT: &'static str = "It walks in a circle and kicks, and its clothes stay on.";

    fn build() -> SceneInstance {
        match Self::dress(Material::preset(Preset::Cotton), Self::settings()) {
            Ok(instance) => instance,
            Err(error) => unreachable!("the descriptor of the scene is wrong: {error}"),
        }
    }

    fn check(instance: &SceneInstance) -> core::result::Result<(), String> {
        let (cloth, body) = (&instance.cloths[0], instance.figure().ok_or("there is no figure")?);
        for x in cloth.positions() {
            if !x.is_finite() {
                return Err(format!("a particle is at {x}"));
            }
            let depth = body.depth_in_arms(*x);
            if depth > 1.0e-3 {
                return Err(format!("a particle at {x} is {depth} m inside an arm"));
            }
            let turns = body.collision().winding_number(*x);
            if turns > 0.5 {
                return Err(format!("a particle at {x} is inside the body"));
            }
        }
        let stretch = cloth.stats().max_stretch;
        if stretch > 0.10 {
            return Err(format!("the largest stretch is {stretch}"));
        }
        Ok(())
    }
}
