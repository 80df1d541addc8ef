//! Tables of all cloths and of all skins: generational slots, each cloth behind a lock of its own.
//!
//! ```text
//! handle = generation << 32 | (slot + 1)      0 is no handle
//! cloth ──▶ lock ─▶ Cloth, its skins          skin ──▶ lock of its cloth
//! ```
//!
//! Reads and writes the global tables.
//! Invariant: a handle never refers to another cloth or skin than the one it was made for; the lock
//! of a cloth is only tried, never waited for; the skins of a destroyed cloth are gone.

use crate::ffi::panic_guard::run_guarded;
use crate::log::{self, MUSLIN_LOG_INFO};
use crate::status::{CallError, MuslinStatus, Result};
use crate::types::value::{MuslinCloth, MuslinSkin};
use muslin_core::{Cloth, Skin};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError, TryLockError};

/// A cloth with its skins, each with the number of its handle.
struct Entry {
    cloth: Cloth,
    skins: Vec<(u64, Skin)>,
}

/// A cloth, or `None` if another thread destroyed it after its slot was looked up.
type SharedCloth = Arc<Mutex<Option<Entry>>>;

struct Slot {
    generation: u32,
    cloth: Option<SharedCloth>,
}

/// All slots, and the indices of the free ones. The slot of a skin holds its cloth.
struct Registry {
    slots: Vec<Slot>,
    free: Vec<u32>,
}

impl Registry {
    const fn new() -> Self {
        Self { slots: Vec::new(), free: Vec::new() }
    }

    /// Stores a cloth in a free slot and returns its handle. `what` names the object in the error.
    fn insert(&mut self, cloth: SharedCloth, what: &str) -> Result<u64> {
        let at = match self.free.pop() {
            Some(at) => at,
            None => {
                let full =
                    |_| CallError::new(MuslinStatus::Full, format!("no room is left for {what}"));
                let at = u32::try_from(self.slots.len()).map_err(full)?;
                self.slots.push(Slot { generation: 1, cloth: None });
                at
            }
        };
        let slot = &mut self.slots[at as usize];
        slot.cloth = Some(cloth);
        Ok(u64::from(slot.generation) << 32 | (u64::from(at) + 1))
    }

    fn find(&self, id: u64) -> Option<&SharedCloth> {
        let at = (id & u64::from(u32::MAX)).checked_sub(1)?;
        let slot = self.slots.get(usize::try_from(at).ok()?)?;
        (u64::from(slot.generation) == id >> 32).then_some(slot.cloth.as_ref()).flatten()
    }

    /// Makes the handle stale. A slot that has used all of its generations stays empty.
    fn remove(&mut self, id: u64) {
        let at = (id & u64::from(u32::MAX)) as u32 - 1;
        let slot = &mut self.slots[at as usize];
        slot.cloth = None;
        if let Some(next) = slot.generation.checked_add(1) {
            slot.generation = next;
            self.free.push(at);
        }
    }
}

static CLOTHS: Mutex<Registry> = Mutex::new(Registry::new());
static SKINS: Mutex<Registry> = Mutex::new(Registry::new());

/// Locks a table. Callers hold the lock only briefly and never wait while holding it.
fn locked(table: &'static Mutex<Registry>) -> MutexGuard<'static, Registry> {
    table.lock().unwrap_or_else(PoisonError::into_inner)
}

fn find_cloth(cloth: MuslinCloth) -> Result<SharedCloth> {
    locked(&CLOTHS).find(cloth.id).cloned().ok_or_else(CallError::bad_cloth)
}

fn find_skin(skin: MuslinSkin) -> Result<SharedCloth> {
    locked(&SKINS).find(skin.id).cloned().ok_or_else(CallError::bad_skin)
}

fn busy() -> CallError {
    CallError::new(MuslinStatus::Busy, "`cloth` must not be in use on another thread")
}

fn try_lock(shared: &SharedCloth) -> Result<MutexGuard<'_, Option<Entry>>> {
    match shared.try_lock() {
        Ok(locked) => Ok(locked),
        Err(TryLockError::WouldBlock) => Err(busy()),
        Err(TryLockError::Poisoned(_)) => Err(CallError::poisoned_cloth()),
    }
}

/// Stores a new cloth and returns its handle.
pub fn insert(cloth: Cloth) -> Result<MuslinCloth> {
    let shared = Arc::new(Mutex::new(Some(Entry { cloth, skins: Vec::new() })));
    Ok(MuslinCloth { id: locked(&CLOTHS).insert(shared, "another cloth")? })
}

/// Returns a copy of a cloth.
pub fn duplicate(cloth: MuslinCloth) -> Result<Cloth> {
    let shared = find_cloth(cloth)?;
    let entry = try_lock(&shared)?;
    // By a save: the code that clones each list of a cloth would make the library 3 % larger.
    Ok(Cloth::restore(&entry.as_ref().ok_or_else(CallError::bad_cloth)?.cloth.save())?)
}

/// Makes a skin of a cloth, stores it and returns its handle.
pub fn insert_skin(
    cloth: MuslinCloth,
    make: impl FnOnce(&Cloth) -> Result<Skin>,
) -> Result<MuslinSkin> {
    let shared = find_cloth(cloth)?;
    let mut entry = try_lock(&shared)?;
    let entry = entry.as_mut().ok_or_else(CallError::bad_cloth)?;
    let skin = make(&entry.cloth)?;
    let id = locked(&SKINS).insert(Arc::clone(&shared), "another skin")?;
    entry.skins.push((id, skin));
    Ok(MuslinSkin { id })
}

/// Runs `call` with exclusive access to a skin and its cloth. A panic makes the cloth unusable.
pub fn with_skin(skin: MuslinSkin, call: impl FnOnce(&mut Skin, &Cloth) -> Result) -> MuslinStatus {
    run_guarded(|| {
        let shared = find_skin(skin)?;
        let mut entry = try_lock(&shared)?;
        let Entry { cloth, skins } = entry.as_mut().ok_or_else(CallError::bad_skin)?;
        let found = skins.iter_mut().find(|(id, _)| *id == skin.id);
        let (_, skin) = found.ok_or_else(CallError::bad_skin)?;
        call(skin, cloth)
    })
}

/// Destroys a skin.
pub fn destroy_skin(skin: MuslinSkin) -> MuslinStatus {
    run_guarded(|| {
        let shared = find_skin(skin)?;
        let mut entry = try_lock(&shared)?;
        let entry = entry.as_mut().ok_or_else(CallError::bad_skin)?;
        let at = entry.skins.iter().position(|(id, _)| *id == skin.id);
        let destroyed = entry.skins.swap_remove(at.ok_or_else(CallError::bad_skin)?);
        locked(&SKINS).remove(skin.id);
        drop(destroyed);
        Ok(())
    })
}

/// Runs `call` with exclusive access to a cloth. A panic makes the cloth unusable.
pub fn with_cloth(cloth: MuslinCloth, call: impl FnOnce(&mut Cloth) -> Result) -> MuslinStatus {
    let mut call = Some(call);
    run_guarded(|| {
        with_cloth_dyn(cloth, &mut |cloth| call.take().map_or(Ok(()), |call| call(cloth)))
    })
}

/// Runs `call` with exclusive access to a cloth and to another one, the argument `other`. A panic makes
/// both unusable.
pub fn with_two_cloths(
    cloth: MuslinCloth,
    other: MuslinCloth,
    call: impl FnOnce(&mut Cloth, &Cloth) -> Result,
) -> MuslinStatus {
    run_guarded(|| {
        let shared = find_cloth(cloth)?;
        let named = |error: CallError| CallError {
            message: error.message.replace("`cloth`", "`other`"),
            ..error
        };
        let shared_other = find_cloth(other).map_err(named)?;
        if Arc::ptr_eq(&shared, &shared_other) {
            return Err(CallError::bad_value("other", "be another cloth"));
        }
        let mut entry = try_lock(&shared)?;
        let entry = entry.as_mut().ok_or_else(CallError::bad_cloth)?;
        let other = try_lock(&shared_other).map_err(named)?;
        let other = other.as_ref().ok_or_else(|| named(CallError::bad_cloth()))?;
        call(&mut entry.cloth, &other.cloth)
    })
}

/// Runs `call` with exclusive access to each of `handles`, the argument `cloths`. A panic makes all
/// of them unusable.
///
/// The first handle that is no live cloth, that is in use, or that occurs twice is refused with its
/// index; then `call` does not run.
pub fn with_cloths(
    handles: &[MuslinCloth],
    call: impl FnOnce(&mut [&mut Cloth]) -> Result,
) -> Result {
    let shared = find_cloths(handles)?;
    let mut entries = Vec::with_capacity(shared.len());
    for (at, cloth) in shared.iter().enumerate() {
        entries.push(try_lock(cloth).map_err(|error| refused_in_list(handles, at, error))?);
    }
    let mut cloths = Vec::with_capacity(entries.len());
    for (at, entry) in entries.iter_mut().enumerate() {
        let entry = entry.as_mut().ok_or_else(CallError::bad_cloth);
        cloths.push(&mut entry.map_err(|error| refused_in_list(handles, at, error))?.cloth);
    }
    call(&mut cloths)
}

fn find_cloths(handles: &[MuslinCloth]) -> Result<Vec<SharedCloth>> {
    let table = locked(&CLOTHS);
    let find = |(at, cloth): (usize, &MuslinCloth)| {
        let found = table.find(cloth.id).cloned().ok_or_else(CallError::bad_cloth);
        found.map_err(|error| refused_in_list(handles, at, error))
    };
    handles.iter().enumerate().map(find).collect()
}

/// The error of a cloth, as that of the handle at `at` in the argument `cloths`.
#[cold]
fn refused_in_list(handles: &[MuslinCloth], at: usize, error: CallError) -> CallError {
    let first = handles.iter().position(|cloth| cloth.id == handles[at].id);
    let name = format!("`cloths[{at}]`");
    match first.filter(|first| *first < at && error.status == MuslinStatus::Busy) {
        // This very call has locked it.
        Some(first) => CallError::bad_value(
            format_args!("cloths[{at}]"),
            format_args!("be another cloth than `cloths[{first}]`"),
        ),
        None => {
            let message = error.message.replace("`cloth`", &name).replace("this cloth", &name);
            CallError { message, ..error }
        }
    }
}

/// The part of `with_cloth` that is compiled once, not once per caller.
fn with_cloth_dyn(cloth: MuslinCloth, call: &mut dyn FnMut(&mut Cloth) -> Result) -> Result {
    let shared = find_cloth(cloth)?;
    let mut entry = try_lock(&shared)?;
    call(&mut entry.as_mut().ok_or_else(CallError::bad_cloth)?.cloth)
}

/// Destroys a cloth and its skins, also one that a panic made unusable.
pub fn destroy(cloth: MuslinCloth) -> MuslinStatus {
    let status = run_guarded(|| {
        let shared = find_cloth(cloth)?;
        let mut entry = match shared.try_lock() {
            Ok(entry) => entry,
            Err(TryLockError::WouldBlock) => return Err(busy()),
            Err(TryLockError::Poisoned(poisoned)) => poisoned.into_inner(),
        };
        let destroyed = entry.take().ok_or_else(CallError::bad_cloth)?;
        locked(&CLOTHS).remove(cloth.id);
        let mut skins = locked(&SKINS);
        destroyed.skins.iter().for_each(|(id, _)| skins.remove(*id));
        drop((entry, skins));
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
    use crate::status::last_error;
    use core::ffi::CStr;
    use muslin_core::{GridDesc, SkinDesc};

    fn small_cloth() -> MuslinCloth {
        let desc = GridDesc { columns: 3, rows: 3, ..GridDesc::default() };
        insert(Cloth::grid(&desc).unwrap()).unwrap()
    }

    /// Makes a skin with the triangles of its cloth.
    fn own_skin(cloth: &Cloth) -> Result<Skin> {
        let (positions, indices) = (cloth.positions().to_vec(), cloth.indices().to_vec());
        Ok(Skin::new(cloth, &SkinDesc { positions, indices, ..SkinDesc::default() })?)
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
    fn calls_on_two_cloths_need_both_and_name_the_other() {
        let (cloth, other) = (small_cloth(), small_cloth());
        let both = |cloth, other| with_two_cloths(cloth, other, |_, _| Ok(()));
        assert_eq!(both(cloth, other), MuslinStatus::Ok);
        assert_eq!(both(cloth, cloth), MuslinStatus::BadValue);
        let status = with_cloth(other, |_| {
            assert_eq!(both(cloth, other), MuslinStatus::Busy);
            assert_eq!(both(other, cloth), MuslinStatus::Busy);
            Ok(())
        });
        assert_eq!(status, MuslinStatus::Ok);
        assert_eq!(
            with_two_cloths(cloth, other, |_, _| panic!("on purpose")),
            MuslinStatus::Panicked
        );
        assert_eq!(both(cloth, other), MuslinStatus::Panicked);
        assert_eq!(destroy(other), MuslinStatus::Ok);
        assert_eq!(both(cloth, other), MuslinStatus::BadHandle);
        assert_eq!(destroy(cloth), MuslinStatus::Ok);
    }

    #[test]
    fn calls_on_a_list_need_all_cloths_and_name_the_index() {
        let cloths = [small_cloth(), small_cloth(), small_cloth()];
        let [first, second, third] = cloths;
        let all = |list: &[MuslinCloth]| run_guarded(|| with_cloths(list, |_| Ok(())));
        let why = || {
            // SAFETY: the message is valid until the next error on this thread.
            unsafe { CStr::from_ptr(last_error()) }.to_str().unwrap().to_owned()
        };
        assert_eq!((all(&cloths), all(&[])), (MuslinStatus::Ok, MuslinStatus::Ok));
        assert_eq!(all(&[first, second, second]), MuslinStatus::BadValue);
        assert_eq!(why(), "`cloths[2]` must be another cloth than `cloths[1]`");
        assert_eq!(all(&[first, MuslinCloth { id: 0 }]), MuslinStatus::BadHandle);
        assert_eq!(why(), "`cloths[1]` must be a live cloth");
        let status = with_cloth(second, |_| {
            assert_eq!(all(&cloths), MuslinStatus::Busy);
            assert_eq!(why(), "`cloths[1]` must not be in use on another thread");
            Ok(())
        });
        assert_eq!((status, all(&cloths)), (MuslinStatus::Ok, MuslinStatus::Ok));
        assert_eq!(with_cloth(third, |_| panic!("on purpose")), MuslinStatus::Panicked);
        assert_eq!(all(&cloths), MuslinStatus::Panicked);
        assert!(why().contains("an earlier call on `cloths[2]`; it"), "{}", why());
        assert_eq!(destroy(third), MuslinStatus::Ok);
        assert_eq!(all(&cloths), MuslinStatus::BadHandle);
        let status = run_guarded(|| with_cloths(&cloths[..2], |_| panic!("on purpose")));
        assert_eq!(status, MuslinStatus::Panicked);
        for cloth in [first, second] {
            assert_eq!(with_cloth(cloth, |_| Ok(())), MuslinStatus::Panicked);
            assert_eq!(destroy(cloth), MuslinStatus::Ok);
        }
    }

    #[test]
    fn a_slot_without_free_generations_is_not_reused() {
        let mut registry = Registry::new();
        let shared = || Arc::new(Mutex::new(None));
        let first = registry.insert(shared(), "another cloth").unwrap();
        registry.remove(first);
        registry.slots[0].generation = u32::MAX;
        let last = registry.insert(shared(), "another cloth").unwrap();
        assert_eq!(last, u64::from(u32::MAX) << 32 | 1);
        registry.remove(last);
        let next = registry.insert(shared(), "another cloth").unwrap();
        assert_eq!(next, 1 << 32 | 2);
        assert!(registry.find(last).is_none() && registry.find(first).is_none());
    }

    #[test]
    fn the_skins_of_a_destroyed_cloth_are_gone() {
        let (cloth, other) = (small_cloth(), small_cloth());
        let skins = [cloth, cloth, other].map(|cloth| insert_skin(cloth, own_skin).unwrap());
        assert_eq!(destroy_skin(skins[0]), MuslinStatus::Ok);
        assert_eq!(destroy_skin(skins[0]), MuslinStatus::BadHandle);
        assert_eq!(with_skin(skins[1], |_, _| Ok(())), MuslinStatus::Ok);
        assert_eq!(destroy(cloth), MuslinStatus::Ok);
        assert_eq!(with_skin(skins[1], |_, _| Ok(())), MuslinStatus::BadHandle);
        assert_eq!(
            insert_skin(cloth, own_skin).map_err(|e| e.status),
            Err(MuslinStatus::BadHandle)
        );
        assert_eq!(with_skin(skins[2], |_, _| Ok(())), MuslinStatus::Ok);
        assert_eq!(destroy(other), MuslinStatus::Ok);
        assert_eq!(destroy_skin(skins[2]), MuslinStatus::BadHandle);
    }

    #[test]
    fn a_skin_of_a_cloth_in_use_is_busy() {
        let cloth = small_cloth();
        let skin = insert_skin(cloth, own_skin).unwrap();
        let status = with_cloth(cloth, |_| {
            assert_eq!(with_skin(skin, |_, _| Ok(())), MuslinStatus::Busy);
            assert_eq!(destroy_skin(skin), MuslinStatus::Busy);
            Ok(())
        });
        assert_eq!(status, MuslinStatus::Ok);
        assert_eq!(destroy(cloth), MuslinStatus::Ok);
    }
}
