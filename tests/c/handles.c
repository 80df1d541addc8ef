/* Handles: stale, made-up and foreign handles are refused and never dereferenced. */
#include "check.h"

static MuslinCloth small_cloth(void) {
  MuslinGridDesc desc;
  MuslinCloth cloth = {0};
  muslin_grid_desc_init(&desc);
  desc.columns = desc.rows = 4;
  DONE(muslin_cloth_create_grid(&desc, &cloth));
  return cloth;
}

static void the_handle_of_a_destroyed_cloth_is_refused(void) {
  MuslinCloth old = small_cloth();
  DONE(muslin_cloth_destroy(old));
  REFUSED(muslin_cloth_destroy(old), MUSLIN_STATUS_BAD_HANDLE, "`cloth` must");
  MuslinCloth young = small_cloth();
  CHECK(young.id != old.id);
  REFUSED(muslin_cloth_step(old, 1), MUSLIN_STATUS_BAD_HANDLE, "`cloth` must");
  DONE(muslin_cloth_step(young, 1));
  DONE(muslin_cloth_destroy(young));
}

static void made_up_handles_are_refused(void) {
  MuslinCloth cloth = small_cloth();
  uint64_t made_up[] = {0, 1, 2, 0xffffffffu, UINT64_MAX, cloth.id + 1, cloth.id - 1,
                        cloth.id + ((uint64_t)1 << 32), cloth.id ^ ((uint64_t)1 << 63)};
  for (size_t i = 0; i < sizeof made_up / sizeof made_up[0]; i++) {
    MuslinCloth none = {0};
    none.id = made_up[i];
    REFUSED(muslin_cloth_step(none, 1), MUSLIN_STATUS_BAD_HANDLE, "`cloth` must");
    REFUSED(muslin_cloth_destroy(none), MUSLIN_STATUS_BAD_HANDLE, "`cloth` must");
  }
  DONE(muslin_cloth_destroy(cloth));
}

static void released_grabs_and_removed_colliders_are_refused(void) {
  MuslinCloth cloth = small_cloth(), other = small_cloth();
  MuslinVec3 here = {0};
  MuslinQuat straight = {0, 0, 0, 1};
  MuslinGrab grab = {0}, no_grab = {0};
  MuslinCollider floor = {0}, no_collider = {0};
  MuslinColliderDesc desc;
  muslin_collider_desc_init(&desc);
  DONE(muslin_cloth_grab_particle(cloth, 5, &grab));
  DONE(muslin_cloth_add_collider(cloth, &desc, &floor));
  CHECK(grab.id != 0 && floor.id != 0);

  REFUSED(muslin_cloth_move_grab(other, grab, here), MUSLIN_STATUS_BAD_HANDLE, "`grab` must");
  REFUSED(muslin_cloth_move_grab(cloth, no_grab, here), MUSLIN_STATUS_BAD_HANDLE, "`grab` must");
  REFUSED(muslin_cloth_remove_collider(other, floor), MUSLIN_STATUS_BAD_HANDLE, "`collider` must");
  REFUSED(muslin_cloth_move_collider(cloth, no_collider, here, straight), MUSLIN_STATUS_BAD_HANDLE,
          "`collider` must");

  DONE(muslin_cloth_move_grab(cloth, grab, here));
  DONE(muslin_cloth_release(cloth, grab));
  REFUSED(muslin_cloth_release(cloth, grab), MUSLIN_STATUS_BAD_HANDLE, "`grab` must");
  DONE(muslin_cloth_move_collider(cloth, floor, here, straight));
  DONE(muslin_cloth_remove_collider(cloth, floor));
  REFUSED(muslin_cloth_remove_collider(cloth, floor), MUSLIN_STATUS_BAD_HANDLE, "`collider` must");
  DONE(muslin_cloth_destroy(cloth));
  DONE(muslin_cloth_destroy(other));
}

static void a_reset_removes_grabs_and_keeps_colliders(void) {
  MuslinCloth cloth = small_cloth();
  MuslinGrab grab = {0};
  MuslinCollider floor = {0};
  MuslinColliderDesc desc;
  muslin_collider_desc_init(&desc);
  DONE(muslin_cloth_grab_particle(cloth, 5, &grab));
  DONE(muslin_cloth_add_collider(cloth, &desc, &floor));
  DONE(muslin_cloth_reset(cloth));
  REFUSED(muslin_cloth_release(cloth, grab), MUSLIN_STATUS_BAD_HANDLE, "`grab` must");
  DONE(muslin_cloth_remove_collider(cloth, floor));
  DONE(muslin_cloth_destroy(cloth));
}

static void a_thousand_cloths_are_created_and_destroyed(void) {
  enum { AT_ONCE = 10, ROUNDS = 100 };
  MuslinCloth cloths[AT_ONCE];
  MuslinCloth first = {0};
  for (int round = 0; round < ROUNDS; round++) {
    for (int i = 0; i < AT_ONCE; i++) {
      cloths[i] = small_cloth();
      for (int j = 0; j < i; j++) CHECK(cloths[i].id != cloths[j].id);
    }
    if (round == 0) first = cloths[0];
    for (int i = 0; i < AT_ONCE; i++) {
      DONE(muslin_cloth_step(cloths[i], 1));
      DONE(muslin_cloth_destroy(cloths[i]));
    }
  }
  REFUSED(muslin_cloth_step(first, 1), MUSLIN_STATUS_BAD_HANDLE, "`cloth` must");
}

int main(void) {
  TEST(the_handle_of_a_destroyed_cloth_is_refused);
  TEST(made_up_handles_are_refused);
  TEST(released_grabs_and_removed_colliders_are_refused);
  TEST(a_reset_removes_grabs_and_keeps_colliders);
  TEST(a_thousand_cloths_are_created_and_destroyed);
  return failures != 0;
}
