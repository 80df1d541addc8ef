/* Fuzzes the C library: any functions in any order with any arguments. No call may crash or access memory
 * outside its arguments, a refused call changes nothing, and a restored cloth continues with the same bits.
 * Only the header's rule for pointers is kept: they are NULL or as large as stated.
 *
 * `cargo xtask fuzz` builds it with libFuzzer and the address sanitizer. */
#include "input.h"
#include "judge.h"

static void call_create_grid(void) {
  MuslinGridDesc desc;
  muslin_grid_desc_init(&desc);
  desc.columns = 2 + byte() % 11;
  desc.rows = 2 + byte() % 11;
  desc.pin_mode = byte() % 4;
  desc.settings.tearing = byte() % 2;
  desc.settings.self_collision = byte() % 3;
  corrupt(&desc, sizeof desc);
  corrupt(&desc.settings, sizeof desc.settings);
  /* Many values are refused or take minutes. */
  if (desc.columns > 24 && desc.columns < 4194304) desc.columns = 24;
  if (desc.rows > 24 && desc.rows < 4194304) desc.rows = 24;
  if (desc.extra_particles > 999 && desc.extra_particles < 9999999) desc.extra_particles = 999;
  const MuslinGridDesc *given = is_valid() ? copy_with_size(&desc, sizeof desc) : NULL;
  MuslinCloth *made = out(sizeof *made);
  store(check_result(CREATE_GRID, muslin_cloth_create_grid(given, made)), made);
}

static void call_create_mesh(void) {
  MuslinMeshDesc desc;
  muslin_mesh_desc_init(&desc);
  const uint32_t columns = 2 + byte() % 6, rows = 2 + byte() % 6;
  corrupt(&desc, sizeof desc);
  corrupt(&desc.settings, sizeof desc.settings);
  if (desc.extra_particles > 999 && desc.extra_particles < 9999999) desc.extra_particles = 999;
  desc.vertex_count = is_valid() ? columns * rows : byte() % 9;
  desc.position_stride = stride();
  uint8_t *positions = (uint8_t *)points(desc.vertex_count, desc.position_stride);
  /* A sheet in which a few vertices and a few corners have random values. */
  const uint32_t step_bytes = desc.position_stride == 0 ? 12 : desc.position_stride;
  for (uint32_t i = 0; positions != NULL && step_bytes >= 12 && step_bytes <= 64 && i < desc.vertex_count; i++) {
    const MuslinVec3 point = {(float)(i % columns) * 0.25f, (float)(i / columns) * -0.25f, 0};
    if (byte() < 240) memcpy(positions + (size_t)step_bytes * i, &point, 12);
  }
  const uint32_t corners = 6 * (columns - 1) * (rows - 1);
  desc.index_count = is_valid() ? corners : byte() % 99;
  uint8_t *indices = is_valid() ? memory_of(4 * (size_t)desc.index_count) : NULL;
  for (uint32_t i = 0; indices != NULL && i < desc.index_count; i++) {
    const uint32_t cell = i / 6, corner = cell + cell / (columns - 1);
    const uint32_t of[] = {0, columns, 1, 1, columns, columns + 1};
    const uint32_t index = byte() < 240 ? corner + of[i % 6] : below(desc.vertex_count);
    memcpy(indices + 4 * (size_t)i, &index, 4);
  }
  desc.positions = (const float *)(const void *)positions;
  desc.indices = (const uint32_t *)(const void *)indices;
  desc.uvs = byte() % 2 ? numbers(2 * desc.vertex_count, number) : NULL;
  desc.pinned_count = byte() % 4;
  desc.pinned = list(desc.pinned_count, desc.vertex_count);
  if (!is_valid()) desc.vertex_count = UINT32_MAX; /* refused before the list is read, like: */
  if (!is_valid()) desc.index_count = UINT32_MAX;
  const MuslinMeshDesc *given = is_valid() ? copy_with_size(&desc, sizeof desc) : NULL;
  MuslinCloth *made = out(sizeof *made);
  store(check_result(CREATE_MESH, muslin_cloth_create_mesh(given, made)), made);
}

static void call_add_collider(void) {
  MuslinColliderDesc desc;
  muslin_collider_desc_init(&desc);
  desc.shape = below(7);
  desc.position = vector();
  desc.rotation = rotation();
  corrupt(&desc, sizeof desc);
  desc.columns = byte() % 6;
  desc.rows = byte() % 6;
  desc.vertex_count = byte() % 24;
  desc.index_count = byte() % 48;
  desc.position_stride = stride();
  desc.positions = points(desc.vertex_count, desc.position_stride);
  desc.indices = list(desc.index_count, desc.vertex_count);
  desc.heights = numbers(desc.columns * desc.rows, number);
  const MuslinColliderDesc *given = is_valid() ? copy_with_size(&desc, sizeof desc) : NULL;
  MuslinCollider *made = out(sizeof *made);
  const MuslinStatus status = check_result(ADD_COLLIDER, muslin_cloth_add_collider(cloth, given, made));
  if (status == MUSLIN_STATUS_OK) memcpy(&colliders[handle()], made, sizeof *made);
}

static void call_set_settings(void) {
  MuslinSettings settings;
  muslin_settings_init(&settings);
  settings.tearing = byte() % 2;
  settings.self_collision = byte() % 3;
  corrupt(&settings, sizeof settings);
  const MuslinSettings *given = is_valid() ? copy_with_size(&settings, sizeof settings) : NULL;
  check_result(SET_SETTINGS, muslin_cloth_set_settings(cloth, given));
  limit_settings(cloth);
}

static void call_set_material(void) {
  MuslinMaterial material;
  muslin_material_init(&material);
  check_result(MATERIAL_PRESET, muslin_material_preset(is_valid() ? &material : NULL, below(6)));
  if (byte() % 4 == 0) {
    /* Folds that yield early, with hardening and weakening. */
    material.yield_angle = at_least_0() / 16;
    material.yield_hardening = at_least_0();
    material.yield_weakening = at_least_0();
  }
  corrupt(&material, sizeof material);
  const MuslinMaterial *given = is_valid() ? copy_with_size(&material, sizeof material) : NULL;
  check_result(SET_MATERIAL, muslin_cloth_set_material(cloth, given));
}

static void call_set_wind(void) {
  MuslinWind wind;
  muslin_wind_init(&wind);
  wind.velocity = vector();
  corrupt(&wind, sizeof wind);
  check_result(SET_WIND, muslin_cloth_set_wind(cloth, is_valid() ? copy_with_size(&wind, sizeof wind) : NULL));
}

static void call_step(void) { check_result(STEP, muslin_cloth_step(cloth, byte() % 4)); }

static void call_advance(void) {
  const float seconds = at_least_0() / 32.0f;
  check_result(ADVANCE, muslin_cloth_advance(cloth, seconds, out(4)));
}

static void call_pin(void) {
  const uint32_t particle = below(particles());
  const MuslinVec3 target = vector();
  const MuslinVec3 *given = byte() % 2 ? memcpy(memory_of(sizeof target), &target, sizeof target) : NULL;
  check_result(PIN, muslin_cloth_pin(cloth, particle, given));
}

static void call_unpin(void) { check_result(UNPIN, muslin_cloth_unpin(cloth, below(particles()))); }

static void call_pins(void) {
  const uint32_t count = list_length(), step_bytes = stride();
  const uint32_t *which = list(count, byte() % 2 ? particles() : 2);
  const float *where = points(count, step_bytes);
  const float stiffness = at_least_0();
  switch (byte() % 4) {
    case 0: check_result(UNPIN_ALL, muslin_cloth_unpin_all(cloth)); break;
    case 1: check_result(SET_PIN_STIFFNESS, muslin_cloth_set_pin_stiffness(cloth, which, count, stiffness)); break;
    default: check_result(SET_PIN_TARGETS, muslin_cloth_set_pin_targets(cloth, which, where, step_bytes, count));
  }
}

static void call_leashes(void) {
  const uint32_t count = list_length(), step_bytes = stride();
  const uint32_t *which = list(count, byte() % 2 ? particles() : 2);
  const float *some = numbers(count, at_least_0), *more = numbers(count, at_least_0);
  const float *where = points(count, step_bytes), *normals = byte() % 2 ? points(count, step_bytes) : NULL;
  switch (byte() % 8) {
    case 0: check_result(SET_MASS_SCALES, muslin_cloth_set_mass_scales(cloth, which, some, count)); break;
    case 1: check_result(CLEAR_LEASHES, muslin_cloth_clear_leashes(cloth)); break;
    case 2: case 3: check_result(SET_BACKSTOPS, muslin_cloth_set_backstops(cloth, which, some, more, count)); break;
    case 4: case 5: check_result(SET_MAX_DISTANCES, muslin_cloth_set_max_distances(cloth, which, some, count)); break;
    default: check_result(SET_ANCHORS, muslin_cloth_set_anchors(cloth, which, where, normals, step_bytes, count));
  }
}

static void call_attach(void) {
  const uint32_t count = list_length(), which = handle();
  const uint32_t *of = list(count, particles());
  const MuslinVec3 position = vector();
  const MuslinQuat turned = rotation();
  MuslinAttachment *made = out(sizeof *made);
  switch (byte() % 4) {
    case 0:
      check_result(MOVE_ATTACHMENT, muslin_cloth_move_attachment(cloth, attachments[which], position, turned)); break;
    case 1: check_result(DETACH, muslin_cloth_detach(cloth, attachments[which])); break;
    default:
      if (check_result(ATTACH, muslin_cloth_attach(cloth, of, count, position, turned, made)) == MUSLIN_STATUS_OK) {
        memcpy(&attachments[which], made, sizeof *made);
      }
  }
}

static void call_place(void) {
  const uint32_t particle = below(particles());
  const MuslinVec3 there = vector();
  if (byte() % 2) check_result(SET_POSITION, muslin_cloth_set_position(cloth, particle, there));
  else check_result(SET_VELOCITY, muslin_cloth_set_velocity(cloth, particle, there));
}

static void call_raycast(void) {
  MuslinHit hit;
  muslin_hit_init(&hit);
  const MuslinVec3 from = vector(), along = aim();
  const float far = at_least_0();
  check_result(RAYCAST,
               muslin_cloth_raycast(cloth, from, along, far, is_valid() ? copy_with_size(&hit, sizeof hit) : NULL));
}

static void call_grab(void) {
  const uint32_t which = handle();
  const MuslinVec3 from = vector(), along = aim();
  MuslinGrab *made = out(sizeof *made);
  MuslinStatus status = MUSLIN_STATUS_FULL;
  switch (byte() % 4) {
    case 0: check_result(MOVE_GRAB, muslin_cloth_move_grab(cloth, grabs[which], from)); break;
    case 1: check_result(RELEASE, muslin_cloth_release(cloth, grabs[which])); break;
    case 2: status = check_result(GRAB_PARTICLE, muslin_cloth_grab_particle(cloth, below(particles()), made)); break;
    default: {
      const float radius = at_least_0();
      status = check_result(GRAB_RAY, muslin_cloth_grab_ray(cloth, from, along, radius, made, out(12)));
    }
  }
  if (status == MUSLIN_STATUS_OK) memcpy(&grabs[which], made, sizeof *made);
}

static void call_open(void) {
  const MuslinVec3 from = vector(), to = vector(), sweep = vector();
  const uint32_t a = below(particles()), columns = 1 + byte() % 12;
  switch (byte() % 4) {
    case 0:
      check_result(TEAR_EDGE, muslin_cloth_tear_edge(cloth, a, is_valid() ? a + columns : below(particles()))); break;
    case 1: check_result(CREASE, muslin_cloth_crease(cloth, from, to, number())); break;
    default: check_result(CUT, muslin_cloth_cut(cloth, from, to, sweep, byte() % 2 ? out(4) : NULL));
  }
}

static void call_next_event(void) {
  MuslinEvent event;
  muslin_event_init(&event);
  void *into = is_valid() ? copy_with_size(&event, sizeof event) : NULL;
  check_result(NEXT_EVENT, muslin_cloth_next_event(cloth, into, out(4)));
}

static void call_collider(void) {
  const uint32_t which = handle();
  const MuslinVec3 there = vector();
  const MuslinQuat turned = rotation();
  switch (byte() % 5) {
    case 0: check_result(REMOVE_COLLIDER, muslin_cloth_remove_collider(cloth, colliders[which])); break;
    case 1:
      check_result(TELEPORT_COLLIDER, muslin_cloth_teleport_collider(cloth, colliders[which], there, turned)); break;
    case 2: {
      void *linear = out(12);
      check_result(GET_COLLIDER_IMPULSE, muslin_cloth_get_collider_impulse(cloth, colliders[which], linear, out(12)));
      break;
    }
    default: check_result(MOVE_COLLIDER, muslin_cloth_move_collider(cloth, colliders[which], there, turned));
  }
}

static void call_body(void) {
  const MuslinVec3 there = vector();
  const MuslinQuat turned = rotation();
  const float inertia = at_least_0() / 8.0f;
  switch (byte() % 3) {
    case 0: check_result(SET_FRAME, muslin_cloth_set_frame(cloth, there, turned)); break;
    case 1: check_result(MOVE_FRAME, muslin_cloth_move_frame(cloth, there, turned, inertia)); break;
    default: check_result(TELEPORT, muslin_cloth_teleport(cloth, there, turned));
  }
}

/* An output struct, initialised or corrupted, in memory of the size that it states. */
#define REPORT(type, init, which, call)                   \
  do {                                                    \
    type report;                                          \
    memset(&report, 0xee, sizeof report);                 \
    init(&report);                                        \
    if (!is_valid()) corrupt(&report, 4);                     \
    void *into = is_valid() ? copy_with_size(&report, sizeof report) : NULL; \
    check_result(which, call);                                   \
  } while (0)

static void call_read(void) {
  switch (byte() % 8) {
    case 0: REPORT(MuslinView, muslin_view_init, VIEW, muslin_cloth_view(cloth, into)); break;
    case 1: REPORT(MuslinChanges, muslin_changes_init, CHANGES, muslin_cloth_changes(cloth, below(9), into)); break;
    case 2: REPORT(MuslinMeshReport, muslin_mesh_report_init, GET_MESH_REPORT, muslin_cloth_get_mesh_report(cloth, into)); break;
    case 3: REPORT(MuslinStats, muslin_stats_init, GET_STATS, muslin_cloth_get_stats(cloth, into)); break;
    case 4: REPORT(MuslinSettings, muslin_settings_init, GET_SETTINGS, muslin_cloth_get_settings(cloth, into)); break;
    case 5: REPORT(MuslinMaterial, muslin_material_init, GET_MATERIAL, muslin_cloth_get_material(cloth, into)); break;
    case 6: check_result(GET_ORIGIN, muslin_cloth_get_origin(cloth, out(12))); break;
    default: check_result(STATE_HASH, muslin_cloth_state_hash(cloth, out(8)));
  }
}

static void call_write_vertices(void) {
  const MuslinView seen = view_of(cloth);
  const uint32_t count = below(4), step = (uint32_t)sizeof(MuslinStream);
  const uint32_t strides[] = {32, 32, 32, 0, 48, 12, 31, 6, UINT32_MAX - 1};
  const size_t widths[] = {12, 12, 16, 8, 4}, step_bytes = strides[byte() % 9];
  size_t size = (byte() % 2 ? seen.vertex_count : seen.vertex_capacity) * (size_t)32;
  if (!is_valid()) size = byte() * (size_t)16;
#ifdef PLANTED
  /* A deliberate bug for testing the fuzzer: the memory lacks the last vertex of one mesh size. */
  const size_t lacking = seen.vertex_count > 50 && size >= 32 ? 32 : 0;
#else
  const size_t lacking = 0;
#endif
  uint8_t *block = aligned_memory(size - lacking), *streams = memory_of((count > 17 ? 17 : count) * (size_t)step);
  for (uint32_t i = 0; i < count && i < 17; i++) {
    const uint32_t attribute = below(5), width = (uint32_t)widths[attribute % 5];
    /* At the start or end of the stride, one after the other, anywhere, or NULL. */
    const size_t offsets[] = {0, step_bytes > width ? step_bytes - width : 0, 12 * (size_t)i, byte()};
    const size_t offset = offsets[byte() % 4];
    void *to = offset <= size && byte() < 250 ? block + offset : NULL;
    MuslinStream stream = muslin_stream(attribute, is_valid() ? 0 : below(4), to, (uint32_t)step_bytes,
                                        to == NULL ? 0 : size - offset);
    if (byte() > 250 && seen.normals != NULL) {
      /* Memory of a view must be refused. */
      memcpy(&stream.buffer, &seen.normals, sizeof stream.buffer);
      stream.size = 12 * (size_t)seen.vertex_count;
    }
    if (byte() > 250) stream.struct_size = byte() % (step + 1);
    memcpy(streams + (size_t)step * i, &stream, step);
  }
  MuslinWriteDesc desc;
  muslin_write_desc_init(&desc);
  corrupt(&desc, sizeof desc);
  const MuslinWriteDesc *given = byte() % 2 ? copy_with_size(&desc, sizeof desc) : NULL;
  const MuslinStream *of = is_valid() ? (const MuslinStream *)(const void *)streams : NULL;
  check_result(WRITE_VERTICES, muslin_cloth_write_vertices(cloth, of, count > 17 ? 17 : count, given));
}

static void call_write_indices(void) {
  const MuslinView seen = view_of(cloth);
  const uint32_t formats[] = {16, 32, 0, 8}, format = formats[is_valid() ? byte() % 2 : byte() % 4];
  const size_t needed = seen.index_count * (size_t)(format == 32 ? 4 : 2);
  const size_t sizes[] = {needed, needed + byte() % 8, needed > 0 ? needed - 1 : 0, byte()};
  const size_t size = sizes[byte() % 4];
  void *buffer = is_valid() ? memory_of(size) : NULL;
  const uint32_t flip = below(2), base = below(300);
  check_result(WRITE_INDICES, muslin_cloth_write_indices(cloth, buffer, size, format, flip, base));
}

static void call_save(void) {
  size_t needed = 0;
  (void)muslin_cloth_save(cloth, NULL, 0, &needed);
  const size_t sizes[] = {needed, needed + 1, needed > 0 ? needed - 1 : 0, byte()};
  const size_t size = sizes[byte() % 4];
  void *buffer = is_valid() ? memory_of(size) : NULL;
  check_result(SAVE, muslin_cloth_save(cloth, buffer, size, byte() % 2 ? out(sizeof size) : NULL));
}

/* Restores a save, sometimes with a few changed bytes and a matching checksum. */
static void call_restore(void) {
  size_t size = 0;
  if (muslin_cloth_save(cloth, NULL, 0, &size) != MUSLIN_STATUS_OK) return;
  uint8_t *bytes = memory_of(size);
  if (muslin_cloth_save(cloth, bytes, size, NULL) != MUSLIN_STATUS_OK) abort();
  for (uint32_t n = byte() % 5; n > 0; n--) bytes[20 + (byte() | byte() << 8) % (size - 20)] = (uint8_t)byte();
  if (!is_valid()) size = byte() % (size + 1);
  if (size >= 20 && is_valid()) write_checksum(bytes, size);
  MuslinCloth *made = out(sizeof *made);
  const void *given = is_valid() ? memcpy(memory_of(size), bytes, size) : NULL;
  store(check_result(RESTORE, muslin_cloth_restore(given, size, made)), made);
}

static void call_whole(void) {
  switch (byte() % 4) {
    case 0: check_result(DESTROY, muslin_cloth_destroy(cloth)); break;
    default: check_result(RESET, muslin_cloth_reset(cloth));
  }
}

static void call_library(void) {
  (void)muslin_version();
  if (muslin_version_string() == NULL || muslin_status_string(word())[0] == '\0') abort();
  (void)muslin_stage_name(below(31));
  const uint32_t level = below(4);
  const MuslinStatus status = muslin_set_log(byte() % 2 ? log_function : NULL, level, is_valid() ? &log_count : NULL);
  check_result(SET_LOG, status);
}

/* The functions behind every ..._init, with any size that the memory has. */
static void call_init(void) {
  const uint32_t size = is_valid() ? 4 * (byte() % 128) : byte() << 4 | byte() >> 4;
  void *of = is_valid() ? memory_of(size) : NULL;
  const uint32_t material = is_valid() ? (uint32_t)sizeof(MuslinMaterial) : below(size);
  const uint32_t settings = is_valid() ? (uint32_t)sizeof(MuslinSettings) : below(size);
  switch (byte() % 8) {
    case 0: check_result(SETTINGS_INIT, muslin_settings_init_sized(of, size)); break;
    case 1: check_result(MATERIAL_INIT, muslin_material_init_sized(of, size)); break;
    case 2: check_result(WIND_INIT, muslin_wind_init_sized(of, size)); break;
    case 3: check_result(COLLIDER_DESC_INIT, muslin_collider_desc_init_sized(of, size)); break;
    case 4: check_result(STREAM_INIT, muslin_stream_init_sized(of, size)); break;
    case 5: check_result(WRITE_DESC_INIT, muslin_write_desc_init_sized(of, size)); break;
    case 6: check_result(GRID_DESC_INIT, muslin_grid_desc_init_sized(of, size, material, settings)); break;
    default: check_result(MESH_DESC_INIT, muslin_mesh_desc_init_sized(of, size, material, settings));
  }
}

/* Frequent calls are listed several times. */
static void (*const calls[])(void) = {
    call_create_grid, call_create_mesh,    call_step,          call_step,     call_advance,  call_pin,
    call_unpin,       call_pins,           call_leashes,       call_attach,   call_place,    call_raycast,
    call_grab,        call_grab,           call_open,          call_open,     call_step,     call_next_event,
    call_add_collider, call_collider,      call_body,          call_read,     call_read,     call_write_vertices,
    call_write_indices, call_save,         call_restore,       call_whole,    call_library,  call_init,
    call_set_settings, call_set_material,  call_set_wind,      call_add_collider,
};

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);
int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
  at = data;
  end = data + size;
  begin();
  choose();
  call_create_grid();
  free_all_memory();
  for (int n = 0; at < end && n < 200; n++) {
    const uint32_t which = byte();
    choose();
    calls[which % (sizeof calls / sizeof calls[0])]();
    free_all_memory();
    if (n % 8 == 7) check_view(cloth);
  }
  finish();
  return 0;
}
