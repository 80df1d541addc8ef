/* A sheet hangs by its top edge in a light wind; a grab pulls it until it tears.
 *
 *   cc -std=c99 -Iinclude bindings/c/examples/hang.c target/release/libmuslin.a -lm -lpthread -ldl
 */
#include <muslin.h>
#include <stdio.h>

/* Prints why a call was refused. */
static int refused(const char *what) {
  fprintf(stderr, "%s: %s\n", what, muslin_last_error());
  return 1;
}

/* Prints the events: the first three torn edges and all detached pieces. */
static void print_events(MuslinCloth cloth) {
  MuslinEvent event;
  uint32_t some = 0, count = 0;
  muslin_event_init(&event);
  while (muslin_cloth_next_event(cloth, &event, &some) == MUSLIN_STATUS_OK && some != 0) {
    if (event.kind == MUSLIN_EVENT_EDGE_TORN && count++ < 3) {
      printf("  tick %u: edge %u-%u tore at (%.2f, %.2f, %.2f)\n", (unsigned)event.tick,
             (unsigned)event.particle_a, (unsigned)event.particle_b, (double)event.position.x,
             (double)event.position.y, (double)event.position.z);
    } else if (event.kind == MUSLIN_EVENT_PIECE_DETACHED) {
      printf("  tick %u: a piece of %u triangles came off\n", (unsigned)event.tick,
             (unsigned)event.count);
    }
  }
  if (count > 3) printf("  ... and %u edges more\n", (unsigned)(count - 3));
}

int main(void) {
  MuslinGridDesc desc;
  muslin_grid_desc_init(&desc);
  desc.pin_mode = MUSLIN_PIN_TOP_EDGE;
  desc.settings.tearing = 1;
  desc.material.tear_stretch = 1.5f;
  MuslinCloth cloth = {0};
  if (muslin_cloth_create_grid(&desc, &cloth) != MUSLIN_STATUS_OK) return refused("create");

  MuslinWind wind;
  muslin_wind_init(&wind);
  wind.velocity.z = 1.5f;
  wind.gust = 0.5f;
  if (muslin_cloth_set_wind(cloth, &wind) != MUSLIN_STATUS_OK) return refused("wind");

  const MuslinVec3 eye = {1.0f, -1.2f, 5.0f}, ahead = {0.0f, 0.0f, -1.0f};
  MuslinVec3 hand = eye;
  MuslinGrab grab = {0};
  MuslinStats stats;
  muslin_stats_init(&stats);
  for (int frame = 0; frame < 300; frame++) {
    MuslinStatus status = MUSLIN_STATUS_OK;
    if (frame == 120) status = muslin_cloth_grab_ray(cloth, eye, ahead, 0.1f, &grab, &hand);
    if (status != MUSLIN_STATUS_OK) return refused("grab");
    if (frame >= 120 && frame < 240) {
      hand.z += 0.03f;
      status = muslin_cloth_move_grab(cloth, grab, hand);
    } else if (frame == 240) {
      status = muslin_cloth_release(cloth, grab);
    }
    if (status != MUSLIN_STATUS_OK) return refused("pull");
    if (muslin_cloth_advance(cloth, 1.0f / 60.0f, NULL) != MUSLIN_STATUS_OK) return refused("advance");
    if (frame % 60 != 59) continue;

    if (muslin_cloth_get_stats(cloth, &stats) != MUSLIN_STATUS_OK) return refused("stats");
    printf("%d s: %u vertices, pieces: %u, stretch: %.1f %% at most, motion: %.3f J\n",
           (frame + 1) / 60, (unsigned)stats.particles, (unsigned)stats.pieces,
           100.0 * (double)stats.max_stretch, (double)stats.kinetic_energy);
    print_events(cloth);
  }
  if (muslin_cloth_destroy(cloth) != MUSLIN_STATUS_OK) return refused("destroy");
  if (stats.particles == 1600) {
    fprintf(stderr, "the grab pulled, but no edge tore\n");
    return 1;
  }
  return 0;
}
