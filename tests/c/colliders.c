/* Colliders: invalid ones are refused by field and change nothing; cloth sleeps on valid ones. */
#include "check.h"
#include <math.h>

#define BAD_VALUE MUSLIN_STATUS_BAD_VALUE

static MuslinCloth cloth; /* the cloth of all tests in this file */
static const MuslinVec3 zero = {0, 0, 0};

static MuslinVec3 with_nan(void) {
  MuslinVec3 v = {0, NAN, 0};
  return v;
}

static void make_cloth(float sleep_speed) {
  MuslinGridDesc desc;
  muslin_grid_desc_init(&desc);
  desc.columns = desc.rows = 12;
  desc.pin_mode = MUSLIN_PIN_NONE;
  desc.down.y = 0;
  desc.down.z = 1;
  desc.settings.sleep_speed = sleep_speed;
  DONE(muslin_cloth_create_grid(&desc, &cloth));
}

static void colliders_are_refused_by_field(void) {
  make_cloth(0);
  uint64_t before = 0, after = 1;
  DONE(muslin_cloth_state_hash(cloth, &before));
  MuslinColliderDesc desc;
  MuslinCollider collider = {7};
  MuslinQuat none = {0, 0, 0, 0}, straight = {0, 0, 0, 1};
  muslin_collider_desc_init(&desc);
  desc.shape = 77;
  REFUSED(muslin_cloth_add_collider(cloth, &desc, &collider), MUSLIN_STATUS_UNSUPPORTED, "shape");
  muslin_collider_desc_init(&desc);
  desc.rotation = none;
  REFUSED(muslin_cloth_add_collider(cloth, &desc, &collider), BAD_VALUE, "rotation`");
  muslin_collider_desc_init(&desc);
  desc.friction = -2;
  REFUSED(muslin_cloth_add_collider(cloth, &desc, &collider), BAD_VALUE, "friction`");
  desc.friction = -1;
  desc.thickness = -2;
  REFUSED(muslin_cloth_add_collider(cloth, &desc, &collider), BAD_VALUE, "thickness`");
  desc.thickness = -1;
  desc.shape = MUSLIN_SHAPE_SPHERE;
  desc.radius = 0;
  REFUSED(muslin_cloth_add_collider(cloth, &desc, &collider), BAD_VALUE, "radius`");
  desc.shape = MUSLIN_SHAPE_BOX;
  desc.half_extents.z = -1;
  REFUSED(muslin_cloth_add_collider(cloth, &desc, &collider), BAD_VALUE, "half_extents`");
  const float flat[] = {0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0};
  desc.shape = MUSLIN_SHAPE_CONVEX;
  REFUSED(muslin_cloth_add_collider(cloth, &desc, &collider), BAD_VALUE, "`vertex_count`");
  desc.vertex_count = 4;
  REFUSED(muslin_cloth_add_collider(cloth, &desc, &collider), BAD_VALUE, "`positions`");
  desc.positions = flat;
  REFUSED(muslin_cloth_add_collider(cloth, &desc, &collider), BAD_VALUE, "positions`");
  const uint32_t indices[] = {0, 1, 4};
  desc.shape = MUSLIN_SHAPE_MESH;
  REFUSED(muslin_cloth_add_collider(cloth, &desc, &collider), BAD_VALUE, "`index_count`");
  desc.index_count = 3;
  REFUSED(muslin_cloth_add_collider(cloth, &desc, &collider), BAD_VALUE, "`indices`");
  desc.indices = indices;
  REFUSED(muslin_cloth_add_collider(cloth, &desc, &collider), MUSLIN_STATUS_BAD_INDEX, "indices`");
  desc.shape = MUSLIN_SHAPE_HEIGHTFIELD;
  REFUSED(muslin_cloth_add_collider(cloth, &desc, &collider), BAD_VALUE, "`columns`");
  desc.columns = desc.rows = 2;
  REFUSED(muslin_cloth_add_collider(cloth, &desc, &collider), BAD_VALUE, "`heights`");
  desc.shape = MUSLIN_SHAPE_PLANE;
  desc.position.y = -50;
  CHECK(collider.id == 7);
  DONE(muslin_cloth_add_collider(cloth, &desc, &collider));
  REFUSED(muslin_cloth_move_collider(cloth, collider, with_nan(), straight), BAD_VALUE, "position`");
  REFUSED(muslin_cloth_move_collider(cloth, collider, zero, none), BAD_VALUE, "rotation`");
  MuslinVec3 linear = with_nan(), angular = with_nan();
  DONE(muslin_cloth_get_collider_impulse(cloth, collider, NULL, NULL));
  DONE(muslin_cloth_get_collider_impulse(cloth, collider, &linear, &angular));
  CHECK(linear.x == 0 && angular.y == 0);
  DONE(muslin_cloth_remove_collider(cloth, collider));
  REFUSED(muslin_cloth_get_collider_impulse(cloth, collider, &linear, NULL), MUSLIN_STATUS_BAD_HANDLE,
          "collider");
  DONE(muslin_cloth_state_hash(cloth, &after));
  CHECK(before == after);
  DONE(muslin_cloth_destroy(cloth));
}

static void a_cloth_on_a_floor_falls_asleep_and_wakes_when_the_floor_moves(void) {
  make_cloth(0.01f);
  MuslinColliderDesc desc;
  MuslinCollider floor = {0};
  MuslinStats stats;
  MuslinView view;
  MuslinQuat straight = {0, 0, 0, 1};
  muslin_collider_desc_init(&desc);
  muslin_stats_init(&stats);
  muslin_view_init(&view);
  desc.position.y = -0.25f;
  DONE(muslin_cloth_add_collider(cloth, &desc, &floor));
  DONE(muslin_cloth_step(cloth, 10));
  DONE(muslin_cloth_get_stats(cloth, &stats));
  CHECK(stats.asleep == 0);
  DONE(muslin_cloth_step(cloth, 600));
  DONE(muslin_cloth_get_stats(cloth, &stats));
  CHECK(stats.asleep == 1 && stats.ticks == 610);
  DONE(muslin_cloth_view(cloth, &view));
  const uint32_t revision = view.state_revision;
  DONE(muslin_cloth_step(cloth, 10));
  DONE(muslin_cloth_view(cloth, &view));
  CHECK(view.state_revision == revision);
  desc.position.y = -0.125f;
  DONE(muslin_cloth_move_collider(cloth, floor, desc.position, straight));
  DONE(muslin_cloth_step(cloth, 1));
  DONE(muslin_cloth_get_stats(cloth, &stats));
  CHECK(stats.asleep == 0);
  DONE(muslin_cloth_destroy(cloth));
}

static void a_fast_collider_adds_substeps_and_stats_tell_their_number(void) {
  make_cloth(0.0f);
  MuslinColliderDesc desc;
  MuslinCollider floor = {0};
  MuslinStats stats;
  MuslinQuat straight = {0, 0, 0, 1};
  muslin_collider_desc_init(&desc);
  muslin_stats_init(&stats);
  desc.position.y = -8.0f;
  DONE(muslin_cloth_add_collider(cloth, &desc, &floor));
  DONE(muslin_cloth_step(cloth, 1));
  DONE(muslin_cloth_get_stats(cloth, &stats));
  CHECK(stats.substeps == 4);
  desc.position.y = 1.0f;
  DONE(muslin_cloth_move_collider(cloth, floor, desc.position, straight));
  DONE(muslin_cloth_step(cloth, 1));
  DONE(muslin_cloth_get_stats(cloth, &stats));
  CHECK(stats.substeps == 32);
  DONE(muslin_cloth_destroy(cloth));
}

int main(void) {
  TEST(colliders_are_refused_by_field);
  TEST(a_cloth_on_a_floor_falls_asleep_and_wakes_when_the_floor_moves);
  TEST(a_fast_collider_adds_substeps_and_stats_tell_their_number);
  return failures != 0;
}
