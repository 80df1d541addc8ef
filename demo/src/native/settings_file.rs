//! File of the saved settings in the configuration folder of the user.
//!
//! Method: one JSON file in the folder that the platform defines.
//!
//! Reads and writes `muslin-demo/settings.json`.
//!
//! Invariant: a missing or corrupt file gives the default settings.

use std::path::{Path, PathBuf};

use crate::settings::Settings;

/// Returns the path of the file; `None` if the user has no configuration folder.
pub fn path() -> Option<PathBuf> {
    let folder =
        |name: &str| std::env::var_os(name).map(PathBuf::from).filter(|path| path.is_absolute());
    let base = if cfg!(windows) {
        folder("APPDATA")
    } else if cfg!(target_os = "macos") {
        folder("HOME").map(|home| home.join("Library/Application Support"))
    } else {
        folder("XDG_CONFIG_HOME").or_else(|| folder("HOME").map(|home| home.join(".config")))
    };
    base.map(|base| base.join("muslin-demo").join("settings.json"))
}

/// Reads the settings of the last run; returns the defaults if there are none or they are corrupt.
pub fn read() -> Settings {
    path().map_or_else(Settings::default, |path| read_from(&path))
}

/// Saves the settings for the next run; prints one line if that fails.
pub fn write(json: &str) {
    if let Some(path) = path()
        && let Err(error) = write_to(&path, json)
    {
        eprintln!("settings are not saved: {}: {error}", path.display());
    }
}

fn read_from(path: &Path) -> Settings {
    std::fs::read_to_string(path)
        .ok()
        .and_then(|text| Settings::from_json(&text).ok())
        .unwrap_or_default()
}

fn write_to(path: &Path, json: &str) -> std::io::Result<()> {
    if let Some(folder) = path.parent() {
        std::fs::create_dir_all(folder)?;
    }
    std::fs::write(path, json)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn saved_settings_are_read_again_and_a_corrupt_file_gives_the_defaults() {
        let folder = std::env::temp_dir().join(format!("muslin-store-{}", std::process::id()));
        let path = folder.join("deep").join("settings.json");
        assert_eq!(read_from(&path), Settings::default());
        let settings = Settings { wind: 2.5, ..Settings::default() };
        write_to(&path, &settings.to_json()).unwrap();
        assert_eq!(read_from(&path), settings);
        write_to(&path, "{ wind:").unwrap();
        assert_eq!(read_from(&path), Settings::default());
        std::fs::remove_dir_all(folder).unwrap();
    }
}
