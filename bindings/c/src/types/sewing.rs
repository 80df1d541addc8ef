//! Descriptor of sewing.

use crate::status::{CallError, Result};
use muslin_core::{SewDesc, SewKind};

/// Value of `kind`: as if woven in one piece. It never tears, and normals are smooth across.
pub const MUSLIN_SEW_WELD: u32 = 0;
/// Value of `kind`: a thread. It tears under more than `tear_force`, and keeps the normals of both
/// sides apart.
pub const MUSLIN_SEW_STITCH: u32 = 1;

/// How muslin_cloth_sew joins pairs of particles. Initialise it with muslin_sew_desc_init.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct MuslinSewDesc {
    /// Set by muslin_sew_desc_init.
    pub struct_size: u32,
    /// Speed at which the distance of each pair falls to zero [m/s]. Default 0.5. Above 0.
    pub speed: f32,
    /// What joins the particles: MUSLIN_SEW_WELD (default) or MUSLIN_SEW_STITCH.
    pub kind: u32,
    /// Force on one pair above which a stitch tears [N], as the mean over a tick; 0 = never.
    /// Default 0. At least 0. A weld ignores it.
    pub tear_force: f32,
}

impl Default for MuslinSewDesc {
    fn default() -> Self {
        let SewDesc { speed, kind, tear_force } = SewDesc::default();
        Self { struct_size: size_of::<Self>() as u32, speed, kind: kind as u32, tear_force }
    }
}

impl TryFrom<MuslinSewDesc> for SewDesc {
    type Error = CallError;

    fn try_from(desc: MuslinSewDesc) -> Result<Self> {
        let kind = match desc.kind {
            MUSLIN_SEW_WELD => SewKind::Weld,
            MUSLIN_SEW_STITCH => SewKind::Stitch,
            _ => return Err(CallError::bad_value("kind", "be 0 or 1")),
        };
        Ok(Self { speed: desc.speed, kind, tear_force: desc.tear_force })
    }
}
