//! Cloth.
