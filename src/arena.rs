//! Generational arena: up to a fixed number of slots addressed by handles that detect stale use.
//!
//! ```text
//! handle = generation (16 bits) | slot + 1 (16 bits)        0 = no handle
//! ```
//! A slot gets a new generation when its value is removed, so a handle to the removed value no
//! longer matches. A generation repeats after 65,535 removals from one slot.
//!
//! Slots are made when they are first needed, so iteration costs nothing for those that never were.
//!
//! Invariants: only `insert` allocates, which no tick calls; a slot is never dropped, so its
//! generation is not forgotten.

use crate::error::{Error, Result};
use crate::math::heap_bytes::HeapBytes;
use crate::math::reserve::ReserveTotal;
use serde::{Deserialize, Serialize};

/// Number of slots that an empty arena has memory for.
const FEW_SLOTS: usize = 4;

/// Values addressed by handles: `generation << 16 | slot + 1`. The handle 0 names nothing.
#[derive(Debug, Serialize, Deserialize)]
pub(crate) struct Arena<T> {
    slots: Vec<Slot<T>>,
    /// The largest number of slots.
    capacity: u16,
}

#[derive(Clone, Debug, Serialize, Deserialize)]
struct Slot<T> {
    generation: u16,
    value: Option<T>,
}

impl<T> HeapBytes for Arena<T> {
    /// The memory of the slots, without that of the values.
    fn heap_bytes(&self) -> usize {
        size_of::<Slot<T>>() * self.slots.capacity()
    }
}

impl<T: Clone> Clone for Arena<T> {
    fn clone(&self) -> Self {
        let mut copy = Self::with_capacity(self.capacity);
        copy.slots.extend(self.slots.iter().cloned());
        copy
    }
}

impl<T> Arena<T> {
    /// Makes an empty arena for at most `capacity` values.
    pub fn with_capacity(capacity: u16) -> Self {
        Self { slots: Vec::with_capacity(FEW_SLOTS.min(capacity.into())), capacity }
    }

    /// Allocates the first slots, for an arena that was read from a save.
    pub fn reserve(&mut self) {
        self.slots.reserve_total(FEW_SLOTS.min(self.capacity.into()));
    }

    /// Stores `value` in the lowest free slot and returns its handle.
    ///
    /// # Errors
    /// [`Error::Full`] with `what` if no slot is free.
    pub fn insert(&mut self, value: T, what: &'static str) -> Result<u32> {
        let free = self.slots.iter().position(|slot| slot.value.is_none());
        let at = free.unwrap_or(self.slots.len());
        if at >= usize::from(self.capacity) {
            return Err(Error::Full { what });
        }
        if at == self.slots.len() {
            self.slots.push(Slot { generation: 1, value: None });
        }
        self.slots[at].value = Some(value);
        Ok(u32::from(self.slots[at].generation) << 16 | (at as u32 + 1))
    }

    /// Removes and returns the value of `handle`, which becomes stale.
    ///
    /// # Errors
    /// [`Error::BadHandle`] with `what` if `handle` is stale or was never given out.
    pub fn remove(&mut self, handle: u32, what: &'static str) -> Result<T> {
        let slot = self.slot_mut(handle).ok_or(Error::BadHandle { what })?;
        let value = slot.value.take().ok_or(Error::BadHandle { what })?;
        slot.generation = slot.generation.checked_add(1).unwrap_or(1);
        Ok(value)
    }

    /// Returns the value of `handle`, or [`Error::BadHandle`] with `what`.
    pub fn get_mut(&mut self, handle: u32, what: &'static str) -> Result<&mut T> {
        let slot = self.slot_mut(handle).ok_or(Error::BadHandle { what })?;
        slot.value.as_mut().ok_or(Error::BadHandle { what })
    }

    /// Returns the value of `handle`, or [`Error::BadHandle`] with `what`.
    pub fn get(&self, handle: u32, what: &'static str) -> Result<&T> {
        let at = (handle & 0xffff).checked_sub(1).map(|at| at as usize);
        let slot = at.and_then(|at| self.slots.get(at));
        let slot = slot.filter(|slot| u32::from(slot.generation) == handle >> 16);
        slot.and_then(|slot| slot.value.as_ref()).ok_or(Error::BadHandle { what })
    }

    /// Removes all values. All handles become stale.
    pub fn clear(&mut self) {
        for slot in &mut self.slots {
            if slot.value.take().is_some() {
                slot.generation = slot.generation.checked_add(1).unwrap_or(1);
            }
        }
    }

    /// Iterates over the values in slot order.
    pub fn iter(&self) -> impl Iterator<Item = &T> {
        self.slots.iter().filter_map(|slot| slot.value.as_ref())
    }

    /// Iterates over the values in slot order.
    pub fn iter_mut(&mut self) -> impl Iterator<Item = &mut T> {
        self.slots.iter_mut().filter_map(|slot| slot.value.as_mut())
    }

    /// Returns whether the arena has at most `capacity` slots, for one that was read from a save.
    pub fn is_within(&self, capacity: u16) -> bool {
        self.capacity == capacity && self.slots.len() <= usize::from(capacity)
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
    fn the_handle_of_a_removed_value_is_refused() {
        let mut arena = Arena::with_capacity(2);
        let old = arena.insert('a', "grab").unwrap();
        assert_eq!(arena.remove(old, "grab"), Ok('a'));
        let new = arena.insert('b', "grab").unwrap();
        assert_ne!(old, new);
        assert_eq!(arena.remove(old, "grab"), Err(Error::BadHandle { what: "grab" }));
        assert_eq!(arena.get_mut(new, "grab").copied(), Ok('b'));
    }

    #[test]
    fn slots_are_made_when_they_are_needed_and_used_again() {
        let mut arena = Arena::with_capacity(3);
        assert!(arena.slots.is_empty() && arena.is_within(3) && !arena.is_within(2));
        let first = arena.insert('a', "grab").unwrap();
        arena.insert('b', "grab").unwrap();
        arena.remove(first, "grab").unwrap();
        arena.insert('c', "grab").unwrap();
        assert_eq!(arena.slots.len(), 2);
        assert_eq!(arena.iter().collect::<String>(), "cb");
    }

    #[test]
    fn a_full_arena_and_unknown_handles_give_errors() {
        let mut arena = Arena::with_capacity(1);
        arena.insert('a', "grab").unwrap();
        assert_eq!(arena.insert('b', "a grab"), Err(Error::Full { what: "a grab" }));
        for unknown in [0, 1, 7, u32::MAX, 1 << 16] {
            assert!(arena.get_mut(unknown, "grab").is_err(), "{unknown:#x}");
        }
    }
}
