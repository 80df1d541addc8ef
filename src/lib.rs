#![doc = include_str!("../README.md")]

mod arena;
mod cloth;
mod error;
mod geometry;
mod math;
mod mesh;
mod model;
mod solver;
mod state;

pub use crate::cloth::Cloth;
pub use crate::cloth::changes::Changes;
pub use crate::cloth::desc::{AS_MANY_AGAIN, GridDesc, MeshDesc, PinMode};
pub use crate::cloth::query::Hit;
pub use crate::cloth::vertex_stream::{
    ALL_VERTICES, Attribute, MAX_STREAMS, Stream, VertexFormat, WriteDesc,
};
pub use crate::cloth::view::{Stats, View};
pub use crate::cloth::write_vertices::IndexFormat;
pub use crate::error::{Error, Result};
pub use crate::mesh::report::MeshReport;
pub use crate::model::links::LinkKind;
pub use crate::model::material::{Material, Preset};
pub use crate::solver::profile::Clock;
pub use crate::solver::stage::Stage;
pub use crate::state::attachments::Attachment;
pub use crate::state::collider_desc::{ColliderDesc, Shape};
pub use crate::state::colliders::{Collider, Impulse};
pub use crate::state::events::{Event, EventKind};
pub use crate::state::grabs::Grab;
pub use crate::state::settings::{SelfCollision, Settings};
pub use crate::state::wind::{Wind, WindModel};
pub use glam;
