//! Replaces the panics of a wasm module by traps.
//!
//! On a page a panic prints nothing: the module has no output and sets no panic hook, so that it
//! only traps. The arguments of a panic and the code that formats its message are dead weight.
//!
//! Reads and writes the module.
//! Invariant: only functions that never return are replaced, and their calls end in a trap as
//! before.

use std::collections::HashSet;

use walrus::ir::{Const, Instr, InstrSeq, Unreachable, Value, VisitorMut, dfs_pre_order_mut};
use walrus::{FunctionId, FunctionKind, LocalFunction, Module};

use crate::failure::{During, Failure, Result};
use crate::{dead_data, dead_formatting};

/// Parts of the mangled names of functions that panic.
const PANICS: [&str; 5] =
    ["4core9panicking", "13unwrap_failed", "13expect_failed", "slice_index_fail", "mismatch_fail"];

/// The least number of calls that a module is expected to have.
const MIN_CALLS: usize = 100;

/// Replaces the panics in the bytes of a module.
///
/// # Errors
/// If few panics are found: the names of the functions changed.
pub fn from_panics(bytes: &[u8]) -> Result<Vec<u8>> {
    let mut module = Module::from_buffer(bytes).during(|| "reading a module".into())?;
    let Replacement { calls, locations, .. } = replace_calls(&mut module);
    if calls < MIN_CALLS {
        return Err(Failure::new(format!("only {calls} calls in the module panic by their names")));
    }
    walrus::passes::gc::run(&mut module);
    dead_formatting::remove(&mut module);
    walrus::passes::gc::run(&mut module);
    dead_data::clear(&mut module, &locations);
    Ok(module.emit_wasm())
}

/// Replaces the calls of functions that panic. The functions stay, for a later pass that removes
/// all code that nothing calls.
fn replace_calls(module: &mut Module) -> Replacement {
    let panics = module.funcs.iter().filter(|function| {
        let name = function.name.as_deref().unwrap_or("");
        PANICS.iter().any(|part| name.contains(part))
            && matches!(&function.kind, FunctionKind::Local(body) if never_returns(body))
    });
    let panics = panics.map(|panic| panic.id()).collect();
    let mut replacement = Replacement { panics, calls: 0, locations: HashSet::new() };
    for (id, body) in module.funcs.iter_local_mut() {
        if !replacement.panics.contains(&id) {
            let entry = body.entry_block();
            dfs_pre_order_mut(&mut replacement, body, entry);
        }
    }
    replacement
}

/// Whether a function ends in a trap. The compiler adds it after each call that does not return.
fn never_returns(body: &LocalFunction) -> bool {
    let instructions = &body.block(body.entry_block()).instrs;
    matches!(instructions.last(), Some((Instr::Unreachable(_), _)))
}

struct Replacement {
    panics: HashSet<FunctionId>,
    /// How many calls were replaced.
    calls: usize,
    /// The numbers that they passed last: the addresses of the places of the panics.
    locations: HashSet<u32>,
}

impl VisitorMut for Replacement {
    fn start_instr_seq_mut(&mut self, sequence: &mut InstrSeq) {
        let is_panic =
            |instr: &Instr| matches!(instr, Instr::Call(call) if self.panics.contains(&call.func));
        let code = &mut sequence.instrs;
        let Some(at) = code.iter().position(|(instr, _)| is_panic(instr)) else {
            return;
        };
        let last = at.checked_sub(1).map(|last| &code[last].0);
        if let Some(Instr::Const(Const { value: Value::I32(address) })) = last {
            self.locations.insert(*address as u32);
        }
        code[at].0 = Unreachable {}.into();
        code.truncate(at + 1);
        let arguments = code[..at].iter().rev().take_while(|(instr, _)| is_unobservable(instr));
        let arguments = arguments.count();
        code.drain(at - arguments..at);
        self.calls += 1;
    }
}

/// Whether a trap after the instruction hides what it does. It may trap itself.
fn is_unobservable(instr: &Instr) -> bool {
    matches!(
        instr,
        Instr::Const(_)
            | Instr::LocalGet(_)
            | Instr::LocalSet(_)
            | Instr::LocalTee(_)
            | Instr::GlobalGet(_)
            | Instr::Binop(_)
            | Instr::Unop(_)
            | Instr::Load(_)
            | Instr::Select(_)
            | Instr::Drop(_)
    )
}

#[cfg(test)]
mod tests {
    use super::*;
    use walrus::ir::BinaryOp;
    use walrus::{FunctionBuilder, ValType};

    /// Adds a function `name` that takes a number and traps, or returns if `returns`.
    fn add_function(module: &mut Module, name: &str, returns: bool) -> FunctionId {
        let mut function = FunctionBuilder::new(&mut module.types, &[ValType::I32], &[]);
        function.name(name.into());
        if !returns {
            function.func_body().unreachable();
        }
        let argument = module.locals.add(ValType::I32);
        function.finish(vec![argument], &mut module.funcs)
    }

    #[test]
    fn calls_that_panic_become_traps_without_arguments_and_others_stay() {
        let mut module = Module::default();
        let panic = add_function(&mut module, "_ZN4core9panicking18panic_bounds_check17hE", false);
        let query = add_function(&mut module, "_ZN4core9panicking9panicking17hE", true);
        let other = add_function(&mut module, "_ZN6muslin4trap17hE", false);
        let mut caller = FunctionBuilder::new(&mut module.types, &[], &[]);
        caller.func_body().block(None, |block| {
            block.i32_const(1).call(query).i32_const(2).call(other);
            block.i32_const(3).i32_const(4).binop(BinaryOp::I32Add).call(panic).unreachable();
        });
        let caller = caller.finish(vec![], &mut module.funcs);
        assert_eq!(replace_calls(&mut module).calls, 1);
        let body = module.funcs.get(caller).kind.unwrap_local();
        let (Instr::Block(block), _) = &body.block(body.entry_block()).instrs[0] else {
            panic!("the caller has no block");
        };
        let code: Vec<_> = body.block(block.seq).instrs.iter().map(|(instr, _)| instr).collect();
        let [one, Instr::Call(first), two, Instr::Call(second), Instr::Unreachable(_)] = &code[..]
        else {
            panic!("{code:?}");
        };
        let is_number = |instr: &Instr, number: i32| matches!(instr, Instr::Const(c) if matches!(c.value, Value::I32(n) if n == number));
        assert!(is_number(one, 1) && is_number(two, 2));
        assert_eq!((first.func, second.func), (query, other));
    }
}
