/* Programs compiled with an older or a newer header than that of the library. */
#include "check.h"
#include <stddef.h>

/* Settings of the first header: without the last field. */
enum { OLD_SETTINGS = offsetof(MuslinSettings, max_tears_per_tick) };

static uint64_t hash_after(MuslinCloth cloth, uint32_t ticks) {
  uint64_t hash = 0;
  DONE(muslin_cloth_step(cloth, ticks));
  DONE(muslin_cloth_state_hash(cloth, &hash));
  DONE(muslin_cloth_destroy(cloth));
  return hash;
}

/* The state hash of a cloth made with the current header. */
static uint64_t expected(void) {
  MuslinGridDesc desc;
  MuslinCloth cloth = {0};
  muslin_grid_desc_init(&desc);
  desc.columns = 9;
  desc.material.density = 0.5f;
  desc.settings.damping = 2.0f;
  DONE(muslin_cloth_create_grid(&desc, &cloth));
  return hash_after(cloth, 30);
}

static void an_older_program_creates_the_same_cloth(void) {
  struct {
    unsigned char head[offsetof(MuslinGridDesc, settings)];
    unsigned char settings[OLD_SETTINGS];
    unsigned char beyond[16];
  } old;
  memset(&old, 0xee, sizeof old);
  uint32_t size = (uint32_t)(sizeof old.head + sizeof old.settings);
  MuslinGridDesc *desc = (MuslinGridDesc *)(void *)&old;
  DONE(muslin_grid_desc_init_sized(desc, size, sizeof(MuslinMaterial), OLD_SETTINGS));
  for (size_t i = 0; i < sizeof old.beyond; i++) CHECK(old.beyond[i] == 0xee);
  desc->columns = 9;
  desc->material.density = 0.5f;
  desc->settings.damping = 2.0f;
  MuslinCloth cloth = {0};
  DONE(muslin_cloth_create_grid(desc, &cloth));
  CHECK(hash_after(cloth, 30) == expected());
}

/* Materials of the first header: without hardening and weakening of folds. */
enum { OLD_MATERIAL = offsetof(MuslinMaterial, yield_hardening) };

static void an_older_program_changes_the_material_fields_that_it_has(void) {
  struct {
    unsigned char known[OLD_MATERIAL];
    unsigned char beyond[16];
  } old;
  memset(&old, 0xee, sizeof old);
  MuslinMaterial *seen = (MuslinMaterial *)(void *)&old, now;
  DONE(muslin_material_init_sized(seen, OLD_MATERIAL));
  CHECK(seen->struct_size == OLD_MATERIAL && seen->fold_length == 0.01f);
  MuslinGridDesc desc;
  MuslinCloth cloth = {0};
  muslin_grid_desc_init(&desc);
  desc.material.yield_weakening = 2;
  DONE(muslin_cloth_create_grid(&desc, &cloth));
  DONE(muslin_cloth_get_material(cloth, seen));
  DONE(muslin_cloth_set_material(cloth, seen));
  for (size_t i = 0; i < sizeof old.beyond; i++) CHECK(old.beyond[i] == 0xee);
  muslin_material_init(&now);
  DONE(muslin_cloth_get_material(cloth, &now));
  CHECK(now.struct_size == sizeof now && now.yield_hardening == 0 && now.yield_weakening == 0);
  DONE(muslin_cloth_destroy(cloth));
}

/* A header to come: the material has a new field, which moves the settings; they and the whole have
 * one too. */
typedef struct NewMaterial {
  MuslinMaterial known;
  float fuzz;
} NewMaterial;
typedef struct NewSettings {
  MuslinSettings known;
  uint32_t warp_speed;
} NewSettings;
typedef struct NewGridDesc {
  unsigned char head[offsetof(MuslinGridDesc, material)];
  NewMaterial material;
  NewSettings settings;
  uint32_t holes;
} NewGridDesc;

static MuslinGridDesc *new_desc(NewGridDesc *desc) {
  MuslinGridDesc *seen = (MuslinGridDesc *)(void *)desc;
  memset(desc, 0xee, sizeof *desc);
  DONE(muslin_grid_desc_init_sized(seen, sizeof *desc, sizeof desc->material, sizeof desc->settings));
  seen->columns = 9;
  desc->material.known.density = 0.5f;
  desc->settings.known.damping = 2.0f;
  return seen;
}

static void a_newer_program_creates_the_same_cloth(void) {
  NewGridDesc desc;
  MuslinCloth cloth = {0};
  DONE(muslin_cloth_create_grid(new_desc(&desc), &cloth));
  CHECK(desc.holes == 0 && desc.settings.warp_speed == 0);
  CHECK(hash_after(cloth, 30) == expected());
}

static void new_fields_of_a_newer_program_are_refused_if_set(void) {
  NewGridDesc desc;
  MuslinCloth cloth = {0};
  MuslinGridDesc *seen = new_desc(&desc);
  desc.material.fuzz = 1.0f;
  REFUSED(muslin_cloth_create_grid(seen, &cloth), MUSLIN_STATUS_UNSUPPORTED, "material.struct_size");
  seen = new_desc(&desc);
  desc.settings.warp_speed = 9;
  REFUSED(muslin_cloth_create_grid(seen, &cloth), MUSLIN_STATUS_UNSUPPORTED, "settings.struct_size");
  seen = new_desc(&desc);
  desc.holes = 1;
  REFUSED(muslin_cloth_create_grid(seen, &cloth), MUSLIN_STATUS_UNSUPPORTED, "`struct_size`");
  CHECK(cloth.id == 0);
}

/* The same for a mesh descriptor. It holds pointers, so it may end in padding; the number of new fields is
 * chosen so that it does. */
enum {
  MESH_HEAD = offsetof(MuslinMeshDesc, material),
  MESH_END = MESH_HEAD + sizeof(MuslinMaterial) + sizeof(MuslinSettings),
  NEW_FIELDS = (MESH_END + sizeof(float)) % sizeof(void *) == 0 ? 2 : 1
};
typedef union NewMeshDesc {
  struct {
    unsigned char head[MESH_HEAD];
    struct {
      MuslinMaterial known;
      float fuzz[NEW_FIELDS];
    } material;
    MuslinSettings settings;
  } parts;
  const void *aligned;
} NewMeshDesc;

static void padding_at_the_end_may_hold_any_bytes(void) {
  const float positions[] = {0, 0, 0, 1, 0, 0, 0, 1, 0};
  const uint32_t indices[] = {0, 1, 2};
  NewMeshDesc desc;
  memset(&desc, 0xee, sizeof desc);
  MuslinMeshDesc *seen = (MuslinMeshDesc *)(void *)&desc;
  MuslinCloth cloth = {0};
  DONE(muslin_mesh_desc_init_sized(seen, sizeof desc, sizeof desc.parts.material,
                                   sizeof desc.parts.settings));
  seen->positions = positions;
  seen->vertex_count = 3;
  seen->indices = indices;
  seen->index_count = 3;
  size_t end = sizeof desc.parts;
  CHECK(end < sizeof desc);
  memset((unsigned char *)&desc + end, 0xee, sizeof desc - end);
  DONE(muslin_cloth_create_mesh(seen, &cloth));
  (void)hash_after(cloth, 1);
}

static void fields_behind_the_settings_are_found_behind_newer_ones(void) {
  const float positions[] = {0, 0, 0, 1, 0, 0, 0, 1, 0};
  const uint32_t indices[] = {0, 1, 2};
  struct {
    NewMeshDesc known;
    double room;
  } desc;
  MuslinMeshDesc *seen = (MuslinMeshDesc *)(void *)&desc;
  const size_t tail = sizeof desc.known.parts + sizeof(uint32_t);
  DONE(muslin_mesh_desc_init_sized(seen, sizeof desc, sizeof desc.known.parts.material,
                                   sizeof desc.known.parts.settings));
  seen->positions = positions;
  seen->vertex_count = 3;
  seen->indices = indices;
  seen->index_count = 3;
  MuslinCloth cloth = {0};
  const float lengths[] = {-1.0f, 0.5f};
  memcpy((unsigned char *)&desc + tail, &lengths[0], sizeof(float));
  REFUSED(muslin_cloth_create_mesh(seen, &cloth), MUSLIN_STATUS_BAD_VALUE, "`simplify_below`");
  memcpy((unsigned char *)&desc + tail, &lengths[1], sizeof(float));
  DONE(muslin_cloth_create_mesh(seen, &cloth));
  (void)hash_after(cloth, 1);
}

static void fields_that_an_older_program_lacks_get_their_defaults(void) {
  MuslinGridDesc desc;
  MuslinCloth cloth = {0};
  muslin_grid_desc_init(&desc);
  DONE(muslin_cloth_create_grid(&desc, &cloth));

  MuslinSettings settings;
  memset(&settings, 0xee, sizeof settings);
  DONE(muslin_settings_init_sized(&settings, OLD_SETTINGS));
  CHECK(settings.struct_size == OLD_SETTINGS && settings.max_tears_per_tick == 0xeeeeeeeeu);
  DONE(muslin_cloth_get_settings(cloth, &settings));
  CHECK(settings.struct_size == OLD_SETTINGS && settings.max_tears_per_tick == 0xeeeeeeeeu);
  settings.substeps = 6;
  DONE(muslin_cloth_set_settings(cloth, &settings));
  muslin_settings_init(&settings);
  settings.max_tears_per_tick = 99;
  DONE(muslin_cloth_get_settings(cloth, &settings));
  CHECK(settings.substeps == 6 && settings.max_tears_per_tick == 8);
  DONE(muslin_cloth_destroy(cloth));
}

static void output_fields_that_this_version_lacks_become_zero(void) {
  struct {
    MuslinStats known;
    uint64_t dreams;
  } stats;
  MuslinGridDesc desc;
  MuslinCloth cloth = {0};
  muslin_grid_desc_init(&desc);
  DONE(muslin_cloth_create_grid(&desc, &cloth));
  memset(&stats, 0xee, sizeof stats);
  stats.known.struct_size = (uint32_t)sizeof stats;
  DONE(muslin_cloth_get_stats(cloth, &stats.known));
  CHECK(stats.known.particles == 1600 && stats.dreams == 0);
  CHECK(stats.known.struct_size == sizeof stats);
  DONE(muslin_cloth_destroy(cloth));
}

static void struct_sizes_of_no_version_are_refused(void) {
  MuslinGridDesc desc;
  MuslinSettings settings;
  MuslinView view;
  MuslinCloth cloth = {0}, made = {0};
  muslin_grid_desc_init(&desc);
  DONE(muslin_cloth_create_grid(&desc, &cloth));
  muslin_settings_init(&settings);
  muslin_view_init(&view);
  uint32_t sizes[] = {0, 1, 4, 8, 47, 5000, 0xcdcdcdcdu, UINT32_MAX};
  for (size_t i = 0; i < sizeof sizes / sizeof sizes[0]; i++) {
    uint32_t size = sizes[i];
    desc.struct_size = settings.struct_size = view.struct_size = size;
    REFUSED(muslin_cloth_create_grid(&desc, &made), MUSLIN_STATUS_BAD_VALUE, "`struct_size` must");
    REFUSED(muslin_cloth_set_settings(cloth, &settings), MUSLIN_STATUS_BAD_VALUE, "settings_init");
    REFUSED(muslin_cloth_view(cloth, &view), MUSLIN_STATUS_BAD_VALUE, "out_view->struct_size");
    REFUSED(muslin_settings_init_sized(&settings, size), MUSLIN_STATUS_BAD_VALUE, "struct_size");
  }
  muslin_grid_desc_init(&desc);
  desc.material.struct_size = 0;
  REFUSED(muslin_cloth_create_grid(&desc, &made), MUSLIN_STATUS_BAD_VALUE, "`material.struct_size`");
  muslin_grid_desc_init(&desc);
  desc.settings.struct_size += 4;
  REFUSED(muslin_cloth_create_grid(&desc, &made), MUSLIN_STATUS_BAD_VALUE, "`struct_size`");
  CHECK(made.id == 0);
  DONE(muslin_cloth_destroy(cloth));
}

int main(void) {
  TEST(an_older_program_creates_the_same_cloth);
  TEST(an_older_program_changes_the_material_fields_that_it_has);
  TEST(a_newer_program_creates_the_same_cloth);
  TEST(new_fields_of_a_newer_program_are_refused_if_set);
  TEST(padding_at_the_end_may_hold_any_bytes);
  TEST(fields_behind_the_settings_are_found_behind_newer_ones);
  TEST(fields_that_an_older_program_lacks_get_their_defaults);
  TEST(output_fields_that_this_version_lacks_become_zero);
  TEST(struct_sizes_of_no_version_are_refused);
  return failures != 0;
}
