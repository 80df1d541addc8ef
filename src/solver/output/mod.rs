//! Stage `Outputs`: normals, tangents and transformed vertices.

pub(crate) mod normals;
pub(crate) mod tangents;
pub(crate) mod vertex_transform;
