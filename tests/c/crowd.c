/* Many cloths on two threads for a while, created, stepped and destroyed there: both threads get the same bits.
 *
 *   crowd [CLOTHS SECONDS]
 *
 * `cargo xtask race` runs it for a minute under the thread sanitizer. */
#define _POSIX_C_SOURCE 200809L
#include "check.h"
#include <pthread.h>
#include <stdlib.h>
#include <time.h>

enum { MOST_ROUNDS = 100000, LIVES = 20 };

static int cloths = 50;
static double seconds = 0.2;

typedef struct Player {
  pthread_t thread;
  int rounds, refused;
  uint64_t *sums; /* sum of all hashes, one per round */
} Player;

static double now(void) {
  struct timespec time;
  clock_gettime(CLOCK_MONOTONIC, &time);
  return (double)time.tv_sec + (double)time.tv_nsec * 1e-9;
}

/* A small sheet, each with other settings: some tear, some collide with themselves, some lie on a ball. */
static MuslinCloth make(int which) {
  MuslinGridDesc desc;
  MuslinCloth cloth = {0};
  muslin_grid_desc_init(&desc);
  desc.columns = 3 + (uint32_t)which % 5;
  desc.rows = 3 + (uint32_t)which % 3;
  desc.spacing = 0.1f;
  desc.settings.tearing = which % 2 == 0;
  desc.settings.self_collision = (uint32_t)which % 3;
  desc.material.tear_stretch = 1.05f;
  desc.pin_mode = MUSLIN_PIN_TOP_CORNERS;
  if (muslin_cloth_create_grid(&desc, &cloth) != MUSLIN_STATUS_OK) cloth.id = 0;
  MuslinColliderDesc ball;
  MuslinCollider made;
  muslin_collider_desc_init(&ball);
  ball.shape = MUSLIN_SHAPE_SPHERE;
  ball.radius = 0.2f;
  if (which % 4 == 0) (void)muslin_cloth_add_collider(cloth, &ball, &made);
  MuslinWind wind;
  muslin_wind_init(&wind);
  wind.velocity.z = (float)(which % 7);
  (void)muslin_cloth_set_wind(cloth, &wind);
  return cloth;
}

static void *play(void *with) {
  Player *player = with;
  MuslinCloth *own = calloc((size_t)cloths, sizeof *own);
  const double end = now() + seconds;
  while (own != NULL && now() < end && player->rounds < MOST_ROUNDS) {
    uint64_t sum = 0;
    for (int i = 0; i < cloths; i++) {
      uint64_t hash = 0;
      if (player->rounds % LIVES == 0) own[i] = make(i);
      /* The error message belongs to the thread of the refused call. */
      player->refused += muslin_cloth_unpin(own[i], 1000) != MUSLIN_STATUS_BAD_INDEX;
      player->refused += muslin_cloth_step(own[i], 1) != MUSLIN_STATUS_OK;
      player->refused += muslin_cloth_state_hash(own[i], &hash) != MUSLIN_STATUS_OK;
      sum = sum * 31 + hash;
      if (player->rounds % LIVES == LIVES - 1) {
        player->refused += muslin_cloth_destroy(own[i]) != MUSLIN_STATUS_OK;
        own[i].id = 0;
      }
    }
    player->sums[player->rounds++] = sum;
  }
  for (int i = 0; own != NULL && i < cloths; i++) (void)muslin_cloth_destroy(own[i]);
  free(own);
  return NULL;
}

int main(int count, char **words) {
  if (count == 3) {
    cloths = atoi(words[1]);
    seconds = atof(words[2]);
  }
  Player players[2];
  memset(players, 0, sizeof players);
  for (int i = 0; i < 2; i++) {
    players[i].sums = calloc(MOST_ROUNDS, sizeof *players[i].sums);
    if (players[i].sums == NULL || pthread_create(&players[i].thread, NULL, play, &players[i]) != 0) abort();
  }
  for (int i = 0; i < 2; i++) pthread_join(players[i].thread, NULL);
  int both = players[0].rounds < players[1].rounds ? players[0].rounds : players[1].rounds;
  CHECK(both > 0 && players[0].refused == 0 && players[1].refused == 0);
  for (int i = 0; i < both; i++) CHECK(players[0].sums[i] == players[1].sums[i]);
  printf("%s %d cloths on each of two threads, %d and %d ticks each, the same bits\n",
         failures == 0 ? "  ok" : "FAIL", cloths, players[0].rounds, players[1].rounds);
  for (int i = 0; i < 2; i++) free(players[i].sums);
  return failures != 0;
}
