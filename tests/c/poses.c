/* Whole poses at once, and cheap questions. */
#include "check.h"
#include <math.h>

static MuslinCloth cloth; /* the cloth of all tests in this file: 8 x 6 particles */

static uint64_t hash_of(MuslinCloth of) {
  uint64_t hash = 0;
  DONE(muslin_cloth_state_hash(of, &hash));
  return hash;
}

static void a_pose_is_set_with_any_stride_and_has_the_bits_of_single_calls(void) {
  struct { float x[3], v[3]; uint32_t mark; } vertices[48];
  const uint32_t stride = sizeof vertices[0];
  for (uint32_t i = 0; i < 48; i++) {
    const float x[] = {(float)(i % 8) * 0.05f, (float)(i / 8) * -0.05f, 0.1f * sinf((float)i)};
    const float v[] = {0.1f, (float)i * 0.01f, -1};
    memcpy(vertices[i].x, x, sizeof x);
    memcpy(vertices[i].v, v, sizeof v);
    vertices[i].mark = i;
  }
  DONE(muslin_cloth_set_positions(cloth, 0, 48, vertices[0].x, stride));
  DONE(muslin_cloth_set_velocities(cloth, 0, 48, vertices[0].v, stride));
  MuslinView view;
  muslin_view_init(&view);
  DONE(muslin_cloth_view(cloth, &view));
  for (uint32_t i = 0; i < 48; i++) CHECK(memcmp(view.positions + 3 * i, vertices[i].x, 12) == 0);
  const uint64_t bulk = hash_of(cloth);
  for (uint32_t i = 0; i < 48; i++) {
    const MuslinVec3 x = {vertices[i].x[0], vertices[i].x[1], vertices[i].x[2]};
    DONE(muslin_cloth_set_position(cloth, i, x));
  }
  for (uint32_t i = 0; i < 48; i++) {
    const MuslinVec3 v = {vertices[i].v[0], vertices[i].v[1], vertices[i].v[2]};
    DONE(muslin_cloth_set_velocity(cloth, i, v));
  }
  CHECK(hash_of(cloth) == bulk);
  memset(vertices[20].v, 0, 12);
  DONE(muslin_cloth_get_velocities(cloth, 20, 28, vertices[20].v, stride));
  for (uint32_t i = 0; i < 48; i++) CHECK(vertices[i].v[1] == (float)i * 0.01f && vertices[i].mark == i);
  float packed[6];
  DONE(muslin_cloth_get_velocities(cloth, 46, 2, packed, 0));
  CHECK(packed[1] == 46 * 0.01f && packed[4] == 47 * 0.01f);
  DONE(muslin_cloth_get_rest_positions(cloth, 46, 2, packed, 0));
  CHECK(packed[2] == 0 && packed[5] == 0 && packed[3] > packed[0] && packed[4] == packed[1]);
  DONE(muslin_cloth_set_positions(cloth, 48, 0, NULL, 0));
  DONE(muslin_cloth_get_velocities(cloth, 0, 0, NULL, 0));
}

static void pins_are_counted_then_read_with_their_targets(void) {
  uint32_t count = 7, pins[9] = {99, 99, 99, 99, 99, 99, 99, 99, 99};
  DONE(muslin_cloth_get_pins(cloth, NULL, 0, &count));
  CHECK(count == 8);
  REFUSED(muslin_cloth_get_pins(cloth, pins, 7, &count), MUSLIN_STATUS_BUFFER_TOO_SMALL, "at least 8");
  CHECK(pins[0] == 99);
  DONE(muslin_cloth_get_pins(cloth, pins, 9, &count));
  CHECK(count == 8 && pins[0] == 0 && pins[7] == 7 && pins[8] == 99);
  const MuslinVec3 target = {1, 2, 3};
  DONE(muslin_cloth_pin(cloth, 7, &target));
  float targets[2][4] = {{9, 9, 9, 9}, {9, 9, 9, 9}};
  DONE(muslin_cloth_get_pin_targets(cloth, pins + 6, targets[0], sizeof targets[0], 2));
  CHECK(targets[1][0] == 1 && targets[1][1] == 2 && targets[1][2] == 3 && targets[1][3] == 9);
  DONE(muslin_cloth_unpin_all(cloth));
  DONE(muslin_cloth_get_pins(cloth, pins, 1, &count));
  CHECK(count == 0);
}

static void cheap_questions_have_the_answers_of_the_statistics(void) {
  MuslinWind wind, read;
  muslin_wind_init(&wind);
  muslin_wind_init(&read);
  wind.velocity.z = 2;
  wind.gust = 0.5f;
  wind.seed = 11;
  wind.model = MUSLIN_WIND_SINE_FIELD;
  DONE(muslin_cloth_set_wind(cloth, &wind));
  DONE(muslin_cloth_get_wind(cloth, &read));
  CHECK(memcmp(&wind, &read, sizeof wind) == 0);
  DONE(muslin_cloth_reset(cloth));
  DONE(muslin_cloth_advance(cloth, 0.04f, NULL));
  MuslinStats stats;
  muslin_stats_init(&stats);
  DONE(muslin_cloth_get_stats(cloth, &stats));
  float blend = 7, total = 0;
  double seconds = 0;
  uint64_t ticks = 0;
  uint32_t asleep = 7;
  MuslinVec3 center = {9, 9, 9}, momentum = {9, 9, 9};
  DONE(muslin_cloth_get_blend(cloth, &blend));
  DONE(muslin_cloth_get_time(cloth, &seconds, &ticks));
  DONE(muslin_cloth_is_asleep(cloth, &asleep));
  DONE(muslin_cloth_get_mass(cloth, &total, &center, &momentum));
  CHECK(blend == stats.blend && blend > 0.39f && ticks == 2 && asleep == stats.asleep && asleep == 0);
  CHECK(fabs(seconds - 2.0 / 60) < 1e-6);
  MuslinMaterial material;
  muslin_material_init(&material);
  DONE(muslin_cloth_get_material(cloth, &material));
  CHECK(fabsf(total / (material.density * 7 * 5 * 0.0025f) - 1) < 1e-4f);
  CHECK(fabsf(center.x - 7 * 0.025f) < 0.01f && fabsf(center.y + 5 * 0.025f) < 0.01f);
  static const float down[3 * 48] = {[3 * 11 + 1] = -2, [3 * 12 + 1] = -2};
  DONE(muslin_cloth_set_velocities(cloth, 0, 48, down, 0));
  DONE(muslin_cloth_get_mass(cloth, NULL, NULL, &momentum));
  CHECK(momentum.x == 0 && fabsf(momentum.y + 4 * total / 35) < 1e-5f * total && momentum.z == 0);
  DONE(muslin_cloth_get_time(cloth, NULL, NULL));
  DONE(muslin_cloth_get_mass(cloth, NULL, NULL, NULL));
}

static void a_collider_is_where_its_last_tick_took_it(void) {
  MuslinColliderDesc floor;
  MuslinCollider collider = {0};
  muslin_collider_desc_init(&floor);
  floor.position.y = -3;
  DONE(muslin_cloth_add_collider(cloth, &floor, &collider));
  const MuslinVec3 lower = {0, -4, 0};
  const MuslinQuat straight = {0, 0, 0, 1};
  MuslinVec3 position = {0, 0, 0};
  MuslinQuat rotation = {9, 9, 9, 9};
  DONE(muslin_cloth_move_collider(cloth, collider, lower, straight));
  DONE(muslin_cloth_get_collider_pose(cloth, collider, &position, NULL));
  CHECK(position.y == -3);
  DONE(muslin_cloth_step(cloth, 1));
  DONE(muslin_cloth_get_collider_pose(cloth, collider, &position, &rotation));
  CHECK(position.y == -4 && rotation.x == 0 && rotation.w == 1);
}

static void a_mesh_reaches_new_vertices(void) {
  const float flat[5][3] = {{-9, -9, -9}, {9, -9, -9}, {9, -9, 9}, {-9, -9, 9}, {0, 0, 0}};
  float raised[4][4] = {{0}};
  const uint32_t indices[] = {0, 2, 1, 0, 3, 2};
  MuslinColliderDesc desc;
  muslin_collider_desc_init(&desc);
  desc.shape = MUSLIN_SHAPE_MESH;
  desc.positions = flat[0];
  desc.vertex_count = 4;
  desc.indices = indices;
  desc.index_count = 6;
  MuslinCollider body;
  DONE(muslin_cloth_add_collider(cloth, &desc, &body));
  for (int v = 0; v < 4; v++) {
    memcpy(raised[v], flat[v], 12);
    raised[v][1] = -8;
  }
  const uint64_t before = hash_of(cloth);
  REFUSED(muslin_cloth_update_collider(cloth, body, raised[0], 16, 5), MUSLIN_STATUS_BAD_VALUE,
          "`count` must be the number of vertices");
  REFUSED(muslin_cloth_update_collider(cloth, body, raised[0], 10, 4), MUSLIN_STATUS_BAD_VALUE, "`stride`");
  CHECK(hash_of(cloth) == before);
  /* The plate rises past the lowest particle in a tick, and takes it along. */
  MuslinView view;
  muslin_view_init(&view);
  DONE(muslin_cloth_view(cloth, &view));
  const float lowest = view.positions[3 * 47 + 1];
  for (int v = 0; v < 4; v++) raised[v][1] = lowest + 0.02f;
  DONE(muslin_cloth_update_collider(cloth, body, raised[0], 16, 4));
  DONE(muslin_cloth_step(cloth, 1));
  DONE(muslin_cloth_view(cloth, &view));
  CHECK(view.positions[3 * 47 + 1] > lowest + 0.02f);
  DONE(muslin_cloth_remove_collider(cloth, body));
}

static MuslinCloth sheet(float height, float spacing, uint32_t pin_mode) {
  MuslinGridDesc desc;
  MuslinCloth made = {0};
  muslin_grid_desc_init(&desc);
  desc.columns = desc.rows = 7;
  desc.spacing = spacing;
  desc.pin_mode = pin_mode;
  desc.origin.x = desc.origin.z = -3 * spacing;
  desc.origin.y = height;
  desc.down.y = 0;
  desc.down.z = 1;
  DONE(muslin_cloth_create_grid(&desc, &made));
  return made;
}

static float mean_height(MuslinCloth of) {
  MuslinVec3 center;
  DONE(muslin_cloth_get_mass(of, NULL, &center, NULL));
  return center.y;
}

static void a_sheet_lies_on_another_one(void) {
  MuslinCloth inner = sheet(0, 0.1f, MUSLIN_PIN_CORNERS), outer = sheet(0.02f, 0.04f, MUSLIN_PIN_NONE);
  MuslinCollider layer = {0}, first = {0};
  for (int tick = 0; tick < 90; tick++) {
    if (tick == 60) DONE(muslin_cloth_tear_edge(inner, 0, 7));
    DONE(muslin_cloth_step(inner, 1));
    DONE(muslin_cloth_collide_with(outer, inner, &layer));
    DONE(muslin_cloth_step(outer, 1));
    if (tick == 0) first = layer;
  }
  CHECK(layer.id != 0 && layer.id == first.id);
  CHECK(mean_height(outer) > mean_height(inner) && mean_height(outer) > -0.5f);
  DONE(muslin_cloth_destroy(inner));
  REFUSED(muslin_cloth_collide_with(outer, inner, &layer), MUSLIN_STATUS_BAD_HANDLE, "`other` must be a live cloth");
  DONE(muslin_cloth_destroy(outer));
}

static void a_painted_map_scales_the_drag_until_it_is_taken_away(void) {
  static const uint32_t maps[] = {MUSLIN_MAP_STRETCH,  MUSLIN_MAP_BEND,      MUSLIN_MAP_TEAR,
                                  MUSLIN_MAP_FRICTION, MUSLIN_MAP_THICKNESS, MUSLIN_MAP_DRAG};
  MuslinWind wind;
  muslin_wind_init(&wind);
  wind.velocity.z = 2;
  DONE(muslin_cloth_set_wind(cloth, &wind));
  float scales[48], pushed[2] = {0, 0};
  for (uint32_t i = 0; i < 48; i++) scales[i] = i % 8 < 4 ? 0.25f : 1;
  DONE(muslin_cloth_reset(cloth));
  const uint64_t before = hash_of(cloth);
  for (int i = 0; i < 6; i++) {
    DONE(muslin_cloth_set_map(cloth, maps[i], scales, 48));
    CHECK(hash_of(cloth) != before);
    if (maps[i] == MUSLIN_MAP_DRAG) break;
    DONE(muslin_cloth_set_map(cloth, maps[i], NULL, 7));
    CHECK(hash_of(cloth) == before);
  }
  float read[48];
  uint32_t is_set = 7;
  DONE(muslin_cloth_get_map(cloth, MUSLIN_MAP_DRAG, read, 48, &is_set));
  CHECK(is_set == 1 && memcmp(read, scales, sizeof read) == 0);
  DONE(muslin_cloth_get_map(cloth, MUSLIN_MAP_TEAR, read, 48, &is_set));
  CHECK(is_set == 0 && read[0] == 1 && read[47] == 1);
  DONE(muslin_cloth_unpin_all(cloth));
  DONE(muslin_cloth_step(cloth, 1));
  float v[3 * 48];
  DONE(muslin_cloth_get_velocities(cloth, 0, 48, v, 0));
  for (uint32_t i = 0; i < 48; i++) pushed[i % 8 < 4] += v[3 * i + 2];
  CHECK(pushed[0] > 0.01f && pushed[1] < 0.5f * pushed[0]);
  DONE(muslin_cloth_set_map(cloth, MUSLIN_MAP_DRAG, NULL, 0));
}

int main(void) {
  MuslinGridDesc desc;
  muslin_grid_desc_init(&desc);
  desc.columns = 8;
  desc.rows = 6;
  desc.spacing = 0.05f;
  DONE(muslin_cloth_create_grid(&desc, &cloth));
  TEST(a_pose_is_set_with_any_stride_and_has_the_bits_of_single_calls);
  TEST(pins_are_counted_then_read_with_their_targets);
  TEST(cheap_questions_have_the_answers_of_the_statistics);
  TEST(a_collider_is_where_its_last_tick_took_it);
  TEST(a_mesh_reaches_new_vertices);
  TEST(a_sheet_lies_on_another_one);
  TEST(a_painted_map_scales_the_drag_until_it_is_taken_away);
  DONE(muslin_cloth_destroy(cloth));
  return failures != 0;
}
