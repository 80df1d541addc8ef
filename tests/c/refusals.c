/* Invalid input is refused with a message that names the field, and changes nothing. */
#include "check.h"
#include <math.h>
#include <stdlib.h>

#define BAD_VALUE MUSLIN_STATUS_BAD_VALUE
#define BAD_INDEX MUSLIN_STATUS_BAD_INDEX

static MuslinCloth cloth;  /* the cloth of all tests in this file */
static const MuslinVec3 zero = {0, 0, 0}, ahead = {0, 0, -1}, eye = {0.5f, -0.5f, 5};

static MuslinVec3 with_nan(void) {
  MuslinVec3 v = {0, NAN, 0};
  return v;
}

static uint64_t hash(void) {
  uint64_t hash = 0;
  DONE(muslin_cloth_state_hash(cloth, &hash));
  return hash;
}

static void make_cloth(void) {
  MuslinGridDesc desc;
  muslin_grid_desc_init(&desc);
  desc.columns = desc.rows = 20;
  DONE(muslin_cloth_create_grid(&desc, &cloth));
  DONE(muslin_cloth_step(cloth, 30));
}

static void null_pointers_are_refused_by_name(void) {
  MuslinCloth made = {0};
  MuslinGridDesc grid;
  MuslinMeshDesc mesh;
  MuslinColliderDesc floor;
  MuslinEvent event;
  muslin_grid_desc_init(&grid);
  muslin_mesh_desc_init(&mesh);
  muslin_collider_desc_init(&floor);
  muslin_event_init(&event);
  MuslinGrab grab = {0};
  MuslinCollider collider = {0};
  MuslinVec3 at = zero;
  uint32_t some = 7;

  REFUSED(muslin_settings_init_sized(NULL, sizeof(MuslinSettings)), BAD_VALUE, "`settings`");
  REFUSED(muslin_material_init_sized(NULL, sizeof(MuslinMaterial)), BAD_VALUE, "`material`");
  REFUSED(muslin_wind_init_sized(NULL, sizeof(MuslinWind)), BAD_VALUE, "`wind`");
  REFUSED(muslin_collider_desc_init_sized(NULL, sizeof floor), BAD_VALUE, "`desc`");
  REFUSED(muslin_stream_init_sized(NULL, sizeof(MuslinStream)), BAD_VALUE, "`stream`");
  REFUSED(muslin_write_desc_init_sized(NULL, sizeof(MuslinWriteDesc)), BAD_VALUE, "`desc`");
  REFUSED(muslin_grid_desc_init_sized(NULL, sizeof grid, sizeof(MuslinMaterial),
                                      sizeof(MuslinSettings)),
          BAD_VALUE, "`desc`");
  REFUSED(muslin_mesh_desc_init_sized(NULL, sizeof mesh, sizeof(MuslinMaterial),
                                      sizeof(MuslinSettings)),
          BAD_VALUE, "`desc`");
  REFUSED(muslin_cloth_create_grid(NULL, &made), BAD_VALUE, "`desc`");
  REFUSED(muslin_cloth_create_grid(&grid, NULL), BAD_VALUE, "`out_cloth`");
  REFUSED(muslin_cloth_create_mesh(NULL, &made), BAD_VALUE, "`desc`");
  REFUSED(muslin_cloth_create_mesh(&mesh, NULL), BAD_VALUE, "`out_cloth`");
  REFUSED(muslin_cloth_restore(NULL, 8, &made), BAD_VALUE, "`buffer`");
  REFUSED(muslin_cloth_restore("muslin", 6, NULL), BAD_VALUE, "`out_cloth`");
  CHECK(made.id == 0);

  REFUSED(muslin_material_preset(NULL, MUSLIN_PRESET_SILK), BAD_VALUE, "`material`");
  REFUSED(muslin_cloth_get_settings(cloth, NULL), BAD_VALUE, "`out_settings`");
  REFUSED(muslin_cloth_set_settings(cloth, NULL), BAD_VALUE, "`settings`");
  REFUSED(muslin_cloth_get_material(cloth, NULL), BAD_VALUE, "`out_material`");
  REFUSED(muslin_cloth_set_material(cloth, NULL), BAD_VALUE, "`material`");
  REFUSED(muslin_cloth_set_wind(cloth, NULL), BAD_VALUE, "`wind`");
  REFUSED(muslin_cloth_set_pin_targets(cloth, NULL, &zero, 0, 1), BAD_VALUE, "`particles`");
  REFUSED(muslin_cloth_set_pin_targets(cloth, &some, NULL, 0, 1), BAD_VALUE, "`positions`");
  REFUSED(muslin_cloth_raycast(cloth, eye, ahead, 10, NULL), BAD_VALUE, "`out_hit`");
  REFUSED(muslin_cloth_grab_ray(cloth, eye, ahead, 0, NULL, &at), BAD_VALUE, "`out_grab`");
  REFUSED(muslin_cloth_grab_particle(cloth, 0, NULL), BAD_VALUE, "`out_grab`");
  REFUSED(muslin_cloth_next_event(cloth, NULL, &some), BAD_VALUE, "`out_event`");
  REFUSED(muslin_cloth_next_event(cloth, &event, NULL), BAD_VALUE, "`out_some`");
  REFUSED(muslin_cloth_add_collider(cloth, NULL, &collider), BAD_VALUE, "`desc`");
  REFUSED(muslin_cloth_add_collider(cloth, &floor, NULL), BAD_VALUE, "`out_collider`");
  REFUSED(muslin_cloth_view(cloth, NULL), BAD_VALUE, "`out_view`");
  REFUSED(muslin_cloth_get_stats(cloth, NULL), BAD_VALUE, "`out_stats`");
  REFUSED(muslin_cloth_get_mesh_report(cloth, NULL), BAD_VALUE, "`out_report`");
  REFUSED(muslin_cloth_get_origin(cloth, NULL), BAD_VALUE, "`out_origin`");
  REFUSED(muslin_cloth_state_hash(cloth, NULL), BAD_VALUE, "`out_hash`");
  REFUSED(muslin_cloth_save(cloth, NULL, 0, NULL), BAD_VALUE, "`out_needed`");
  CHECK(some == 7 && grab.id == 0 && collider.id == 0 && at.x == 0);
  DONE(muslin_cloth_set_pin_targets(cloth, NULL, NULL, 0, 0));
}

static void every_function_refuses_a_handle_of_no_cloth(void) {
  const MuslinStatus bad = MUSLIN_STATUS_BAD_HANDLE;
  MuslinCloth none = {0};
  MuslinSettings settings;
  MuslinMaterial material;
  MuslinWind wind;
  MuslinColliderDesc floor;
  MuslinHit hit;
  MuslinEvent event;
  MuslinView view;
  MuslinChanges changes;
  MuslinStats stats;
  muslin_settings_init(&settings);
  muslin_material_init(&material);
  muslin_wind_init(&wind);
  muslin_collider_desc_init(&floor);
  muslin_hit_init(&hit);
  muslin_event_init(&event);
  muslin_view_init(&view);
  muslin_changes_init(&changes);
  muslin_stats_init(&stats);
  MuslinStream stream = muslin_stream(MUSLIN_ATTRIBUTE_POSITION, MUSLIN_FORMAT_F32, &stats, 0, 0);
  MuslinGrab grab = {9};
  MuslinCollider collider = {9};
  MuslinQuat straight = {0, 0, 0, 1};
  uint32_t number = 9;
  uint64_t long_number = 9;
  size_t size = 9;
  REFUSED(muslin_cloth_destroy(none), bad, "`cloth`");
  MuslinMeshReport report;
  muslin_mesh_report_init(&report);
  REFUSED(muslin_cloth_get_mesh_report(none, &report), bad, "`cloth`");
  REFUSED(muslin_cloth_reset(none), bad, "`cloth`");
  REFUSED(muslin_cloth_get_settings(none, &settings), bad, "`cloth`");
  REFUSED(muslin_cloth_set_settings(none, &settings), bad, "`cloth`");
  REFUSED(muslin_cloth_get_material(none, &material), bad, "`cloth`");
  REFUSED(muslin_cloth_set_material(none, &material), bad, "`cloth`");
  REFUSED(muslin_cloth_set_wind(none, &wind), bad, "`cloth`");
  REFUSED(muslin_cloth_advance(none, 1, &number), bad, "`cloth`");
  REFUSED(muslin_cloth_step(none, 1), bad, "`cloth`");
  REFUSED(muslin_cloth_pin(none, 0, NULL), bad, "`cloth`");
  REFUSED(muslin_cloth_unpin(none, 0), bad, "`cloth`");
  REFUSED(muslin_cloth_unpin_all(none), bad, "`cloth`");
  REFUSED(muslin_cloth_set_pin_targets(none, &number, &zero, 0, 1), bad, "`cloth`");
  REFUSED(muslin_cloth_set_position(none, 0, zero), bad, "`cloth`");
  REFUSED(muslin_cloth_set_velocity(none, 0, zero), bad, "`cloth`");
  REFUSED(muslin_cloth_raycast(none, eye, ahead, 9, &hit), bad, "`cloth`");
  REFUSED(muslin_cloth_grab_ray(none, eye, ahead, 9, &grab, NULL), bad, "`cloth`");
  REFUSED(muslin_cloth_grab_particle(none, 0, &grab), bad, "`cloth`");
  REFUSED(muslin_cloth_move_grab(none, grab, zero), bad, "`cloth`");
  REFUSED(muslin_cloth_release(none, grab), bad, "`cloth`");
  REFUSED(muslin_cloth_cut(none, zero, eye, ahead, NULL), bad, "`cloth`");
  REFUSED(muslin_cloth_tear_edge(none, 0, 1), bad, "`cloth`");
  REFUSED(muslin_cloth_next_event(none, &event, &number), bad, "`cloth`");
  REFUSED(muslin_cloth_add_collider(none, &floor, &collider), bad, "`cloth`");
  REFUSED(muslin_cloth_move_collider(none, collider, zero, straight), bad, "`cloth`");
  REFUSED(muslin_cloth_remove_collider(none, collider), bad, "`cloth`");
  REFUSED(muslin_cloth_view(none, &view), bad, "`cloth`");
  REFUSED(muslin_cloth_changes(none, 0, &changes), bad, "`cloth`");
  REFUSED(muslin_cloth_write_indices(none, &number, 4, 32, 0, 0), bad, "`cloth`");
  REFUSED(muslin_cloth_write_vertices(none, &stream, 1, NULL), bad, "`cloth`");
  REFUSED(muslin_cloth_get_stats(none, &stats), bad, "`cloth`");
  REFUSED(muslin_cloth_state_hash(none, &long_number), bad, "`cloth`");
  REFUSED(muslin_cloth_save(none, NULL, 0, &size), bad, "`cloth`");
  CHECK(grab.id == 9 && collider.id == 9 && number == 9 && long_number == 9 && size == 9);
}

/* A grid that is valid except for one field. */
#define BAD_GRID(field, value, words)                                            \
  do {                                                                           \
    MuslinGridDesc desc;                                                         \
    MuslinCloth made = {0};                                                      \
    muslin_grid_desc_init(&desc);                                                \
    desc.field = (value);                                                        \
    REFUSED(muslin_cloth_create_grid(&desc, &made), BAD_VALUE, "`" words "`");   \
    CHECK(made.id == 0);                                                         \
  } while (0)

static void grids_are_refused_by_field(void) {
  BAD_GRID(columns, 1, "columns");
  BAD_GRID(rows, 0, "rows");
  BAD_GRID(columns, UINT32_MAX, "columns");
  BAD_GRID(spacing, 0, "spacing");
  BAD_GRID(spacing, NAN, "spacing");
  BAD_GRID(origin.y, INFINITY, "origin");
  BAD_GRID(right.x, 2, "right");
  BAD_GRID(down.y, NAN, "down");
  BAD_GRID(pin_mode, 4, "pin_mode");
  BAD_GRID(extra_particles, UINT32_MAX - 1, "extra_particles");
  BAD_GRID(material.density, -1, "material.density");
  BAD_GRID(material.tear_stretch, 0.5f, "material.tear_stretch");
  BAD_GRID(material.yield_hardening, INFINITY, "material.yield_hardening");
  BAD_GRID(material.yield_weakening, -1, "material.yield_weakening");
  BAD_GRID(settings.tick, 0, "settings.tick");
  BAD_GRID(settings.tethers, 2, "settings.tethers");
}

static void meshes_are_refused_by_field(void) {
  const float positions[] = {0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0};
  const float bad_positions[] = {0, 0, 0, 1, 0, 0, 0, NAN, 0, 1, 1, 0};
  const uint32_t indices[] = {0, 1, 2, 2, 1, 3}, bad_indices[] = {0, 1, 2, 2, 1, 4};
  const uint32_t flat[] = {0, 1, 1, 2, 1, 2}, pinned[] = {3, 4};
  MuslinCloth made = {0};
  MuslinMeshDesc good;
  muslin_mesh_desc_init(&good);
  REFUSED(muslin_cloth_create_mesh(&good, &made), BAD_VALUE, "`vertex_count`");
  good.vertex_count = 4;
  good.index_count = 6;
  REFUSED(muslin_cloth_create_mesh(&good, &made), BAD_VALUE, "`positions`");
  good.positions = positions;
  REFUSED(muslin_cloth_create_mesh(&good, &made), BAD_VALUE, "`indices`");
  good.indices = indices;

  MuslinMeshDesc desc = good;
  desc.vertex_count = UINT32_MAX; /* refused before the list is read */
  REFUSED(muslin_cloth_create_mesh(&desc, &made), BAD_VALUE, "`vertex_count`");
  desc = good;
  desc.index_count = UINT32_MAX; /* refused before the list is read */
  REFUSED(muslin_cloth_create_mesh(&desc, &made), BAD_VALUE, "`index_count`");
  desc.index_count = 5;
  REFUSED(muslin_cloth_create_mesh(&desc, &made), BAD_VALUE, "`index_count`");
  desc = good;
  desc.position_stride = 13;
  REFUSED(muslin_cloth_create_mesh(&desc, &made), BAD_VALUE, "stride`");
  desc = good;
  desc.positions = bad_positions;
  REFUSED(muslin_cloth_create_mesh(&desc, &made), BAD_VALUE, "`positions`");
  desc = good;
  desc.indices = bad_indices;
  REFUSED(muslin_cloth_create_mesh(&desc, &made), BAD_INDEX, "`indices`");
  desc.indices = flat;
  REFUSED(muslin_cloth_create_mesh(&desc, &made), MUSLIN_STATUS_BAD_MESH, "`indices`");
  desc = good;
  desc.uvs = bad_positions;
  REFUSED(muslin_cloth_create_mesh(&desc, &made), BAD_VALUE, "`uvs`");
  desc = good;
  desc.pinned_count = 2;
  REFUSED(muslin_cloth_create_mesh(&desc, &made), BAD_VALUE, "`pinned`");
  desc.pinned = pinned;
  REFUSED(muslin_cloth_create_mesh(&desc, &made), BAD_INDEX, "`pinned`");
  desc.pinned_count = 5; /* refused before the list is read */
  REFUSED(muslin_cloth_create_mesh(&desc, &made), BAD_VALUE, "`pinned_count`");
  desc = good;
  desc.weld_distance = NAN;
  REFUSED(muslin_cloth_create_mesh(&desc, &made), BAD_VALUE, "`weld_distance`");
  const float lengths[] = {-1.0f, NAN, INFINITY, 1.5f}; /* the edges have a mean length of 1.08 m */
  for (int i = 0; i < 4; i++) {
    desc = good;
    desc.simplify_below = lengths[i];
    REFUSED(muslin_cloth_create_mesh(&desc, &made), BAD_VALUE, "`simplify_below`");
  }
  CHECK(made.id == 0);

  /* Interleaved with other data, and unaligned by one byte. */
  unsigned char odd[4 * 20 + 1];
  memset(odd, 0xee, sizeof odd);
  for (int i = 0; i < 4; i++) memcpy(odd + 1 + 20 * i, positions + 3 * i, 12);
  uintptr_t odd_address = (uintptr_t)(odd + 1);
  desc = good;
  memcpy(&desc.positions, &odd_address, sizeof odd_address);
  desc.position_stride = 20;
  desc.pinned = pinned;
  desc.pinned_count = 1;
  desc.extra_particles = 6;
  DONE(muslin_cloth_create_mesh(&desc, &made));
  MuslinView view;
  muslin_view_init(&view);
  DONE(muslin_cloth_view(made, &view));
  CHECK(view.vertex_count == 4 && view.index_count == 6);
  CHECK(memcmp(view.positions, positions, sizeof positions) == 0);
  CHECK(view.uvs[0] == 0 && view.source_vertices[3] == 3 && view.normals[2] == 1);

  /* A cut changes a part of the lists, and its borders are frayed. */
  MuslinVec3 from = {-9, 0.5f, -9}, to = {9, 0.5f, -9}, sweep = {0, 0, 18};
  uint32_t edges = 0;
  DONE(muslin_cloth_cut(made, from, to, sweep, &edges));
  CHECK(edges == 2);
  MuslinChanges changes;
  muslin_changes_init(&changes);
  REFUSED(muslin_cloth_changes(made, 0, NULL), BAD_VALUE, "`out_changes`");
  DONE(muslin_cloth_changes(made, view.topology_revision, &changes));
  CHECK(changes.first_vertex == 4 && changes.vertex_count == 6);
  CHECK(changes.first_index < 6 && changes.first_index + changes.index_count == 18);
  DONE(muslin_cloth_view(made, &view));
  CHECK(view.vertex_count == 10 && view.index_count == 18);
  for (uint32_t i = 0; i < 10; i++) CHECK(view.frayed[i] == (i >= 4));
  DONE(muslin_cloth_changes(made, view.topology_revision, &changes));
  CHECK(changes.vertex_count == 0 && changes.index_count == 0);

  /* 16-bit indices with reversed winding and a base vertex. */
  uint16_t written[19];
  memset(written, 0xee, sizeof written);
  DONE(muslin_cloth_write_indices(made, written, sizeof written, 16, 1, 100));
  for (int i = 0; i < 18; i += 3) {
    CHECK(written[i] == view.indices[i] + 100u);
    CHECK(written[i + 1] == view.indices[i + 2] + 100u && written[i + 2] == view.indices[i + 1] + 100u);
  }
  CHECK(written[18] == 0xeeee);
  REFUSED(muslin_cloth_write_indices(made, NULL, 99, 16, 0, 0), BAD_VALUE, "`buffer`");
  REFUSED(muslin_cloth_write_indices(made, written, 99, 8, 0, 0), BAD_VALUE, "`index_format`");
  REFUSED(muslin_cloth_write_indices(made, written, 99, 16, 2, 0), BAD_VALUE, "`flip`");
  REFUSED(muslin_cloth_write_indices(made, written, 35, 16, 0, 0), MUSLIN_STATUS_BUFFER_TOO_SMALL, "`size`");
  REFUSED(muslin_cloth_write_indices(made, written, 38, 16, 0, 65526), BAD_VALUE, "`index_format`");
  CHECK(written[0] == view.indices[0] + 100u);
  DONE(muslin_cloth_destroy(made));
}

static void settings_material_and_wind_are_refused_by_field(void) {
  MuslinSettings settings, kept;
  MuslinMaterial material;
  MuslinWind wind;
  muslin_settings_init(&settings);
  muslin_material_init(&material);
  muslin_wind_init(&wind);
  settings.substeps = 0;
  REFUSED(muslin_cloth_set_settings(cloth, &settings), BAD_VALUE, "`settings.substeps`");
  muslin_settings_init(&settings);
  settings.gravity = with_nan();
  REFUSED(muslin_cloth_set_settings(cloth, &settings), BAD_VALUE, "`settings.gravity`");
  muslin_settings_init(&settings);
  settings.tearing = 5;
  REFUSED(muslin_cloth_set_settings(cloth, &settings), BAD_VALUE, "`settings.tearing`");
  muslin_settings_init(&settings);
  settings.self_collision = 3;
  REFUSED(muslin_cloth_set_settings(cloth, &settings), BAD_VALUE, "`settings.self_collision`");
  settings.self_distance = 1;
  settings.self_collision = MUSLIN_SELF_COLLISION_SURFACE;
  REFUSED(muslin_cloth_set_settings(cloth, &settings), BAD_VALUE, "`settings.self_distance`");
  settings.self_collision = MUSLIN_SELF_COLLISION_PARTICLES;
  REFUSED(muslin_cloth_set_settings(cloth, &settings), BAD_VALUE, "`settings.self_distance`");
  material.friction = -1;
  REFUSED(muslin_cloth_set_material(cloth, &material), BAD_VALUE, "`material.friction`");
  REFUSED(muslin_material_preset(&material, 6), BAD_VALUE, "`preset`");
  CHECK(material.friction == -1);
  muslin_material_init(&material);
  material.yield_hardening = -0.5f;
  REFUSED(muslin_cloth_set_material(cloth, &material), BAD_VALUE, "`material.yield_hardening`");
  muslin_material_init(&material);
  material.yield_weakening = NAN;
  REFUSED(muslin_cloth_set_material(cloth, &material), BAD_VALUE, "`material.yield_weakening`");
  wind.model = 2;
  REFUSED(muslin_cloth_set_wind(cloth, &wind), BAD_VALUE, "`wind.model`");
  wind.model = MUSLIN_WIND_SINE_FIELD;
  wind.velocity = with_nan();
  REFUSED(muslin_cloth_set_wind(cloth, &wind), BAD_VALUE, "`wind.velocity`");
  muslin_settings_init(&kept);
  DONE(muslin_cloth_get_settings(cloth, &kept));
  CHECK(kept.substeps == 4 && kept.tearing == 0 && kept.gravity.x == 0);
}

/* Attachments, anchors and the reference frame: lists and poses. */
static void attachments_and_anchors_are_refused_by_argument(void) {
  uint32_t last = 399, beyond = 400, some[401] = {0};
  const MuslinVec3 nan = with_nan();
  const MuslinQuat as_it_is = {0, 0, 0, 1}, too_long = {0, 0, 0, 2};
  const float one = 1, below = -1, none = 0;
  const MuslinAttachment made_up = {7};
  const MuslinCollider no_collider = {7};
  MuslinAttachment body = {0};
  REFUSED(muslin_cloth_attach(cloth, &beyond, 1, zero, as_it_is, &body), BAD_INDEX, "`particles`");
  REFUSED(muslin_cloth_attach(cloth, NULL, 1, zero, as_it_is, &body), BAD_VALUE, "`particles`");
  REFUSED(muslin_cloth_attach(cloth, some, 401, zero, as_it_is, &body), BAD_VALUE, "`count`");
  REFUSED(muslin_cloth_attach(cloth, &last, 1, nan, as_it_is, &body), BAD_VALUE, "`position`");
  REFUSED(muslin_cloth_attach(cloth, &last, 1, zero, too_long, &body), BAD_VALUE, "`rotation`");
  REFUSED(muslin_cloth_attach(cloth, &last, 1, zero, as_it_is, NULL), BAD_VALUE, "`out_attachment`");
  CHECK(body.id == 0);
  REFUSED(muslin_cloth_move_attachment(cloth, made_up, zero, as_it_is), MUSLIN_STATUS_BAD_HANDLE,
          "`attachment`");
  REFUSED(muslin_cloth_detach(cloth, made_up), MUSLIN_STATUS_BAD_HANDLE, "`attachment`");
  REFUSED(muslin_cloth_set_pin_stiffness(cloth, &last, 1, 1), BAD_VALUE, "`particles` must be pinned");
  REFUSED(muslin_cloth_set_pin_stiffness(cloth, some, 1, -1), BAD_VALUE, "`stiffness`");
  REFUSED(muslin_cloth_set_pin_stiffness(cloth, &beyond, 1, 1), BAD_INDEX, "`particles`");
  REFUSED(muslin_cloth_set_mass_scales(cloth, &last, &none, 1), BAD_VALUE, "`scales`");
  REFUSED(muslin_cloth_set_mass_scales(cloth, &last, NULL, 1), BAD_VALUE, "`scales`");
  REFUSED(muslin_cloth_set_mass_scales(cloth, &beyond, &one, 1), BAD_INDEX, "`particles`");
  REFUSED(muslin_cloth_set_map(cloth, MUSLIN_MAP_TEAR, &one, 1), BAD_VALUE,
          "`count` must be 400, the number of particles, but is 1");
  REFUSED(muslin_cloth_set_map(cloth, 99, NULL, 0), BAD_VALUE, "`map` must be a MUSLIN_MAP_ value");
  REFUSED(muslin_cloth_set_max_distances(cloth, &last, &below, 1), BAD_VALUE, "`distances`");
  REFUSED(muslin_cloth_set_max_distances(cloth, &last, NULL, 1), BAD_VALUE, "`distances`");
  REFUSED(muslin_cloth_set_max_distances(cloth, &beyond, &one, 1), BAD_INDEX, "`particles`");
  REFUSED(muslin_cloth_set_backstops(cloth, &last, &below, &one, 1), BAD_VALUE, "`distances`");
  REFUSED(muslin_cloth_set_backstops(cloth, &last, &one, &below, 1), BAD_VALUE, "`radii`");
  REFUSED(muslin_cloth_set_backstops(cloth, &last, &one, NULL, 1), BAD_VALUE, "`radii`");
  REFUSED(muslin_cloth_set_anchors(cloth, &beyond, &zero, NULL, 0, 1), BAD_INDEX, "`particles`");
  REFUSED(muslin_cloth_set_anchors(cloth, &last, NULL, NULL, 0, 1), BAD_VALUE, "`positions`");
  REFUSED(muslin_cloth_set_anchors(cloth, &last, &nan, NULL, 0, 1), BAD_VALUE, "`positions`");
  REFUSED(muslin_cloth_set_anchors(cloth, &last, &zero, &zero, 0, 1), BAD_VALUE, "`normals`");
  REFUSED(muslin_cloth_set_anchors(cloth, &last, &zero, NULL, 10, 1), BAD_VALUE, "`stride`");
  REFUSED(muslin_cloth_set_frame(cloth, nan, as_it_is), BAD_VALUE, "`position`");
  REFUSED(muslin_cloth_teleport(cloth, zero, too_long), BAD_VALUE, "`rotation`");
  REFUSED(muslin_cloth_teleport_collider(cloth, no_collider, zero, as_it_is),
          MUSLIN_STATUS_BAD_HANDLE, "`collider`");
}

static void edits_are_refused_by_argument(void) {
  uint32_t ticks = 9, some[401] = {0};
  uint32_t last = 399, beyond = 400;
  const MuslinVec3 nan = with_nan();
  REFUSED(muslin_cloth_advance(cloth, -1, &ticks), BAD_VALUE, "`seconds`");
  REFUSED(muslin_cloth_advance(cloth, NAN, &ticks), BAD_VALUE, "`seconds`");
  CHECK(ticks == 9);
  REFUSED(muslin_cloth_pin(cloth, 400, NULL), BAD_INDEX, "`particle` must be below 400, but is 400");
  REFUSED(muslin_cloth_pin(cloth, 0, &nan), BAD_VALUE, "`target`");
  REFUSED(muslin_cloth_unpin(cloth, 400), BAD_INDEX, "`particle`");
  REFUSED(muslin_cloth_set_pin_targets(cloth, &last, &nan, 0, 1), BAD_VALUE, "`positions`");
  REFUSED(muslin_cloth_set_pin_targets(cloth, &beyond, &zero, 0, 1), BAD_INDEX, "`particles`");
  REFUSED(muslin_cloth_set_pin_targets(cloth, &last, &zero, 10, 1), BAD_VALUE, "`stride`");
  REFUSED(muslin_cloth_set_pin_targets(cloth, some, &zero, 0, 401), BAD_VALUE, "`count`");
  attachments_and_anchors_are_refused_by_argument();
  REFUSED(muslin_cloth_set_position(cloth, 400, zero), BAD_INDEX, "`particle`");
  REFUSED(muslin_cloth_set_position(cloth, 0, nan), BAD_VALUE, "`position`");
  REFUSED(muslin_cloth_set_velocity(cloth, 400, zero), BAD_INDEX, "`particle`");
  REFUSED(muslin_cloth_set_velocity(cloth, 0, nan), BAD_VALUE, "`velocity`");
  REFUSED(muslin_cloth_tear_edge(cloth, 400, 0), BAD_INDEX, "`particle_a`");
  REFUSED(muslin_cloth_tear_edge(cloth, 0, 400), BAD_INDEX, "`particle_b`");
  REFUSED(muslin_cloth_tear_edge(cloth, 0, 399), BAD_VALUE, "`particle_b`");
  REFUSED(muslin_cloth_tear_edge(cloth, 0, 1), MUSLIN_STATUS_NOT_TORN, "did not tear");
  const MuslinVec3 right = {1, 0, 0}, left = {-1, 0, 0};
  uint32_t edges = 7;
  REFUSED(muslin_cloth_cut(cloth, nan, right, left, &edges), BAD_VALUE, "`from`");
  REFUSED(muslin_cloth_cut(cloth, right, nan, left, &edges), BAD_VALUE, "`to`");
  REFUSED(muslin_cloth_cut(cloth, zero, right, nan, &edges), BAD_VALUE, "`sweep`");
  REFUSED(muslin_cloth_cut(cloth, right, right, left, &edges), BAD_VALUE, "`to`");
  REFUSED(muslin_cloth_cut(cloth, zero, right, left, &edges), BAD_VALUE, "`sweep`");
  CHECK(edges == 7);
}

static void rays_are_refused_by_argument_and_may_hit_nothing(void) {
  const MuslinVec3 nan = with_nan(), away = {0, 0, 1};
  MuslinHit hit;
  MuslinGrab grab = {7}, grabs[64];
  MuslinVec3 at = {7, 7, 7};
  memset(&hit, 0xee, sizeof hit);
  muslin_hit_init(&hit);
  REFUSED(muslin_cloth_raycast(cloth, nan, ahead, 9, &hit), BAD_VALUE, "`origin`");
  REFUSED(muslin_cloth_raycast(cloth, eye, nan, 9, &hit), BAD_VALUE, "`direction`");
  REFUSED(muslin_cloth_raycast(cloth, eye, zero, 9, &hit), BAD_VALUE, "`direction`");
  REFUSED(muslin_cloth_raycast(cloth, eye, ahead, NAN, &hit), BAD_VALUE, "`max_distance`");
  REFUSED(muslin_cloth_raycast(cloth, eye, away, 9, &hit), MUSLIN_STATUS_NOTHING_HIT, "nothing");
  REFUSED(muslin_cloth_raycast(cloth, eye, ahead, 1, &hit), MUSLIN_STATUS_NOTHING_HIT, "nothing");
  CHECK(hit.triangle == 0xeeeeeeeeu && hit.struct_size == sizeof hit);
  REFUSED(muslin_cloth_grab_ray(cloth, nan, ahead, 0, &grab, &at), BAD_VALUE, "`origin`");
  REFUSED(muslin_cloth_grab_ray(cloth, eye, ahead, -1, &grab, &at), BAD_VALUE, "`radius`");
  REFUSED(muslin_cloth_grab_ray(cloth, eye, away, 0, &grab, &at), MUSLIN_STATUS_NOTHING_HIT, "nothing");
  REFUSED(muslin_cloth_grab_particle(cloth, 400, &grab), BAD_INDEX, "`particle`");
  CHECK(grab.id == 7 && at.x == 7);

  const uint64_t before = hash();
  for (uint32_t i = 0; i < 64; i++) DONE(muslin_cloth_grab_particle(cloth, i, &grabs[i]));
  REFUSED(muslin_cloth_grab_particle(cloth, 64, &grab), MUSLIN_STATUS_FULL, "another grab");
  REFUSED(muslin_cloth_move_grab(cloth, grabs[3], nan), BAD_VALUE, "`target`");
  CHECK(hash() != before);
  for (uint32_t i = 64; i-- > 0;) DONE(muslin_cloth_release(cloth, grabs[i]));

  DONE(muslin_cloth_raycast(cloth, eye, ahead, INFINITY, &hit));
  CHECK(hit.struct_size == sizeof hit && hit.distance > 4 && hit.position.x == 0.5f);
  CHECK(hit.normal.z > 0 && hit.particle < 400 && hit.triangle < 2 * 19 * 19);
}

static void invalid_saves_are_refused(void) {
  size_t needed = 0, written = 7;
  MuslinCloth made = {7};
  DONE(muslin_cloth_save(cloth, NULL, 0, &needed));
  unsigned char *bytes = calloc(needed, 1);
  if (bytes == NULL) {
    CHECK(bytes != NULL);
    return;
  }
  char words[64];
  snprintf(words, sizeof words, "`size` must be at least %lu,", (unsigned long)needed);
  REFUSED(muslin_cloth_save(cloth, bytes, needed - 1, &written), MUSLIN_STATUS_BUFFER_TOO_SMALL, words);
  CHECK(written == 7 && bytes[0] == 0);
  DONE(muslin_cloth_save(cloth, bytes, needed, NULL));
  REFUSED(muslin_cloth_restore(bytes, needed - 1, &made), MUSLIN_STATUS_BAD_SAVE, "`buffer`");
  REFUSED(muslin_cloth_restore(bytes, 0, &made), MUSLIN_STATUS_BAD_SAVE, "`buffer`");
  REFUSED(muslin_cloth_restore(bytes, SIZE_MAX, &made), BAD_VALUE, "`size`");
  bytes[needed / 2] ^= 1;
  REFUSED(muslin_cloth_restore(bytes, needed, &made), MUSLIN_STATUS_BAD_SAVE, "damaged");
  CHECK(made.id == 7);
  free(bytes);
}

int main(void) {
  CHECK(muslin_last_error()[0] == '\0');
  make_cloth();
  const uint64_t before = hash();
  TEST(null_pointers_are_refused_by_name);
  TEST(every_function_refuses_a_handle_of_no_cloth);
  TEST(grids_are_refused_by_field);
  TEST(meshes_are_refused_by_field);
  TEST(settings_material_and_wind_are_refused_by_field);
  TEST(edits_are_refused_by_argument);
  TEST(invalid_saves_are_refused);
  CHECK(hash() == before); /* none of the refused calls changed the cloth */
  TEST(rays_are_refused_by_argument_and_may_hit_nothing);
  DONE(muslin_cloth_destroy(cloth));
  return failures != 0;
}
