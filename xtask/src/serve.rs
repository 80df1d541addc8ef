//! A server for pages on this machine.

use std::fs::File;
use std::path::{Component, Path, PathBuf};

use tiny_http::{Header, Method, Request, Response};

use crate::failure::{During, Failure, Result};

/// What the page may do: run its own scripts and wasm, style itself, draw inline pictures.
const POLICY: &str = "default-src 'self'; script-src 'self' 'wasm-unsafe-eval'; \
    style-src 'self' 'unsafe-inline'; img-src 'self' data:; connect-src 'self'";

/// The port that people know.
const USUAL: u16 = 8080;

/// A folder and where it appears.
pub struct Mount {
    /// The start of its addresses, from slash to slash.
    pub at: &'static str,
    /// The folder.
    pub dir: PathBuf,
}

/// A server that listens, on 127.0.0.1 only.
pub struct Server {
    http: tiny_http::Server,
    mounts: Vec<Mount>,
}

impl Server {
    /// Listens on `port`, or on one that is free if it is 0. The first mount that fits an address
    /// answers for it.
    pub fn open(mounts: Vec<Mount>, port: u16) -> Result<Self> {
        let http = tiny_http::Server::http(("127.0.0.1", port)).map_err(|error| {
            Failure::new(format!("cannot listen on port {port} ({error}); --port N takes another"))
        })?;
        Ok(Self { http, mounts })
    }

    /// Listens on the usual port, or if it is taken on a free one.
    pub fn open_anywhere(dir: &Path) -> Result<Self> {
        let mounts = || vec![Mount { at: "/", dir: dir.to_path_buf() }];
        Self::open(mounts(), USUAL).or_else(|_| Self::open(mounts(), 0))
    }

    /// Where it listens.
    pub fn url(&self) -> String {
        format!("http://{}/", self.http.server_addr())
    }

    /// Answers until the program ends.
    pub fn run(self) {
        for request in self.http.incoming_requests() {
            // A browser that has gone away needs no answer.
            answer(&self.mounts, request).ok();
        }
    }

    /// The same on a thread of its own; returns the address.
    pub fn run_aside(self) -> String {
        let url = self.url();
        std::thread::spawn(|| self.run());
        url
    }
}

fn answer(mounts: &[Mount], request: Request) -> Result {
    let told = || String::from("answering");
    if !matches!(request.method(), Method::Get | Method::Head) {
        return request.respond(Response::empty(405)).during(told);
    }
    let Some(path) = file(mounts, request.url()) else {
        return request
            .respond(Response::from_string("not here\n").with_status_code(404))
            .during(told);
    };
    let mut response = Response::from_file(File::open(&path).during(told)?);
    for (name, value) in [
        ("Content-Type", content_type(&path)),
        ("Content-Security-Policy", POLICY),
        ("X-Content-Type-Options", "nosniff"),
        ("Cache-Control", "no-store"),
    ] {
        let header = Header::from_bytes(name, value)
            .map_err(|()| Failure::new(format!("{name} cannot be {value:?}")))?;
        response.add_header(header);
    }
    request.respond(response).during(told)
}

/// The file that an address means, if there is one.
fn file(mounts: &[Mount], url: &str) -> Option<PathBuf> {
    let path = url.split(['?', '#']).next()?;
    let mount = mounts.iter().find(|mount| path.starts_with(mount.at))?;
    let inner = Path::new(&path[mount.at.len()..]);
    if !inner.components().all(|part| matches!(part, Component::Normal(_))) {
        return None;
    }
    let file = mount.dir.join(inner);
    let file = if file.is_dir() { file.join("index.html") } else { file };
    file.is_file().then_some(file)
}

fn content_type(path: &Path) -> &'static str {
    match path.extension().and_then(|end| end.to_str()) {
        Some("html") => "text/html; charset=utf-8",
        Some("js" | "mjs") => "text/javascript; charset=utf-8",
        Some("css") => "text/css; charset=utf-8",
        Some("wasm") => "application/wasm",
        Some("json" | "map") => "application/json",
        Some("svg") => "image/svg+xml",
        Some("png") => "image/png",
        Some("ts" | "md" | "txt" | "hash") => "text/plain; charset=utf-8",
        _ => "application/octet-stream",
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::files;

    fn mounts() -> Vec<Mount> {
        let dir = files::root().join("xtask");
        vec![Mount { at: "/code/", dir: dir.join("src") }, Mount { at: "/", dir }]
    }

    #[test]
    fn the_first_mount_that_fits_answers() {
        assert_eq!(file(&mounts(), "/code/main.rs?x=1"), Some(mounts()[0].dir.join("main.rs")));
        assert_eq!(file(&mounts(), "/Cargo.toml"), Some(mounts()[1].dir.join("Cargo.toml")));
        assert_eq!(file(&mounts(), "/code/absent.rs"), None);
    }

    #[test]
    fn nothing_outside_a_mount_is_served() {
        for url in
            ["/../Cargo.toml", "/code/../Cargo.toml", "//etc/passwd", "/%2e%2e/Cargo.toml", ""]
        {
            assert_eq!(file(&mounts(), url), None, "{url}");
        }
    }
}
