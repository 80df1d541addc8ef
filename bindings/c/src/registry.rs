//! Table of all cloths: generational slots, each cloth behind a lock of its own.
//!
//! ```text
//! handle = generation << 32 | (slot + 1)      0 is no handle
//! ```
//!
//! Reads and writes the global table.
//! Invariant: a handle never refers to another cloth than the one it was made for; a lock is only
//! tried, never waited for.

use crate::ffi::panic_guard::run_guarded;
use crate::log::{self, MUSLIN_LOG_INFO};
use crate::status::{CallError, MuslinStatus, Result};
use crate::types::value::MuslinCloth;
use muslin_core::Cloth;
use std::sync::{Arc, Mutex, MutexGuard, PoisonError, TryLockError};

/// A cloth, or `None` if another thread destroyed it after its slot was looked up.
type SharedCloth = Arc<Mutex<Option<Cloth>>>;

struct Slot {
    generation: u32,
    cloth: Option<SharedCloth>,
}

/// All slots, and the indices of the free ones.
struct Registry {
    slots: Vec<Slot>,
    free: Vec<u32>,
}

impl Registry {
    fn insert(&mut self, cloth: Cloth) -> Result<MuslinCloth> {
        let at = match self.free.pop() {
            Some(at) => at,
            None => {
                let full =
                    || CallError::new(MuslinStatus::Full, "no room is left for another cloth");
                let at = u32::try_from(self.slots.len()).map_err(|_| full())?;
                self.slots.push(Slot { generation: 1, cloth: None });
                at
            }
        };
        let slot = &mut self.slots[at as usize];
        slot.cloth = Some(Arc::new(Mutex::new(Some(cloth))));
        Ok(MuslinCloth { id: u64::from(slot.generation) << 32 | (u64::from(at) + 1) })
    }

    fn find(&self, cloth: MuslinCloth) -> Option<&SharedCloth> {
        let at = (cloth.id & u64::from(u32::MAX)).checked_sub(1)?;
        let slot = self.slots.get(usize::try_from(at).ok()?)?;
        (u64::from(slot.generation) == cloth.id >> 32).then_some(slot.cloth.as_ref()).flatten()
    }

    /// Makes the handle stale. A slot that has used all of its generations stays empty.
    fn remove(&mut self, cloth: MuslinCloth) {
        let at = (cloth.id & u64::from(u32::MAX)) as u32 - 1;
        let slot = &mut self.slots[at as usize];
        slot.cloth = None;
        if let Some(next) = slot.generation.checked_add(1) {
            slot.generation = next;
            self.free.push(at);
        }
    }
}

static REGISTRY: Mutex<Registry> = Mutex::new(Registry { slots: Vec::new(), free: Vec::new() });

/// Locks the table. Callers hold the lock only briefly and never wait while holding it.
fn registry() -> MutexGuard<'static, Registry> {
    REGISTRY.lock().unwrap_or_else(PoisonError::into_inner)
}

fn find_cloth(cloth: MuslinCloth) -> Result<SharedCloth> {
    registry().find(cloth).cloned().ok_or_else(CallError::bad_cloth)
}

fn busy() -> CallError {
    CallError::new(MuslinStatus::Busy, "`cloth` must not be in use on another thread")
}

/// Stores a new cloth and returns its handle.
pub fn insert(cloth: Cloth) -> Result<MuslinCloth> {
    registry().insert(cloth)
}

/// Runs `call` with exclusive access to a cloth. A panic makes the cloth unusable.
pub fn with_cloth(cloth: MuslinCloth, call: impl FnOnce(&mut Cloth) -> Result) -> MuslinStatus {
    let mut call = Some(call);
    run_guarded(|| {
        with_cloth_dyn(cloth, &mut |cloth| call.take().map_or(Ok(()), |call| call(cloth)))
    })
}

/// The part of `with_cloth` that is compiled once, not once per caller.
fn with_cloth_dyn(cloth: MuslinCloth, call: &mut dyn FnMut(&mut Cloth) -> Result) -> Result {
    let shared = find_cloth(cloth)?;
    let mut locked = match shared.try_lock() {
        Ok(locked) => locked,
        Err(TryLockError::WouldBlock) => return Err(busy()),
        Err(TryLockError::Poisoned(_)) => return Err(CallError::poisoned_cloth()),
    };
    call(locked.as_mut().ok_or_else(CallError::bad_cloth)?)
}

/// Destroys a cloth, also one that a panic made unusable.
pub fn destroy(cloth: MuslinCloth) -> MuslinStatus {
    let status = run_guarded(|| {
        let shared = find_cloth(cloth)?;
        let mut locked = match shared.try_lock() {
            Ok(locked) => locked,
            Err(TryLockError::WouldBlock) => return Err(busy()),
            Err(TryLockError::Poisoned(poisoned)) => poisoned.into_inner(),
        };
        let destroyed = locked.take().ok_or_else(CallError::bad_cloth)?;
        registry().remove(cloth);
        drop(locked);
        drop(destroyed);
        Ok(())
    });
    if status == MuslinStatus::Ok {
        log::emit(MUSLIN_LOG_INFO, || format!("cloth {:#x} was destroyed", cloth.id));
    }
    status
}

#[cfg(test)]
mod tests {
    use super::*;
    use muslin_core::GridDesc;

    fn small_cloth() -> MuslinCloth {
        let desc = GridDesc { columns: 3, rows: 3, ..GridDesc::default() };
        insert(Cloth::grid(&desc).unwrap()).unwrap()
    }

    #[test]
    fn a_panic_makes_only_its_own_cloth_unusable() {
        let (poisoned, healthy) = (small_cloth(), small_cloth());
        assert_eq!(with_cloth(poisoned, |_| panic!("on purpose")), MuslinStatus::Panicked);
        assert_eq!(with_cloth(poisoned, |_| Ok(())), MuslinStatus::Panicked);
        assert_eq!(with_cloth(healthy, |_| Ok(())), MuslinStatus::Ok);
        assert_eq!(destroy(poisoned), MuslinStatus::Ok);
        assert_eq!(with_cloth(poisoned, |_| Ok(())), MuslinStatus::BadHandle);
        assert_eq!(destroy(healthy), MuslinStatus::Ok);
    }

    #[test]
    fn a_cloth_in_use_is_busy_for_calls_and_for_destroy() {
        let cloth = small_cloth();
        let status = with_cloth(cloth, |_| {
            assert_eq!(with_cloth(cloth, |_| Ok(())), MuslinStatus::Busy);
            assert_eq!(destroy(cloth), MuslinStatus::Busy);
            Ok(())
        });
        assert_eq!(status, MuslinStatus::Ok);
        assert_eq!(destroy(cloth), MuslinStatus::Ok);
        assert_eq!(destroy(cloth), MuslinStatus::BadHandle);
    }

    #[test]
    fn a_slot_without_free_generations_is_not_reused() {
        let mut registry = Registry { slots: Vec::new(), free: Vec::new() };
        let cloth = || Cloth::grid(&GridDesc { columns: 2, rows: 2, ..GridDesc::default() });
        let first = registry.insert(cloth().unwrap()).unwrap();
        registry.remove(first);
        registry.slots[0].generation = u32::MAX;
        let last = registry.insert(cloth().unwrap()).unwrap();
        assert_eq!(last.id, u64::from(u32::MAX) << 32 | 1);
        registry.remove(last);
        let next = registry.insert(cloth().unwrap()).unwrap();
        assert_eq!(next.id, 1 << 32 | 2);
        assert!(registry.find(last).is_none() && registry.find(first).is_none());
    }
}
