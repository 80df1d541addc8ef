//! Translates the core of the npm package from wasm to JavaScript with Binaryen's wasm2js, for
//! pages whose content security policy forbids WebAssembly.

use std::path::{Path, PathBuf};

use crate::failure::{During, Failure, Result};
use crate::{files, function_order, tools};

/// The wasm features that wasm2js can translate.
const FEATURES: [&str; 3] = ["--mvp-features", "--enable-bulk-memory", "--enable-mutable-globals"];

/// These options limit inlining: JavaScript engines do not optimise very large functions.
const OPTIMIZED: [&str; 7] = ["-O4", "-aimfs", "2", "-fimfs", "0", "-ocimfs", "0"];

/// Replacements in the output of wasm2js: the start of a part, its end, and the text that replaces
/// both and what lies between. `no-wasm.js` does all importing and exporting.
const REPLACEMENTS: [(&str, &str, &str); 4] = [
    ("import * as $_", "\n", "import { grow, trap } from \"./heap.js\";\n"),
    ("function wasm2js_trap()", "\n", "function wasm2js_trap() { trap(); }\n"),
    (" function __wasm_memory_size()", " return {\n  \"memory\"", MEMORY),
    ("var retasmFunc = ", "", "export { asmFunc as instantiate };\n"),
];

/// Memory that `grow` of `heap.js` enlarges; growing returns −1 where `grow` returns nothing.
const MEMORY: &str = r#" var pages = buffer.byteLength >> 16;
 function __wasm_memory_size() {
  return pages;
 }
 function __wasm_memory_grow(more) {
  var old = pages;
  var larger = grow(buffer, 65536 * (old + (more >>> 0)));
  if (!larger) return -1;
  pages = old + more | 0;
  if (larger !== buffer) {
   buffer = larger;
   HEAP8 = new Int8Array(buffer);
   HEAP16 = new Int16Array(buffer);
   HEAP32 = new Int32Array(buffer);
   bufferView = HEAPU8 = new Uint8Array(buffer);
   HEAPU16 = new Uint16Array(buffer);
   HEAPU32 = new Uint32Array(buffer);
   HEAPF32 = new Float32Array(buffer);
   HEAPF64 = new Float64Array(buffer);
  }
  return old;
 }
"#;

/// Translates a module in the folder `work` and returns the path of the script.
///
/// A script that was made from the same module with the same tools is not made again.
pub fn convert(module: &Path, work: &Path) -> Result<PathBuf> {
    let tools = tools::install()?;
    files::create_dir(work)?;
    let [inputs, code, small] = ["inputs", "code.js", "code.min.js"].map(|name| work.join(name));
    let read = |path: &Path| std::fs::read(path).during(|| format!("reading {}", path.display()));
    let mut input = read(module)?;
    input.extend_from_slice(include_bytes!("no_wasm.rs"));
    input.extend_from_slice(include_bytes!("function_order.rs"));
    input.extend_from_slice(include_bytes!("similar_order.rs"));
    input.extend(read(&tools.join(".installed-lock.json"))?);
    if small.is_file() && std::fs::read(&inputs).is_ok_and(|bytes| bytes == input) {
        return Ok(small);
    }
    std::fs::remove_file(&inputs).ok(); // it may be missing
    tools::to_javascript(module, &code, &[&FEATURES[..], &OPTIMIZED].concat())?;
    let parts = shorten_constants(&replace_parts(&files::read(&code)?)?);
    files::write(&code, &parts)?;
    tools::minify(&code, &small, "--minify")?;
    files::write(&small, &function_order::in_script(&files::read(&small)?)?)?;
    std::fs::write(&inputs, input).during(|| format!("writing {}", inputs.display()))?;
    Ok(small)
}

/// Applies all replacements to the output of wasm2js.
fn replace_parts(code: &str) -> Result<String> {
    let mut code = code.to_owned();
    for (from, to, replacement) in REPLACEMENTS {
        let start = code.find(from);
        let end = start.and_then(|start| {
            let rest = start + from.len();
            if to.is_empty() { Some(code.len()) } else { code[rest..].find(to).map(|at| rest + at) }
        });
        let (Some(start), Some(end)) = (start, end) else {
            return Err(Failure::new(format!(
                "the output of wasm2js has no {from:?}; it is of another version"
            )));
        };
        code.replace_range(start..end, replacement);
    }
    Ok(code)
}

/// What wasm2js writes before and after a constant of 32 bits.
const CONSTANT: [&str; 2] = ["Math_fround(", ")"];

/// Writes each constant of 32 bits with the fewest digits that give its bits. wasm2js writes them
/// with the digits of 64 bits.
fn shorten_constants(code: &str) -> String {
    let [before, after] = CONSTANT;
    let mut parts = code.split(before);
    let mut short = parts.next().unwrap_or_default().to_owned();
    for part in parts {
        short += before;
        let constant = part.split_once(after).and_then(|(digits, rest)| {
            let value: f64 = digits.parse().ok()?;
            let value32 = value as f32;
            let [plain, power] = [value32.to_string(), format!("{value32:e}")];
            let text = if power.len() < plain.len() { power } else { plain };
            let is_same = |read: f64| (read as f32).to_bits() == value32.to_bits();
            // Infinity has another name there.
            let is_exact = value.is_finite() && f64::from(value32).to_bits() == value.to_bits();
            let is_same = is_exact && text.parse().is_ok_and(is_same);
            (is_same && text.len() < digits.len()).then_some((text, rest))
        });
        match constant {
            Some((digits, rest)) => {
                short += &digits;
                short += after;
                short += rest;
            }
            None => short += part,
        }
    }
    short
}

#[cfg(test)]
mod tests {
    use super::*;

    const WRITTEN: &str = "import * as $_raw from './raw.js';\nvar view;\n\
        function wasm2js_trap() { throw new Error('abort'); }\nfunction asmFunc(imports) {\n \
        function __wasm_memory_size() {\n }\n function __wasm_memory_grow() {\n }\n return {\n  \"memory\": 1\n };\n}\n\
        var retasmFunc = asmFunc({});\nexport var memory = retasmFunc.memory;\n";

    #[test]
    fn the_parts_are_replaced_and_the_rest_stays() {
        let code = replace_parts(WRITTEN).unwrap();
        assert!(
            code.starts_with("import { grow, trap } from \"./heap.js\";\n\nvar view;\n"),
            "{code}"
        );
        assert!(code.contains("{ trap(); }") && code.contains("larger = grow(buffer"), "{code}");
        assert!(
            code.ends_with(
                " return {\n  \"memory\": 1\n };\n}\nexport { asmFunc as instantiate };\n"
            ),
            "{code}"
        );
        assert!(!code.contains("abort") && !code.contains("raw.js"), "{code}");
    }

    #[test]
    fn constants_get_the_fewest_digits_that_give_their_bits() {
        let code = "Math_fround(.11999999731779099) + Math_fround(a + 1.5) * Math_fround(0.1)";
        let short = "Math_fround(0.12) + Math_fround(a + 1.5) * Math_fround(0.1)";
        assert_eq!(shorten_constants(code), short);
        assert_eq!(shorten_constants("Math_fround(-2.0000000e3);"), "Math_fround(-2e3);");
        let infinite = "Math_fround(Infinity) - Math_fround(-Infinity) + Math_fround(NaN)";
        assert_eq!(shorten_constants(infinite), infinite);
    }

    #[test]
    fn output_of_another_version_is_refused() {
        let failure =
            replace_parts(&WRITTEN.replace("wasm2js_trap", "trap")).unwrap_err().to_string();
        assert!(failure.contains("wasm2js_trap"), "{failure}");
    }
}
