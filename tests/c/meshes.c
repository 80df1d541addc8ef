/* Meshes with duplicate vertices and defects: the report, and the particle of each vertex. */
#include "check.h"

enum { COLUMNS = 5, ROWS = 6, HALF = COLUMNS * ROWS, CELLS = (COLUMNS - 1) * (ROWS - 1) };

/* Two sheets side by side; the last column of the first lies on the first column of the second. */
static float positions[3 * (2 * HALF + 1)];
static float uvs[2 * (2 * HALF + 1)];
static uint32_t indices[2 * 6 * CELLS + 9];

static MuslinMeshDesc seamed_sheet(void) {
  uint32_t n = 0;
  for (uint32_t half = 0; half < 2; half++) {
    for (uint32_t i = 0; i < HALF; i++) {
      uint32_t v = half * HALF + i;
      positions[3 * v] = 0.125f * (float)(i % COLUMNS + half * (COLUMNS - 1));
      positions[3 * v + 1] = -0.125f * (float)(i / COLUMNS);
      uvs[2 * v] = (float)half + 0.125f * (float)(i % COLUMNS);
      uvs[2 * v + 1] = 0.125f * (float)(i / COLUMNS);
    }
    for (uint32_t cell = 0; cell < CELLS; cell++) {
      uint32_t a = half * HALF + cell / (COLUMNS - 1) * COLUMNS + cell % (COLUMNS - 1);
      uint32_t quad[6] = {a, a + COLUMNS, a + 1, a + COLUMNS, a + COLUMNS + 1, a + 1};
      memcpy(indices + n, quad, sizeof quad);
      n += 6;
    }
  }
  /* A duplicate triangle, one without an area, and one that faces the other way. */
  uint32_t defects[9] = {1, 0, COLUMNS, 7, 7, 8, 0, 1, 2};
  memcpy(indices + n, defects, sizeof defects);
  uint32_t first = indices[6];
  indices[6] = indices[7];
  indices[7] = first;
  MuslinMeshDesc desc;
  muslin_mesh_desc_init(&desc);
  desc.positions = positions;
  desc.vertex_count = 2 * HALF + 1; /* no triangle uses the last one */
  desc.indices = indices;
  desc.index_count = sizeof indices / sizeof indices[0];
  desc.uvs = uvs;
  desc.weld_distance = 0.0f;
  positions[6 * HALF] = 9.0f;
  return desc;
}

static void the_mesh_report_counts_the_repairs(void) {
  MuslinMeshDesc desc = seamed_sheet();
  MuslinCloth cloth = {0};
  DONE(muslin_cloth_create_mesh(&desc, &cloth));
  MuslinMeshReport report;
  muslin_mesh_report_init(&report);
  DONE(muslin_cloth_get_mesh_report(cloth, &report));
  CHECK(report.vertices == 2 * HALF + 1 && report.particles == 2 * HALF + 1 - ROWS);
  CHECK(report.triangles == 4 * CELLS + 3 && report.kept_triangles == 4 * CELLS);
  CHECK(report.welded_vertices == ROWS && report.unused_vertices == 1);
  CHECK(report.dropped_duplicates == 1 && report.dropped_degenerate == 2);
  CHECK(report.turned_triangles == 1 && report.split_edges == 0 && report.split_vertices == 0);
  CHECK(report.pieces == 1 && report.one_sided_pieces == 0 && report.is_grid == 0);
  CHECK(report.shortest_edge > 0.0f && report.shortest_edge <= report.mean_edge);
  CHECK(report.worst_aspect > 1.9f && report.thin_triangles == 0);
  char text[200] = {7};
  size_t needed = 0;
  DONE(muslin_cloth_get_mesh_warnings(cloth, NULL, 0, &needed));
  DONE(muslin_cloth_get_mesh_warnings(cloth, text, needed, NULL));
  CHECK(needed == strlen(text) + 1);
  CHECK(strcmp(text, "2 triangles were removed for lack of an area\n1 vertex is in no triangle") == 0);
  REFUSED(muslin_cloth_get_mesh_warnings(cloth, text, needed - 1, NULL), MUSLIN_STATUS_BUFFER_TOO_SMALL,
          "`size` must");
  MuslinMeshReport never_begun;
  memset(&never_begun, 0xee, sizeof never_begun);
  REFUSED(muslin_cloth_get_mesh_report(cloth, &never_begun), MUSLIN_STATUS_BAD_VALUE,
          "muslin_mesh_report_init");
  REFUSED(muslin_cloth_get_mesh_report(cloth, NULL), MUSLIN_STATUS_BAD_VALUE, "`out_report`");
  DONE(muslin_cloth_destroy(cloth));
}

static void vertices_of_a_seam_share_a_particle_until_it_is_cut(void) {
  MuslinMeshDesc desc = seamed_sheet();
  uint32_t pinned[2] = {COLUMNS - 1, HALF};
  desc.pinned = pinned;
  desc.pinned_count = 2;
  MuslinCloth cloth = {0};
  DONE(muslin_cloth_create_mesh(&desc, &cloth));
  MuslinView view;
  muslin_view_init(&view);
  DONE(muslin_cloth_view(cloth, &view));
  CHECK(view.vertex_count == desc.vertex_count);
  for (uint32_t row = 0; row < ROWS; row++) {
    uint32_t one = row * COLUMNS + COLUMNS - 1, other = HALF + row * COLUMNS;
    CHECK(view.particles[one] == view.particles[other]);
    CHECK(view.uvs[2 * one] == 0.5f && view.uvs[2 * other] == 1.0f);
    CHECK(memcmp(view.normals + 3 * one, view.normals + 3 * other, 12) == 0);
  }
  MuslinVec3 from = {0.5f, -0.3f, -1.0f}, to = {0.5f, -9.0f, -1.0f}, sweep = {0.0f, 0.0f, 2.0f};
  uint32_t edges = 0, revision = view.topology_revision;
  DONE(muslin_cloth_cut(cloth, from, to, sweep, &edges));
  CHECK(edges == 2); /* the cut ends at row 3 */
  DONE(muslin_cloth_view(cloth, &view));
  CHECK(view.vertex_count == desc.vertex_count);
  CHECK(view.topology_revision != revision);
  for (uint32_t row = 0; row < ROWS; row++) {
    uint32_t one = row * COLUMNS + COLUMNS - 1, other = HALF + row * COLUMNS;
    CHECK((view.particles[one] == view.particles[other]) == (row < 4));
  }
  DONE(muslin_cloth_step(cloth, 30));
  DONE(muslin_cloth_destroy(cloth));
}

/* Two squares of 1 m whose middle vertex is 5 mm from that of the left border. */
static void short_edges_are_collapsed_and_counted(void) {
  const float points[] = {0, 0, 0, 1, 0, 0, 0, 0.5f, 0, 0.005f, 0.5f, 0, 1, 0.5f, 0, 0, 1, 0, 1, 1, 0};
  const uint32_t triangles[] = {0, 1, 3, 0, 3, 2, 1, 4, 3, 2, 3, 5, 3, 6, 5, 3, 4, 6};
  MuslinMeshDesc desc;
  muslin_mesh_desc_init(&desc);
  CHECK(desc.simplify_below == 0.0f && desc.reserved == 0);
  desc.positions = points;
  desc.vertex_count = 7;
  desc.indices = triangles;
  desc.index_count = 18;
  desc.simplify_below = 0.01f;
  MuslinCloth cloth = {0};
  DONE(muslin_cloth_create_mesh(&desc, &cloth));
  MuslinMeshReport report;
  muslin_mesh_report_init(&report);
  DONE(muslin_cloth_get_mesh_report(cloth, &report));
  CHECK(report.collapsed_edges == 1 && report.collapsed_triangles == 2 && report.short_edges == 0);
  CHECK(report.trimmed_triangles == 0 && report.flipped_edges == 0);
  CHECK(report.particles == 6 && report.kept_triangles == 4 && report.shortest_edge == 0.5f);
  MuslinView view;
  muslin_view_init(&view);
  DONE(muslin_cloth_view(cloth, &view));
  CHECK(view.vertex_count == 7 && view.particles[3] == view.particles[2]);
  DONE(muslin_cloth_destroy(cloth));
}

static void a_grid_as_a_mesh_gives_the_bits_of_the_grid(void) {
  MuslinGridDesc grid;
  MuslinCloth cloths[2] = {{0}, {0}};
  muslin_grid_desc_init(&grid);
  DONE(muslin_cloth_create_grid(&grid, &cloths[0]));
  MuslinView view;
  muslin_view_init(&view);
  DONE(muslin_cloth_view(cloths[0], &view));
  MuslinMeshDesc desc;
  muslin_mesh_desc_init(&desc);
  desc.positions = view.positions;
  desc.vertex_count = view.vertex_count;
  desc.indices = view.indices;
  desc.index_count = view.index_count;
  desc.uvs = view.uvs;
  uint32_t pinned[40];
  for (uint32_t i = 0; i < 40; i++) pinned[i] = i;
  desc.pinned = pinned;
  desc.pinned_count = 40;
  DONE(muslin_cloth_create_mesh(&desc, &cloths[1]));
  MuslinMeshReport report;
  muslin_mesh_report_init(&report);
  DONE(muslin_cloth_get_mesh_report(cloths[1], &report));
  CHECK(report.is_grid == 1);
  uint64_t hashes[2] = {0, 1};
  for (int i = 0; i < 2; i++) {
    DONE(muslin_cloth_step(cloths[i], 60));
    DONE(muslin_cloth_state_hash(cloths[i], &hashes[i]));
    DONE(muslin_cloth_destroy(cloths[i]));
  }
  CHECK(hashes[0] == hashes[1]);
}

int main(void) {
  TEST(the_mesh_report_counts_the_repairs);
  TEST(vertices_of_a_seam_share_a_particle_until_it_is_cut);
  TEST(short_edges_are_collapsed_and_counted);
  TEST(a_grid_as_a_mesh_gives_the_bits_of_the_grid);
  return failures != 0;
}
