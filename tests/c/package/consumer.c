/* A program that uses the installed package: hangs a sheet and writes its vertices once. */
#include <muslin.h>
#include <stdio.h>

#ifdef WITH_OTHER
/* Another Rust library in the same program, which panics on purpose. */
int other_catches(void);
#endif

int main(void) {
  static float vertices[1600][3];
  MuslinGridDesc desc;
  MuslinCloth cloth = {0};
  muslin_grid_desc_init(&desc);
  const MuslinStream stream = muslin_stream(MUSLIN_ATTRIBUTE_POSITION, MUSLIN_FORMAT_F32, vertices,
                                            sizeof vertices[0], sizeof vertices);
  if (muslin_cloth_create_grid(&desc, &cloth) != MUSLIN_STATUS_OK ||
      muslin_cloth_step(cloth, 30) != MUSLIN_STATUS_OK ||
      muslin_cloth_write_vertices(cloth, &stream, 1, NULL) != MUSLIN_STATUS_OK ||
      muslin_cloth_destroy(cloth) != MUSLIN_STATUS_OK) {
    fprintf(stderr, "refused: %s\n", muslin_last_error());
    return 1;
  }
#ifdef WITH_OTHER
  if (other_catches() != 7) return 1;
#endif
  printf("Muslin %s: the sheet hangs down to %.2f m\n", muslin_version_string(), (double)vertices[1599][1]);
  return vertices[1599][1] < -1.9f ? 0 : 1;
}
