/* Sewing and pressure: a sheet sewn to a tube, stitches that tear, a tetrahedron that is inflated. */
#include "check.h"

enum { COLUMNS = 12, ROWS = 6 };

static uint32_t pairs[2 * ROWS];

static MuslinCloth sheet(uint32_t pin_mode) {
  MuslinGridDesc desc;
  MuslinCloth cloth = {0};
  muslin_grid_desc_init(&desc);
  desc.columns = COLUMNS;
  desc.rows = ROWS;
  desc.pin_mode = pin_mode;
  DONE(muslin_cloth_create_grid(&desc, &cloth));
  for (uint32_t row = 0; row < ROWS; row++) {
    pairs[2 * row] = row * COLUMNS;
    pairs[2 * row + 1] = row * COLUMNS + COLUMNS - 1;
  }
  return cloth;
}

static const float *positions_of(MuslinCloth cloth) {
  MuslinView view;
  view.struct_size = sizeof view;
  DONE(muslin_cloth_view(cloth, &view));
  return view.positions;
}

static void sewn_borders_meet_exactly(void) {
  MuslinCloth cloth = sheet(MUSLIN_PIN_NONE);
  MuslinSewDesc desc;
  muslin_sew_desc_init(&desc);
  CHECK(desc.struct_size == sizeof desc && desc.speed == 0.5f);
  CHECK(desc.kind == MUSLIN_SEW_WELD && desc.tear_force == 0.0f);
  desc.speed = 2;
  DONE(muslin_cloth_sew(cloth, NULL, 0, NULL));
  DONE(muslin_cloth_sew(cloth, pairs, ROWS, &desc));
  DONE(muslin_cloth_step(cloth, 60));
  const float *x = positions_of(cloth);
  for (uint32_t row = 0; row < ROWS; row++) {
    CHECK(memcmp(x + 3 * pairs[2 * row], x + 3 * pairs[2 * row + 1], 12) == 0);
  }
  DONE(muslin_cloth_destroy(cloth));
}

static void a_torn_stitch_is_an_event(void) {
  MuslinCloth cloth = sheet(MUSLIN_PIN_TOP_CORNERS);
  MuslinSewDesc desc;
  MuslinEvent event;
  uint32_t some = 1, torn = 0;
  muslin_sew_desc_init(&desc);
  desc.speed = 2;
  desc.kind = MUSLIN_SEW_STITCH;
  desc.tear_force = 1e-4f;
  DONE(muslin_cloth_sew(cloth, pairs + 2, ROWS - 1, &desc));
  DONE(muslin_cloth_step(cloth, 120));
  event.struct_size = sizeof event;
  while (some) {
    DONE(muslin_cloth_next_event(cloth, &event, &some));
    torn += some && event.kind == MUSLIN_EVENT_STITCH_TORN && event.particle_b == event.particle_a + COLUMNS - 1;
  }
  CHECK(torn == ROWS - 1);
  DONE(muslin_cloth_destroy(cloth));
}

static void pressure_inflates_a_closed_mesh(void) {
  static const float corners[] = {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1};
  static const uint32_t faces[] = {0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3};
  MuslinMeshDesc desc;
  MuslinSettings settings;
  MuslinCloth cloth = {0};
  muslin_mesh_desc_init(&desc);
  muslin_settings_init(&settings);
  desc.positions = corners;
  desc.vertex_count = 4;
  desc.indices = faces;
  desc.index_count = 12;
  desc.settings.gravity.y = 0;
  desc.material.stretch_stiffness_warp = desc.material.stretch_stiffness_weft = 100;
  DONE(muslin_cloth_create_mesh(&desc, &cloth));
  DONE(muslin_cloth_get_settings(cloth, &settings));
  CHECK(settings.pressure == 0.0f);
  settings.pressure = 20;
  DONE(muslin_cloth_set_settings(cloth, &settings));
  DONE(muslin_cloth_step(cloth, 120));
  const float *x = positions_of(cloth);
  float edge2 = 0;
  for (int k = 0; k < 3; k++) edge2 += (x[3 + k] - x[k]) * (x[3 + k] - x[k]);
  CHECK(edge2 > 1.02f);
  settings.pressure = 1e30f * 1e30f;
  REFUSED(muslin_cloth_set_settings(cloth, &settings), MUSLIN_STATUS_BAD_VALUE, "`settings.pressure`");
  DONE(muslin_cloth_destroy(cloth));
}

int main(void) {
  TEST(sewn_borders_meet_exactly);
  TEST(a_torn_stitch_is_an_event);
  TEST(pressure_inflates_a_closed_mesh);
  return failures != 0;
}
