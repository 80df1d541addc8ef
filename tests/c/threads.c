/* Different cloths run on different threads at once; a cloth in use on another thread is busy. */
#define _POSIX_C_SOURCE 200809L
#include "check.h"
#include <pthread.h>
#include <stdlib.h>

enum { THREADS = 4, ROUNDS = 40 };

static MuslinCloth cloth_of(uint32_t columns) {
  MuslinGridDesc desc;
  MuslinCloth cloth = {0};
  muslin_grid_desc_init(&desc);
  desc.columns = desc.rows = columns;
  if (muslin_cloth_create_grid(&desc, &cloth) != MUSLIN_STATUS_OK) cloth.id = 0;
  return cloth;
}

static void run(void *(*of)(void *), void *with[THREADS]) {
  pthread_t threads[THREADS];
  for (int i = 0; i < THREADS; i++) {
    if (pthread_create(&threads[i], NULL, of, with[i]) != 0) abort();
  }
  for (int i = 0; i < THREADS; i++) pthread_join(threads[i], NULL);
}

typedef struct Own {
  uint32_t number;
  uint64_t hash;
  int sound;
} Own;

/* Creates, steps and destroys cloths of its own, and reads the last error of its thread in between. */
static void *play_alone(void *with) {
  Own *own = with;
  char index[16];
  snprintf(index, sizeof index, "is %u", (unsigned)(1000 + own->number));
  own->sound = 1;
  for (int round = 0; round < ROUNDS; round++) {
    MuslinCloth cloth = cloth_of(8);
    int refused = muslin_cloth_unpin(cloth, 1000 + own->number) == MUSLIN_STATUS_BAD_INDEX;
    int stepped = muslin_cloth_step(cloth, 5) == MUSLIN_STATUS_OK;
    int told = strstr(muslin_last_error(), index) != NULL;
    int hashed = muslin_cloth_state_hash(cloth, &own->hash) == MUSLIN_STATUS_OK;
    int destroyed = muslin_cloth_destroy(cloth) == MUSLIN_STATUS_OK;
    own->sound = own->sound && refused && stepped && told && hashed && destroyed;
  }
  return NULL;
}

static void cloths_on_different_threads_are_independent(void) {
  Own owns[THREADS];
  void *with[THREADS];
  memset(owns, 0, sizeof owns);
  for (uint32_t i = 0; i < THREADS; i++) {
    owns[i].number = i;
    with[i] = &owns[i];
  }
  CHECK(muslin_cloth_step(cloth_of(1), 1) == MUSLIN_STATUS_BAD_HANDLE);
  const char *mine = muslin_last_error();
  char before[256];
  snprintf(before, sizeof before, "%s", mine);
  run(play_alone, with);
  for (int i = 0; i < THREADS; i++) {
    CHECK(owns[i].sound);
    CHECK(owns[i].hash == owns[0].hash && owns[i].hash != 0);
  }
  CHECK(muslin_last_error() == mine && strcmp(mine, before) == 0);
}

typedef struct Shared {
  MuslinCloth cloth;
  int done, busy, other;
} Shared;

static void *share(void *with) {
  Shared *shared = with;
  for (int round = 0; round < ROUNDS; round++) {
    MuslinStatus status = muslin_cloth_step(shared->cloth, 3);
    if (status == MUSLIN_STATUS_OK) shared->done++;
    else if (status == MUSLIN_STATUS_BUSY && strstr(muslin_last_error(), "another thread")) shared->busy++;
    else shared->other++;
  }
  return NULL;
}

static void one_cloth_on_many_threads_is_busy_and_stays_valid(void) {
  MuslinCloth cloth = cloth_of(20);
  Shared shared[THREADS];
  void *with[THREADS];
  memset(shared, 0, sizeof shared);
  for (int i = 0; i < THREADS; i++) {
    shared[i].cloth = cloth;
    with[i] = &shared[i];
  }
  run(share, with);
  int done = 0;
  for (int i = 0; i < THREADS; i++) {
    done += shared[i].done;
    CHECK(shared[i].other == 0 && shared[i].done + shared[i].busy == ROUNDS);
  }
  CHECK(done >= 1);
  MuslinStats stats;
  muslin_stats_init(&stats);
  DONE(muslin_cloth_get_stats(cloth, &stats));
  CHECK(stats.ticks == (uint32_t)(3 * done));
  DONE(muslin_cloth_destroy(cloth));
}

typedef struct Logged {
  MuslinCloth cloth;
  MuslinStatus inside;
} Logged;

/* A log function that uses the cloth of the logged call. */
static void step_from_the_log(uint32_t level, const char *message, void *user) {
  Logged *logged = user;
  (void)message;
  if (level == MUSLIN_LOG_WARN) logged->inside = muslin_cloth_step(logged->cloth, 1);
}

static void a_log_function_may_call_the_library(void) {
  Logged logged;
  logged.cloth = cloth_of(4);
  logged.inside = MUSLIN_STATUS_PANICKED;
  DONE(muslin_set_log(step_from_the_log, MUSLIN_LOG_INFO, &logged));
  CHECK(muslin_cloth_unpin(logged.cloth, 16) == MUSLIN_STATUS_BAD_INDEX);
  CHECK(logged.inside == MUSLIN_STATUS_OK);
  DONE(muslin_set_log(NULL, 0, NULL));
  logged.inside = MUSLIN_STATUS_PANICKED;
  CHECK(muslin_cloth_unpin(logged.cloth, 16) == MUSLIN_STATUS_BAD_INDEX);
  CHECK(logged.inside == MUSLIN_STATUS_PANICKED);
  DONE(muslin_cloth_destroy(logged.cloth));
}

static void *destroy_on_another_thread(void *with) {
  Shared *shared = with;
  MuslinStatus status;
  do {
    status = muslin_cloth_destroy(shared->cloth);
    if (status == MUSLIN_STATUS_OK) shared->done++;
    else if (status == MUSLIN_STATUS_BUSY) shared->busy++;
    else if (status != MUSLIN_STATUS_BAD_HANDLE) shared->other++;
  } while (status == MUSLIN_STATUS_BUSY);
  return NULL;
}

static void only_one_of_several_threads_destroys_a_cloth(void) {
  for (int round = 0; round < ROUNDS; round++) {
    MuslinCloth cloth = cloth_of(4);
    Shared shared[THREADS];
    void *with[THREADS];
    memset(shared, 0, sizeof shared);
    for (int i = 0; i < THREADS; i++) {
      shared[i].cloth = cloth;
      with[i] = &shared[i];
    }
    run(destroy_on_another_thread, with);
    int done = 0;
    for (int i = 0; i < THREADS; i++) {
      done += shared[i].done;
      CHECK(shared[i].other == 0);
    }
    CHECK(done == 1);
  }
}

int main(void) {
  TEST(cloths_on_different_threads_are_independent);
  TEST(one_cloth_on_many_threads_is_busy_and_stays_valid);
  TEST(a_log_function_may_call_the_library);
  TEST(only_one_of_several_threads_destroys_a_cloth);
  return failures != 0;
}
