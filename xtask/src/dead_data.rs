//! Clears the places of panics in the data of a wasm module, once nothing passes them on.
//!
//! ```text
//! location   address of the name · its length · line · column        16 bytes
//! name       src/solver/world.rs
//! ```
//! Rust stores such a location for each call that may panic. After `traps` most are dead, but no
//! later pass removes data: it has no borders. Zeros compress to nearly nothing.
//!
//! Reads the code; writes the data segments.
//! Invariant: what an instruction or other data refers to stays as it is.

use std::collections::{BTreeSet, HashSet};

use walrus::ir::{Const, Load, LoadSimd, Store, Value, Visitor, dfs_in_order};
use walrus::{ConstExpr, Data, DataId, DataKind, GlobalKind, Module};

/// The size of a location [bytes].
const LOCATION: u32 = 16;

/// The most bytes that a name is expected to have.
const MAX_NAME: u32 = 256;

/// Clears those of the `locations` that no instruction refers to any more, and the names that only
/// they refer to. Returns the number of bytes that were cleared.
pub fn clear(module: &mut Module, locations: &HashSet<u32>) -> usize {
    let used = numbers_in_code(module);
    let mut data = Segments::take(module);
    let (mut names, mut cleared) = (HashSet::new(), 0);
    for location in locations {
        if used.range(*location..location + LOCATION).next().is_some() {
            continue;
        }
        if let Some(name) = data.name_of(*location) {
            cleared += data.clear(*location, LOCATION);
            names.insert(name);
        }
    }
    let pointers = data.words();
    for (start, length) in names {
        let is_used = |numbers: &BTreeSet<u32>| numbers.range(start..start + length).count() > 0;
        if !is_used(&used) && !is_used(&pointers) {
            cleared += data.clear(start, length);
        }
    }
    data.put_back(module);
    cleared
}

/// Returns all numbers in the code that may be addresses.
fn numbers_in_code(module: &Module) -> BTreeSet<u32> {
    let mut numbers = Numbers::default();
    for (_, body) in module.funcs.iter_local() {
        dfs_in_order(&mut numbers, body, body.entry_block());
    }
    for global in module.globals.iter() {
        if let GlobalKind::Local(ConstExpr::Value(Value::I32(value))) = global.kind {
            numbers.0.insert(value as u32);
        }
    }
    numbers.0
}

#[derive(Default)]
struct Numbers(BTreeSet<u32>);

impl<'a> Visitor<'a> for Numbers {
    fn visit_const(&mut self, constant: &Const) {
        if let Value::I32(value) = constant.value {
            self.0.insert(value as u32);
        }
    }

    fn visit_load(&mut self, load: &Load) {
        self.0.insert(load.arg.offset as u32);
    }

    fn visit_load_simd(&mut self, load: &LoadSimd) {
        self.0.insert(load.arg.offset as u32);
    }

    fn visit_store(&mut self, store: &Store) {
        self.0.insert(store.arg.offset as u32);
    }
}

/// The data segments of a module while they are edited: each with its address and its bytes.
struct Segments(Vec<(DataId, u32, Vec<u8>)>);

impl Segments {
    /// Takes the bytes out of the module.
    fn take(module: &mut Module) -> Self {
        let address = |data: &Data| match data.kind {
            DataKind::Active { offset: ConstExpr::Value(Value::I32(at)), .. } => Some(at as u32),
            _ => None,
        };
        let placed = module.data.iter().filter_map(|data| Some((data.id(), address(data)?)));
        let placed: Vec<_> = placed.collect();
        let mut take = |id| core::mem::take(&mut module.data.get_mut(id).value);
        Self(placed.into_iter().map(|(id, address)| (id, address, take(id))).collect())
    }

    /// Puts the bytes back.
    fn put_back(self, module: &mut Module) {
        for (id, _, bytes) in self.0 {
            module.data.get_mut(id).value = bytes;
        }
    }

    /// The bytes at an address; `None` if they are not all in one segment.
    fn bytes(&mut self, address: u32, length: u32) -> Option<&mut [u8]> {
        self.0.iter_mut().find_map(|(_, start, bytes)| {
            let from = address.checked_sub(*start)? as usize;
            bytes.get_mut(from..from + length as usize)
        })
    }

    /// The address and the length of the name of a location; `None` if it is none.
    fn name_of(&mut self, location: u32) -> Option<(u32, u32)> {
        let words = self.bytes(location, LOCATION)?.as_chunks::<4>().0;
        let [start, length] = [0, 1].map(|at| u32::from_le_bytes(words[at]));
        let is_name = length <= MAX_NAME && self.bytes(start, length)?.ends_with(b".rs");
        is_name.then_some((start, length))
    }

    /// Sets bytes to zero, and returns how many.
    fn clear(&mut self, address: u32, length: u32) -> usize {
        let bytes = self.bytes(address, length).unwrap_or_default();
        bytes.fill(0);
        bytes.len()
    }

    /// All words at addresses that are multiples of their size.
    fn words(&self) -> BTreeSet<u32> {
        let of_segment = |(_, start, bytes): &(DataId, u32, Vec<u8>)| {
            let skipped = (start.wrapping_neg() % 4) as usize;
            let rest = bytes.get(skipped..).unwrap_or_default();
            rest.as_chunks::<4>().0.iter().map(|word| u32::from_le_bytes(*word)).collect::<Vec<_>>()
        };
        self.0.iter().flat_map(of_segment).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use walrus::{FunctionBuilder, ValType};

    const NAME: &[u8] = b"src/a.rs";

    /// A module with two locations that share a name, and a function that uses the number `used`.
    fn module(used: i32) -> (Module, HashSet<u32>) {
        let mut module = Module::default();
        let memory = module.memories.add_local(false, false, 1, None, None);
        let start = 1024 + 2 * LOCATION;
        let location =
            |line: u32| [start, NAME.len() as u32, line, 5].map(u32::to_le_bytes).concat();
        let data = [location(7), location(8), NAME.to_vec(), b"rest".to_vec()].concat();
        let offset = ConstExpr::Value(Value::I32(1024));
        module.data.add(DataKind::Active { memory, offset }, data);
        let mut user = FunctionBuilder::new(&mut module.types, &[], &[ValType::I32]);
        user.func_body().i32_const(used);
        let user = user.finish(vec![], &mut module.funcs);
        module.exports.add("user", user);
        (module, HashSet::from([1024, 1040]))
    }

    fn data_of(module: &Module) -> &[u8] {
        &module.data.iter().next().unwrap().value
    }

    #[test]
    fn locations_that_nothing_uses_are_cleared_with_their_name_and_the_rest_stays() {
        let (mut module, locations) = module(7);
        assert_eq!(clear(&mut module, &locations), 2 * 16 + NAME.len());
        assert_eq!(data_of(&module), [&[0; 2 * 16 + NAME.len()][..], b"rest"].concat());
    }

    #[test]
    fn a_location_that_code_uses_keeps_its_name() {
        let (mut module, locations) = module(1040);
        assert_eq!(clear(&mut module, &locations), 16);
        let data = data_of(&module);
        assert!(
            data[..16].iter().all(|byte| *byte == 0)
                && data[16..].starts_with(&1056_u32.to_le_bytes())
        );
        assert!(data[32..].starts_with(NAME));
    }

    #[test]
    fn data_that_is_no_location_stays() {
        let (mut module, _) = module(7);
        let before = data_of(&module).to_vec();
        assert_eq!(clear(&mut module, &HashSet::from([1032, 1060, 9000])), 0);
        assert_eq!(data_of(&module), before);
    }
}
