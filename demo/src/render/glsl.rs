//! Sources of shaders, as they are shipped.
//!
//! Method: `glsl!` joins files of `shaders` and strips comments and indentation at compile time,
//! so that pages do not transfer them.
//!
//! Reads files; returns a constant text.
//!
//! Invariant: directives of the preprocessor stay on lines of their own.

/// Joins shader files, without comments and indentation.
macro_rules! glsl {
    ($($file:literal),+) => {{
        const SOURCE: &str = concat!($(include_str!(concat!("shaders/", $file))),+);
        const LENGTH: usize = $crate::render::glsl::strip::<0>(SOURCE).1;
        const STRIPPED: &[u8] = &$crate::render::glsl::strip::<LENGTH>(SOURCE).0;
        const TEXT: &str = match std::str::from_utf8(STRIPPED) {
            Ok(text) => text,
            Err(_) => panic!("a shader is no UTF-8"),
        };
        TEXT
    }};
}
pub(super) use glsl;

/// Returns the first `N` bytes of `source` without comments, indentation and empty lines, and how
/// many there are in all.
pub(super) const fn strip<const N: usize>(source: &str) -> ([u8; N], usize) {
    let text = source.as_bytes();
    let (mut stripped, mut length) = ([0; N], 0);
    let (mut is_comment, mut is_line_start) = (false, true);
    let mut i = 0;
    while i < text.len() {
        let is_end = text[i] == b'\n';
        is_comment &= !is_end;
        is_comment |= text[i] == b'/' && i + 1 < text.len() && text[i + 1] == b'/';
        if !(is_comment || is_line_start && (is_end || text[i] == b' ')) {
            if length < N {
                stripped[length] = text[i];
            }
            length += 1;
            is_line_start = is_end;
        }
        i += 1;
    }
    (stripped, length)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn comments_indentation_and_empty_lines_are_stripped() {
        const SOURCE: &str = "// About.\n\n#ifdef A\n    float a = b / c; // ½\n#endif\n";
        let wanted = "#ifdef A\nfloat a = b / c; \n#endif\n";
        let (stripped, length) = strip::<{ strip::<0>(SOURCE).1 }>(SOURCE);
        assert_eq!((str::from_utf8(&stripped), length), (Ok(wanted), wanted.len()));
    }
}
