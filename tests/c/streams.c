/* Vertices and indices in the caller's buffers: layouts, formats, changed ranges and refusals. */
#include "check.h"
#include <math.h>
#include <stdlib.h>

#define BAD_VALUE MUSLIN_STATUS_BAD_VALUE
#define BOTH(attribute, format) MUSLIN_ATTRIBUTE_##attribute, MUSLIN_FORMAT_##format

static MuslinCloth cloth;

static MuslinView view_of(void) {
  MuslinView view;
  muslin_view_init(&view);
  DONE(muslin_cloth_view(cloth, &view));
  return view;
}

static void make_cloth(void) {
  MuslinGridDesc desc;
  muslin_grid_desc_init(&desc);
  desc.columns = desc.rows = 20;
  desc.pin_mode = MUSLIN_PIN_TOP_CORNERS;
  DONE(muslin_cloth_create_grid(&desc, &cloth));
  DONE(muslin_cloth_step(cloth, 30));
  DONE(muslin_cloth_tear_edge(cloth, 210, 230));
  DONE(muslin_cloth_step(cloth, 1));
}

typedef struct Vertex {
  float position[3];
  int16_t normal[2];
  uint16_t uv[2];
  uint32_t mine;
} Vertex;

static void an_interleaved_buffer_receives_the_vertices(void) {
  MuslinView view = view_of();
  Vertex *vertices = malloc(view.vertex_capacity * sizeof *vertices);
  if (vertices == NULL) {
    CHECK(vertices != NULL);
    return;
  }
  memset(vertices, 0xee, view.vertex_capacity * sizeof *vertices);
  const size_t size = view.vertex_capacity * sizeof *vertices;
  const MuslinStream streams[] = {
      muslin_stream(BOTH(POSITION, F32), vertices[0].position, sizeof *vertices, size),
      muslin_stream(BOTH(NORMAL, OCTAHEDRAL16), vertices[0].normal, sizeof *vertices, size - 12),
      muslin_stream(BOTH(UV, F16), vertices[0].uv, sizeof *vertices, size - 16),
  };
  DONE(muslin_cloth_write_vertices(cloth, streams, 3, NULL));
  for (uint32_t i = 0; i < view.vertex_count; i++) {
    CHECK(memcmp(vertices[i].position, view.positions + 3 * i, 12) == 0);
    CHECK(vertices[i].mine == 0xeeeeeeeeu);
    const float u = (float)vertices[i].normal[0] / 32767.0f, v = (float)vertices[i].normal[1] / 32767.0f;
    const float *n = view.normals + 3 * i, z = 1.0f - fabsf(u) - fabsf(v);
    const float length = sqrtf(u * u + v * v + z * z);
    CHECK(n[2] < 0 || (fabsf(u / length - n[0]) < 1e-3f && fabsf(z / length - n[2]) < 1e-3f));
  }
  CHECK(vertices[0].uv[0] == 0 && vertices[0].uv[1] == 0x3c00);
  CHECK(vertices[view.vertex_count].position[0] != vertices[0].position[0]);
  const unsigned char *behind = (const unsigned char *)(vertices + view.vertex_count);
  for (size_t i = 0; i < sizeof *vertices; i++) CHECK(behind[i] == 0xee);
  free(vertices);
}

static void separate_blocks_receive_transformed_vertices(void) {
  MuslinView view = view_of();
  const uint32_t count = view.vertex_count;
  float *block = malloc(count * 28), *positions = block, *tangents = block + 3 * count;
  if (block == NULL) {
    CHECK(block != NULL);
    return;
  }
  const MuslinStream streams[] = {
      muslin_stream(BOTH(TANGENT, F32), tangents, 0, 16 * (size_t)count),
      muslin_stream(BOTH(POSITION, F32), positions, 0, 12 * (size_t)count),
  };
  MuslinWriteDesc desc;
  muslin_write_desc_init(&desc);
  /* Rotates y up to z up, and moves two metres to the right. */
  const float z_up[12] = {1, 0, 0, 2, 0, 0, -1, 0, 0, 1, 0, 0};
  memcpy(desc.transform, z_up, sizeof z_up);
  DONE(muslin_cloth_write_vertices(cloth, streams, 2, &desc));
  for (uint32_t i = 0; i < count; i++) {
    const float *p = positions + 3 * i, *q = view.positions + 3 * i, *t = tangents + 4 * i;
    CHECK(p[0] == q[0] + 2 && p[1] == -q[2] && p[2] == q[1]);
    CHECK(fabsf(t[0] * t[0] + t[1] * t[1] + t[2] * t[2] - 1) < 1e-5f && t[3] == 1);
  }
  /* A part of the vertices goes to the start of the buffer. */
  muslin_write_desc_init(&desc);
  desc.first_vertex = count - 2;
  desc.vertex_count = 1;
  DONE(muslin_cloth_write_vertices(cloth, streams + 1, 1, &desc));
  CHECK(memcmp(positions, view.positions + 3 * (count - 2), 12) == 0 && positions[3] != positions[0]);
  /* Blends halfway to the last tick. */
  muslin_write_desc_init(&desc);
  desc.blend = 0;
  DONE(muslin_cloth_write_vertices(cloth, streams + 1, 1, &desc));
  float *before = malloc(count * 12);
  if (before == NULL) {
    CHECK(before != NULL);
    return;
  }
  memcpy(before, positions, count * 12);
  desc.blend = 0.5f;
  DONE(muslin_cloth_write_vertices(cloth, streams + 1, 1, &desc));
  for (uint32_t i = 0; i < 3 * count; i++) {
    CHECK(fabsf(positions[i] - 0.5f * (before[i] + view.positions[i])) < 1e-6f);
  }
  free(before);
  free(block);
}

static void uploading_the_changed_ranges_is_enough(void) {
  MuslinView view = view_of();
  const uint32_t seen = view.topology_revision;
  uint16_t *indices = malloc(2 * (size_t)view.index_capacity);
  float *uvs = malloc(8 * (size_t)view.vertex_capacity);
  if (indices == NULL || uvs == NULL) {
    CHECK(indices != NULL && uvs != NULL);
    return;
  }
  memset(uvs, 0xee, 8 * (size_t)view.vertex_capacity);
  const MuslinStream all = muslin_stream(BOTH(UV, F32), uvs, 0, 8 * (size_t)view.vertex_capacity);
  DONE(muslin_cloth_write_vertices(cloth, &all, 1, NULL));
  DONE(muslin_cloth_tear_edge(cloth, 150, 170));
  MuslinChanges changes;
  muslin_changes_init(&changes);
  DONE(muslin_cloth_changes(cloth, seen, &changes));
  CHECK(changes.vertex_count > 0 && changes.vertex_count < view.vertex_count);
  MuslinWriteDesc desc;
  muslin_write_desc_init(&desc);
  desc.first_vertex = changes.first_vertex;
  desc.vertex_count = changes.vertex_count;
  const size_t begin = 2 * (size_t)changes.first_vertex;
  const MuslinStream some = muslin_stream(BOTH(UV, F32), uvs + begin, 0, 8 * (size_t)changes.vertex_count);
  DONE(muslin_cloth_write_vertices(cloth, &some, 1, &desc));
  DONE(muslin_cloth_write_indices(cloth, indices, 2 * (size_t)view.index_capacity, 16, 0, 0));
  view = view_of();
  CHECK(memcmp(uvs, view.uvs, 8 * (size_t)view.vertex_count) == 0);
  for (uint32_t i = 0; i < view.index_count; i++) CHECK(indices[i] == view.indices[i]);
  free(indices);
  free(uvs);
}

/* A stream that is valid except for one field. */
#define BAD_STREAM(field, value, status, words)                                           \
  do {                                                                                    \
    MuslinStream streams[2];                                                              \
    streams[0] = muslin_stream(BOTH(POSITION, F32), room, 32, sizeof room);               \
    streams[1] = muslin_stream(BOTH(NORMAL, SNORM16), room + 16, 32, sizeof room - 16);   \
    streams[1].field = (value);                                                           \
    REFUSED(muslin_cloth_write_vertices(cloth, streams, 2, NULL), status, words);         \
  } while (0)

static void streams_are_refused_by_field_and_nothing_is_written(void) {
  static union {
    unsigned char bytes[32 * 1000];
    float aligned;
  } whole;
  memset(&whole, 0xee, sizeof whole);
  unsigned char(*const at)[sizeof whole] = &whole.bytes;
#define room (*at)
  MuslinView view = view_of();
  uintptr_t lent = (uintptr_t)(view.positions + 3 * view.vertex_count) - 4;
  void *inside = NULL;
  memcpy(&inside, &lent, sizeof inside);

  BAD_STREAM(attribute, 5, BAD_VALUE, "`streams[1].attribute` must be a MUSLIN_ATTRIBUTE_");
  BAD_STREAM(attribute, 0xcdcdcdcdu, BAD_VALUE, "`streams[1].attribute`");
  BAD_STREAM(attribute, MUSLIN_ATTRIBUTE_UV, BAD_VALUE, "`streams[1].format` must be one that");
  BAD_STREAM(format, 4, BAD_VALUE, "`streams[1].format` must be a MUSLIN_FORMAT_");
  BAD_STREAM(stride, 31, BAD_VALUE, "`streams[1].stride`");
  BAD_STREAM(stride, 6, BAD_VALUE, "`streams[1].stride`");
  BAD_STREAM(stride, 34, BAD_VALUE, "`streams[1].buffer` must be apart");
  BAD_STREAM(stride, UINT32_MAX - 1, MUSLIN_STATUS_BUFFER_TOO_SMALL, "`streams[1].size` must be at least");
  BAD_STREAM(buffer, NULL, BAD_VALUE, "`streams[1].buffer` must not be NULL");
  BAD_STREAM(buffer, room + 17, BAD_VALUE, "`streams[1].buffer` must be aligned");
  BAD_STREAM(buffer, room + 8, BAD_VALUE, "`streams[1].buffer` must be apart");
  BAD_STREAM(buffer, inside, BAD_VALUE, "`streams[1].buffer` must not be memory of a view");
  BAD_STREAM(size, 0, MUSLIN_STATUS_BUFFER_TOO_SMALL, "but is 0");
  BAD_STREAM(size, 32 * (size_t)(view.vertex_count - 1) + 7, MUSLIN_STATUS_BUFFER_TOO_SMALL, "`streams[1].size`");
  BAD_STREAM(size, SIZE_MAX, BAD_VALUE, "`streams[1].size` must fit in the address space");
  BAD_STREAM(struct_size, 0, BAD_VALUE, "`streams[1].struct_size` must be that of the first");
  BAD_STREAM(struct_size, 4000, BAD_VALUE, "`streams[1].struct_size`");

  MuslinStream good = muslin_stream(BOTH(NORMAL, F32), room, 32, sizeof room);
  MuslinStream many[17], old = good;
  old.struct_size = 4;
  REFUSED(muslin_cloth_write_vertices(cloth, &old, 1, NULL), BAD_VALUE, "[0].struct_size` must be set by");
  for (int i = 0; i < 17; i++) many[i] = good;
  REFUSED(muslin_cloth_write_vertices(cloth, NULL, 1, NULL), BAD_VALUE, "`streams`");
  REFUSED(muslin_cloth_write_vertices(cloth, &good, 0, NULL), BAD_VALUE, "`stream_count`");
  REFUSED(muslin_cloth_write_vertices(cloth, many, 17, NULL), BAD_VALUE, "`stream_count`");

#define BAD_DESC(field, value, words)                                                      \
  do {                                                                                     \
    MuslinWriteDesc desc;                                                                  \
    muslin_write_desc_init(&desc);                                                         \
    desc.field = (value);                                                                  \
    REFUSED(muslin_cloth_write_vertices(cloth, &good, 1, &desc), BAD_VALUE, words);        \
  } while (0)
  BAD_DESC(struct_size, 7, "`struct_size` must be set by muslin_write_desc_init");
  BAD_DESC(first_vertex, view.vertex_count + 1, "`first_vertex`");
  BAD_DESC(vertex_count, view.vertex_count + 1, "`vertex_count`");
  BAD_DESC(blend, -0.5f, "`blend`");
  BAD_DESC(blend, NAN, "`blend`");
  BAD_DESC(transform[3], INFINITY, "`transform`");
  BAD_DESC(transform[5], NAN, "`transform`");
  BAD_DESC(transform[0], 0, "`transform` must be one that can be inverted");
  BAD_DESC(flip_normals, 2, "`flip_normals`");
  BAD_DESC(offset, NAN, "`offset`");
  BAD_DESC(relative, 2, "`relative`");
  for (size_t i = 0; i < sizeof room; i++) CHECK(room[i] == 0xee);
  DONE(muslin_cloth_write_vertices(cloth, &good, 1, NULL));
#undef room
}

static void a_cloth_far_from_zero_has_an_origin_and_relative_positions(void) {
  MuslinCloth far = {0};
  MuslinGridDesc grid;
  muslin_grid_desc_init(&grid);
  grid.columns = grid.rows = 20;
  grid.origin.x = 5000.25f;
  DONE(muslin_cloth_create_grid(&grid, &far));
  MuslinVec3 origin = {0, 0, 0};
  DONE(muslin_cloth_get_origin(far, &origin));
  CHECK(origin.x == 5001.0f && origin.z == 0.0f);
  static float positions[3 * 400], relative[3 * 400];
  const MuslinStream streams[] = {muslin_stream(BOTH(POSITION, F32), positions, 0, sizeof positions),
                                  muslin_stream(BOTH(POSITION, F32), relative, 0, sizeof relative)};
  MuslinWriteDesc desc;
  muslin_write_desc_init(&desc);
  DONE(muslin_cloth_write_vertices(far, streams, 1, &desc));
  desc.relative = 1;
  DONE(muslin_cloth_write_vertices(far, streams + 1, 1, &desc));
  for (int i = 0; i < 400; i++) {
    CHECK(positions[3 * i] == origin.x + relative[3 * i]);
    CHECK(fabsf(relative[3 * i] - (0.05f * (float)(i % 20) - 0.75f)) < 1e-6f);
  }
  DONE(muslin_cloth_destroy(far));
}

/* Streams of a newer header: longer by one field, which must be 0 for this library. */
static void streams_of_a_newer_program_are_read_with_their_own_size(void) {
  struct {
    MuslinStream known;
    uint64_t glitter;
  } streams[2];
  static float positions[3 * 1000], uvs[2 * 1000];
  for (int i = 0; i < 2; i++) {
    DONE(muslin_stream_init_sized(&streams[i].known, (uint32_t)sizeof streams[0]));
    CHECK(streams[i].glitter == 0 && streams[i].known.stride == 0);
    streams[i].known.attribute = i == 0 ? MUSLIN_ATTRIBUTE_POSITION : MUSLIN_ATTRIBUTE_UV;
    streams[i].known.buffer = i == 0 ? positions : uvs;
    streams[i].known.size = i == 0 ? sizeof positions : sizeof uvs;
  }
  DONE(muslin_cloth_write_vertices(cloth, &streams[0].known, 2, NULL));
  MuslinView view = view_of();
  CHECK(memcmp(uvs, view.uvs, 8 * (size_t)view.vertex_count) == 0);
  CHECK(memcmp(positions, view.positions, 12 * (size_t)view.vertex_count) == 0);
  streams[1].glitter = 1;
  REFUSED(muslin_cloth_write_vertices(cloth, &streams[0].known, 2, NULL), MUSLIN_STATUS_UNSUPPORTED,
          "`streams[1].struct_size`");
}

int main(void) {
  make_cloth();
  TEST(an_interleaved_buffer_receives_the_vertices);
  TEST(separate_blocks_receive_transformed_vertices);
  TEST(uploading_the_changed_ranges_is_enough);
  TEST(streams_are_refused_by_field_and_nothing_is_written);
  TEST(a_cloth_far_from_zero_has_an_origin_and_relative_positions);
  TEST(streams_of_a_newer_program_are_read_with_their_own_size);
  DONE(muslin_cloth_destroy(cloth));
  return failures != 0;
}
