//! Orders the functions of a module, or of the script that wasm2js makes of one, so that they
//! compress better; see `similar_order`.
//!
//! Reads and writes bytes or text.
//! Invariant: nothing but the order and the numbers of functions changes.

use std::ops::Range;

use wasm_encoder::reencode::{Error, Reencode};
use wasm_encoder::{
    CodeSection, ElementSection, ExportSection, FunctionSection, Module, RawSection, StartSection,
};
use wasmparser::{FunctionBody, Parser, Payload, TypeRef};

use crate::failure::{During, Failure, Result};
use crate::similar_order::similar_order;

/// Returns a module with its functions in an order that compresses better.
pub fn in_module(bytes: &[u8]) -> Result<Vec<u8>> {
    let during = || String::from("ordering the functions of a module");
    Functions::read(bytes).during(during)?.write(bytes).during(during)
}

/// The functions of a module.
struct Functions<'a> {
    imported: u32,
    types: Vec<u32>,
    bodies: Vec<FunctionBody<'a>>,
    /// The old place of each function.
    order: Vec<usize>,
    /// The new place of each function.
    places: Vec<u32>,
}

impl<'a> Functions<'a> {
    fn read(bytes: &'a [u8]) -> wasmparser::Result<Self> {
        let mut functions =
            Self { imported: 0, types: vec![], bodies: vec![], order: vec![], places: vec![] };
        for payload in Parser::new(0).parse_all(bytes) {
            match payload? {
                Payload::ImportSection(imports) => {
                    for import in imports.into_imports() {
                        let is_function = matches!(import?.ty, TypeRef::Func(_));
                        functions.imported += u32::from(is_function);
                    }
                }
                Payload::FunctionSection(types) => {
                    functions.types = types.into_iter().collect::<wasmparser::Result<_>>()?;
                }
                Payload::CodeSectionEntry(body) => functions.bodies.push(body),
                _ => {}
            }
        }
        let codes: Vec<_> = functions.bodies.iter().map(|body| &bytes[body.range()]).collect();
        functions.order = similar_order(&codes);
        functions.places = vec![0; codes.len()];
        for (new, old) in (0..).zip(&functions.order) {
            functions.places[*old] = new;
        }
        Ok(functions)
    }

    /// Returns the module with its functions in their new order.
    fn write(&mut self, bytes: &[u8]) -> std::result::Result<Vec<u8>, Error> {
        let mut module = Module::new();
        for payload in Parser::new(0).parse_all(bytes) {
            match payload? {
                Payload::FunctionSection(_) => {
                    let mut section = FunctionSection::new();
                    self.order.iter().for_each(|old| {
                        section.function(self.types[*old]);
                    });
                    module.section(&section);
                }
                Payload::ExportSection(exports) => {
                    let mut section = ExportSection::new();
                    self.parse_export_section(&mut section, exports)?;
                    module.section(&section);
                }
                Payload::ElementSection(elements) => {
                    let mut section = ElementSection::new();
                    self.parse_element_section(&mut section, elements)?;
                    module.section(&section);
                }
                Payload::CodeSectionStart { .. } => {
                    let mut section = CodeSection::new();
                    for old in 0..self.order.len() {
                        let body = self.bodies[self.order[old]].clone();
                        self.parse_function_body(&mut section, body)?;
                    }
                    module.section(&section);
                }
                Payload::StartSection { func, .. } => {
                    let function_index = self.start_section(func)?;
                    module.section(&StartSection { function_index });
                }
                // What else there is names no functions.
                other => {
                    if let Some((id, range)) = other.as_section() {
                        module.section(&RawSection { id, data: &bytes[range] });
                    }
                }
            }
        }
        Ok(module.finish())
    }
}

impl Reencode for Functions<'_> {
    type Error = std::convert::Infallible;

    fn function_index(&mut self, old: u32) -> std::result::Result<u32, Error> {
        let place = old.checked_sub(self.imported).map(|at| self.places[at as usize]);
        Ok(place.map_or(old, |place| self.imported + place))
    }
}

/// The start of a function in a script.
const START: &str = "function ";

/// Returns the minified output of wasm2js with its functions in an order that compresses better.
/// Functions may be declared in any order. Only functions directly inside another one move: wasm2js puts
/// all functions of the module there.
pub fn in_script(code: &str) -> Result<String> {
    let functions = inner_functions(code)
        .ok_or_else(|| Failure::new("a string or a block in the output of wasm2js has no end"))?;
    let Some(first) = functions.first() else {
        return Err(Failure::new("the output of wasm2js has no functions"));
    };
    let bytes: Vec<_> = functions.iter().map(|range| &code.as_bytes()[range.clone()]).collect();
    let mut ordered = String::with_capacity(code.len());
    ordered += &code[..first.start];
    for place in similar_order(&bytes) {
        ordered += &code[functions[place].clone()];
    }
    let mut end = first.start;
    for range in &functions {
        ordered += &code[end..range.start];
        end = range.end;
    }
    Ok(ordered + &code[end..])
}

/// Returns the places of the functions that lie directly inside another one. `None` if a string or a
/// block has no end.
fn inner_functions(code: &str) -> Option<Vec<Range<usize>>> {
    let (bytes, mut functions) = (code.as_bytes(), Vec::new());
    let (mut depth, mut at, mut start) = (0_usize, 0, None);
    while at < bytes.len() {
        match bytes[at] {
            quote @ (b'"' | b'\'' | b'`') => {
                at += 1;
                while *bytes.get(at)? != quote {
                    at += if bytes[at] == b'\\' { 2 } else { 1 };
                }
            }
            b'{' => depth += 1,
            b'}' => {
                depth = depth.checked_sub(1)?;
                if depth == 1
                    && let Some(start) = start.take()
                {
                    functions.push(start..at + 1);
                }
            }
            b'f' if depth == 1 && start.is_none() && code[at..].starts_with(START) => {
                let before = bytes[at - 1];
                if !(before.is_ascii_alphanumeric() || b"_$.".contains(&before)) {
                    start = Some(at);
                }
            }
            _ => {}
        }
        at += 1;
    }
    (depth == 0).then_some(functions)
}

#[cfg(test)]
mod tests {
    use super::*;
    use walrus::ir::Instr;
    use walrus::{ExportItem, FunctionBuilder, ValType};

    #[test]
    fn calls_and_exports_of_a_module_name_the_functions_that_they_named() {
        let mut module = walrus::Module::default();
        let signature = module.types.add(&[], &[]);
        module.add_import_func("other", "imported", signature);
        let mut one = FunctionBuilder::new(&mut module.types, &[], &[ValType::I32]);
        one.func_body().i32_const(1).i32_const(2).drop().i32_const(2).drop();
        let one = one.finish(vec![], &mut module.funcs);
        let mut caller = FunctionBuilder::new(&mut module.types, &[], &[ValType::I32]);
        caller.func_body().call(one);
        let caller = caller.finish(vec![], &mut module.funcs);
        module.exports.add("caller", caller);
        let bytes = module.emit_wasm();
        // Its order is reversed, since walrus writes long functions first.
        let mut functions = Functions::read(&bytes).unwrap();
        functions.order.reverse();
        functions.places.reverse();
        let module = walrus::Module::from_buffer(&functions.write(&bytes).unwrap()).unwrap();
        let export = module.exports.iter().find(|export| export.name == "caller").unwrap();
        let ExportItem::Function(caller) = export.item else {
            panic!("{export:?}");
        };
        let code = |function| {
            let body = module.funcs.get(function).kind.unwrap_local();
            let code = &body.block(body.entry_block()).instrs;
            code.iter().map(|(instr, _)| instr.clone()).collect::<Vec<_>>()
        };
        let [Instr::Call(call)] = &code(caller)[..] else {
            panic!("{:?}", code(caller));
        };
        assert!(matches!(code(call.func)[0], Instr::Const(_)));
    }

    #[test]
    fn functions_of_a_script_move_and_all_else_stays() {
        let code = "var a='}';function m(){var b={c:1};function d(){e(1)}var f=\"\\\"{\";\
                    function g(){if(a){e(2)}e(3);e(4)}return{d:d}}function h(){}";
        let [one, two] = ["function d(){e(1)}", "function g(){if(a){e(2)}e(3);e(4)}"];
        let (before, after) =
            ("var a='}';function m(){var b={c:1};", "var f=\"\\\"{\";return{d:d}}function h(){}");
        assert_eq!(in_script(code).unwrap(), format!("{before}{two}{one}{after}"));
        assert!(in_script("var a;").is_err());
        assert!(in_script("function a(){'}").is_err());
    }
}
