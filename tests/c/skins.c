/* Skins: a fine mesh on a coarse cloth, its view, its streams, tears and handles. */
#include "check.h"

enum { SIDE = 31, COUNT = SIDE * SIDE, INDICES = 6 * (SIDE - 1) * (SIDE - 1) };

/* A sheet as large as the default grid: 1.95 m x 1.95 m, in the plane z = 0. */
static float positions[4 * COUNT], uvs[2 * COUNT];
static uint32_t indices[INDICES];

static MuslinSkinDesc sheet_desc(void) {
  MuslinSkinDesc desc;
  muslin_skin_desc_init(&desc);
  CHECK(desc.struct_size == sizeof desc && desc.smoothness == 1.0f);
  for (uint32_t i = 0; i < COUNT; i++) {
    uvs[2 * i] = (float)(i % SIDE) / (SIDE - 1);
    uvs[2 * i + 1] = (float)(i / SIDE) / (SIDE - 1);
    positions[4 * i] = 1.95f * uvs[2 * i];
    positions[4 * i + 1] = -1.95f * uvs[2 * i + 1];
    positions[4 * i + 2] = 0;
    positions[4 * i + 3] = -99;
  }
  uint32_t *out = indices;
  for (uint32_t row = 0; row + 1 < SIDE; row++) {
    for (uint32_t column = 0; column + 1 < SIDE; column++) {
      uint32_t a = row * SIDE + column;
      uint32_t quad[] = {a, a + SIDE, a + 1, a + 1, a + SIDE, a + SIDE + 1};
      memcpy(out, quad, sizeof quad);
      out += 6;
    }
  }
  desc.positions = positions;
  desc.stride = 16;
  desc.vertex_count = COUNT;
  desc.indices = indices;
  desc.index_count = INDICES;
  desc.uvs = uvs;
  return desc;
}

static MuslinCloth coarse_cloth(void) {
  MuslinGridDesc desc;
  MuslinCloth cloth = {0};
  muslin_grid_desc_init(&desc);
  desc.columns = desc.rows = 14;
  desc.spacing = 0.15f;
  DONE(muslin_cloth_create_grid(&desc, &cloth));
  return cloth;
}

static float distance(const float *a, const float *b) {
  float squared = 0;
  for (int k = 0; k < 3; k++) squared += (a[k] - b[k]) * (a[k] - b[k]);
  return squared;
}

static void a_skin_follows_its_cloth(void) {
  MuslinCloth cloth = coarse_cloth();
  MuslinSkinDesc desc = sheet_desc();
  MuslinSkin skin = {0};
  MuslinView view, before;
  muslin_view_init(&view);
  DONE(muslin_skin_create(cloth, &desc, &skin));
  CHECK(skin.id != 0);
  DONE(muslin_skin_view(skin, &view));
  CHECK(view.vertex_count == COUNT && view.index_count == INDICES && view.particles == NULL);
  CHECK(view.index_capacity == INDICES && view.vertex_capacity >= COUNT);
  CHECK(memcmp(view.indices, indices, sizeof indices) == 0);
  CHECK(memcmp(view.uvs, uvs, sizeof uvs) == 0);
  for (uint32_t i = 0; i < COUNT; i++) {
    CHECK(distance(view.positions + 3 * i, positions + 4 * i) < 1e-10f);
    CHECK(view.source_vertices[i] == i && view.frayed[i] == 0);
  }
  before = view;
  DONE(muslin_cloth_unpin_all(cloth));
  DONE(muslin_cloth_step(cloth, 30));
  DONE(muslin_skin_view(skin, &view));
  CHECK(view.state_revision != before.state_revision);
  CHECK(view.topology_revision == before.topology_revision);
  CHECK(view.positions[3 * (COUNT - 1) + 1] != positions[4 * (COUNT - 1) + 1]);

  static float written[8 * COUNT];
  MuslinStream streams[2];
  streams[0] = muslin_stream(MUSLIN_ATTRIBUTE_POSITION, MUSLIN_FORMAT_F32, written, 32, sizeof written);
  streams[1] = muslin_stream(MUSLIN_ATTRIBUTE_TANGENT, MUSLIN_FORMAT_F32, written + 4, 32,
                             sizeof written - 16);
  DONE(muslin_skin_write_vertices(skin, streams, 2, NULL));
  DONE(muslin_skin_view(skin, &view));
  for (uint32_t i = 0; i < COUNT; i++) {
    const float *tangent = written + 8 * i + 4, zero[3] = {0};
    CHECK(memcmp(written + 8 * i, view.positions + 3 * i, 12) == 0);
    CHECK(distance(tangent, zero) > 0.999f && distance(tangent, zero) < 1.001f);
  }
  /* Buffers of the library are refused. */
  streams[0].buffer = (void *)(uintptr_t)view.positions;
  REFUSED(muslin_skin_write_vertices(skin, streams, 1, NULL), MUSLIN_STATUS_BAD_VALUE, "streams[0]");
  streams[0] = muslin_stream(MUSLIN_ATTRIBUTE_POSITION, MUSLIN_FORMAT_F32, written, 0, 12);
  REFUSED(muslin_skin_write_vertices(skin, streams, 1, NULL), MUSLIN_STATUS_BUFFER_TOO_SMALL,
          "streams[0].size");
  DONE(muslin_skin_destroy(skin));
  DONE(muslin_cloth_destroy(cloth));
}

static void a_cut_adds_vertices_and_a_reset_removes_them(void) {
  MuslinCloth cloth = coarse_cloth();
  MuslinSkinDesc desc = sheet_desc();
  MuslinSkin skin = {0};
  MuslinView view;
  MuslinVec3 from = {0.52f, -0.4f, -1}, to = {0.6f, -1.5f, -1}, sweep = {0, 0, 2};
  muslin_view_init(&view);
  DONE(muslin_skin_create(cloth, &desc, &skin));
  DONE(muslin_skin_view(skin, &view));
  uint32_t revision = view.topology_revision, frayed = 0;
  DONE(muslin_cloth_cut(cloth, from, to, sweep, NULL));
  DONE(muslin_skin_view(skin, &view));
  CHECK(view.vertex_count > COUNT && view.vertex_count <= view.vertex_capacity);
  CHECK(view.index_count == INDICES && view.topology_revision != revision);
  for (uint32_t i = 0; i < view.vertex_count; i++) {
    CHECK(view.source_vertices[i] < COUNT);
    frayed += view.frayed[i];
  }
  CHECK(frayed > 0);
  DONE(muslin_cloth_reset(cloth));
  DONE(muslin_skin_view(skin, &view));
  CHECK(view.vertex_count == COUNT && memcmp(view.indices, indices, sizeof indices) == 0);
  DONE(muslin_cloth_destroy(cloth));
}

static void wrong_descriptors_are_refused(void) {
  MuslinCloth cloth = coarse_cloth(), none = {0};
  MuslinSkin skin = {77};
  MuslinSkinDesc good = sheet_desc(), bad = good;
  MuslinStatus value = MUSLIN_STATUS_BAD_VALUE;
  REFUSED(muslin_skin_create(cloth, NULL, &skin), value, "`desc`");
  REFUSED(muslin_skin_create(cloth, &good, NULL), value, "`out_skin`");
  REFUSED(muslin_skin_create(none, &good, &skin), MUSLIN_STATUS_BAD_HANDLE, "`cloth`");
  bad.struct_size = 0;
  REFUSED(muslin_skin_create(cloth, &bad, &skin), value, "muslin_skin_desc_init");
  bad = good, bad.positions = NULL;
  REFUSED(muslin_skin_create(cloth, &bad, &skin), value, "`positions`");
  bad = good, bad.stride = 10;
  REFUSED(muslin_skin_create(cloth, &bad, &skin), value, "`stride`");
  bad = good, bad.vertex_count = 2;
  REFUSED(muslin_skin_create(cloth, &bad, &skin), value, "`vertex_count`");
  bad = good, bad.indices = NULL;
  REFUSED(muslin_skin_create(cloth, &bad, &skin), value, "`indices`");
  bad = good, bad.index_count = 4;
  REFUSED(muslin_skin_create(cloth, &bad, &skin), value, "`index_count`");
  bad = good, bad.vertex_count = COUNT - 1;
  REFUSED(muslin_skin_create(cloth, &bad, &skin), MUSLIN_STATUS_BAD_INDEX, "`indices`");
  bad = good, bad.smoothness = 2;
  REFUSED(muslin_skin_create(cloth, &bad, &skin), value, "`smoothness`");
  positions[2] = 9;
  REFUSED(muslin_skin_create(cloth, &good, &skin), value, "`positions` must be within half");
  CHECK(skin.id == 77);
  DONE(muslin_cloth_destroy(cloth));
}

static void skins_end_with_their_cloth_and_stale_handles_are_refused(void) {
  MuslinCloth cloth = coarse_cloth(), other = coarse_cloth();
  MuslinSkinDesc desc = sheet_desc();
  MuslinSkin one = {0}, two = {0}, foreign = {0};
  MuslinView view;
  MuslinStatus bad = MUSLIN_STATUS_BAD_HANDLE;
  muslin_view_init(&view);
  DONE(muslin_skin_create(cloth, &desc, &one));
  DONE(muslin_skin_create(cloth, &desc, &two));
  DONE(muslin_skin_create(other, &desc, &foreign));
  CHECK(one.id != two.id && two.id != foreign.id);
  DONE(muslin_skin_destroy(one));
  REFUSED(muslin_skin_destroy(one), bad, "`skin` must");
  REFUSED(muslin_skin_view(one, &view), bad, "`skin` must");
  DONE(muslin_skin_view(two, &view));
  uint64_t made_up[] = {0, 1, UINT64_MAX, two.id + 99, two.id + ((uint64_t)1 << 32)};
  for (size_t i = 0; i < sizeof made_up / sizeof made_up[0]; i++) {
    MuslinSkin none = {0};
    none.id = made_up[i];
    REFUSED(muslin_skin_view(none, &view), bad, "`skin` must");
    REFUSED(muslin_skin_write_vertices(none, NULL, 1, NULL), bad, "`skin` must");
    REFUSED(muslin_skin_destroy(none), bad, "`skin` must");
  }
  DONE(muslin_cloth_destroy(cloth));
  REFUSED(muslin_skin_view(two, &view), bad, "`skin` must");
  REFUSED(muslin_skin_destroy(two), bad, "`skin` must");
  DONE(muslin_skin_view(foreign, &view));
  DONE(muslin_cloth_destroy(other));
  REFUSED(muslin_skin_view(foreign, &view), bad, "`skin` must");
}

int main(void) {
  TEST(a_skin_follows_its_cloth);
  TEST(a_cut_adds_vertices_and_a_reset_removes_them);
  TEST(wrong_descriptors_are_refused);
  TEST(skins_end_with_their_cloth_and_stale_handles_are_refused);
  return failures != 0;
}
