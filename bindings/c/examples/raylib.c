/* raylib: a sheet on a rail in the wind. The left mouse button pulls it until it tears; the right one cuts it.
 *
 *   cc -std=c99 -Iinclude bindings/c/examples/raylib.c target/release/libmuslin.a -lraylib -lm -lpthread -ldl
 *
 * With `--shot FILE.png` a script moves the mouse, and the last frame is saved. */
#include <muslin.h>
#include <raylib.h>
#include <raymath.h>
#include <rlgl.h>
#include <string.h>

static const char *const vertex_shader =
    "#version 330\nin vec3 vertexPosition, vertexNormal; in vec2 vertexTexCoord; uniform mat4 mvp;"
    "out vec3 normal; out vec2 uv; void main() { normal = vertexNormal; uv = vertexTexCoord;"
    "  gl_Position = mvp * vec4(vertexPosition, 1); }";
/* Two-sided lighting with some translucency. */
static const char *const fragment_shader =
    "#version 330\nin vec3 normal; in vec2 uv; uniform vec4 colDiffuse; out vec4 colour;"
    "const vec3 sun = normalize(vec3(-0.5, 0.9, 0.7));"
    "void main() {"
    "  vec3 n = normalize(gl_FrontFacing ? normal : -normal);"
    "  vec2 woven = smoothstep(0.47, 0.53, abs(fract(uv * vec2(15, 10)) - 0.5) * 2.0);"
    "  vec3 base = pow(mix(vec3(0.96, 0.93, 0.87), colDiffuse.rgb, (woven.x + woven.y) * 0.5), vec3(2.2));"
    "  float lit = max(dot(n, sun), 0.0) + 0.35 * max(-dot(n, sun), 0.0);"
    "  vec3 sky = mix(vec3(0.30, 0.27, 0.25), vec3(0.55, 0.62, 0.72), n.y * 0.5 + 0.5);"
    "  colour = vec4(pow(base * (sky + lit * vec3(1.05, 0.98, 0.88)), vec3(1.0 / 2.2)), 1); }";

static MuslinCloth cloth;
static Mesh mesh;
static uint32_t seen;

/* Exits with the message if a call fails. */
static void must(MuslinStatus status) {
  if (status != MUSLIN_STATUS_OK) TraceLog(LOG_FATAL, "%s", muslin_last_error());
}

static void hang(void) {
  /* From nothing... */
  MuslinGridDesc desc;
  muslin_grid_desc_init(&desc);
  desc.columns = 64;
  desc.spacing = 0.04f;
  desc.origin = (MuslinVec3){-1.26f, 2.0f, 0};
  desc.settings.tearing = 1;
  desc.material.tear_stretch = 2.0f;
  must(muslin_cloth_create_grid(&desc, &cloth));
  MuslinView view;
  muslin_view_init(&view);
  must(muslin_cloth_view(cloth, &view));
  mesh = (Mesh){.vertexCount = (int)view.vertex_capacity, .triangleCount = (int)view.index_capacity / 3,
                .vertices = MemAlloc(12 * view.vertex_capacity), .normals = MemAlloc(12 * view.vertex_capacity),
                .texcoords = MemAlloc(8 * view.vertex_capacity), .indices = MemAlloc(2 * view.index_capacity)};
  memcpy(mesh.vertices, view.positions, 12 * (size_t)view.vertex_count);
  memcpy(mesh.normals, view.normals, 12 * (size_t)view.vertex_count);
  memcpy(mesh.texcoords, view.uvs, 8 * (size_t)view.vertex_count);
  must(muslin_cloth_write_indices(cloth, mesh.indices, 2 * (size_t)view.index_capacity, 16, 0, 0));
  UploadMesh(&mesh, true);
  /* ...to the first frame. */
  seen = view.topology_revision;
}

/* Uploads positions and normals, and the topology if it changed. */
static void refresh(void) {
  MuslinView view;
  muslin_view_init(&view);
  must(muslin_cloth_view(cloth, &view));
  UpdateMeshBuffer(mesh, 0, view.positions, 12 * (int)view.vertex_count, 0);
  UpdateMeshBuffer(mesh, 2, view.normals, 12 * (int)view.vertex_count, 0);
  if (view.topology_revision == seen) return;
  must(muslin_cloth_write_indices(cloth, mesh.indices, 2 * (size_t)view.index_capacity, 16, 0, 0));
  UpdateMeshBuffer(mesh, 1, view.uvs, 8 * (int)view.vertex_count, 0);
  UpdateMeshBuffer(mesh, 6, mesh.indices, 2 * (int)view.index_count, 0);
  mesh.triangleCount = (int)view.index_count / 3;
  seen = view.topology_revision;
}

static MuslinVec3 at_distance(Ray ray, float distance) {
  const Vector3 at = Vector3Add(ray.position, Vector3Scale(ray.direction, distance));
  return (MuslinVec3){at.x, at.y, at.z};
}

/* Grabs the particle under the mouse and pulls it 0.2 m towards the eye. */
static void pull(Ray ray, bool is_down) {
  static MuslinGrab held;
  static float distance;
  MuslinVec3 at, eye = at_distance(ray, 0), along = {ray.direction.x, ray.direction.y, ray.direction.z};
  if (held.id != 0 && is_down) {
    must(muslin_cloth_move_grab(cloth, held, at_distance(ray, distance)));
  } else if (held.id != 0) {
    must(muslin_cloth_release(cloth, held));
    held.id = 0;
  } else if (is_down && muslin_cloth_grab_ray(cloth, eye, along, 0.1f, &held, &at) == MUSLIN_STATUS_OK) {
    distance = Vector3Distance(ray.position, (Vector3){at.x, at.y, at.z}) - 0.2f;
  }
}

/* Cuts with a blade from the eye, swept from where the button was pressed to where it is released. */
static void cut(Ray ray, bool is_down) {
  static Ray begin;
  static bool was_down;
  const MuslinVec3 far = at_distance(begin, 9), to = at_distance(ray, 9);
  const MuslinVec3 sweep = {to.x - far.x, to.y - far.y, to.z - far.z};
  if (was_down && !is_down) must(muslin_cloth_cut(cloth, at_distance(begin, 0), far, sweep, NULL));
  if (!was_down) begin = ray;
  was_down = is_down;
}

int main(int count, char **words) {
  const char *shot = count == 3 && strcmp(words[1], "--shot") == 0 ? words[2] : NULL;
  SetConfigFlags(FLAG_MSAA_4X_HINT);
  InitWindow(960, 640, "Muslin in raylib");
  SetTargetFPS(60);
  Camera camera = {{1.5f, 1.35f, 4.6f}, {0, 1.02f, 0}, {0, 1, 0}, 36, CAMERA_PERSPECTIVE};
  Material dyed = LoadMaterialDefault(), shadow = LoadMaterialDefault();
  dyed.shader = LoadShaderFromMemory(vertex_shader, fragment_shader);
  dyed.maps[MATERIAL_MAP_DIFFUSE].color = (Color){178, 40, 46, 255};
  shadow.maps[MATERIAL_MAP_DIFFUSE].color = (Color){176, 172, 166, 255};
  /* Projects along the sun's rays onto the floor. */
  const Matrix flat = {1, 0.5f / 0.9f, 0, 0, 0, 0, 0, 0.002f, 0, -0.7f / 0.9f, 1, 0, 0, 0, 0, 1};
  MuslinWind wind;
  muslin_wind_init(&wind);
  wind.velocity = (MuslinVec3){0.8f, 0, 2.2f};
  wind.gust = wind.turbulence = 0.6f;
  hang();
  must(muslin_cloth_set_wind(cloth, &wind));
  for (int frame = 0; shot != NULL ? frame < 165 : !WindowShouldClose(); frame++) {
    const float t = (float)frame;
    const Vector2 script = t < 90 ? (Vector2){300 + t, 620 - 4 * t} : (Vector2){480 - 1.5f * t, 150 + 2.2f * t};
    const Ray ray = GetScreenToWorldRay(shot != NULL ? script : GetMousePosition(), camera);
    cut(ray, shot != NULL ? frame > 20 && frame < 80 : IsMouseButtonDown(MOUSE_BUTTON_RIGHT));
    pull(ray, shot != NULL ? frame > 90 : IsMouseButtonDown(MOUSE_BUTTON_LEFT));
    must(muslin_cloth_advance(cloth, shot != NULL ? 1.0f / 60 : GetFrameTime(), NULL));
    refresh();
    BeginDrawing();
    ClearBackground((Color){226, 222, 215, 255});
    DrawRectangleGradientV(0, 0, 960, 400, (Color){150, 170, 190, 255}, (Color){226, 222, 215, 255});
    BeginMode3D(camera);
    rlDisableBackfaceCulling();
    DrawMesh(mesh, shadow, flat);
    DrawMesh(mesh, dyed, MatrixIdentity());
    DrawCylinderEx((Vector3){-1.4f, 2.02f, 0}, (Vector3){1.4f, 2.02f, 0}, 0.02f, 0.02f, 16, (Color){122, 88, 56, 255});
    EndMode3D();
    EndDrawing();
  }
  const int failed = shot != NULL && !ExportImage(LoadImageFromScreen(), shot);
  must(muslin_cloth_destroy(cloth));
  CloseWindow();
  return failed;
}
