//! Pages of the demo that open one scene each, with the picture and the text of previews of links.

use std::path::Path;

use jpeg_encoder::{ColorType, Encoder};

use crate::failure::{During, Failure, Result};
use crate::{files, picture};

/// A scene that has a page of its own.
struct Shared {
    /// Name in the demo, and of the page.
    scene: &'static str,
    title: &'static str,
    about: &'static str,
    /// What the picture shows.
    alt: &'static str,
    /// Options of the demo that draw the picture, after scene and size.
    options: &'static str,
}

const SHARED: [Shared; 8] = [
    Shared {
        scene: "flag",
        title: "Muslin: a flag in the wind",
        about: "A nylon flag to pull, cut and tear: cloth that is simulated in the browser.",
        alt: "A striped flag that waves on its pole on a dark stage",
        options: "--fabric 3 --frames 240 --zoom 0.85",
    },
    Shared {
        scene: "ball",
        title: "Muslin: a sheet on a ball",
        about: "A sheet falls on a ball and drapes: cloth that is simulated in the browser.",
        alt: "A sheet of cotton that hangs in folds over a ball on a dark stage",
        options: "--fabric 1 --frames 240 --zoom 0.85",
    },
    Shared {
        scene: "discs",
        title: "Muslin: silk, cotton and denim",
        about: "Discs of three fabrics, each with its own drape, simulated in the browser.",
        alt: "Discs of silk, cotton and denim that drape over three pedestals",
        options: "--frames 300 --zoom 0.9",
    },
    Shared {
        scene: "curtain",
        title: "Muslin: a curtain and a ball",
        about: "A ball rolls through a silk curtain: cloth that is simulated in the browser.",
        alt: "A curtain of blue silk that hangs in folds from brass rings",
        options: "--fabric 0 --frames 200 --zoom 0.9",
    },
    Shared {
        scene: "figure",
        title: "Muslin: a dressed figure",
        about: "A mannequin walks and kicks in a skirt and a shirt, simulated in the browser.",
        alt: "A mannequin in a striped shirt and a red skirt that kicks",
        options: "--fabric 1 --frames 150 --zoom 0.8",
    },
    Shared {
        scene: "glass",
        title: "Muslin: silk on balls of glass",
        about: "A sheet of silk falls on balls of glass: cloth that is simulated in the browser.",
        alt: "A sheet of blue silk over two large balls of glass, and smaller ones beside it",
        options: "--fabric 0 --frames 240 --zoom 0.85",
    },
    Shared {
        scene: "doorway",
        title: "Muslin: a curtain to walk through",
        about: "Move the mouse to walk through the curtain: cloth that is simulated in the browser.",
        alt: "A wooden figure that parts a curtain of cotton on a rod",
        options: "--fabric 1 --frames 170 --zoom 0.85",
    },
    Shared {
        scene: "storm",
        title: "Muslin: a torn flag in a storm",
        about: "A torn flag whips in the rain: cloth that is simulated in the browser.",
        alt: "A torn flag on its pole in slanting rain",
        options: "--fabric 3 --frames 140 --zoom 0.85",
    },
];

/// Quality of the pictures, 1 to 100.
const QUALITY: u8 = 86;

/// The scene of the first page, and the options of the demo that draw its picture.
const FIRST: (&str, &str) = ("sheet", "--fabric 0 --frames 20");

/// Returns each scene and the options of the demo that draw its picture.
pub fn shots() -> impl Iterator<Item = (&'static str, Vec<&'static str>)> {
    let others = SHARED.iter().map(|shared| (shared.scene, shared.options));
    std::iter::once(FIRST).chain(others).map(|(scene, options)| {
        let first = ["--scene", scene, "--size", "1200x630"];
        (scene, first.into_iter().chain(options.split(' ')).collect())
    })
}

/// Saves the PNG of a scene as the picture of its page, in `demo/web`.
pub fn save_picture(scene: &str, png: &Path) -> Result {
    let ([width, height], rgb) = picture::read(png)?;
    let jpeg = files::root().join("demo/web").join(picture_name(scene));
    let why = || format!("writing {}", jpeg.display());
    let encoder = Encoder::new_file(&jpeg, QUALITY).during(why)?;
    let size = [width, height].map(|side| side as u16);
    encoder.encode(rgb.as_flattened(), size[0], size[1], ColorType::Rgb).during(why)
}

/// Writes the page of each scene beside the first page, from which it differs in its head only.
pub fn write_pages(dir: &Path) -> Result {
    let first = files::read(&dir.join("index.html"))?;
    for shared in SHARED {
        files::write(&dir.join(format!("{}.html", shared.scene)), &page(&first, &shared)?)?;
    }
    Ok(())
}

fn picture_name(scene: &str) -> String {
    format!("share-{scene}.jpg")
}

/// The page of a scene.
fn page(first: &str, shared: &Shared) -> Result<String> {
    let mut page = String::from(first);
    let mut replace = |old: &str, new: &str| {
        if !page.contains(old) {
            return Err(Failure::new(format!("demo/web/index.html has no {old:?}")));
        }
        page = page.replace(old, new);
        Ok(())
    };
    let picture = picture_name(shared.scene);
    replace("<html ", &format!("<html data-scene=\"{}\" ", shared.scene))?;
    replace("Muslin: a hanging sheet", shared.title)?;
    for old in [
        "A hanging sheet to pull, blow at and tear: the demo of Muslin, a cloth component.",
        "Pull it, blow at it, cut it and tear it: cloth that is simulated in the browser.",
    ] {
        replace(old, shared.about)?;
    }
    replace("A sheet of blue silk that hangs in the wind on a dark stage", shared.alt)?;
    replace(&format!("./{}", picture_name(FIRST.0)), &format!("./{picture}"))?;
    Ok(page)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_scene_has_a_page_with_its_own_text_and_a_small_picture() {
        let web = files::root().join("demo/web");
        let first = files::read(&web.join("index.html")).unwrap();
        for shared in SHARED {
            let page = page(&first, &shared).unwrap();
            assert!(page.contains(&format!("<title>{}</title>", shared.title)));
            assert!(!page.contains("share-sheet") && !page.contains("hanging sheet to"), "{page}");
            assert!(shared.about.len() > 40 && shared.alt.len() > 20);
        }
        for (scene, _) in shots() {
            let bytes = std::fs::read(web.join(picture_name(scene))).unwrap();
            assert!(bytes.starts_with(&[0xff, 0xd8, 0xff]), "{scene} is no JPEG");
            assert!(bytes.len() < 120_000, "{scene} has {} bytes", bytes.len());
        }
    }

    #[test]
    fn the_demo_has_the_scenes() {
        let text = files::read(&files::root().join("demo/src/scene_kind.rs")).unwrap();
        let names = text.split_once("NAMES: ").unwrap().1.split_once("];").unwrap().0;
        let count = names.matches('"').count() / 2;
        assert_eq!(SHARED.len() + 1, count, "a scene has no page");
        for Shared { scene, .. } in SHARED {
            assert!(names.to_lowercase().contains(&format!("\"{scene}\"")), "{scene}");
        }
    }

    #[test]
    fn a_first_page_with_another_text_is_refused() {
        let failure = page("<html lang>", &SHARED[0]).unwrap_err().to_string();
        assert!(failure.contains("index.html has no"), "{failure}");
    }
}
