//! A server for pages on this machine.

use std::io::{BufRead, BufReader, Read, Write};
use std::net::{TcpListener, TcpStream};
use std::path::{Component, Path, PathBuf};
use std::time::Duration;

use crate::failure::{Failure, Result};

/// What the page may do: run its own scripts and wasm, style itself, draw inline pictures.
const POLICY: &str = "default-src 'self'; script-src 'self' 'wasm-unsafe-eval'; \
    style-src 'self' 'unsafe-inline'; img-src 'self' data:; connect-src 'self'";

/// How long a connection may take to ask.
const PATIENCE: Duration = Duration::from_secs(10);

/// Bytes that the head of a request may have.
const MOST_HEAD: u64 = 1 << 16;

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
    listener: TcpListener,
    mounts: Vec<Mount>,
    policy: &'static str,
}

impl Server {
    /// Listens on `port`, or on one that is free if it is 0. The first mount that fits an address
    /// answers for it.
    pub fn open(mounts: Vec<Mount>, port: u16) -> Result<Self> {
        let listener = TcpListener::bind(("127.0.0.1", port)).map_err(|error| {
            Failure::new(format!("cannot listen on port {port} ({error}); --port N takes another"))
        })?;
        Ok(Self { listener, mounts, policy: POLICY })
    }

    /// Serves under another content security policy.
    pub fn under(self, policy: &'static str) -> Self {
        Self { policy, ..self }
    }

    /// Listens on the usual port, or if it is taken on a free one.
    pub fn open_anywhere(dir: &Path) -> Result<Self> {
        let mounts = || vec![Mount { at: "/", dir: dir.to_path_buf() }];
        Self::open(mounts(), USUAL).or_else(|_| Self::open(mounts(), 0))
    }

    /// Where it listens.
    pub fn url(&self) -> String {
        let port = self.listener.local_addr().map_or(0, |address| address.port());
        format!("http://127.0.0.1:{port}/")
    }

    /// Answers until the program ends, each connection on a thread of its own.
    pub fn run(&self) {
        std::thread::scope(|scope| {
            for connection in self.listener.incoming().flatten() {
                // A browser that has gone away needs no answer.
                scope.spawn(|| self.answer(connection).ok());
            }
        });
    }

    /// The same on a thread of its own; returns the address.
    pub fn run_aside(self) -> String {
        let url = self.url();
        std::thread::spawn(move || self.run());
        url
    }

    /// Reads one request and answers it; that ends the connection, so none waits for another.
    fn answer(&self, connection: TcpStream) -> std::io::Result<()> {
        connection.set_read_timeout(Some(PATIENCE))?;
        let mut lines = BufReader::new(&connection).take(MOST_HEAD).lines();
        let request = lines.next().transpose()?.unwrap_or_default();
        // The rest of the head says nothing that matters here, but must be read before answering.
        for line in lines {
            if line?.is_empty() {
                break;
            }
        }
        let mut words = request.split_whitespace();
        let (method, url) = (words.next().unwrap_or_default(), words.next().unwrap_or_default());
        let mut out = &connection;
        if !matches!(method, "GET" | "HEAD") {
            return out.write_all(&self.head("405 Method Not Allowed", "text/plain", 0));
        }
        let Some(path) = file(&self.mounts, url) else {
            return out.write_all(&self.head("404 Not Found", "text/plain", 0));
        };
        let body = std::fs::read(&path)?;
        out.write_all(&self.head("200 OK", content_type(&path), body.len()))?;
        if method == "GET" {
            out.write_all(&body)?;
        }
        Ok(())
    }

    fn head(&self, status: &str, content_type: &str, length: usize) -> Vec<u8> {
        let policy = self.policy;
        format!(
            "HTTP/1.1 {status}\r\n\
             Content-Type: {content_type}\r\n\
             Content-Length: {length}\r\n\
             Content-Security-Policy: {policy}\r\n\
             X-Content-Type-Options: nosniff\r\n\
             Cache-Control: no-store\r\n\
             Connection: close\r\n\r\n"
        )
        .into_bytes()
    }
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
    fn connections_that_stay_silent_keep_nobody_waiting() {
        let url = Server::open(mounts(), 0).unwrap().run_aside();
        let address = url.trim_start_matches("http://").trim_end_matches('/');
        let silent: Vec<_> = (0..20).map(|_| TcpStream::connect(address).unwrap()).collect();
        for (request, status) in [
            ("GET /Cargo.toml HTTP/1.1\r\nHost: here\r\n\r\n", "HTTP/1.1 200 OK"),
            ("GET /absent HTTP/1.1\r\n\r\n", "HTTP/1.1 404 Not Found"),
            ("POST / HTTP/1.1\r\n\r\n", "HTTP/1.1 405 Method Not Allowed"),
        ] {
            let mut connection = TcpStream::connect(address).unwrap();
            connection.write_all(request.as_bytes()).unwrap();
            let mut answer = String::new();
            connection.read_to_string(&mut answer).unwrap();
            assert!(answer.starts_with(status), "{answer}");
            assert_eq!(answer.contains("name = \"xtask\""), status.ends_with("OK"));
        }
        drop(silent);
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
