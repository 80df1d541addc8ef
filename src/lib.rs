#![doc = include_str!("../README.md")]

mod arena;
mod cloth;
mod error;
mod fabric;
mod geom;
mod math;
mod mesh;
mod solver;
mod state;

pub use cloth::Cloth;
pub use cloth::changes::Changes;
pub use cloth::desc::{AS_MANY_AGAIN, GridDesc, MeshDesc, PinMode};
pub use cloth::query::Hit;
pub use cloth::stream::{ALL_VERTICES, Attribute, MAX_STREAMS, Stream, VertexFormat, WriteDesc};
pub use cloth::view::{Stats, View};
pub use cloth::write::IndexFormat;
pub use error::{Error, Result};
pub use fabric::links::LinkKind;
pub use fabric::material::{Material, Preset};
pub use glam;
pub use mesh::report::MeshReport;
pub use solver::profile::Clock;
pub use solver::stage::Stage;
pub use state::attachments::Attachment;
pub use state::collider_desc::{ColliderDesc, Shape};
pub use state::colliders::{Collider, Impulse};
pub use state::events::{Event, EventKind};
pub use state::grabs::Grab;
pub use state::settings::{SelfCollision, Settings};
pub use state::wind::{Wind, WindModel};
