//! Removes code that formats messages from a wasm module in which nothing formats any more.
//!
//! ```text
//! exports, table ──▶ functions that they call ──▶ core::fmt?     yes: nothing changes
//!                                                                no: its functions become traps
//! ```
//! Messages of panics refer to functions such as `<f32 as Debug>::fmt` by their number in the
//! table. The table keeps them after `traps` removed the panics.
//!
//! Reads and writes the functions.
//! Invariant: a function of `core::fmt`, or one that implements a trait of it, runs only if another
//! one calls it.

use std::collections::HashSet;

use walrus::ir::{Call, Unreachable, Visitor, dfs_in_order};
use walrus::{ElementItems, ExportItem, FunctionId, FunctionKind, Module};

/// Parts of the mangled names of functions that format.
const FORMATTING: [&str; 5] = ["core..fmt", "4core3fmt", "3fmt17h", "5Debug3fmt", "7Display3fmt"];

/// Replaces the functions of the table that format by traps, unless something else calls such a
/// function. Returns how many were replaced.
pub fn remove(module: &mut Module) -> usize {
    let formats = |id: &FunctionId| {
        let name = module.funcs.get(*id).name.as_deref().unwrap_or("");
        FORMATTING.iter().any(|part| name.contains(part))
    };
    let (formatters, others): (Vec<_>, Vec<_>) = table(module).into_iter().partition(formats);
    if reachable(module, others.into_iter().chain(exported(module))).iter().any(formats) {
        return 0;
    }
    for id in &formatters {
        if let FunctionKind::Local(body) = &mut module.funcs.get_mut(*id).kind {
            let entry = body.entry_block();
            let code = &mut body.block_mut(entry).instrs;
            code.clear();
            code.push((Unreachable {}.into(), Default::default()));
        }
    }
    formatters.len()
}

/// The functions that the table holds.
fn table(module: &Module) -> HashSet<FunctionId> {
    let functions = module.elements.iter().flat_map(|elements| match &elements.items {
        ElementItems::Functions(functions) => functions.clone(),
        ElementItems::Expressions(..) => Vec::new(),
    });
    functions.collect()
}

/// The functions that run from outside.
fn exported(module: &Module) -> Vec<FunctionId> {
    let functions = module.exports.iter().filter_map(|export| match export.item {
        ExportItem::Function(id) => Some(id),
        _ => None,
    });
    functions.chain(module.start).collect()
}

/// The functions that `roots` call, themselves or through others, and the roots.
fn reachable(module: &Module, roots: impl Iterator<Item = FunctionId>) -> HashSet<FunctionId> {
    let (mut found, mut open) = (HashSet::new(), roots.collect::<Vec<_>>());
    while let Some(id) = open.pop() {
        if let (true, FunctionKind::Local(body)) = (found.insert(id), &module.funcs.get(id).kind) {
            dfs_in_order(&mut Calls(&mut open), body, body.entry_block());
        }
    }
    found
}

struct Calls<'a>(&'a mut Vec<FunctionId>);

impl Visitor<'_> for Calls<'_> {
    fn visit_call(&mut self, call: &Call) {
        self.0.push(call.func);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use walrus::{ConstExpr, ElementKind, FunctionBuilder, RefType};

    /// Adds a function `name` that calls `others`.
    fn add(module: &mut Module, name: &str, others: &[FunctionId]) -> FunctionId {
        let mut function = FunctionBuilder::new(&mut module.types, &[], &[]);
        function.name(name.into());
        let mut body = function.func_body();
        others.iter().for_each(|other| {
            body.call(*other);
        });
        function.finish(vec![], &mut module.funcs)
    }

    /// A module whose table holds a function that formats and another one; the export calls
    /// `core::fmt::write` if `writes`.
    fn module(writes: bool) -> (Module, [FunctionId; 2]) {
        let mut module = Module::default();
        let write = add(&mut module, "_ZN4core3fmt5write17h0E", &[]);
        let debug = add(&mut module, "_RNvXs_NtNtCs_4core3fmt5floatfNtB_5Debug3fmt", &[write]);
        let compare = add(&mut module, "_ZN6muslin4math4sort17h0E", &[write; 0]);
        let table = module.tables.add_local(false, 2, None, RefType::FUNCREF);
        let kind =
            ElementKind::Active { table, offset: ConstExpr::Value(walrus::ir::Value::I32(0)) };
        module.elements.add(kind, ElementItems::Functions(vec![debug, compare]));
        let called = if writes { vec![write] } else { vec![] };
        let export = add(&mut module, "rawcloth_grid", &called);
        module.exports.add("rawcloth_grid", export);
        (module, [debug, compare])
    }

    fn length(module: &Module, id: FunctionId) -> usize {
        let body = module.funcs.get(id).kind.unwrap_local();
        body.block(body.entry_block()).instrs.len()
    }

    #[test]
    fn functions_of_the_table_that_format_become_traps_if_nothing_formats() {
        let (mut module, [debug, compare]) = module(false);
        assert_eq!(remove(&mut module), 1);
        let body = module.funcs.get(debug).kind.unwrap_local();
        let code = &body.block(body.entry_block()).instrs;
        assert!(matches!(code[..], [(walrus::ir::Instr::Unreachable(_), _)]));
        assert_eq!(length(&module, compare), 0);
    }

    #[test]
    fn a_module_that_formats_keeps_all_of_it() {
        let (mut module, [debug, _]) = module(true);
        assert_eq!((remove(&mut module), length(&module, debug)), (0, 1));
    }
}
