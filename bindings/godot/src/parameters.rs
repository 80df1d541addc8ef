//! Settings, material and wind, and how a cloth takes them.

use crate::refusal::{Refusal, Result};
use muslin::{Cloth, Material, Settings, Wind};

/// Settings, material and wind together.
#[derive(Clone, Debug, PartialEq)]
pub struct Parameters {
    pub settings: Settings,
    pub material: Material,
    pub wind: Wind,
}

impl Parameters {
    /// Gives the cloth those parameters that differ from `applied`.
    ///
    /// # Errors
    /// Names the first property that breaks a rule; the cloth then keeps its parameters.
    pub fn apply(&self, cloth: &mut Cloth, applied: Option<&Self>) -> Result<()> {
        if applied == Some(self) {
            return Ok(());
        }
        let old = (cloth.settings().clone(), cloth.material().clone());
        let set = |cloth: &mut Cloth| {
            cloth.set_settings(self.settings.clone())?;
            cloth.set_material(self.material.clone())?;
            cloth.set_wind(self.wind.clone())
        };
        set(cloth).map_err(|error| {
            // Both were valid before, so they are accepted again.
            cloth.set_settings(old.0).ok();
            cloth.set_material(old.1).ok();
            Refusal::from_node(&error)
        })
    }
}
