//! Scenes of cloth.
