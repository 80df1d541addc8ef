//! The life of the node: making the cloth, ticks, frames, signals.
//!
//! ```text
//! ready ─▶ rebuild: source, parameters
//! each physics tick: parameters ─▶ pose of the node ─▶ colliders ─▶ advance ─▶ signals
//! each drawn frame: surface
//! ```
//! Uses Godot's internal processing, so that a script on the node may have `_process` and
//! `_physics_process` of its own.
//! Invariant: signals are emitted when the cloth is in its place, so that handlers may call all
//! methods of the node.

use crate::convert::{Placement, to_affine, to_godot};
use crate::node::MuslinCloth3D;
use crate::parameters::Parameters;
use crate::preview::Preview;
use crate::refusal::{Refusal, Result, check};
use crate::source::{GridSize, Source};
use godot::classes::node::PhysicsInterpolationMode;
use godot::classes::object::ConnectFlags;
use godot::classes::{Engine, Material};
use godot::obj::{Gd, Singleton, WithBaseField, WithUserSignals};
use muslin::{Cloth, EventKind, MeshDesc};

impl MuslinCloth3D {
    /// Prints a refusal, and keeps it for the warning in the editor and for scripts.
    pub(crate) fn report(&mut self, call: &str, refusal: &Refusal) {
        self.last_error = refusal.to_string();
        let path = if self.base().is_inside_tree() {
            self.base().get_path().to_string()
        } else {
            self.base().get_name().to_string()
        };
        if !is_editor() {
            godot::global::godot_error!("MuslinCloth3D {path}, {call}: {refusal}");
        }
    }

    /// Makes the cloth when the node is ready.
    pub(crate) fn start(&mut self) {
        self.base_mut().set_process_internal(true);
        if is_editor() {
            return;
        }
        let tree = self.base().get_tree();
        let this = self.to_gd();
        tree.signals().tree_changed().connect_other(&this, |node: &mut Self| {
            node.colliders.find_nodes_again();
        });
        let mut base = self.base_mut();
        base.set_physics_process_internal(true);
        // The cloth itself is interpolated between ticks, from the poses of ticks.
        base.set_physics_interpolation_mode(PhysicsInterpolationMode::OFF);
        drop(base);
        self.rebuild();
    }

    /// Advances the cloth by the time of a physics tick.
    pub(crate) fn tick(&mut self) {
        let Some(mut cloth) = self.cloth.take() else { return };
        let advanced = self.advance(&mut cloth);
        let mut events = Vec::new();
        while let Some(event) = cloth.next_event() {
            events.push(event);
        }
        self.cloth = Some(cloth);
        match advanced {
            Ok(()) => self.tick_error.clear(),
            Err(refusal) => self.report_once(&refusal),
        }
        for event in events {
            let at = to_godot(event.position);
            let (a, b) = (i64::from(event.particle_a), i64::from(event.particle_b));
            match event.kind {
                EventKind::EdgeTorn => self.signals().torn().emit(at, a, b),
                EventKind::PieceDetached => {
                    self.signals().piece_detached().emit(at, i64::from(event.count));
                }
                _ => {}
            }
        }
    }

    fn advance(&mut self, cloth: &mut Cloth) -> Result<()> {
        let parameters = self.parameters();
        let refused = parameters.apply(cloth, self.applied.as_ref()).err();
        self.applied = Some(parameters);
        let placement = self.placement()?;
        let inertia = self.inertia;
        check((0.0..=1.0).contains(&inertia), "inertia", "be from 0 to 1")?;
        let from_node = |error: muslin::Error| Refusal::from_node(&error);
        cloth.move_frame(placement.position, placement.rotation, inertia).map_err(from_node)?;
        let refused = refused.or(self.follow_colliders(cloth).err());
        let seconds = self.base().get_physics_process_delta_time();
        cloth.advance(seconds as f32).map_err(from_node)?;
        refused.map_or(Ok(()), Err)
    }

    /// Reports a refusal unless it is the one that was reported last.
    fn report_once(&mut self, refusal: &Refusal) {
        if self.tick_error != refusal.to_string() {
            self.report("physics tick", refusal);
            self.tick_error = refusal.to_string();
        }
    }

    /// Draws the cloth: in a game between its last two ticks, in the editor at rest.
    pub(crate) fn frame(&mut self) {
        if is_editor() {
            let preview = self.preview();
            if self.preview.as_ref() != Some(&preview) {
                self.preview = Some(preview);
                self.watch_meshes();
                if !self.rebuild() {
                    self.cloth = None;
                    self.surface.clear();
                }
            }
            return;
        }
        let is_smooth = self.base().get_tree().is_physics_interpolation_enabled();
        let blend = match &self.cloth {
            Some(cloth) if is_smooth => {
                let fraction = Engine::singleton().get_physics_interpolation_fraction();
                (cloth.blend() + fraction as f32).min(1.0)
            }
            _ => 1.0,
        };
        self.draw(blend);
    }

    /// Writes the cloth to the mesh that Godot draws.
    pub(crate) fn draw(&mut self, blend: f32) {
        let transform = self.base().get_global_transform();
        let is_visible = self.base().is_visible_in_tree();
        let Some(cloth) = &mut self.cloth else { return };
        if Placement::new(transform).is_none() || !is_visible {
            return;
        }
        let from_world = to_affine(transform.affine_inverse());
        let is_new = self.surface.update(cloth, from_world, blend, self.tangents);
        if is_new {
            let material = self.source_material();
            self.surface.set_material(material);
            let mesh = self.surface.rid();
            self.base_mut().set_base(mesh);
        }
    }

    /// Returns the material of the mesh that the cloth is made from.
    fn source_material(&self) -> Option<Gd<Material>> {
        if let Some(mesh) = &self.mesh {
            return mesh.surface_get_material(0);
        }
        self.mesh_source.as_ref().and_then(|node| node.get_active_material(0))
    }

    pub(crate) fn hide_source(&mut self) {
        if self.mesh.is_none()
            && let Some(node) = &mut self.mesh_source
            && !is_editor()
        {
            node.set_visible(false);
        }
    }

    /// Returns the pose of the node that pins follow.
    pub(crate) fn placement(&self) -> Result<Placement> {
        let must = "be finite, with a scale that is not 0";
        Placement::new(self.base().get_global_transform())
            .ok_or_else(|| Refusal::new(format!("`transform` must {must}")))
    }

    /// Makes the cloth of the properties at the place of the node.
    pub(crate) fn make(&self) -> Result<(Cloth, Parameters, Placement)> {
        let mut transform = self.base().get_global_transform();
        let source = if let Some(mesh) = &self.mesh {
            Source::mesh(mesh, self.pin_mode, &self.pin_vertices)?
        } else if let Some(node) = &self.mesh_source {
            let mesh = node.get_mesh();
            let must = "be a node with a mesh";
            let mesh = mesh.ok_or_else(|| Refusal::new(format!("`mesh_source` must {must}")))?;
            transform = node.get_global_transform();
            Source::mesh(&mesh, self.pin_mode, &self.pin_vertices)?
        } else {
            Source::grid(self.grid_size(), self.pin_mode, &self.pin_vertices)?
        };
        let placement = self.placement()?;
        let to_world = to_affine(transform);
        let extra_particles = match self.extra_particles {
            -1 => muslin::AS_MANY_AGAIN,
            extra => u32::try_from(extra)
                .map_err(|_| Refusal::new("`extra_particles` must be at least -1"))?,
        };
        let parameters = self.parameters();
        let positions = source.positions.iter().map(|x| to_world.transform_point3(*x)).collect();
        let desc = MeshDesc {
            positions,
            indices: source.indices,
            uvs: source.uvs,
            pinned: source.pinned,
            weld_distance: self.weld_distance,
            simplify_below: self.simplify_below,
            extra_particles,
            material: parameters.material.clone(),
            settings: parameters.settings.clone(),
        };
        let from_node = |error: muslin::Error| Refusal::from_node(&error);
        let mut cloth = Cloth::mesh(&desc).map_err(from_node)?;
        cloth.set_wind(parameters.wind.clone()).map_err(from_node)?;
        cloth.set_frame(placement.position, placement.rotation).map_err(from_node)?;
        Ok((cloth, parameters, placement))
    }

    fn grid_size(&self) -> GridSize {
        let Self { columns, rows, width, height, .. } = *self;
        GridSize { columns, rows, width, height }
    }

    /// Draws the cloth anew in the editor when its mesh changes.
    fn watch_meshes(&mut self) {
        let source = self.mesh_source.as_ref().and_then(|node| node.get_mesh());
        let changed = self.to_gd().callable("rebuild");
        for mut mesh in self.mesh.clone().into_iter().chain(source) {
            if !mesh.is_connected("changed", &changed) {
                // Later, since reading a mesh may change it.
                mesh.connect_flags("changed", &changed, ConnectFlags::DEFERRED);
            }
        }
    }

    fn preview(&self) -> Preview {
        let source = self.mesh_source.as_ref().and_then(|node| node.get_mesh());
        let meshes = [self.mesh.as_ref(), source.as_ref()];
        Preview {
            grid: self.grid_size(),
            weld_distance: self.weld_distance,
            simplify_below: self.simplify_below,
            extra_particles: self.extra_particles,
            pins: (self.pin_mode, self.pin_vertices.clone()),
            mesh: meshes.map(|mesh| mesh.map(|mesh| mesh.instance_id())),
            parameters: self.parameters(),
        }
    }
}

/// Whether the node is shown in the editor, where cloth stays at rest.
pub(crate) fn is_editor() -> bool {
    Engine::singleton().is_editor_hint()
}
