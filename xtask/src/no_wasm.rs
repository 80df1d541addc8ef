//! The core of the npm package as JavaScript, for pages that may not use WebAssembly: made of a wasm module by
//! Binaryen's wasm2js.

use std::path::{Path, PathBuf};

use crate::failure::{During, Failure, Result};
use crate::{files, tools};

/// What the module may use: all else has no counterpart.
const FEATURES: [&str; 3] = ["--mvp-features", "--enable-bulk-memory", "--enable-mutable-globals"];

/// Functions stay apart: engines leave those unoptimised that are very large.
const OPTIMIZED: [&str; 7] = ["-O3", "-aimfs", "2", "-fimfs", "0", "-ocimfs", "0"];

/// What wasm2js writes, and what is to stand there instead: whatever imports and exports is left to no-wasm.js.
const CHANGES: [(&str, &str, &str); 4] = [
    ("import * as $_", "\n", "import { grow, trap } from \"./heap.js\";\n"),
    ("function wasm2js_trap()", "\n", "function wasm2js_trap() { trap(); }\n"),
    (" function __wasm_memory_size()", " return {\n  \"memory\"", MEMORY),
    ("var retasmFunc = ", "", "export { asmFunc as instantiate };\n"),
];

/// Memory with room to grow into, and none at all where `grow` finds none.
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

/// Makes `code.js` of a module, in `work`; gives it. What was made of the same module before is taken as it is.
pub fn convert(module: &Path, work: &Path) -> Result<PathBuf> {
    let tools = tools::install()?;
    files::make(work)?;
    let [made, code, small] = ["made-of", "code.js", "code.min.js"].map(|name| work.join(name));
    let read = |path: &Path| std::fs::read(path).during(|| format!("reading {}", path.display()));
    let mut of = read(module)?;
    of.extend_from_slice(include_bytes!("no_wasm.rs"));
    of.extend(read(&tools.join(".installed-lock.json"))?);
    if small.is_file() && std::fs::read(&made).is_ok_and(|bytes| bytes == of) {
        return Ok(small);
    }
    std::fs::remove_file(&made).ok(); // there may be none
    tools::to_javascript(module, &code, &[&FEATURES[..], &OPTIMIZED].concat())?;
    files::write(&code, &changed(&files::read(&code)?)?)?;
    tools::minify(&code, &small, "--minify")?;
    std::fs::write(&made, of).during(|| format!("writing {}", made.display()))?;
    Ok(small)
}

/// Puts what we have in place of what wasm2js wrote.
fn changed(code: &str) -> Result<String> {
    let mut code = code.to_owned();
    for (from, to, ours) in CHANGES {
        let start = code.find(from);
        let end = start.and_then(|start| {
            let rest = start + from.len();
            if to.is_empty() { Some(code.len()) } else { code[rest..].find(to).map(|at| rest + at) }
        });
        let (Some(start), Some(end)) = (start, end) else {
            return Err(Failure::new(format!("wasm2js wrote no {from:?}: it is another version")));
        };
        code.replace_range(start..end, ours);
    }
    Ok(code)
}

#[cfg(test)]
mod tests {
    use super::*;

    const WRITTEN: &str = "import * as $_raw from './raw.js';\nvar view;\n\
        function wasm2js_trap() { throw new Error('abort'); }\nfunction asmFunc(imports) {\n \
        function __wasm_memory_size() {\n }\n function __wasm_memory_grow() {\n }\n return {\n  \"memory\": 1\n };\n}\n\
        var retasmFunc = asmFunc({});\nexport var memory = retasmFunc.memory;\n";

    #[test]
    fn what_wasm2js_wrote_is_changed_and_the_rest_stays() {
        let code = changed(WRITTEN).unwrap();
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
    fn another_wasm2js_is_noticed() {
        let failure = changed(&WRITTEN.replace("wasm2js_trap", "trap")).unwrap_err().to_string();
        assert!(failure.contains("wasm2js_trap"), "{failure}");
    }
}
