//! Colliders: kinematic bodies that a cloth collides with.
//!
//! A collider moves from its pose at the end of the last tick to the pose that the host has set,
//! evenly over the ticks of an `advance` and their substeps, so that contacts are swept.

use crate::arena::Arena;
use crate::error::{Result, check, check_finite};
use crate::geometry::collision_shape::CollisionShape;
use crate::geometry::solid_mesh::ClosestPointQuery;
use crate::math::{max, saturate};
use crate::state::collider_desc::{ColliderDesc, Shape};
use crate::state::deformation::Deformation;
use crate::state::origin::{is_valid_origin, whole_metres};
use crate::state::pose::{COLLIDER_FIELDS, Pose, check_pose};
use glam::{Quat, Vec3};
use serde::{Deserialize, Serialize};
use std::sync::Arc;

/// Whether colliders can deform. A constant, so that the compiler removes what handles it.
const DEFORMS: bool = cfg!(feature = "facet-colliders");

/// A handle to a collider of one cloth. It becomes stale when the collider is removed.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
pub struct Collider(pub(crate) u32);

impl Collider {
    /// Converts the handle to a number, for language bindings. Never 0.
    pub fn to_bits(self) -> u32 {
        self.0
    }

    /// Converts a number from [`Collider::to_bits`] back. Functions that use an unknown handle
    /// return an error.
    pub fn from_bits(bits: u32) -> Self {
        Self(bits)
    }
}

/// Impulse of the cloth on a collider during the last tick. Divide by the tick length to get the
/// mean force and torque, for coupling with a rigid body engine.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Impulse {
    /// Linear impulse [kg m/s].
    pub linear: Vec3,
    /// Angular impulse about the position of the collider [kg m²/s].
    pub angular: Vec3,
}

impl Impulse {
    /// Adds an impulse that acts at a point, about the origin of its coordinates [m].
    pub(crate) fn add_at(&mut self, point: Vec3, linear: Vec3) {
        self.linear += linear;
        self.angular += point.cross(linear);
    }

    /// The same impulse, about a point that is `shift` from the present one [m].
    pub(crate) fn about(self, shift: Vec3) -> Self {
        Self { angular: self.angular - shift.cross(self.linear), ..self }
    }

    /// Adds `factor` times another impulse about the same point.
    pub(crate) fn add_scaled(&mut self, other: Self, factor: f32) {
        self.linear += other.linear * factor;
        self.angular += other.angular * factor;
    }

    /// The same impulse within the range of f32.
    pub(crate) fn saturate(self) -> Self {
        Self { linear: saturate(self.linear), angular: saturate(self.angular) }
    }
}

/// One collider of a cloth. Its poses are those of its `center`, relative to the origin of the
/// cloth, so that coordinates near the cloth are small in both frames:
///
/// ```text
/// position of a pose = absolute position − origin + rotation · center
/// ```
/// Field order is part of the save format.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub(crate) struct ColliderBody {
    /// Its pose is absolute: the one that the host gave last.
    pub desc: ColliderDesc,
    /// Pose at the end of the last tick.
    pub last: Pose,
    /// Pose at the end of the next tick.
    pub next: Pose,
    /// Impulse received during the last tick.
    pub impulse: Impulse,
    /// Impulse that the velocities of the cloth have not taken up yet: the second-order scheme
    /// (BDF2) spreads it over the next substeps.
    pub pending: Impulse,
    /// The deformation of a mesh, once the host has given new vertices.
    #[cfg_attr(
        not(feature = "facet-colliders"),
        serde(deserialize_with = "super::no_facets::skip_deformation")
    )]
    deformation: Option<Box<Deformation>>,
    /// Whether it is the surface of another cloth, which `collide_with` added.
    pub is_layer: bool,
    /// A point in the local frame [m]: that of `ColliderDesc::shape_center`, or a point of a plane
    /// near the origin of the cloth.
    center: Vec3,
    /// Pose at the end of an `advance`; equal to `next` except while its ticks run, see
    /// `solver::kinematic::tick_targets`.
    #[serde(skip)]
    pub final_pose: Pose,
    /// Absolute pose at the end of the last tick, also after `move_frame` changed `last`; `None`
    /// between `restore` and the next tick.
    #[serde(skip)]
    arrived: Option<Pose>,
    /// Shape built from the descriptor; `None` between reading a save and `restore`, and if the
    /// collider deforms.
    #[serde(skip)]
    collision_shape: Option<Arc<CollisionShape>>,
    /// 1 if the normals of a solid mesh point outward, −1 if they point inward, 0 for other shapes.
    #[serde(skip)]
    orientation: f32,
}

impl ColliderBody {
    pub fn new(desc: ColliderDesc, origin: Vec3) -> Result<Self> {
        desc.check()?;
        let pose = Pose::new(desc.position, desc.rotation);
        let (center, shape) = (desc.shape_center(), Arc::new(desc.collision_shape()?));
        let orientation = desc.orientation()?;
        let mut body = Self {
            desc,
            last: pose,
            next: pose,
            impulse: Impulse::default(),
            pending: Impulse::default(),
            deformation: None,
            is_layer: false,
            center,
            final_pose: pose,
            arrived: Some(pose),
            collision_shape: Some(shape),
            orientation,
        };
        body.place(pose.rotation, origin);
        body.last = body.next;
        Ok(body)
    }

    /// Validates a collider from a save and builds its shape.
    pub fn restore(&mut self) -> Result<()> {
        self.desc.check()?;
        for impulse in [self.impulse, self.pending] {
            check_finite(impulse.linear, "collider.impulse")?;
            check_finite(impulse.angular, "collider.impulse")?;
        }
        check(is_valid_origin(self.center), "collider.center", "be in whole metres")?;
        if self.desc.shape != Shape::Plane {
            self.center = self.desc.shape_center();
        }
        check_pose(self.last.position, self.last.rotation, COLLIDER_FIELDS)?;
        check_pose(self.next.position, self.next.rotation, COLLIDER_FIELDS)?;
        self.final_pose = self.next;
        self.orientation = self.desc.orientation()?;
        match &mut self.deformation {
            Some(deformation) => {
                let (positions, triangles) = self.desc.mesh_surface();
                check(self.desc.shape == Shape::Mesh, "collider.deformation", "be that of a mesh")?;
                deformation.restore(&positions, triangles)?;
            }
            None => self.collision_shape = Some(Arc::new(self.desc.collision_shape()?)),
        }
        Ok(())
    }

    /// The shape; `None` before `restore`.
    pub fn collision_shape(&self) -> Option<&CollisionShape> {
        match &self.deformation {
            Some(deformation) => deformation.shape(),
            None => self.collision_shape.as_deref(),
        }
    }

    /// Whether this is a mesh with an inside.
    pub fn is_solid_mesh(&self) -> bool {
        self.desc.shape == Shape::Mesh && self.desc.solid > 0.0
    }

    /// Returns the closest point of the surface of a solid mesh to a point inside it, and the direction
    /// to it, in the frame of the collider at the start of the tick; `None` for points that are outside
    /// or deeper than `ColliderDesc::solid`.
    pub fn closest_point_from_inside(&self, point: Vec3) -> Option<(Vec3, Vec3)> {
        let mut query = ClosestPointQuery::new(point, self.desc.solid);
        match (&self.deformation, self.collision_shape.as_deref()) {
            (Some(deformation), _) => deformation.visit_near(&mut query),
            (None, Some(CollisionShape::TriangleSurface(surface, _))) => {
                surface.visit_near(&mut query, None);
            }
            _ => {}
        }
        query.if_inside(self.orientation)
    }

    /// The deformation; `None` if the collider is rigid.
    pub fn deformation(&self) -> Option<&Deformation> {
        self.deformation.as_deref().filter(|_| DEFORMS)
    }

    /// The deformation; `None` if the collider is rigid.
    pub fn deformation_mut(&mut self) -> Option<&mut Deformation> {
        self.deformation.as_deref_mut().filter(|_| DEFORMS)
    }

    /// Whether the collider deforms in the next tick.
    pub fn is_deforming(&self) -> bool {
        self.deformation().is_some_and(|one| one.is_moving())
    }

    /// Whether the collider moves or deforms in the next tick.
    pub fn is_moving(&self) -> bool {
        self.last != self.next || self.is_deforming()
    }

    /// Returns [`Error::BadValue`](crate::Error::BadValue) unless this is a mesh of `count` vertices.
    pub fn check_vertices(&self, count: usize) -> Result<()> {
        check(self.desc.shape == Shape::Mesh, "collider", "be a mesh")?;
        let is_whole = count == self.desc.positions.len();
        check(is_whole, "count", "be the number of vertices of the collider")
    }

    /// Sets the vertices of a mesh that the next tick, or the ticks of the next `advance`, reach, in
    /// the local frame [m].
    pub fn update(&mut self, position: &dyn Fn(usize) -> Vec3) {
        let center = self.center;
        if let Some(deformation) = self.make_deformable() {
            deformation.set_target(&|i| position(i) - center);
        }
    }

    fn make_deformable(&mut self) -> Option<&mut Deformation> {
        if self.deformation.is_none() {
            let (base, triangles) = self.desc.mesh_surface();
            self.deformation = Deformation::new(&base, triangles).map(Box::new);
            self.collision_shape = None;
        }
        self.deformation_mut()
    }

    /// A vertex of a mesh where it is at the start of the next tick, in the local frame [m].
    pub fn vertex(&self, i: usize) -> Vec3 {
        match &self.deformation {
            Some(deformation) => deformation.vertex(i) + self.center,
            None => self.desc.positions[i],
        }
    }

    /// Moves the local frame of a mesh that is not rotated to the absolute `position` [m]. The
    /// surface stays where it is until it is updated.
    pub fn move_mesh_frame(&mut self, position: Vec3, origin: Vec3) {
        let shift = self.desc.position - position;
        if let Some(deformation) = self.make_deformable() {
            deformation.translate(shift);
        }
        self.move_last_frame(-shift);
        self.desc.position = position;
        self.place(Quat::IDENTITY, origin);
    }

    /// Replaces a mesh by that of `new`, at the same position. The vertices of `new` are at `start`
    /// at the start of the next tick, in the local frame [m]. The pose at that time and the impulses
    /// stay.
    pub fn replace_mesh(&mut self, mut new: Self, start: &[Vec3]) {
        let center = new.center;
        if let Some(deformation) = new.make_deformable() {
            deformation.place(&|i| start[i] - center);
        }
        new.last = self.last;
        new.move_last_frame(new.center - self.center);
        (new.impulse, new.pending) = (self.impulse, self.pending);
        *self = new;
    }

    /// Moves the pose at the end of the last tick by a vector of its frame [m].
    fn move_last_frame(&mut self, local: Vec3) {
        self.last.position = self.last.offset(self.last.position.as_dvec3(), local);
    }

    /// Upper bound of how far the rotation of a tick takes any point of the collider from the
    /// straight line between its start and its end [m].
    pub fn max_arc_deviation(&self, collision_shape: &CollisionShape) -> f32 {
        let bounds = collision_shape.bounds();
        let farthest = bounds.low.abs().max(bounds.high.abs()).length();
        let dot: f32 = {
            let (from, to) = (self.last.rotation.to_array(), self.next.rotation.to_array());
            (0..4).map(|i| from[i] * to[i]).sum()
        };
        // 1 − cos(θ/2) ≤ sin²(θ/2), where θ is the rotation and `dot` = cos(θ/2).
        farthest * max(1.0 - dot * dot, 0.0)
    }

    /// Sets the absolute pose that the collider reaches at the end of the next tick.
    pub fn move_to(&mut self, position: Vec3, rotation: Quat, origin: Vec3) -> Result<()> {
        check_pose(position, rotation, COLLIDER_FIELDS)?;
        self.desc.position = position;
        self.place(Pose::new(position, rotation).rotation, origin);
        Ok(())
    }

    /// Sets `next` and `final_pose` from the absolute position of the descriptor and a unit
    /// `rotation`. The center of a plane moves to the origin of the cloth.
    fn place(&mut self, rotation: Quat, origin: Vec3) {
        let mut pose = Pose { position: self.desc.position - origin, rotation };
        if self.desc.shape == Shape::Plane {
            let to_origin = if origin == Vec3::ZERO { Vec3::ZERO } else { -pose.position };
            let Vec3 { x, z, .. } = pose.to_transform().vector_to_local(to_origin);
            let center = whole_metres(Vec3::ZERO, Vec3::new(x, 0.0, z));
            self.last.position =
                self.last.offset(self.last.position.as_dvec3(), center - self.center);
            self.center = center;
        }
        pose.position = pose.offset(self.desc.position.as_dvec3() - origin.as_dvec3(), self.center);
        (self.next, self.final_pose) = (pose, pose);
    }

    /// The position that the host gave last, relative to the origin of the cloth [m].
    pub fn position(&self) -> Vec3 {
        self.next.offset(self.next.position.as_dvec3(), -self.center)
    }

    /// The absolute pose at the end of the last tick.
    pub fn pose(&self, origin: Vec3) -> Pose {
        self.arrived.unwrap_or_else(|| {
            let center = self.last.position.as_dvec3() + origin.as_dvec3();
            Pose { position: self.last.offset(center, -self.center), ..self.last }
        })
    }

    /// Makes the poses relative to `origin`, which is `shift` from the last one.
    ///
    /// At rest, they are computed from the absolute position, which keeps its digits while the
    /// cloth is far away.
    pub fn move_origin(&mut self, origin: Vec3, shift: Vec3) {
        if self.last == self.next && self.next == self.final_pose {
            self.place(self.next.rotation, origin);
            self.last = self.next;
        } else {
            for pose in [&mut self.last, &mut self.next, &mut self.final_pose] {
                pose.position -= shift;
            }
        }
    }

    /// Sets the absolute pose immediately, without motion in between.
    pub fn teleport(&mut self, position: Vec3, rotation: Quat, origin: Vec3) -> Result<()> {
        self.move_to(position, rotation, origin)?;
        self.finish_tick();
        Ok(())
    }

    /// Completes the motion of a tick: the collider has arrived at its next pose.
    pub fn finish_tick(&mut self) {
        self.last = self.next;
        if let Some(deformation) = &mut self.deformation {
            deformation.finish_tick();
        }
        self.desc.rotation = self.next.rotation;
        self.arrived = Some(Pose { position: self.desc.position, ..self.last });
    }
}

/// Maximum number of colliders of a cloth.
pub(crate) const MAX_COLLIDERS: u16 = 1024;

/// All colliders of a cloth.
pub(crate) type Colliders = Arena<Box<ColliderBody>>;
