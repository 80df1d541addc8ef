// The recipe for Unreal, with test doubles of the classes of the engine: a sheet that hangs, a ball
// that moves into it, a tear.

#include "MuslinSheetActor.cpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>

namespace {

int failures = 0;

void check(bool holds, const char *claim) {
  if (holds) return;
  failures++;
  std::fprintf(stderr, "not so: %s (last check of the actor: %s)\n", claim, failed_check.c_str());
}

#define CHECK(claim) check(static_cast<bool>(claim), #claim)

FVector minus(const FVector &a, const FVector &b) { return {a.X - b.X, a.Y - b.Y, a.Z - b.Z}; }
double dot(const FVector &a, const FVector &b) { return a.X * b.X + a.Y * b.Y + a.Z * b.Z; }
FVector cross(const FVector &a, const FVector &b) {
  return {a.Y * b.Z - a.Z * b.Y, a.Z * b.X - a.X * b.Z, a.X * b.Y - a.Y * b.X};
}

// Unreal's normal of a triangle is cross(p1 - p2, p0 - p2): that side is drawn.
void each_triangle_is_drawn_on_the_side_of_its_normals(const UProceduralMeshComponent &mesh) {
  int wrong = 0;
  for (int32 i = 0; i < mesh.triangles.Num(); i += 3) {
    const int32 a = mesh.triangles[i], b = mesh.triangles[i + 1], c = mesh.triangles[i + 2];
    const FVector &last = mesh.positions[c];
    const FVector normal = cross(minus(mesh.positions[b], last), minus(mesh.positions[a], last));
    wrong += dot(normal, mesh.normals[a]) <= 0;
  }
  CHECK(wrong == 0);
}

void the_actor_draws_a_sheet_that_a_ball_pushes() {
  AActor ball;
  ball.location = {950, 200, 100};
  AMuslinSheetActor actor;
  actor.location = {1000, 100, 200};
  actor.Wind = {0, 0, 0};
  actor.Balls = {&ball};
  actor.BeginPlay();
  for (int frame = 0; frame < 120; frame++) {
    ball.location.X += 0.5;
    actor.Tick(1 / 60.0f);
  }
  CHECK(failed_check.empty());
  const UProceduralMeshComponent &mesh = *actor.Mesh;
  CHECK(mesh.is_absolute && mesh.location.X == 1000);
  CHECK(mesh.created == 1 && mesh.updated == 119);
  CHECK(mesh.positions.Num() == 3200 && mesh.triangles.Num() == 2 * 6 * 39 * 39);
  each_triangle_is_drawn_on_the_side_of_its_normals(mesh);
  double gap = std::numeric_limits<double>::infinity(), lowest = 0, bulge = 0;
  for (int32 i = 0; i < 1600; i++) {
    const FVector &p = mesh.positions[i];
    CHECK(p.X == mesh.positions[i + 1600].X && dot(mesh.normals[i], mesh.normals[i + 1600]) < -0.999);
    const FVector from = minus(p, minus(ball.location, mesh.location));
    gap = std::min(gap, std::sqrt(dot(from, from)) - 30);
    lowest = std::min(lowest, p.Z);
    bulge = std::max(bulge, p.X);
  }
  CHECK(gap > -0.5 && gap < 2);
  CHECK(lowest < -150 && lowest > -210); // a sheet of 195 cm hangs down
  CHECK(bulge > 20);
}

void a_tear_gives_new_triangles() {
  ClothSheet sheet;
  SheetMesh mesh;
  CHECK(sheet.make(20, 20, 5, {0, 0, 0}, {0, 1, 0}, {0, 0, -1}) == MUSLIN_STATUS_OK);
  CHECK(sheet.update(mesh) == MUSLIN_STATUS_OK && mesh.has_new_triangles);
  CHECK(sheet.update(mesh) == MUSLIN_STATUS_OK && !mesh.has_new_triangles);
  const std::size_t before = mesh.positions.size();
  CHECK(sheet.cloth().cut({-1, -1, -0.4f}, {-1, 2, -0.4f}, {2, 0, 0}).value() > 10);
  CHECK(sheet.update(mesh) == MUSLIN_STATUS_OK && mesh.has_new_triangles && mesh.positions.size() > before);
}

void a_refused_value_is_named() {
  AMuslinSheetActor actor;
  actor.Columns = 1;
  actor.BeginPlay();
  CHECK(failed_check.find("columns") != std::string::npos);
}

}  // namespace

int main() {
  the_actor_draws_a_sheet_that_a_ball_pushes();
  a_tear_gives_new_triangles();
  a_refused_value_is_named();
  std::printf("%s the recipe for Unreal\n", failures == 0 ? "  ok" : "FAIL");
  return failures != 0;
}
