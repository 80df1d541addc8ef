//! Which collision shapes of the scene a cloth collides with.
//!
//! Reads the scene tree and the properties of the node; `colliders` follows what is found.

use crate::colliders::Contact;
use crate::node::MuslinCloth3D;
use crate::refusal::{Refusal, Result};
use godot::builtin::NodePath;
use godot::classes::{CollisionShape3D, Node};
use godot::obj::{Gd, WithBaseField};
use muslin::Cloth;
use std::collections::HashSet;

impl MuslinCloth3D {
    /// Brings the colliders of the cloth to the collision shapes of the scene.
    ///
    /// # Errors
    /// Names the first node whose shape cannot be simulated, and the rule; all others are followed.
    pub(crate) fn follow_colliders(&mut self, cloth: &mut Cloth) -> Result<()> {
        let contact = Contact {
            group: self.collider_group.clone(),
            paths: self.collider_nodes.hash_u32(),
            friction: self.collider_friction,
            gap: self.collider_gap,
        };
        let mut colliders = core::mem::take(&mut self.colliders);
        let changed = || self.to_gd().callable("refresh_colliders");
        let followed = colliders.follow(cloth, contact, changed, || self.collision_shapes());
        self.colliders = colliders;
        followed
    }

    /// Finds the nodes: those of the group, those of the paths, and those below the cloth.
    fn collision_shapes(&self) -> Result<Vec<Gd<CollisionShape3D>>> {
        let this = self.to_gd().upcast::<Node>();
        let mut roots = vec![this.clone()];
        if !self.collider_group.is_empty() {
            roots.extend(this.get_tree().get_nodes_in_group(&self.collider_group).iter_shared());
        }
        for (i, path) in self.collider_nodes.iter_shared().enumerate() {
            roots.push(node_at(&this, &path, i)?);
        }
        let mut found: Vec<Gd<CollisionShape3D>> = Vec::new();
        for root in roots {
            let below = root.find_children_ex("*").type_("CollisionShape3D").owned(false).done();
            let below = below.iter_shared().filter_map(|node| node.try_cast().ok());
            found.extend(root.try_cast().ok().into_iter().chain(below));
        }
        let mut known = HashSet::new();
        found.retain(|node| known.insert(node.instance_id()));
        Ok(found)
    }
}

fn node_at(this: &Gd<Node>, path: &NodePath, i: usize) -> Result<Gd<Node>> {
    let must = format!("`collider_nodes[{i}]` must name a node, but there is none at \"{path}\"");
    this.get_node_or_null(path).ok_or_else(|| Refusal::new(must))
}
