//! The colliders of a cloth: the collision shapes that it follows.
//!
//! ```text
//! group, paths, children ─▶ bodies: node, shape, handle ─▶ Cloth::{add, move, remove}_collider
//! ```
//! Reads the scene tree; writes the colliders of the cloth in each physics tick.
//! Invariant: a node that is disabled, out of the tree or refused has no collider.

use crate::convert::Placement;
use crate::refusal::{Refusal, Result};
use crate::shapes::PlacedShape;
use godot::builtin::{Callable, StringName};
use godot::classes::object::ConnectFlags;
use godot::classes::{CollisionShape3D, PhysicsBody3D, RigidBody3D, StaticBody3D};
use godot::obj::{Gd, InstanceId};
use muslin::glam::{Quat, Vec3};
use muslin::{Cloth, Collider};
use std::collections::HashMap;

/// The bodies, and what has to be read again.
pub struct Colliders {
    bodies: Vec<Body>,
    /// What the nodes and shapes were read with.
    contact: Option<Contact>,
    /// Whether the nodes are to be searched.
    nodes_are_old: bool,
    /// Whether the shapes are to be converted.
    shapes_are_old: bool,
}

impl Default for Colliders {
    fn default() -> Self {
        Self { bodies: Vec::new(), contact: None, nodes_are_old: true, shapes_are_old: true }
    }
}

/// What the properties of the node say about colliders.
#[derive(Clone, PartialEq)]
pub struct Contact {
    /// The group whose nodes are colliders.
    pub group: StringName,
    /// Hash of the list of paths.
    pub paths: u32,
    /// Friction of those whose body has no physics material; −1 = that of the cloth.
    pub friction: f32,
    /// Gap to the cloth [m]; −1 = its thickness.
    pub gap: f32,
}

/// A collision shape, and the collider that stands for it.
struct Body {
    node: Gd<CollisionShape3D>,
    id: InstanceId,
    collider: Option<Follower>,
    /// Whether the shape was refused as it is.
    is_refused: bool,
}

/// A collider in the cloth.
struct Follower {
    handle: Collider,
    shape: InstanceId,
    offset: Vec3,
    turn: Quat,
    placement: Placement,
}

impl Colliders {
    /// Forgets all colliders: the cloth is another one.
    pub fn forget(&mut self) {
        *self = Self::default();
    }

    /// Searches the nodes again in the next tick.
    pub fn find_nodes_again(&mut self) {
        self.nodes_are_old = true;
    }

    /// Searches the nodes and converts all shapes again in the next tick.
    pub fn read_again(&mut self) {
        (self.nodes_are_old, self.shapes_are_old) = (true, true);
    }

    /// The colliders of the cloth.
    pub fn handles(&self) -> impl Iterator<Item = Collider> + '_ {
        self.bodies.iter().filter_map(|body| body.collider.as_ref()).map(|c| c.handle)
    }

    /// Brings the colliders of the cloth to their nodes, which `find` searches if that is due. A
    /// shape calls `changed` when it changes.
    ///
    /// # Errors
    /// Names the first node whose shape cannot be simulated, and the rule; all others are followed.
    pub fn follow(
        &mut self,
        cloth: &mut Cloth,
        contact: Contact,
        changed: impl Fn() -> Callable,
        find: impl FnOnce() -> Result<Vec<Gd<CollisionShape3D>>>,
    ) -> Result<()> {
        let mut refused = Ok(());
        if self.contact.as_ref() != Some(&contact) {
            self.read_again();
        }
        if core::mem::replace(&mut self.nodes_are_old, false) {
            match find() {
                Ok(nodes) => self.keep(nodes, cloth, &changed()),
                Err(refusal) => refused = Err(refusal),
            }
        }
        let shapes_are_old = core::mem::replace(&mut self.shapes_are_old, false);
        for body in &mut self.bodies {
            if shapes_are_old {
                body.remove(cloth);
                body.is_refused = false;
            }
            if let Err(refusal) = body.follow(cloth, &contact) {
                refused = refused.and(Err(refusal));
            }
        }
        self.contact = Some(contact);
        refused
    }

    /// Keeps the bodies of `nodes`, removes the others and adds new ones, in the order of `nodes`.
    fn keep(&mut self, nodes: Vec<Gd<CollisionShape3D>>, cloth: &mut Cloth, changed: &Callable) {
        let mut old: Vec<_> = self.bodies.drain(..).map(Some).collect();
        let places = old.iter().flatten().enumerate().map(|(at, body)| (body.id, at));
        let places: HashMap<_, _> = places.collect();
        for node in nodes {
            let id = node.instance_id();
            let kept = places.get(&id).and_then(|at| old[*at].take());
            let new = Body { node, id, collider: None, is_refused: false };
            self.bodies.push(kept.unwrap_or(new));
        }
        old.iter_mut().flatten().for_each(|body| body.remove(cloth));
        for mut shape in self.bodies.iter().filter_map(|body| body.node.get_shape()) {
            if !shape.is_connected("changed", changed) {
                shape.connect_flags("changed", changed, ConnectFlags::DEFERRED);
            }
        }
    }
}

impl Body {
    fn remove(&mut self, cloth: &mut Cloth) {
        if let Some(collider) = self.collider.take() {
            cloth.remove_collider(collider.handle).ok();
        }
    }

    /// Adds, moves or removes the collider.
    fn follow(&mut self, cloth: &mut Cloth, contact: &Contact) -> Result<()> {
        let is_there = self.node.is_instance_valid() && self.node.is_inside_tree();
        let shape = if is_there && !self.node.is_disabled() { self.node.get_shape() } else { None };
        let Some(shape) = shape else {
            self.remove(cloth);
            return Ok(());
        };
        let name = |refusal: Refusal, node: &Gd<CollisionShape3D>| {
            refusal.of(&format!("collider {}", node.get_path()))
        };
        let must = "`transform` must be finite, with a scale that is not 0";
        let placement = Placement::new(self.node.get_global_transform())
            .ok_or_else(|| name(Refusal::new(must), &self.node))?;
        if let Some(collider) = &mut self.collider {
            let is_same = collider.shape == shape.instance_id();
            if is_same && collider.placement == placement {
                return Ok(());
            }
            if is_same && collider.placement.has_shape_of(&placement) {
                let (position, rotation) =
                    PlacedShape::pose(collider.offset, collider.turn, &placement);
                collider.placement = placement;
                let moved = cloth.move_collider(collider.handle, position, rotation);
                return moved.map_err(|error| name(Refusal::new(error.to_string()), &self.node));
            }
            self.remove(cloth);
            self.is_refused = false;
        }
        if self.is_refused {
            return Ok(());
        }
        let added = add(cloth, &self.node, &shape, placement, contact);
        self.is_refused = added.is_err();
        self.collider = Some(added.map_err(|refusal| name(refusal, &self.node))?);
        Ok(())
    }
}

fn add(
    cloth: &mut Cloth,
    node: &Gd<CollisionShape3D>,
    shape: &Gd<godot::classes::Shape3D>,
    placement: Placement,
    contact: &Contact,
) -> Result<Follower> {
    let PlacedShape { mut desc, offset, turn } = PlacedShape::new(shape, &placement)?;
    (desc.position, desc.rotation) = PlacedShape::pose(offset, turn, &placement);
    desc.friction = friction(node).unwrap_or(contact.friction);
    desc.thickness = contact.gap;
    let handle = cloth.add_collider(&desc).map_err(|error| {
        let sentence = error.to_string();
        let sentence = sentence.replacen("`collider.friction", "`collider_friction", 1);
        let sentence = sentence.replacen("`collider.thickness", "`collider_gap", 1);
        Refusal::new(sentence.replacen("`collider.", "`shape.", 1))
    })?;
    Ok(Follower { handle, shape: shape.instance_id(), offset, turn, placement })
}

/// Returns the friction of the physics material of the body that the shape belongs to.
fn friction(node: &Gd<CollisionShape3D>) -> Option<f32> {
    let body = node.get_parent()?.try_cast::<PhysicsBody3D>().ok()?;
    let material = match body.try_cast::<StaticBody3D>() {
        Ok(body) => body.get_physics_material_override(),
        Err(body) => body.try_cast::<RigidBody3D>().ok()?.get_physics_material_override(),
    };
    material.map(|material| material.get_friction())
}
