//! Properties of the node that are one of a few values. Godot shows their names.

use godot::prelude::{Export, GodotConvert, Var};

/// Which vertices are pinned from the start.
#[derive(GodotConvert, Var, Export, Clone, Copy, Debug, Default, PartialEq)]
#[godot(via = i64)]
pub enum PinMode {
    None = 0,
    #[default]
    TopEdge = 1,
    TopCorners = 2,
    Corners = 3,
    LeftEdge = 4,
    VertexColor = 5,
    Vertices = 6,
}

/// Fabric that gives the values of the material.
#[derive(GodotConvert, Var, Export, Clone, Copy, Debug, Default, PartialEq)]
#[godot(via = i64)]
pub enum FabricPreset {
    Silk = 0,
    #[default]
    Cotton = 1,
    Denim = 2,
    Leather = 3,
    Paper = 4,
    FlagNylon = 5,
}

/// How the cloth collides with itself.
#[derive(GodotConvert, Var, Export, Clone, Copy, Debug, Default, PartialEq)]
#[godot(via = i64)]
pub enum SelfCollisionMode {
    #[default]
    None = 0,
    Surface = 1,
    Particles = 2,
}

/// How the wind acts on the cloth.
#[derive(GodotConvert, Var, Export, Clone, Copy, Debug, Default, PartialEq)]
#[godot(via = i64)]
pub enum WindMode {
    #[default]
    Surface = 0,
    SineField = 1,
}

/// Value of a property of the material that means "that of the preset".
pub const OF_PRESET: f32 = -1.0;
