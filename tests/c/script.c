/* One script in four languages: tests/golden/tests/golden/script.rs, tests/js/script.mjs,
 * tests/python/test_golden.py.
 * All of them must end in the hash that tests/script.hash holds. */
#include "check.h"
#include <stdbool.h>
#include <stdlib.h>

static const uint64_t golden =
#include "../script.hash"
    ;

/* With an argument the script is played in a tenth of the ticks, for valgrind, and ends in another hash. */
static bool is_short = false;

static uint32_t part_of(uint32_t ticks) {
  return is_short ? ticks / 10 : ticks;
}

static bool is_golden(uint64_t hash) {
  return is_short || hash == golden;
}

static uint64_t hash_of(MuslinCloth cloth) {
  uint64_t hash = 0;
  DONE(muslin_cloth_state_hash(cloth, &hash));
  return hash;
}

static MuslinCloth hang_in_the_wind(void) {
  MuslinGridDesc desc;
  muslin_grid_desc_init(&desc);
  desc.settings.tearing = 1;
  desc.material.tear_stretch = 1.5f;
  MuslinCloth cloth = {0};
  DONE(muslin_cloth_create_grid(&desc, &cloth));

  MuslinWind wind;
  muslin_wind_init(&wind);
  MuslinVec3 velocity = {0.25f, 0.0f, 1.0f};
  wind.velocity = velocity;
  wind.gust = 0.5f;
  wind.wander = 0.25f;
  wind.turbulence = 0.25f;
  wind.seed = 7;
  DONE(muslin_cloth_set_wind(cloth, &wind));

  MuslinColliderDesc floor;
  MuslinCollider collider = {0};
  muslin_collider_desc_init(&floor);
  floor.position.y = -2.5f;
  DONE(muslin_cloth_add_collider(cloth, &floor, &collider));
  CHECK(collider.id != 0);
  DONE(muslin_cloth_step(cloth, part_of(120)));
  return cloth;
}

/* Hangs in the wind, is grabbed and dragged until it tears, is torn by hand, released, cut, falls on the floor,
 * be picked up by a corner: 630 ticks. */
static MuslinCloth play_script(void) {
  MuslinCloth cloth = hang_in_the_wind();
  MuslinVec3 eye = {1.0f, -1.0f, 5.0f}, ahead = {0.0f, 0.0f, -1.0f}, at = {0};
  MuslinGrab grab = {0};
  DONE(muslin_cloth_grab_ray(cloth, eye, ahead, 0.1f, &grab, &at));
  for (uint32_t i = 1; i <= part_of(120); i++) {
    MuslinVec3 target = at;
    target.x += 0.015625f * (float)i;
    target.z += 0.03125f * (float)i;
    DONE(muslin_cloth_move_grab(cloth, grab, target));
    DONE(muslin_cloth_step(cloth, 1));
  }
  DONE(muslin_cloth_tear_edge(cloth, 820, 860));
  DONE(muslin_cloth_release(cloth, grab));
  DONE(muslin_cloth_step(cloth, part_of(180)));
  MuslinVec3 from = {-1.0f, -0.59375f, -9.0f}, to = {3.0f, -0.78125f, -9.0f}, sweep = {0.0f, 0.0f, 18.0f};
  uint32_t edges = 0;
  DONE(muslin_cloth_cut(cloth, from, to, sweep, &edges));
  CHECK(edges > 40);
  DONE(muslin_cloth_step(cloth, part_of(30)));

  DONE(muslin_cloth_unpin_all(cloth));
  DONE(muslin_cloth_step(cloth, part_of(120)));
  MuslinVec3 corner = {0.0f, 0.0f, 0.5f};
  uint32_t ticks = 0;
  DONE(muslin_cloth_pin(cloth, 0, &corner));
  DONE(muslin_cloth_step(cloth, part_of(59)));
  DONE(muslin_cloth_advance(cloth, 1.0f / 60.0f, &ticks));
  CHECK(ticks == 1);
  return cloth;
}

static void the_script_ends_in_the_golden_hash(void) {
  MuslinCloth cloth = play_script();
  MuslinEvent event;
  muslin_event_init(&event);
  int torn = 0;
  for (uint32_t some = 1; some != 0;) {
    DONE(muslin_cloth_next_event(cloth, &event, &some));
    torn += some != 0 && event.kind == MUSLIN_EVENT_EDGE_TORN;
  }
  CHECK(is_short || torn >= 10);
  uint64_t hash = hash_of(cloth);
  if (!is_golden(hash)) {
    fprintf(stderr, "hash is 0x%08lx%08lx\n", (unsigned long)(hash >> 32),
            (unsigned long)(hash & 0xffffffffu));
  }
  CHECK(is_golden(hash));
  DONE(muslin_cloth_destroy(cloth));
}

static void a_restored_cloth_continues_with_the_same_bits(void) {
  MuslinCloth straight = play_script(), restored = {0};
  size_t needed = 0, written = 0;
  DONE(muslin_cloth_save(straight, NULL, 0, &needed));
  void *bytes = malloc(needed);
  if (bytes == NULL) {
    CHECK(bytes != NULL);
    return;
  }
  DONE(muslin_cloth_save(straight, bytes, needed, &written));
  CHECK(written == needed);
  DONE(muslin_cloth_restore(bytes, needed, &restored));
  free(bytes);
  CHECK(restored.id != straight.id);
  CHECK(hash_of(restored) == hash_of(straight));
  for (int i = 0; i < 2; i++) {
    MuslinCloth cloth = i == 0 ? straight : restored;
    DONE(muslin_cloth_step(cloth, part_of(60)));
    DONE(muslin_cloth_tear_edge(cloth, 400, 401));
    DONE(muslin_cloth_step(cloth, part_of(60)));
  }
  CHECK(hash_of(restored) == hash_of(straight));
  CHECK(hash_of(restored) != golden);
  DONE(muslin_cloth_destroy(straight));
  DONE(muslin_cloth_destroy(restored));
}

static void a_duplicate_and_a_list_continue_with_the_same_bits(void) {
  MuslinCloth cloths[3] = {play_script()};
  DONE(muslin_cloth_duplicate(cloths[0], &cloths[1]));
  DONE(muslin_cloth_duplicate(cloths[1], &cloths[2]));
  CHECK(cloths[1].id != cloths[0].id && is_golden(hash_of(cloths[1])));
  uint32_t ticks[3] = {7, 7, 7}, alone = 0;
  DONE(muslin_cloths_advance(cloths, 2, 0.04f, ticks));
  CHECK(ticks[0] == 2 && ticks[1] == 2 && ticks[2] == 7);
  CHECK(hash_of(cloths[1]) == hash_of(cloths[0]) && is_golden(hash_of(cloths[2])));
  DONE(muslin_cloth_advance(cloths[2], 0.04f, &alone));
  CHECK(alone == 2 && hash_of(cloths[2]) == hash_of(cloths[0]));
  DONE(muslin_cloths_advance(NULL, 0, 0.04f, NULL));
  for (int i = 0; i < 3; i++) DONE(muslin_cloth_destroy(cloths[i]));
}

int main(int count, char **arguments) {
  (void)arguments;
  is_short = count > 1;
  TEST(the_script_ends_in_the_golden_hash);
  TEST(a_restored_cloth_continues_with_the_same_bits);
  TEST(a_duplicate_and_a_list_continue_with_the_same_bits);
  return failures != 0;
}
