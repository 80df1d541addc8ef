/* The log, the version, and names of statuses and stages. */
#include "check.h"

static int heard[4];

static void count_messages(uint32_t level, const char *message, void *user) {
  if (level < 4 && message[0] != '\0' && user == heard) heard[level]++;
}

static void the_log_reports_creation_destruction_and_refusals(void) {
  MuslinGridDesc desc;
  MuslinCloth made = {0};
  const MuslinVec3 eye = {0.5f, -0.5f, 5}, ahead = {0, 0, -1};
  MuslinHit hit;
  muslin_grid_desc_init(&desc);
  muslin_hit_init(&hit);
  DONE(muslin_set_log(count_messages, MUSLIN_LOG_INFO, heard));
  DONE(muslin_cloth_create_grid(&desc, &made));
  CHECK(muslin_cloth_unpin(made, 9999) == MUSLIN_STATUS_BAD_INDEX);
  CHECK(muslin_cloth_raycast(made, eye, ahead, 0, &hit) == MUSLIN_STATUS_NOTHING_HIT);
  DONE(muslin_cloth_destroy(made));
  CHECK(heard[MUSLIN_LOG_INFO] == 2 && heard[MUSLIN_LOG_WARN] == 1 && heard[MUSLIN_LOG_ERROR] == 0);
  DONE(muslin_set_log(count_messages, MUSLIN_LOG_ERROR, heard));
  CHECK(muslin_cloth_destroy(made) == MUSLIN_STATUS_BAD_HANDLE);
  CHECK(heard[MUSLIN_LOG_WARN] == 1);
  DONE(muslin_set_log(NULL, MUSLIN_LOG_INFO, NULL));
}

static void every_status_and_stage_has_a_name(void) {
  MuslinCloth cloth = {0};
  MuslinGridDesc desc;
  muslin_grid_desc_init(&desc);
  desc.columns = desc.rows = 20;
  DONE(muslin_cloth_create_grid(&desc, &cloth));
  char version[32];
  const unsigned number = (unsigned)muslin_version();
  snprintf(version, sizeof version, "%u.%u.%u", number >> 16, number >> 8 & 255, number & 255);
  CHECK(strcmp(muslin_version_string(), version) == 0 && number > 0);
  CHECK(strcmp(muslin_status_string(MUSLIN_STATUS_OK), "done") == 0);
  CHECK(muslin_status_string(0xffffffffu)[0] != '\0');
  MuslinStats stats;
  muslin_stats_init(&stats);
  DONE(muslin_cloth_get_stats(cloth, &stats));
  DONE(muslin_cloth_step(cloth, 1));
  DONE(muslin_cloth_get_stats(cloth, &stats));
  double sum = 0;
  for (uint32_t i = 0; i < MUSLIN_STAGE_SLOTS; i++) {
    CHECK((muslin_stage_name(i) != NULL) == (i < stats.stage_count));
    CHECK(i < stats.stage_count || stats.seconds[i] == 0);
    sum += (double)stats.seconds[i];
  }
  CHECK(sum > 0 && sum < 10);
  CHECK(stats.particles == 400 && stats.pieces == 1 && stats.bytes > 400 * 12);
  DONE(muslin_cloth_destroy(cloth));
}

int main(void) {
  TEST(the_log_reports_creation_destruction_and_refusals);
  TEST(every_status_and_stage_has_a_name);
  return failures != 0;
}
