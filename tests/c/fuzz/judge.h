/* State between calls, and the checks after each call. */
#ifndef MUSLIN_FUZZ_JUDGE_H
#define MUSLIN_FUZZ_JUDGE_H

#include "input.h"
#include <stdio.h>

/* All functions that return a status. EACH_READING functions leave a cloth unchanged even if they succeed. */
#define EACH_CHANGING(X)                                                                                       \
  X(CREATE_GRID) X(CREATE_MESH) X(DESTROY) X(RESET) X(SET_SETTINGS) X(SET_MATERIAL) X(SET_WIND) X(ADVANCE)     \
  X(STEP) X(PIN) X(UNPIN) X(UNPIN_ALL) X(SET_PIN_TARGETS) X(SET_PIN_STIFFNESS) X(SET_MASS_SCALES)              \
  X(SET_POSITION) X(SET_VELOCITY) X(ATTACH) X(MOVE_ATTACHMENT) X(DETACH) X(SET_MAX_DISTANCES) X(SET_BACKSTOPS) \
  X(SET_ANCHORS) X(CLEAR_LEASHES) X(GRAB_RAY) X(GRAB_PARTICLE) X(MOVE_GRAB) X(RELEASE) X(TEAR_EDGE) X(CREASE)  \
  X(CUT) X(NEXT_EVENT) X(ADD_COLLIDER) X(MOVE_COLLIDER) X(REMOVE_COLLIDER) X(SET_FRAME) X(MOVE_FRAME) X(TELEPORT)          \
  X(TELEPORT_COLLIDER)
#define EACH_READING(X)                                                                                        \
  X(MATERIAL_PRESET) X(GET_SETTINGS) X(GET_MATERIAL) X(RAYCAST) X(GET_COLLIDER_IMPULSE) X(VIEW) X(CHANGES)     \
  X(GET_MESH_REPORT) X(GET_STATS) X(GET_ORIGIN) X(STATE_HASH) X(WRITE_VERTICES) X(WRITE_INDICES) X(SAVE) X(RESTORE)          \
  X(SET_LOG) X(SETTINGS_INIT) X(MATERIAL_INIT) X(WIND_INIT) X(COLLIDER_DESC_INIT) X(STREAM_INIT)               \
  X(WRITE_DESC_INIT) X(GRID_DESC_INIT) X(MESH_DESC_INIT)

#define NUMBER(name) name,
#define NAME(name) #name,
typedef enum Function { EACH_CHANGING(NUMBER) CHANGING, EACH_READING(NUMBER) FUNCTIONS } Function;
static const char *const function_names[] = {EACH_CHANGING(NAME) "", EACH_READING(NAME)};

enum { CLOTHS = 4, HELD = 4, STATUSES = MUSLIN_STATUS_PANICKED + 1 };

static MuslinCloth cloths[CLOTHS], cloth;
static MuslinGrab grabs[HELD];
static MuslinCollider colliders[HELD];
static MuslinAttachment attachments[HELD];
static uint64_t before;
static int had_hash;
static int is_traced; /* prints each call if MUSLIN_TRACE is set in the environment */

static uint64_t status_counts[FUNCTIONS][STATUSES];

/* Prints the failure and aborts, so that the fuzzer records the input. */
static void fail(const char *function, const char *what) {
  fprintf(stderr, "%s: %s (last error: %s)\n", function, what, muslin_last_error());
  abort();
}

static int hash_of(MuslinCloth of, uint64_t *hash) { return muslin_cloth_state_hash(of, hash) == MUSLIN_STATUS_OK; }

/* Chooses the cloth of the next call; seldom an invalid handle. */
static void choose(void) {
  const uint32_t which = byte();
  cloth = cloths[which % CLOTHS];
  for (uint32_t i = 1; cloth.id == 0 && i < CLOTHS; i++) cloth = cloths[(which + i) % CLOTHS];
  if (which > 250) cloth.id = which == 251 ? word() : cloth.id + ((uint64_t)1 << 32);
  had_hash = hash_of(cloth, &before);
}

/* Checks the result of a call, and counts it. */
static MuslinStatus check_result(Function function, MuslinStatus status) {
  const char *name = function_names[function];
  if ((unsigned)status >= STATUSES) fail(name, "unknown status");
  status_counts[function][status]++;
  if (is_traced) fprintf(stderr, "%s: %s\n", name, muslin_status_string(status));
  if (status == MUSLIN_STATUS_PANICKED) fail(name, "a panic");
  if (status != MUSLIN_STATUS_OK && muslin_last_error()[0] == '\0') fail(name, "refused without a message");
  uint64_t after = 0;
  if (status != MUSLIN_STATUS_OK || function > CHANGING) {
    if (hash_of(cloth, &after) != had_hash) fail(name, "a refused or reading call created or destroyed the cloth");
    if (had_hash && after != before) fail(name, "a refused or reading call changed the cloth");
  }
  return status;
}

/* The view of a cloth; all zeros for an invalid handle. */
static MuslinView view_of(MuslinCloth of) {
  MuslinView view;
  memset(&view, 0, sizeof view);
  muslin_view_init(&view);
  (void)muslin_cloth_view(of, &view);
  return view;
}

static uint32_t particles(void) {
  MuslinStats stats;
  muslin_stats_init(&stats);
  return muslin_cloth_get_stats(cloth, &stats) == MUSLIN_STATUS_OK ? stats.particles : 0;
}

/* A list length: a few, or the number of particles, or one more. */
static uint32_t list_length(void) {
  if (is_valid()) return byte() % 9;
  const uint32_t all = particles();
  return byte() % 2 ? all + 1 : all;
}

/* Checks what a renderer relies on. */
static void check_view(MuslinCloth of) {
  const MuslinView view = view_of(of);
  if (view.vertex_count > view.vertex_capacity || view.index_count > view.index_capacity)
    fail("VIEW", "counts exceed the capacities");
  for (uint32_t i = 0; i < view.index_count; i++) {
    if (view.indices[i] >= view.vertex_count) fail("VIEW", "an index is past the last vertex");
  }
  for (uint32_t i = 0; i < view.vertex_count; i++) {
    if (view.particles[i] >= view.vertex_capacity) fail("VIEW", "a particle is past the last one");
    if (view.source_vertices[i] >= view.vertex_count || view.frayed[i] > 1)
      fail("VIEW", "an invalid source vertex or frayed flag");
  }
  for (uint32_t i = 0; i < 3 * view.vertex_count; i++) {
    if (!isfinite(view.positions[i])) fail("VIEW", "a position is not finite");
    if (!isfinite(view.normals[i])) fail("VIEW", "a normal is not finite");
  }
}

/* Limits the settings, so that a tick does not take minutes. */
static void limit_settings(MuslinCloth of) {
  MuslinSettings settings;
  muslin_settings_init(&settings);
  if (muslin_cloth_get_settings(of, &settings) != MUSLIN_STATUS_OK) return;
  const uint32_t most = settings.self_collision == MUSLIN_SELF_COLLISION_SURFACE ? 1 : 4;
  if (settings.substeps > most) settings.substeps = most;
  if (settings.iterations > most) settings.iterations = most;
  if (settings.max_ticks_per_advance > 8) settings.max_ticks_per_advance = 8;
  if (muslin_cloth_set_settings(of, &settings) != MUSLIN_STATUS_OK)
    fail("SET_SETTINGS", "its own settings are refused");
}

/* Stores a new cloth in place of an older one. */
static void store(MuslinStatus status, const void *made) {
  if (status != MUSLIN_STATUS_OK) return;
  const uint32_t place = byte() % CLOTHS;
  if (hash_of(cloths[place], &before)) {
    if (muslin_cloth_destroy(cloths[place]) != MUSLIN_STATUS_OK) fail("DESTROY", "refused");
  }
  memcpy(&cloths[place], made, sizeof cloths[place]);
  limit_settings(cloths[place]);
}

/* Writes the checksum that matches these bytes. */
static void write_checksum(uint8_t *bytes, size_t size) {
  const size_t head = 20;
  uint64_t sum = (uint64_t)(size - head) ^ 0x9e3779b97f4a7c15u;
  for (size_t i = head; i < size; i += 4) {
    uint32_t w = 0;
    memcpy(&w, bytes + i, size - i < 4 ? size - i : 4);
    sum = (sum ^ w) * 0xff51afd7ed558ccdu;
    sum = sum << 29 | sum >> 35;
  }
  sum = (sum ^ sum >> 30) * 0xbf58476d1ce4e5b9u;
  sum = (sum ^ sum >> 27) * 0x94d049bb133111ebu;
  sum ^= sum >> 31;
  memcpy(bytes + head - 8, &sum, 8);
}

/* A log function that calls the library. */
static int log_count;
static void log_function(uint32_t level, const char *message, void *user) {
  if (level == 0 || level > MUSLIN_LOG_INFO || message[0] == '\0') abort();
  if (user != NULL) ++*(int *)user;
  (void)muslin_version_string();
  (void)muslin_last_error();
}

/* Prints how often each function returned each status. */
static void print_counts(void) {
  uint64_t all = 0, done = 0;
  for (int f = 0; f < FUNCTIONS; f++) {
    if (f == CHANGING) continue;
    fprintf(stderr, "%-22s", function_names[f]);
    for (int s = 0; s < STATUSES; s++) {
      all += status_counts[f][s];
      if (s == 0) done += status_counts[f][s];
      if (status_counts[f][s] != 0) fprintf(stderr, " %d:%llu", s, (unsigned long long)status_counts[f][s]);
    }
    fprintf(stderr, "\n");
  }
  fprintf(stderr, "fuzzed %llu calls, %llu of them succeeded\n", (unsigned long long)all, (unsigned long long)done);
}

static void begin(void) {
  static int is_counting = 0;
  if (!is_counting) atexit(print_counts);
  is_counting = 1;
  is_traced = getenv("MUSLIN_TRACE") != NULL;
  memset(cloths, 0, sizeof cloths);
  memset(grabs, 0, sizeof grabs);
  memset(colliders, 0, sizeof colliders);
  memset(attachments, 0, sizeof attachments);
  if (muslin_set_log(NULL, 0, NULL) != MUSLIN_STATUS_OK) fail("SET_LOG", "refused");
}

/* Restores a save and steps both cloths, which must stay equal; then destroys all. */
static void finish(void) {
  size_t size = 0;
  for (int i = 0; i < CLOTHS; i++) {
    check_view(cloths[i]);
    if (muslin_cloth_save(cloths[i], NULL, 0, &size) == MUSLIN_STATUS_OK) cloth = cloths[i];
  }
  if (muslin_cloth_save(cloth, NULL, 0, &size) == MUSLIN_STATUS_OK) {
    void *bytes = aligned_memory(size);
    MuslinCloth again = {0};
    uint64_t one = 0, other = 1;
    if (muslin_cloth_save(cloth, bytes, size, NULL) != MUSLIN_STATUS_OK) fail("SAVE", "refused");
    if (muslin_cloth_restore(bytes, size, &again) != MUSLIN_STATUS_OK) fail("RESTORE", "a valid save is refused");
    for (int tick = 0; tick < 3; tick++) {
      if (!hash_of(cloth, &one) || !hash_of(again, &other) || one != other)
        fail("RESTORE", "the restored cloth has another hash");
      if (muslin_cloth_step(cloth, 1) != muslin_cloth_step(again, 1))
        fail("STEP", "one of two equal cloths is refused");
    }
    if (muslin_cloth_destroy(again) != MUSLIN_STATUS_OK) fail("DESTROY", "refused");
    free_all_memory();
  }
  for (int i = 0; i < CLOTHS; i++) (void)muslin_cloth_destroy(cloths[i]);
}

#endif
