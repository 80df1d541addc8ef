//! Refusals: sentences that name a property of the node and the rule that it broke.
//!
//! Reads errors of the library and writes their field names as names of properties.

use std::fmt;

/// Why the node refused a value. Whatever was refused changed nothing.
#[derive(Clone, Debug, PartialEq)]
pub struct Refusal(String);

/// The result of what can be refused.
pub type Result<T> = core::result::Result<T, Refusal>;

/// Fields of the library's descriptors, and the properties that they come from.
const PROPERTIES: [(&str, &str); 8] = [
    ("`settings.", "`"),
    ("`material.", "`"),
    ("`wind.", "`wind_"),
    ("`pinned`", "`pin_vertices`"),
    ("`positions`", "`mesh`"),
    ("`positions[", "`mesh.vertices["),
    ("`indices`", "`mesh`"),
    ("`uvs`", "`mesh`"),
];

impl Refusal {
    /// Makes a refusal of a whole sentence.
    pub fn new(sentence: impl Into<String>) -> Self {
        Self(sentence.into())
    }

    /// Translates an error about the mesh or the parameters of the node.
    pub fn from_node(error: &muslin::Error) -> Self {
        let sentence = error.to_string();
        let found = PROPERTIES.iter().find(|(field, _)| sentence.starts_with(field));
        Self(match found {
            Some((field, property)) => sentence.replacen(field, property, 1),
            None => sentence,
        })
    }

    /// Adds what the refusal is about in front.
    pub fn of(self, subject: &str) -> Self {
        Self(format!("{subject}: {}", self.0))
    }
}

impl fmt::Display for Refusal {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.0)
    }
}

/// Refuses `property` with `must` unless `ok`.
pub fn check(ok: bool, property: &str, must: &str) -> Result<()> {
    if ok { Ok(()) } else { Err(Refusal::new(format!("`{property}` must {must}"))) }
}

#[cfg(test)]
mod tests {
    use super::*;
    use muslin::Error;

    #[test]
    fn fields_of_the_library_become_properties_of_the_node() {
        let sentence =
            |field| Refusal::from_node(&Error::BadValue { field, must: "be finite" }).to_string();
        assert_eq!(sentence("settings.gravity"), "`gravity` must be finite");
        assert_eq!(sentence("material.density"), "`density` must be finite");
        assert_eq!(sentence("wind.velocity"), "`wind_velocity` must be finite");
        assert_eq!(sentence("extra_particles"), "`extra_particles` must be finite");
        let pinned = Error::BadIndex { field: "pinned", index: 9, count: 4 };
        assert_eq!(
            Refusal::from_node(&pinned).to_string(),
            "`pin_vertices` must be below 4, but is 9"
        );
    }
}
