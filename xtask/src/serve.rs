//! An HTTP server for pages on this machine.

use std::io::{BufRead, BufReader, Read, Write};
use std::net::{TcpListener, TcpStream};
use std::path::{Component, Path, PathBuf};
use std::time::Duration;

use crate::failure::{Failure, Result};

/// The content security policy: a page may run its own scripts and wasm, use inline styles and
/// inline pictures. The hash is that of the import map of the example `figure`, which cannot be a
/// file of its own.
const POLICY: &str = "default-src 'self'; script-src 'self' 'wasm-unsafe-eval' \
    'sha256-63HB+x6cOSoyjjoUNwGyHweuS+XXQ8XSHH9W7emvUp8='; \
    style-src 'self' 'unsafe-inline'; img-src 'self' data:; connect-src 'self'";

/// How long the server waits for a request.
const REQUEST_TIMEOUT: Duration = Duration::from_secs(10);

/// The most bytes that the server reads of a request.
const MAX_HEAD: u64 = 1 << 16;

/// The port that is tried first.
const DEFAULT_PORT: u16 = 8080;

/// The end of the head of an answer.
const END: &[u8] = b"\r\n";

/// A folder and the addresses that it answers for.
pub struct Mount {
    /// The start of the addresses, from slash to slash.
    pub at: &'static str,
    /// The folder.
    pub dir: PathBuf,
}

/// A server that listens on 127.0.0.1 only.
pub struct Server {
    listener: TcpListener,
    mounts: Vec<Mount>,
    policy: &'static str,
}

impl Server {
    /// Listens on `port`, or on a free one if `port` is 0. The first mount that fits an address
    /// answers for it.
    pub fn open(mounts: Vec<Mount>, port: u16) -> Result<Self> {
        let listener = TcpListener::bind(("127.0.0.1", port)).map_err(|error| {
            Failure::new(format!("cannot listen on port {port} ({error}); --port N takes another"))
        })?;
        Ok(Self { listener, mounts, policy: POLICY })
    }

    /// Sets another content security policy.
    pub fn with_policy(self, policy: &'static str) -> Self {
        Self { policy, ..self }
    }

    /// Listens on the default port, or on a free one if another program has that.
    pub fn open_anywhere(dir: &Path) -> Result<Self> {
        let mounts = || vec![Mount { at: "/", dir: dir.to_path_buf() }];
        Self::open(mounts(), DEFAULT_PORT).or_else(|_| Self::open(mounts(), 0))
    }

    /// The address of the server.
    pub fn url(&self) -> String {
        let port = self.listener.local_addr().map_or(0, |address| address.port());
        format!("http://127.0.0.1:{port}/")
    }

    /// Answers until the process ends, each connection on a thread of its own.
    pub fn run(&self) {
        std::thread::scope(|scope| {
            for connection in self.listener.incoming().flatten() {
                // An error means that the browser has closed the connection.
                scope.spawn(|| self.answer(connection).ok());
            }
        });
    }

    /// Answers on a thread of its own; returns the address.
    pub fn spawn(self) -> String {
        let url = self.url();
        std::thread::spawn(move || self.run());
        url
    }

    /// Reads one request, answers it and closes the connection, so that no connection waits for
    /// another.
    fn answer(&self, connection: TcpStream) -> std::io::Result<()> {
        connection.set_read_timeout(Some(REQUEST_TIMEOUT))?;
        let mut lines = BufReader::new(&connection).take(MAX_HEAD).lines();
        let request = lines.next().transpose()?.unwrap_or_default();
        // The whole head must be read before the answer.
        let mut takes_gzip = false;
        for line in lines {
            let line = line?;
            if line.is_empty() {
                break;
            }
            takes_gzip |= accepts_gzip(&line);
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
        let packed = Some(gzip_of(&path)).filter(|file| takes_gzip && file.is_file());
        let body = std::fs::read(packed.as_ref().unwrap_or(&path))?;
        let mut head = self.head("200 OK", content_type(&path), body.len());
        if packed.is_some() {
            head.truncate(head.len() - END.len());
            head.extend_from_slice(b"Content-Encoding: gzip\r\nVary: Accept-Encoding\r\n");
            head.extend_from_slice(END);
        }
        out.write_all(&head)?;
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

/// The file at an address; none if there is no such file, or if it lies outside its mount.
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

/// The gzip file beside a file, which is sent in its place if there is one.
pub fn gzip_of(path: &Path) -> PathBuf {
    let mut name = path.as_os_str().to_owned();
    name.push(".gz");
    name.into()
}

/// Whether a line of a request says that the browser takes gzip.
fn accepts_gzip(line: &str) -> bool {
    line.split_once(':').is_some_and(|(name, value)| {
        let mut codings = value.split(',').map(str::trim);
        name.eq_ignore_ascii_case("accept-encoding")
            && codings.any(|coding| coding.split(';').next() == Some("gzip"))
    })
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
        Some("jpg") => "image/jpeg",
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
    fn silent_connections_do_not_delay_others() {
        let url = Server::open(mounts(), 0).unwrap().spawn();
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
    fn a_browser_that_takes_gzip_gets_the_gzip_file_beside_a_file() {
        let dir = files::target().join("serve-gzip");
        std::fs::create_dir_all(&dir).unwrap();
        std::fs::write(dir.join("a.js"), "whole").unwrap();
        std::fs::write(dir.join("a.js.gz"), "packed").unwrap();
        std::fs::write(dir.join("b.js"), "alone").unwrap();
        let url = Server::open(vec![Mount { at: "/", dir }], 0).unwrap().spawn();
        let address = url.trim_start_matches("http://").trim_end_matches('/');
        for (path, line, body) in [
            ("a.js", "Accept-Encoding: gzip, deflate, br", "packed"),
            ("a.js", "accept-encoding: br;q=1.0, gzip;q=0.8", "packed"),
            ("a.js", "Accept-Encoding: br", "whole"),
            ("a.js", "Accept: gzip", "whole"),
            ("b.js", "Accept-Encoding: gzip", "alone"),
        ] {
            let mut connection = TcpStream::connect(address).unwrap();
            let request = format!("GET /{path} HTTP/1.1\r\n{line}\r\n\r\n");
            connection.write_all(request.as_bytes()).unwrap();
            let mut answer = String::new();
            connection.read_to_string(&mut answer).unwrap();
            let (head, sent) = answer.split_once("\r\n\r\n").unwrap();
            assert_eq!(sent, body, "{line}");
            assert!(head.contains("Content-Type: text/javascript"), "{head}");
            assert_eq!(head.contains("Content-Encoding: gzip"), body == "packed", "{head}");
            assert!(head.contains(&format!("Content-Length: {}", body.len())), "{head}");
        }
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
