/* Every argument of every function: an invalid value is refused with its status and a message that names the
 * argument, and leaves the cloth unchanged. `cargo xtask c` checks that no argument of muslin.h lacks a row. */
#include "table.h"
#include <math.h>
#include <stdlib.h>

#define VALUE MUSLIN_STATUS_BAD_VALUE
#define INDEX MUSLIN_STATUS_BAD_INDEX
#define HANDLE MUSLIN_STATUS_BAD_HANDLE
#define SMALL MUSLIN_STATUS_BUFFER_TOO_SMALL

static MuslinCloth cloth;
static const MuslinCloth none = {0};
static const MuslinVec3 zero = {0, 0, 0}, one = {1, 0, 0}, side = {0, 1, 0}, not_finite = {0, NAN, 0};
static const MuslinQuat straight = {0, 0, 0, 1}, too_long = {0, 0, 0, 2};
static const uint32_t first = 0, beyond = 400, many[401] = {0};
static const float number = 1, not_a_number = NAN;
static uint32_t word = 7;
static int rows = 0;

static uint64_t hash(void) {
  uint64_t hash = 0;
  DONE(muslin_cloth_state_hash(cloth, &hash));
  return hash;
}

static void init_functions(void) {
  union {
    MuslinGridDesc grid;
    MuslinMeshDesc mesh;
    MuslinSettings settings;
    MuslinMaterial material;
    MuslinWind wind;
    MuslinColliderDesc collider;
    MuslinStream stream;
    MuslinWriteDesc write;
    MuslinSkinDesc skin;
    MuslinSewDesc sew;
  } of;
  const uint32_t material = sizeof of.material, settings = sizeof of.settings;
  ROW(muslin_settings_init_sized, settings, VALUE, "`settings`", (NULL, sizeof of.settings));
  ROW(muslin_settings_init_sized, struct_size, VALUE, "`struct_size`", (&of.settings, 3));
  ROW(muslin_material_init_sized, material, VALUE, "`material`", (NULL, sizeof of.material));
  ROW(muslin_material_init_sized, struct_size, VALUE, "`struct_size`", (&of.material, 0));
  ROW(muslin_wind_init_sized, wind, VALUE, "`wind`", (NULL, sizeof of.wind));
  ROW(muslin_wind_init_sized, struct_size, VALUE, "`struct_size`", (&of.wind, 41));
  ROW(muslin_collider_desc_init_sized, desc, VALUE, "`desc`", (NULL, sizeof of.collider));
  ROW(muslin_collider_desc_init_sized, struct_size, VALUE, "`struct_size`", (&of.collider, 8));
  ROW(muslin_stream_init_sized, stream, VALUE, "`stream`", (NULL, sizeof of.stream));
  ROW(muslin_stream_init_sized, struct_size, VALUE, "`struct_size`", (&of.stream, 4));
  ROW(muslin_write_desc_init_sized, desc, VALUE, "`desc`", (NULL, sizeof of.write));
  ROW(muslin_write_desc_init_sized, struct_size, VALUE, "`struct_size`", (&of.write, 5000));
  ROW(muslin_sew_desc_init_sized, desc, VALUE, "`desc`", (NULL, sizeof of.sew));
  ROW(muslin_sew_desc_init_sized, struct_size, VALUE, "`struct_size`", (&of.sew, 5));
  ROW(muslin_skin_desc_init_sized, desc, VALUE, "`desc`", (NULL, sizeof of.skin));
  ROW(muslin_skin_desc_init_sized, struct_size, VALUE, "`struct_size`", (&of.skin, 5));
  ROW(muslin_grid_desc_init_sized, desc, VALUE, "`desc`", (NULL, sizeof of.grid, material, settings));
  ROW(muslin_grid_desc_init_sized, struct_size, VALUE, "`struct_size`", (&of.grid, 60, material, settings));
  ROW(muslin_grid_desc_init_sized, material_size, VALUE, "`material_size`", (&of.grid, sizeof of.grid, 2, settings));
  ROW(muslin_grid_desc_init_sized, settings_size, VALUE, "`settings_size`", (&of.grid, sizeof of.grid, material, 2));
  ROW(muslin_mesh_desc_init_sized, desc, VALUE, "`desc`", (NULL, sizeof of.mesh, material, settings));
  ROW(muslin_mesh_desc_init_sized, struct_size, VALUE, "`struct_size`", (&of.mesh, 60, material, settings));
  ROW(muslin_mesh_desc_init_sized, material_size, VALUE, "`material_size`", (&of.mesh, sizeof of.mesh, 2, settings));
  ROW(muslin_mesh_desc_init_sized, settings_size, VALUE, "`settings_size`", (&of.mesh, sizeof of.mesh, material, 2));
  BEGUN(MuslinMaterial, silk, density, 1);
  ROW(muslin_material_preset, material, VALUE, "`material`", (NULL, MUSLIN_PRESET_SILK));
  ROW(muslin_material_preset, preset, VALUE, "`preset`", (&silk, 6));
  ANY(muslin_set_log, log);
  ANY(muslin_set_log, user);
  ANY(muslin_set_log, max_level);
}

static void creating_destroying_and_saving(void) {
  MuslinCloth made = {7};
  BEGUN(MuslinGridDesc, grid, columns, 1);
  ROW(muslin_cloth_create_grid, desc, VALUE, "`columns`", (&grid, &made));
  ROW(muslin_cloth_create_grid, desc, VALUE, "`desc`", (NULL, &made));
  ROW(muslin_cloth_create_grid, out_cloth, VALUE, "`out_cloth`", (&grid, NULL));
  BEGUN(MuslinMeshDesc, mesh, vertex_count, 2);
  ROW(muslin_cloth_create_mesh, desc, VALUE, "`vertex_count`", (&mesh, &made));
  ROW(muslin_cloth_create_mesh, desc, VALUE, "`desc`", (NULL, &made));
  ROW(muslin_cloth_create_mesh, out_cloth, VALUE, "`out_cloth`", (&mesh, NULL));
  OF_NONE(muslin_cloth_duplicate, (none, &made));
  ROW(muslin_cloth_duplicate, out_cloth, VALUE, "`out_cloth`", (cloth, NULL));
  OF_NONE(muslin_cloth_destroy, (none));
  OF_NONE(muslin_cloth_reset, (none));
  size_t size = 7;
  unsigned char few[4] = {0};
  OF_NONE(muslin_cloth_save, (none, NULL, 0, &size));
  ROW(muslin_cloth_save, buffer, VALUE, "`out_needed`", (cloth, NULL, 0, NULL));
  ROW(muslin_cloth_save, size, SMALL, "`size`", (cloth, few, sizeof few, &size));
  ROW(muslin_cloth_save, out_needed, VALUE, "`out_needed`", (cloth, NULL, 9, NULL));
  ROW(muslin_cloth_restore, buffer, VALUE, "`buffer`", (NULL, 9, &made));
  ROW(muslin_cloth_restore, buffer, MUSLIN_STATUS_BAD_SAVE, "`buffer`", (few, sizeof few, &made));
  ROW(muslin_cloth_restore, size, VALUE, "`size`", (few, SIZE_MAX, &made));
  ROW(muslin_cloth_restore, out_cloth, VALUE, "`out_cloth`", (few, sizeof few, NULL));
  CHECK(made.id == 7 && size == 7);
}

static void parameters_time_and_particles(void) {
  BEGUN(MuslinSettings, settings, substeps, 0);
  BEGUN(MuslinMaterial, material, density, 0);
  BEGUN(MuslinWind, wind, model, 2);
  MuslinSettings into = settings;
  into.struct_size = 2;
  OF_NONE(muslin_cloth_get_settings, (none, &settings));
  ROW(muslin_cloth_get_settings, out_settings, VALUE, "`out_settings`", (cloth, NULL));
  ROW(muslin_cloth_get_settings, out_settings, VALUE, "`out_settings->struct_size`", (cloth, &into));
  OF_NONE(muslin_cloth_set_settings, (none, &settings));
  ROW(muslin_cloth_set_settings, settings, VALUE, "`settings.substeps`", (cloth, &settings));
  OF_NONE(muslin_cloth_get_material, (none, &material));
  ROW(muslin_cloth_get_material, out_material, VALUE, "`out_material`", (cloth, NULL));
  OF_NONE(muslin_cloth_set_material, (none, &material));
  ROW(muslin_cloth_set_material, material, VALUE, "`material.density`", (cloth, &material));
  OF_NONE(muslin_cloth_set_wind, (none, &wind));
  ROW(muslin_cloth_set_wind, wind, VALUE, "`wind.model`", (cloth, &wind));
  OF_NONE(muslin_cloth_advance, (none, 1, &word));
  ROW(muslin_cloth_advance, seconds, VALUE, "`seconds`", (cloth, -1, &word));
  ANY(muslin_cloth_advance, out_ticks);
  const MuslinCloth gone[2] = {cloth, none}, twice[2] = {cloth, cloth};
  ROW(muslin_cloths_advance, cloths, VALUE, "`cloths`", (NULL, 1, 1, &word));
  ROW(muslin_cloths_advance, cloths, HANDLE, "`cloths[1]`", (gone, 2, 1, &word));
  ROW(muslin_cloths_advance, cloths, VALUE, "`cloths[1]`", (twice, 2, 1, &word));
  ROW(muslin_cloths_advance, seconds, VALUE, "`seconds`", (&cloth, 1, -1, &word));
  ANY(muslin_cloths_advance, count);
  ANY(muslin_cloths_advance, out_ticks);
  OF_NONE(muslin_cloth_step, (none, 1));
  ANY(muslin_cloth_step, ticks);
  OF_NONE(muslin_cloth_pin, (none, 0, NULL));
  ROW(muslin_cloth_pin, particle, INDEX, "`particle`", (cloth, 400, NULL));
  ROW(muslin_cloth_pin, target, VALUE, "`target`", (cloth, 0, &not_finite));
  OF_NONE(muslin_cloth_unpin, (none, 0));
  ROW(muslin_cloth_unpin, particle, INDEX, "`particle`", (cloth, 400));
  OF_NONE(muslin_cloth_unpin_all, (none));
  OF_NONE(muslin_cloth_set_pin_targets, (none, &first, &zero, 0, 1));
  ROW(muslin_cloth_set_pin_targets, particles, INDEX, "`particles`", (cloth, &beyond, &zero, 0, 1));
  ROW(muslin_cloth_set_pin_targets, positions, VALUE, "`positions`", (cloth, &first, &not_finite, 0, 1));
  ROW(muslin_cloth_set_pin_targets, stride, VALUE, "`stride`", (cloth, &first, &zero, 8, 1));
  ROW(muslin_cloth_set_pin_targets, count, VALUE, "`count`", (cloth, many, &zero, 0, 401));
  OF_NONE(muslin_cloth_set_pin_stiffness, (none, &first, 1, 1));
  ROW(muslin_cloth_set_pin_stiffness, particles, INDEX, "`particles`", (cloth, &beyond, 1, 1));
  ROW(muslin_cloth_set_pin_stiffness, count, VALUE, "`count`", (cloth, many, 401, 1));
  ROW(muslin_cloth_set_pin_stiffness, stiffness, VALUE, "`stiffness`", (cloth, &first, 1, -1));
  OF_NONE(muslin_cloth_set_mass_scales, (none, &first, &number, 1));
  ROW(muslin_cloth_set_mass_scales, particles, INDEX, "`particles`", (cloth, &beyond, &number, 1));
  ROW(muslin_cloth_set_mass_scales, scales, VALUE, "`scales`", (cloth, &first, &not_a_number, 1));
  ROW(muslin_cloth_set_mass_scales, count, VALUE, "`count`", (cloth, many, (const float *)many, 401));
  static float scales[400];
  scales[17] = NAN;
  OF_NONE(muslin_cloth_set_map, (none, MUSLIN_MAP_TEAR, scales, 400));
  ROW(muslin_cloth_set_map, map, VALUE, "`map`", (cloth, 6, scales, 400));
  ROW(muslin_cloth_set_map, scales, VALUE, "`scales[17]`", (cloth, MUSLIN_MAP_DRAG, scales, 400));
  ROW(muslin_cloth_set_map, count, VALUE, "`count` must be 400", (cloth, MUSLIN_MAP_DRAG, scales, 401));
  OF_NONE(muslin_cloth_get_map, (none, MUSLIN_MAP_TEAR, scales, 400, &word));
  ROW(muslin_cloth_get_map, map, VALUE, "`map`", (cloth, 6, scales, 400, &word));
  ROW(muslin_cloth_get_map, count, VALUE, "`count` must be 400", (cloth, MUSLIN_MAP_DRAG, scales, 401, &word));
  ANY(muslin_cloth_get_map, out_scales);
  ANY(muslin_cloth_get_map, out_is_set);
  OF_NONE(muslin_cloth_set_position, (none, 0, zero));
  ROW(muslin_cloth_set_position, particle, INDEX, "`particle`", (cloth, 400, zero));
  ROW(muslin_cloth_set_position, position, VALUE, "`position`", (cloth, 0, not_finite));
  OF_NONE(muslin_cloth_set_velocity, (none, 0, zero));
  ROW(muslin_cloth_set_velocity, particle, INDEX, "`particle`", (cloth, 400, zero));
  ROW(muslin_cloth_set_velocity, velocity, VALUE, "`velocity`", (cloth, 0, not_finite));
}

static void poses_and_queries(void) {
  static const float bad[6] = {0, 0, 0, 0, NAN, 0};
  static float room[3 * 400];
  const float *good = room;
  MuslinWind wind = {1, 0, {0, 0, 0}, 0, 0, 0, 0, 0};
  MuslinVec3 vector = {7, 7, 7};
  double seconds = 7;
  uint64_t ticks = 7;
  float real = 7;
  OF_NONE(muslin_cloth_set_positions, (none, 0, 1, good, 0));
  ROW(muslin_cloth_set_positions, first, INDEX, "`first`", (cloth, 400, 1, good, 0));
  ROW(muslin_cloth_set_positions, first, INDEX, "`first`", (cloth, UINT32_MAX, 2, good, 0));
  ROW(muslin_cloth_set_positions, count, VALUE, "`count`", (cloth, 1, 400, good, 0));
  ROW(muslin_cloth_set_positions, positions, VALUE, "`positions[1]`", (cloth, 0, 2, bad, 0));
  ROW(muslin_cloth_set_positions, positions, VALUE, "`positions`", (cloth, 0, 2, NULL, 0));
  ROW(muslin_cloth_set_positions, stride, VALUE, "`stride`", (cloth, 0, 2, good, 8));
  OF_NONE(muslin_cloth_set_velocities, (none, 0, 1, good, 0));
  ROW(muslin_cloth_set_velocities, first, INDEX, "`first`", (cloth, 400, 1, good, 0));
  ROW(muslin_cloth_set_velocities, count, VALUE, "`count`", (cloth, 399, UINT32_MAX, good, 0));
  ROW(muslin_cloth_set_velocities, velocities, VALUE, "`velocities[1]`", (cloth, 0, 2, bad, 0));
  ROW(muslin_cloth_set_velocities, stride, VALUE, "`stride`", (cloth, 0, 2, good, 14));
  OF_NONE(muslin_cloth_get_velocities, (none, 0, 1, room, 0));
  ROW(muslin_cloth_get_velocities, first, INDEX, "`first`", (cloth, 400, 1, room, 0));
  ROW(muslin_cloth_get_velocities, count, VALUE, "`count`", (cloth, 200, 201, room, 0));
  ROW(muslin_cloth_get_velocities, out_velocities, VALUE, "`out_velocities`", (cloth, 0, 1, NULL, 0));
  ROW(muslin_cloth_get_velocities, stride, VALUE, "`stride`", (cloth, 0, 1, room, 11));
  OF_NONE(muslin_cloth_get_rest_positions, (none, 0, 1, room, 0));
  ROW(muslin_cloth_get_rest_positions, first, INDEX, "`first`", (cloth, 401, 0, room, 0));
  ROW(muslin_cloth_get_rest_positions, count, VALUE, "`count`", (cloth, 0, 401, room, 0));
  ROW(muslin_cloth_get_rest_positions, out_positions, VALUE, "`out_positions`", (cloth, 0, 1, NULL, 0));
  ROW(muslin_cloth_get_rest_positions, stride, VALUE, "`stride`", (cloth, 0, 1, room, 1));
  OF_NONE(muslin_cloth_get_pins, (none, &word, 0, &word));
  ROW(muslin_cloth_get_pins, out_particles, VALUE, "`out_particles`", (cloth, NULL, 400, &word));
  ROW(muslin_cloth_get_pins, capacity, SMALL, "`capacity` must be 0 or at least 20", (cloth, &word, 1, &word));
  ROW(muslin_cloth_get_pins, out_count, VALUE, "`out_count`", (cloth, &word, 0, NULL));
  OF_NONE(muslin_cloth_get_pin_targets, (none, &first, room, 0, 1));
  ROW(muslin_cloth_get_pin_targets, particles, INDEX, "`particles`", (cloth, &beyond, room, 0, 1));
  ROW(muslin_cloth_get_pin_targets, particles, VALUE, "`particles`", (cloth, (uint32_t[]){0, 399}, room, 0, 2));
  ROW(muslin_cloth_get_pin_targets, out_positions, VALUE, "`out_positions`", (cloth, &first, NULL, 0, 1));
  ROW(muslin_cloth_get_pin_targets, stride, VALUE, "`stride`", (cloth, &first, room, 3, 1));
  ROW(muslin_cloth_get_pin_targets, count, VALUE, "`count`", (cloth, many, room, 0, 401));
  OF_NONE(muslin_cloth_get_blend, (none, &real));
  ROW(muslin_cloth_get_blend, out_blend, VALUE, "`out_blend`", (cloth, NULL));
  OF_NONE(muslin_cloth_is_asleep, (none, &word));
  ROW(muslin_cloth_is_asleep, out_asleep, VALUE, "`out_asleep`", (cloth, NULL));
  OF_NONE(muslin_cloth_get_wind, (none, &wind));
  ROW(muslin_cloth_get_wind, out_wind, VALUE, "`out_wind->struct_size`", (cloth, &wind));
  ROW(muslin_cloth_get_wind, out_wind, VALUE, "`out_wind`", (cloth, NULL));
  OF_NONE(muslin_cloth_get_time, (none, &seconds, &ticks));
  ANY(muslin_cloth_get_time, out_seconds);
  ANY(muslin_cloth_get_time, out_ticks);
  OF_NONE(muslin_cloth_get_mass, (none, &real, &vector, &vector));
  ANY(muslin_cloth_get_mass, out_total);
  ANY(muslin_cloth_get_mass, out_center);
  ANY(muslin_cloth_get_mass, out_momentum);
  CHECK(real == 7 && vector.y == 7 && seconds == 7 && ticks == 7);
  for (int i = 0; i < 3 * 400; i++) CHECK(room[i] == 0);
}

static void attachments_anchors_and_frames(void) {
  MuslinAttachment body = {9};
  OF_NONE(muslin_cloth_attach, (none, &first, 1, zero, straight, &body));
  ROW(muslin_cloth_attach, particles, INDEX, "`particles`", (cloth, &beyond, 1, zero, straight, &body));
  ROW(muslin_cloth_attach, count, VALUE, "`count`", (cloth, many, 401, zero, straight, &body));
  ROW(muslin_cloth_attach, position, VALUE, "`position`", (cloth, &first, 1, not_finite, straight, &body));
  ROW(muslin_cloth_attach, rotation, VALUE, "`rotation`", (cloth, &first, 1, zero, too_long, &body));
  ROW(muslin_cloth_attach, out_attachment, VALUE, "`out_attachment`", (cloth, &first, 1, zero, straight, NULL));
  CHECK(body.id == 9);
  OF_NONE(muslin_cloth_move_attachment, (none, body, zero, straight));
  OF_NONE(muslin_cloth_detach, (none, body));
  ROW(muslin_cloth_move_attachment, attachment, HANDLE, "`attachment`", (cloth, body, zero, straight));
  ROW(muslin_cloth_detach, attachment, HANDLE, "`attachment`", (cloth, body));
  DONE(muslin_cloth_attach(cloth, NULL, 0, zero, straight, &body));
  ROW(muslin_cloth_move_attachment, position, VALUE, "`position`", (cloth, body, not_finite, straight));
  ROW(muslin_cloth_move_attachment, rotation, VALUE, "`rotation`", (cloth, body, zero, too_long));
  DONE(muslin_cloth_detach(cloth, body));
  const float *lengths = (const float *)many;
  OF_NONE(muslin_cloth_set_max_distances, (none, &first, &number, 1));
  ROW(muslin_cloth_set_max_distances, particles, INDEX, "`particles`", (cloth, &beyond, &number, 1));
  ROW(muslin_cloth_set_max_distances, distances, VALUE, "`distances`", (cloth, &first, &not_a_number, 1));
  ROW(muslin_cloth_set_max_distances, count, VALUE, "`count`", (cloth, many, lengths, 401));
  OF_NONE(muslin_cloth_set_backstops, (none, &first, &number, &number, 1));
  ROW(muslin_cloth_set_backstops, particles, INDEX, "`particles`", (cloth, &beyond, &number, &number, 1));
  ROW(muslin_cloth_set_backstops, distances, VALUE, "`distances`", (cloth, &first, &not_a_number, &number, 1));
  ROW(muslin_cloth_set_backstops, radii, VALUE, "`radii`", (cloth, &first, &number, &not_a_number, 1));
  ROW(muslin_cloth_set_backstops, count, VALUE, "`count`", (cloth, many, lengths, lengths, 401));
  OF_NONE(muslin_cloth_set_anchors, (none, &first, &zero, &one, 0, 1));
  ROW(muslin_cloth_set_anchors, particles, INDEX, "`particles`", (cloth, &beyond, &zero, &one, 0, 1));
  ROW(muslin_cloth_set_anchors, positions, VALUE, "`positions`", (cloth, &first, &not_finite, &one, 0, 1));
  ROW(muslin_cloth_set_anchors, normals, VALUE, "`normals`", (cloth, &first, &zero, &zero, 0, 1));
  ROW(muslin_cloth_set_anchors, stride, VALUE, "`stride`", (cloth, &first, &zero, &one, 13, 1));
  static const MuslinVec3 places[401] = {{0, 0, 0}};
  ROW(muslin_cloth_set_anchors, count, VALUE, "`count`", (cloth, many, places, NULL, 0, 401));
  OF_NONE(muslin_cloth_clear_leashes, (none));
  OF_NONE(muslin_cloth_set_frame, (none, zero, straight));
  ROW(muslin_cloth_set_frame, position, VALUE, "`position`", (cloth, not_finite, straight));
  ROW(muslin_cloth_set_frame, rotation, VALUE, "`rotation`", (cloth, zero, too_long));
  OF_NONE(muslin_cloth_move_frame, (none, zero, straight, 1));
  ROW(muslin_cloth_move_frame, position, VALUE, "`position`", (cloth, not_finite, straight, 1));
  ROW(muslin_cloth_move_frame, rotation, VALUE, "`rotation`", (cloth, zero, too_long, 1));
  ROW(muslin_cloth_move_frame, inertia, VALUE, "`inertia`", (cloth, zero, straight, 2));
  OF_NONE(muslin_cloth_teleport, (none, zero, straight));
  ROW(muslin_cloth_teleport, position, VALUE, "`position`", (cloth, not_finite, straight));
  ROW(muslin_cloth_teleport, rotation, VALUE, "`rotation`", (cloth, zero, too_long));
}

static void rays_grabs_tears_and_cuts(void) {
  MuslinHit hit;
  muslin_hit_init(&hit);
  MuslinGrab grab = {9};
  MuslinVec3 at = zero;
  OF_NONE(muslin_cloth_raycast, (none, zero, one, 1, &hit));
  ROW(muslin_cloth_raycast, origin, VALUE, "`origin`", (cloth, not_finite, one, 1, &hit));
  ROW(muslin_cloth_raycast, direction, VALUE, "`direction`", (cloth, zero, zero, 1, &hit));
  ROW(muslin_cloth_raycast, max_distance, VALUE, "`max_distance`", (cloth, zero, one, -1, &hit));
  ROW(muslin_cloth_raycast, out_hit, VALUE, "`out_hit`", (cloth, zero, one, 1, NULL));
  OF_NONE(muslin_cloth_grab_ray, (none, zero, one, 1, &grab, &at));
  ROW(muslin_cloth_grab_ray, origin, VALUE, "`origin`", (cloth, not_finite, one, 1, &grab, &at));
  ROW(muslin_cloth_grab_ray, direction, VALUE, "`direction`", (cloth, zero, not_finite, 1, &grab, &at));
  ROW(muslin_cloth_grab_ray, radius, VALUE, "`radius`", (cloth, zero, one, INFINITY, &grab, &at));
  ROW(muslin_cloth_grab_ray, out_grab, VALUE, "`out_grab`", (cloth, zero, one, 1, NULL, &at));
  ANY(muslin_cloth_grab_ray, out_at);
  OF_NONE(muslin_cloth_grab_particle, (none, 0, &grab));
  ROW(muslin_cloth_grab_particle, particle, INDEX, "`particle`", (cloth, 400, &grab));
  ROW(muslin_cloth_grab_particle, out_grab, VALUE, "`out_grab`", (cloth, 0, NULL));
  OF_NONE(muslin_cloth_move_grab, (none, grab, zero));
  OF_NONE(muslin_cloth_release, (none, grab));
  ROW(muslin_cloth_move_grab, grab, HANDLE, "`grab`", (cloth, grab, zero));
  ROW(muslin_cloth_release, grab, HANDLE, "`grab`", (cloth, grab));
  DONE(muslin_cloth_grab_particle(cloth, 0, &grab));
  ROW(muslin_cloth_move_grab, target, VALUE, "`target`", (cloth, grab, not_finite));
  DONE(muslin_cloth_release(cloth, grab));
  OF_NONE(muslin_cloth_tear_edge, (none, 0, 1));
  ROW(muslin_cloth_tear_edge, particle_a, INDEX, "`particle_a`", (cloth, 400, 1));
  ROW(muslin_cloth_tear_edge, particle_b, INDEX, "`particle_b`", (cloth, 0, 400));
  ROW(muslin_cloth_tear_edge, particle_b, VALUE, "`particle_b`", (cloth, 0, 399));
  BEGUN(MuslinSewDesc, stopped, speed, 0);
  BEGUN(MuslinSewDesc, glued, kind, 2);
  BEGUN(MuslinSewDesc, repelled, tear_force, -1);
  const uint32_t pairs[] = {0, 1, 2, 3}, missing[] = {0, 1, 2, 400}, same[] = {0, 1, 3, 3};
  OF_NONE(muslin_cloth_sew, (none, pairs, 2, NULL));
  ROW(muslin_cloth_sew, pairs, VALUE, "`pairs`", (cloth, NULL, 2, NULL));
  ROW(muslin_cloth_sew, pairs, VALUE, "`pairs[1]` must name particles", (cloth, missing, 2, NULL));
  ROW(muslin_cloth_sew, pairs, VALUE, "`pairs[1]` must name two different", (cloth, same, 2, NULL));
  ROW(muslin_cloth_sew, pair_count, VALUE, "`pair_count`", (cloth, pairs, 401, NULL));
  ROW(muslin_cloth_sew, desc, VALUE, "`speed`", (cloth, pairs, 2, &stopped));
  ROW(muslin_cloth_sew, desc, VALUE, "`kind`", (cloth, pairs, 2, &glued));
  ROW(muslin_cloth_sew, desc, VALUE, "`tear_force`", (cloth, pairs, 2, &repelled));
  OF_NONE(muslin_cloth_crease, (none, zero, one, 1));
  ROW(muslin_cloth_crease, from, VALUE, "`from`", (cloth, not_finite, one, 1));
  ROW(muslin_cloth_crease, to, VALUE, "`to`", (cloth, zero, zero, 1));
  ROW(muslin_cloth_crease, angle, VALUE, "`angle`", (cloth, zero, one, 4));
  OF_NONE(muslin_cloth_cut, (none, zero, one, side, &word));
  ROW(muslin_cloth_cut, from, VALUE, "`from`", (cloth, not_finite, one, side, &word));
  ROW(muslin_cloth_cut, to, VALUE, "`to`", (cloth, zero, zero, side, &word));
  ROW(muslin_cloth_cut, sweep, VALUE, "`sweep`", (cloth, zero, one, one, &word));
  ANY(muslin_cloth_cut, out_edges);
  MuslinEvent event;
  muslin_event_init(&event);
  OF_NONE(muslin_cloth_next_event, (none, &event, &word));
  ROW(muslin_cloth_next_event, out_event, VALUE, "`out_event`", (cloth, NULL, &word));
  ROW(muslin_cloth_next_event, out_some, VALUE, "`out_some`", (cloth, &event, NULL));
}

static void colliders(void) {
  BEGUN(MuslinColliderDesc, ball, radius, 0);
  ball.shape = MUSLIN_SHAPE_SPHERE;
  BEGUN(MuslinColliderDesc, ground, friction, 1);
  MuslinCollider body = {9};
  MuslinVec3 linear = zero;
  const float corners[] = {0, 9, 0, 1, 9, 0, 0, 9, 1};
  OF_NONE(muslin_cloth_add_collider, (none, &ground, &body));
  ROW(muslin_cloth_add_collider, desc, VALUE, "`collider.radius`", (cloth, &ball, &body));
  ROW(muslin_cloth_add_collider, out_collider, VALUE, "`out_collider`", (cloth, &ground, NULL));
  CHECK(body.id == 9);
  OF_NONE(muslin_cloth_move_collider, (none, body, zero, straight));
  OF_NONE(muslin_cloth_teleport_collider, (none, body, zero, straight));
  OF_NONE(muslin_cloth_remove_collider, (none, body));
  OF_NONE(muslin_cloth_get_collider_impulse, (none, body, &linear, NULL));
  OF_NONE(muslin_cloth_get_collider_pose, (none, body, &linear, NULL));
  ROW(muslin_cloth_get_collider_pose, collider, HANDLE, "`collider`", (cloth, body, &linear, NULL));
  ANY(muslin_cloth_get_collider_pose, out_position);
  ANY(muslin_cloth_get_collider_pose, out_rotation);
  ROW(muslin_cloth_move_collider, collider, HANDLE, "`collider`", (cloth, body, zero, straight));
  ROW(muslin_cloth_teleport_collider, collider, HANDLE, "`collider`", (cloth, body, zero, straight));
  ROW(muslin_cloth_remove_collider, collider, HANDLE, "`collider`", (cloth, body));
  OF_NONE(muslin_cloth_update_collider, (none, body, corners, 0, 3));
  ROW(muslin_cloth_update_collider, collider, HANDLE, "`collider`", (cloth, body, corners, 0, 3));
  ROW(muslin_cloth_get_collider_impulse, collider, HANDLE, "`collider`", (cloth, body, &linear, NULL));
  ANY(muslin_cloth_get_collider_impulse, out_linear);
  ANY(muslin_cloth_get_collider_impulse, out_angular);
  DONE(muslin_cloth_add_collider(cloth, &ground, &body));
  ROW(muslin_cloth_move_collider, position, VALUE, "`collider.position`", (cloth, body, not_finite, straight));
  ROW(muslin_cloth_move_collider, rotation, VALUE, "`collider.rotation`", (cloth, body, zero, too_long));
  ROW(muslin_cloth_teleport_collider, position, VALUE, "`collider.position`", (cloth, body, not_finite, straight));
  ROW(muslin_cloth_teleport_collider, rotation, VALUE, "`collider.rotation`", (cloth, body, zero, too_long));
  ROW(muslin_cloth_update_collider, collider, VALUE, "`collider`", (cloth, body, corners, 0, 3));
  DONE(muslin_cloth_remove_collider(cloth, body));
  BEGUN(MuslinColliderDesc, mesh, friction, 1);
  const uint32_t one[] = {0, 1, 2};
  mesh.shape = MUSLIN_SHAPE_MESH;
  mesh.positions = corners;
  mesh.indices = one;
  mesh.vertex_count = mesh.index_count = 3;
  mesh.solid = 1;
  ROW(muslin_cloth_add_collider, desc, VALUE, "`collider.solid`", (cloth, &mesh, &body));
  mesh.solid = 0;
  DONE(muslin_cloth_add_collider(cloth, &mesh, &body));
  const float not_near[] = {0, 9, 0, 1, NAN, 0, 0, 9, 1};
  ROW(muslin_cloth_update_collider, count, VALUE, "`count`", (cloth, body, corners, 0, 2));
  ROW(muslin_cloth_update_collider, stride, VALUE, "`stride`", (cloth, body, corners, 8, 3));
  ROW(muslin_cloth_update_collider, positions, VALUE, "`positions[1]`", (cloth, body, not_near, 0, 3));
  ROW(muslin_cloth_update_collider, positions, VALUE, "`positions`", (cloth, body, NULL, 0, 3));
  DONE(muslin_cloth_remove_collider(cloth, body));
}

static void layers(void) {
  MuslinCollider layer = {0}, known = {9};
  MuslinCloth inner;
  BEGUN(MuslinGridDesc, grid, columns, 4);
  grid.rows = 4;
  DONE(muslin_cloth_create_grid(&grid, &inner));
  OF_NONE(muslin_cloth_collide_with, (none, inner, &layer));
  ROW(muslin_cloth_collide_with, other, HANDLE, "`other` must be a live cloth", (cloth, none, &layer));
  ROW(muslin_cloth_collide_with, other, VALUE, "`other` must be another cloth", (cloth, cloth, &layer));
  ROW(muslin_cloth_collide_with, inout_collider, VALUE, "`inout_collider`", (cloth, inner, NULL));
  ROW(muslin_cloth_collide_with, inout_collider, HANDLE, "`collider`", (cloth, inner, &known));
  CHECK(layer.id == 0 && known.id == 9);
  BEGUN(MuslinColliderDesc, ground, friction, 1);
  DONE(muslin_cloth_add_collider(cloth, &ground, &known));
  ROW(muslin_cloth_collide_with, inout_collider, VALUE, "`collider` must be one that `collide_with` returned", (cloth, inner, &known));
  DONE(muslin_cloth_remove_collider(cloth, known));
  DONE(muslin_cloth_destroy(inner));
}

/* An output struct that is not initialised. */
#define REPORT(function, type, argument, words)                        \
  do {                                                                 \
    type report;                                                       \
    report.struct_size = 1;                                            \
    OF_NONE(function, (none, &report));                                \
    ROW(function, argument, VALUE, "`" words "`", (cloth, NULL));      \
    ROW(function, argument, VALUE, "`" words "->struct_size`", (cloth, &report)); \
  } while (0)

static void views_statistics_and_streams(void) {
  MuslinChanges changes;
  muslin_changes_init(&changes);
  REPORT(muslin_cloth_view, MuslinView, out_view, "out_view");
  REPORT(muslin_cloth_get_mesh_report, MuslinMeshReport, out_report, "out_report");
  size_t needed = 7;
  char none_fits[1] = {7};
  OF_NONE(muslin_cloth_get_mesh_warnings, (none, NULL, 0, &needed));
  ROW(muslin_cloth_get_mesh_warnings, buffer, VALUE, "`out_needed`", (cloth, NULL, 0, NULL));
  ROW(muslin_cloth_get_mesh_warnings, size, SMALL, "`size`", (cloth, none_fits, 0, &needed));
  ROW(muslin_cloth_get_mesh_warnings, out_needed, VALUE, "`out_needed`", (cloth, NULL, 9, NULL));
  CHECK(needed == 7 && none_fits[0] == 7);
  REPORT(muslin_cloth_get_stats, MuslinStats, out_stats, "out_stats");
  OF_NONE(muslin_cloth_changes, (none, 0, &changes));
  ANY(muslin_cloth_changes, since_topology_revision);
  ROW(muslin_cloth_changes, out_changes, VALUE, "`out_changes`", (cloth, 0, NULL));
  uint64_t bits = 7;
  MuslinVec3 origin = {7, 7, 7};
  OF_NONE(muslin_cloth_get_origin, (none, &origin));
  ROW(muslin_cloth_get_origin, out_origin, VALUE, "`out_origin`", (cloth, NULL));
  CHECK(origin.x == 7);
  OF_NONE(muslin_cloth_state_hash, (none, &bits));
  ROW(muslin_cloth_state_hash, out_hash, VALUE, "`out_hash`", (cloth, NULL));
  CHECK(bits == 7);
  static float room[3 * 400];
  MuslinStream stream = muslin_stream(MUSLIN_ATTRIBUTE_POSITION, MUSLIN_FORMAT_F32, room, 0, sizeof room);
  MuslinStream short_one = stream;
  short_one.size = 12;
  BEGUN(MuslinWriteDesc, desc, blend, 2);
  OF_NONE(muslin_cloth_write_vertices, (none, &stream, 1, NULL));
  ROW(muslin_cloth_write_vertices, streams, VALUE, "`streams`", (cloth, NULL, 1, NULL));
  ROW(muslin_cloth_write_vertices, streams, SMALL, "`streams[0].size`", (cloth, &short_one, 1, NULL));
  ROW(muslin_cloth_write_vertices, stream_count, VALUE, "`stream_count`", (cloth, &stream, 0, NULL));
  ROW(muslin_cloth_write_vertices, desc, VALUE, "`blend`", (cloth, &stream, 1, &desc));
  static uint32_t indices[6 * 19 * 19];
  OF_NONE(muslin_cloth_write_indices, (none, indices, sizeof indices, 32, 0, 0));
  ROW(muslin_cloth_write_indices, buffer, VALUE, "`buffer`", (cloth, NULL, sizeof indices, 32, 0, 0));
  ROW(muslin_cloth_write_indices, size, SMALL, "`size`", (cloth, indices, sizeof indices - 1, 32, 0, 0));
  ROW(muslin_cloth_write_indices, index_format, VALUE, "`index_format`", (cloth, indices, sizeof indices, 64, 0, 0));
  ROW(muslin_cloth_write_indices, flip, VALUE, "`flip`", (cloth, indices, sizeof indices, 32, 2, 0));
  ROW(muslin_cloth_write_indices, base_vertex, VALUE, "`base_vertex`",
      (cloth, indices, sizeof indices, 32, 0, UINT32_MAX));
  CHECK(room[4] == 0 && indices[1] == 0);
}

static void skins(void) {
  MuslinView view = {0}, coarse;
  muslin_view_init(&view);
  muslin_view_init(&coarse);
  DONE(muslin_cloth_view(cloth, &coarse));
  const MuslinSkin no_skin = {0};
  MuslinSkin skin = {7};
  BEGUN(MuslinSkinDesc, good, positions, coarse.positions);
  good.vertex_count = coarse.vertex_count;
  good.indices = coarse.indices;
  good.index_count = coarse.index_count;
  MuslinSkinDesc bad = good;
  bad.smoothness = -1;
  OF_NONE(muslin_skin_create, (none, &good, &skin));
  ROW(muslin_skin_create, desc, VALUE, "`desc`", (cloth, NULL, &skin));
  ROW(muslin_skin_create, desc, VALUE, "`smoothness`", (cloth, &bad, &skin));
  ROW(muslin_skin_create, out_skin, VALUE, "`out_skin`", (cloth, &good, NULL));
  CHECK(skin.id == 7);
  DONE(muslin_skin_create(cloth, &good, &skin));
  static float room[3 * 400];
  MuslinStream stream = muslin_stream(MUSLIN_ATTRIBUTE_POSITION, MUSLIN_FORMAT_F32, room, 0, sizeof room);
  MuslinStream short_one = stream;
  short_one.size = 12;
  BEGUN(MuslinWriteDesc, desc, blend, 2);
  ROW(muslin_skin_write_vertices, skin, HANDLE, "`skin`", (no_skin, &stream, 1, NULL));
  ROW(muslin_skin_write_vertices, streams, VALUE, "`streams`", (skin, NULL, 1, NULL));
  ROW(muslin_skin_write_vertices, streams, SMALL, "`streams[0].size`", (skin, &short_one, 1, NULL));
  ROW(muslin_skin_write_vertices, stream_count, VALUE, "`stream_count`", (skin, &stream, 0, NULL));
  ROW(muslin_skin_write_vertices, desc, VALUE, "`blend`", (skin, &stream, 1, &desc));
  CHECK(room[4] == 0);
  ROW(muslin_skin_view, skin, HANDLE, "`skin`", (no_skin, &view));
  ROW(muslin_skin_view, out_view, VALUE, "`out_view`", (skin, NULL));
  ROW(muslin_skin_destroy, skin, HANDLE, "`skin`", (no_skin));
  CHECK(view.positions == NULL);
  DONE(muslin_skin_destroy(skin));
}

int main(void) {
  MuslinGridDesc desc;
  muslin_grid_desc_init(&desc);
  desc.columns = desc.rows = 20;
  DONE(muslin_cloth_create_grid(&desc, &cloth));
  DONE(muslin_cloth_step(cloth, 10));
  TEST(init_functions);
  TEST(creating_destroying_and_saving);
  TEST(parameters_time_and_particles);
  TEST(poses_and_queries);
  TEST(attachments_anchors_and_frames);
  TEST(rays_grabs_tears_and_cuts);
  TEST(colliders);
  TEST(layers);
  TEST(views_statistics_and_streams);
  TEST(skins);
  printf("%d rows\n", rows);
  DONE(muslin_cloth_destroy(cloth));
  return failures != 0;
}
