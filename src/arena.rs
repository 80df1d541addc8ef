//! Generational slots: a handle outlives what it named without ever naming something else.

use crate::error::{Error, Result};
use serde::{Deserialize, Serialize};

/// Values behind handles. A handle is `generation << 16 | slot + 1`, so zero is none.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub(crate) struct Arena<T> {
    slots: Vec<Slot<T>>,
}

#[derive(Clone, Debug, Serialize, Deserialize)]
struct Slot<T> {
    generation: u16,
    value: Option<T>,
}

impl<T> Arena<T> {
    /// Room for `capacity` values at once; more are refused, so that nothing allocates later.
    pub fn with_capacity(capacity: u16) -> Self {
        let empty = || Slot { generation: 1, value: None };
        Self { slots: (0..capacity).map(|_| empty()).collect() }
    }

    /// Keeps `value` and names it.
    pub fn insert(&mut self, value: T, what: &'static str) -> Result<u32> {
        let free = self.slots.iter().position(|slot| slot.value.is_none());
        let at = free.ok_or(Error::Full { what })?;
        self.slots[at].value = Some(value);
        Ok(u32::from(self.slots[at].generation) << 16 | (at as u32 + 1))
    }

    /// Takes out what `handle` names; the handle is stale from then on.
    pub fn remove(&mut self, handle: u32, what: &'static str) -> Result<T> {
        let slot = self.slot_mut(handle).ok_or(Error::BadHandle { what })?;
        let value = slot.value.take().ok_or(Error::BadHandle { what })?;
        slot.generation = slot.generation.checked_add(1).unwrap_or(1);
        Ok(value)
    }

    /// What `handle` names.
    pub fn get_mut(&mut self, handle: u32, what: &'static str) -> Result<&mut T> {
        let slot = self.slot_mut(handle).ok_or(Error::BadHandle { what })?;
        slot.value.as_mut().ok_or(Error::BadHandle { what })
    }

    /// What `handle` names.
    pub fn get(&self, handle: u32, what: &'static str) -> Result<&T> {
        let at = (handle & 0xffff).checked_sub(1).map(|at| at as usize);
        let slot = at.and_then(|at| self.slots.get(at));
        let slot = slot.filter(|slot| u32::from(slot.generation) == handle >> 16);
        slot.and_then(|slot| slot.value.as_ref()).ok_or(Error::BadHandle { what })
    }

    /// Forgets every value; all handles are stale from then on.
    pub fn clear(&mut self) {
        for slot in &mut self.slots {
            if slot.value.take().is_some() {
                slot.generation = slot.generation.checked_add(1).unwrap_or(1);
            }
        }
    }

    /// The live values in slot order.
    pub fn iter(&self) -> impl Iterator<Item = &T> {
        self.slots.iter().filter_map(|slot| slot.value.as_ref())
    }

    /// The live values in slot order.
    pub fn iter_mut(&mut self) -> impl Iterator<Item = &mut T> {
        self.slots.iter_mut().filter_map(|slot| slot.value.as_mut())
    }

    /// The number of slots, live or not.
    pub fn capacity(&self) -> usize {
        self.slots.len()
    }

    fn slot_mut(&mut self, handle: u32) -> Option<&mut Slot<T>> {
        let at = (handle & 0xffff).checked_sub(1)? as usize;
        let slot = self.slots.get_mut(at)?;
        (u32::from(slot.generation) == handle >> 16).then_some(slot)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_removed_value_leaves_a_stale_handle_behind() {
        let mut arena = Arena::with_capacity(2);
        let old = arena.insert('a', "grab").unwrap();
        assert_eq!(arena.remove(old, "grab"), Ok('a'));
        let new = arena.insert('b', "grab").unwrap();
        assert_ne!(old, new);
        assert_eq!(arena.remove(old, "grab"), Err(Error::BadHandle { what: "grab" }));
        assert_eq!(arena.get_mut(new, "grab").copied(), Ok('b'));
    }

    #[test]
    fn a_full_arena_refuses_and_made_up_handles_are_refused() {
        let mut arena = Arena::with_capacity(1);
        arena.insert('a', "grab").unwrap();
        assert_eq!(arena.insert('b', "a grab"), Err(Error::Full { what: "a grab" }));
        for made_up in [0, 1, 7, u32::MAX, 1 << 16] {
            assert!(arena.get_mut(made_up, "grab").is_err(), "{made_up:#x}");
        }
    }
}
