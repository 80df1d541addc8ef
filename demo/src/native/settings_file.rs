//! The settings file in the user's configuration folder.

use std::path::{Path, PathBuf};

use crate::settings::Settings;

/// Where the settings are saved_settings; `None` if the user has no such folder.
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

/// The settings of an earlier run, or the usual ones if there are none or they are corrupt.
pub fn read() -> Settings {
    path().map_or_else(Settings::default, |path| read_from(&path))
}

/// Keeps the settings for the next run; says so in one line if it cannot.
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
    fn what_is_kept_is_read_again_and_a_corrupt_file_gives_the_usual_settings() {
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
