//! Builds the demo as a page into `dist/web`, and tests it in a browser.

use std::io::Write;
use std::path::PathBuf;

use flate2::Compression;
use flate2::write::GzEncoder;

use crate::browser::ServerProcess;
use crate::failure::{During, Failure, Result};
use crate::{browser, files, picture, serve, share, wasm};

/// The folder that the page is built in.
pub fn dir() -> PathBuf {
    files::root().join("dist/web")
}

/// `cargo xtask web`: builds the page, with `--url` for the address that it will be served at.
pub fn run(options: &[String]) -> Result {
    let typed: Vec<_> = options.iter().flat_map(|option| option.splitn(2, '=')).collect();
    match typed[..] {
        [] => build(),
        ["--url", url] if url.starts_with("http") && url.ends_with('/') => {
            build()?;
            write_address(url)?;
            compress()
        }
        _ => Err(Failure::new(
            "`cargo xtask web` takes only --url, such as https://example.org/cloth/ with the slash",
        )),
    }
}

/// Writes whole addresses of pictures into the pages: previews of links need them.
fn write_address(url: &str) -> Result {
    for page in files::with_suffix(&dir(), ".html")? {
        files::write(&page, &with_address(&files::read(&page)?, url))?;
    }
    Ok(())
}

fn with_address(page: &str, url: &str) -> String {
    page.replace("content=\"./", &format!("content=\"{url}"))
}

/// Builds the page into `dist/web`.
pub fn build() -> Result {
    files::create_empty_dir(&dir())?;
    files::copy_dir(&files::root().join("demo/web"), &dir())?;
    share::write_pages(&dir())?;
    // The wasm module holds the receipt's font, whose licence must come with it.
    let licence = files::read(&files::root().join("demo/fonts/OFL.txt"))?;
    files::write(&dir().join("OFL.txt"), &licence)?;
    wasm::build("muslin-demo", &dir(), "muslin_demo")?;
    compress()?;
    println!("the page is in dist/web; it needs a server, such as `cargo xtask demo --web`");
    Ok(())
}

/// Writes a gzip file beside each text and module of the page, for servers that send those.
fn compress() -> Result {
    for suffix in [".html", ".css", ".js", ".wasm"] {
        for file in files::with_suffix(&dir(), suffix)? {
            let why = || format!("compressing {}", file.display());
            let bytes = std::fs::read(&file).during(why)?;
            let mut gzip = GzEncoder::new(Vec::new(), Compression::best());
            gzip.write_all(&bytes).during(why)?;
            let packed = gzip.finish().during(why)?;
            std::fs::write(serve::gzip_of(&file), packed).during(why)?;
        }
    }
    Ok(())
}

/// Serves the page with `cargo xtask demo --web` and tests it in a browser.
pub fn test() -> Result {
    let server = ServerProcess::start(&["demo", "--web", "--no-open", "--port", "0"])?;
    let shots = files::target().join("shots");
    files::create_dir(&shots)?;
    let pictures = [
        "web-1280x720.png",
        "web-390x844.png",
        "web-photo.png",
        "tender-1280x720.png",
        "tender-390x844.png",
    ];
    let pictures = pictures.map(|name| shots.join(name));
    for stale in pictures.iter().filter(|picture| picture.exists()) {
        std::fs::remove_file(stale).ok();
    }
    browser::node_test("tests/web/demo.test.mjs", &server.url, &[("MUSLIN_SHOTS", &shots)])?;
    pictures.iter().try_for_each(|picture| picture::check(picture))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_page_names_the_whole_address_of_its_picture() {
        for (page, picture) in [("index.html", "share-sheet.jpg"), ("tender.html", "tender.png")] {
            let dir = files::root().join("demo/web");
            let file = dir.join(picture);
            let size = std::fs::metadata(&file).map_or(0, |file| file.len());
            assert!((1..150_000).contains(&size), "{picture} has {size} bytes");
            let text =
                with_address(&files::read(&dir.join(page)).unwrap(), "https://example.org/a/");
            for name in ["property=\"og:image\"", "name=\"twitter:image\""] {
                let tag = format!("<meta {name} content=\"https://example.org/a/{picture}\" />");
                assert!(text.contains(&tag), "{page} has no {tag}");
            }
        }
    }

    #[test]
    fn an_address_without_a_final_slash_is_refused() {
        for options in [&["--url"][..], &["--url", "https://example.org/a"], &["--at"]] {
            let options: Vec<_> = options.iter().map(|option| String::from(*option)).collect();
            assert!(run(&options).is_err_and(|failure| failure.to_string().contains("--url")));
        }
    }
}
