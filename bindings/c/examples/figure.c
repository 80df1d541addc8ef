/* raylib: a figure of capsules walks on the spot and kicks, in a skirt and a loose halter top: two pieces of one coarse
 * cloth, which collide with each other, with a fine skin.
 *
 *   cc -std=c99 -Iinclude bindings/c/examples/figure.c target/release/libmuslin.a -lraylib -lm -lpthread -ldl
 *
 * With `--shot FILE.png` it plays up to the kick, and the last frame is saved. */
#include <muslin.h>
#include <raylib.h>
#include <raymath.h>
#include <rlgl.h>
#include <string.h>

static const char *const vertex_shader =
    "#version 330\nin vec3 vertexPosition, vertexNormal; in vec2 vertexTexCoord; uniform mat4 mvp, matModel;"
    "out vec3 normal; out vec2 uv; void main() { normal = mat3(matModel) * vertexNormal; uv = vertexTexCoord;"
    "  gl_Position = mvp * vec4(vertexPosition, 1); }";
/* Two-sided lighting; texture coordinates from 1 on are the top, which is striped, below 1 the skirt with a band. */
static const char *const fragment_shader =
    "#version 330\nin vec3 normal; in vec2 uv; uniform vec4 colDiffuse; out vec4 colour;"
    "const vec3 sun = normalize(vec3(-0.5, 0.9, 0.7));"
    "void main() {"
    "  vec3 n = normalize(gl_FrontFacing ? normal : -normal), base = colDiffuse.rgb, cream = vec3(0.95, 0.89, 0.79);"
    "  if (uv.y >= 1.0) base = mix(cream, vec3(0.15, 0.21, 0.37), smoothstep(0.55, 0.6, abs(fract(uv.y * 11.0) - 0.5) * 2.0));"
    "  else if (uv.y > 0.0) base = mix(base, cream, 1.0 - smoothstep(0.024, 0.028, abs(uv.y - 0.1)));"
    "  vec3 sky = mix(vec3(0.30, 0.27, 0.25), vec3(0.55, 0.62, 0.72), n.y * 0.5 + 0.5);"
    "  colour = vec4(pow(pow(base, vec3(2.2)) * (sky + max(dot(n, sun), 0.0) * vec3(1.05, 0.98, 0.88)), vec3(1.0 / 2.2)), 1); }";

/* Bones with parent and joint [m]; of each pair of limbs the left one is first. The figure faces +z. */
enum { HIPS, CHEST, THIGH, SHIN = THIGH + 2, ARM = SHIN + 2, FOREARM = ARM + 2, BONES = FOREARM + 2 };
static const int parents[BONES] = {-1, HIPS, HIPS, HIPS, THIGH, THIGH + 1, CHEST, CHEST, ARM, ARM + 1};
static const Vector3 joints[BONES] = {{0, 0.93f, 0}, {0, 1.11f, 0}, {0.09f, 0.9f, 0}, {-0.09f, 0.9f, 0}, {0.09f, 0.49f, 0},
    {-0.09f, 0.49f, 0}, {0.175f, 1.38f, 0}, {-0.175f, 1.38f, 0}, {0.175f, 1.11f, 0}, {-0.175f, 1.11f, 0}};
/* Tapered capsules, on the left side: the bone, the upper and the lower end, and their radii [m]. */
typedef struct { int bone; Vector3 top, bottom; float top_radius, radius; } Capsule;
static const Capsule capsules[] = {
    {CHEST, {0.04f, 1.28f, 0.008f}, {0.03f, 1.13f, 0}, 0.106f, 0.087f},
    {HIPS, {0.03f, 1.05f, 0}, {0.046f, 0.915f, -0.013f}, 0.09f, 0.113f}, {THIGH, {0.09f, 0.885f, 0}, {0.09f, 0.49f, 0}, 0.095f, 0.06f},
    {SHIN, {0.09f, 0.49f, 0}, {0.09f, 0.1f, 0}, 0.06f, 0.034f}, {ARM, {0.175f, 1.38f, 0}, {0.175f, 1.11f, 0}, 0.048f, 0.034f},
    {FOREARM, {0.175f, 1.11f, 0}, {0.175f, 0.75f, 0}, 0.034f, 0.03f}, {SHIN, {0.09f, 0.04f, 0}, {0.09f, 0.03f, 0.12f}, 0.038f, 0.032f},
    {CHEST, {0, 1.62f, 0.01f}, {0, 1.58f, 0.015f}, 0.088f, 0.07f}, {CHEST, {0, 1.5f, 0}, {0, 1.42f, -0.01f}, 0.047f, 0.055f},
    {CHEST, {0.03f, 1.375f, 0}, {0.13f, 1.37f, 0}, 0.06f, 0.052f}};
/* Feet, head, neck and shoulders are only drawn. */
enum { CAPSULES = sizeof capsules / sizeof *capsules, DRESSED = CAPSULES - 4 };

static MuslinCloth cloth;
static MuslinSkin skin;
static MuslinCollider colliders[2 * DRESSED];
static MuslinAttachment held[2];
static Vector3 places[BONES];
static Quaternion turns[BONES];
static Mesh mesh;

/* Exits with the message if a call fails. */
static void must(MuslinStatus status) {
  if (status != MUSLIN_STATUS_OK) TraceLog(LOG_FATAL, "%s", muslin_last_error());
}

static MuslinVec3 vec(Vector3 v) { return (MuslinVec3){v.x, v.y, v.z}; }
static MuslinQuat quat(Quaternion q) { return (MuslinQuat){q.x, q.y, q.z, q.w}; }
static float smooth(float from, float to, float x) {
  const float share = Clamp((x - from) / (to - from), 0, 1);
  return share * share * (3 - 2 * share);
}

/* Returns where a bone carries a point of the rest pose. */
static Vector3 carry(int bone, Vector3 point) {
  return Vector3Add(places[bone], Vector3RotateByQuaternion(Vector3Subtract(point, joints[bone]), turns[bone]));
}

/* Sets the pose at a time: four seconds of walking, then a kick of the right leg. */
static void pose(float time) {
  const float t = fmodf(time, 6), walk = smooth(0, 0.5f, t) * (1 - smooth(3.5f, 4, t)), phase = 2 * PI * t;
  const float kick = -0.4f * smooth(4.1f, 4.5f, t) + 1.4f * smooth(4.5f, 5.1f, t) - smooth(5.2f, 5.8f, t);
  Vector3 angles[BONES] = {{-0.1f * fmaxf(kick, 0), 0.1f * walk * sinf(phase), 0}, {-0.05f, -0.25f * walk * sinf(phase), 0}};
  for (int side = 0; side < 2; side++) {
    const float sign = side == 0 ? 1 : -1, forward = sign * walk * sinf(phase), own = side == 1 ? kick : 0;
    const float lift = walk * powf(fmaxf(sign * cosf(phase), 0), 2);
    angles[THIGH + side].x = -(0.08f + 0.4f * forward + 0.22f * lift + 1.35f * own);
    angles[SHIN + side].x = 0.16f + 0.75f * lift + (own < 0 ? -1.2f * own : 0.5f * own * (1 - own));
    angles[ARM + side] = (Vector3){0.05f - 0.35f * forward, 0, sign * (0.34f + 0.2f * fmaxf(kick, 0))};
    angles[FOREARM + side].x = -0.35f;
  }
  for (int i = 0; i < BONES; i++) {
    Quaternion turn = QuaternionFromAxisAngle((Vector3){0, 0, 1}, angles[i].z);
    turn = QuaternionMultiply(turn, QuaternionFromAxisAngle((Vector3){0, 1, 0}, angles[i].y));
    turn = QuaternionMultiply(turn, QuaternionFromAxisAngle((Vector3){1, 0, 0}, angles[i].x));
    places[i] = i == HIPS ? joints[i] : carry(parents[i], joints[i]);
    turns[i] = i == HIPS ? turn : QuaternionMultiply(turns[parents[i]], turn);
  }
}

/* Returns a capsule of a side, 0 left and 1 right, in the present pose. */
static MuslinColliderDesc place(int index, int side) {
  const Capsule *c = &capsules[index];
  const float sign = side == 0 ? 1 : -1;
  const int bone = c->bone < THIGH ? c->bone : c->bone + side;
  const Vector3 top = carry(bone, (Vector3){sign * c->top.x, c->top.y, c->top.z});
  const Vector3 bottom = carry(bone, (Vector3){sign * c->bottom.x, c->bottom.y, c->bottom.z});
  const Vector3 along = Vector3Subtract(top, bottom);
  MuslinColliderDesc desc;
  muslin_collider_desc_init(&desc);
  desc.shape = MUSLIN_SHAPE_CAPSULE;
  desc.position = vec(Vector3Lerp(bottom, top, 0.5f));
  desc.rotation = quat(QuaternionFromVector3ToVector3((Vector3){0, 1, 0}, Vector3Normalize(along)));
  desc.half_height = 0.5f * Vector3Length(along);
  desc.top_radius = c->top_radius, desc.radius = c->radius, desc.thickness = 0.006f, desc.friction = 0.25f;
  return desc;
}

/* A piece: two tubes, from the hem up, each through three rings (height, half width, half depth). */
enum { COLUMNS = 40, ROWS = 13, FINE = 3, MOST = 2 * (COLUMNS * FINE + 1) * (ROWS * FINE + 1) };
static const float rings[2][3][3] = {{{0.55f, 0.42f, 0.38f}, {0.92f, 0.2f, 0.165f}, {1.06f, 0.134f, 0.1f}},
                                     {{0.95f, 0.25f, 0.22f}, {1.26f, 0.178f, 0.15f}, {1.455f, 0.066f, 0.068f}}};
static Vector3 positions[MOST];
static Vector2 uvs[MOST];
static uint32_t indices[6 * MOST], vertex_count, index_count;

static void sample(int fine) {
  vertex_count = index_count = 0;
  for (int piece = 0; piece < 2; piece++) {
    for (int row = 0; row <= ROWS * fine; row++) {
      const float up = (float)row / (ROWS * fine), s = up < 0.7f ? up / 0.7f : (up - 0.7f) / 0.3f;
      const float *from = rings[piece][up < 0.7f ? 0 : 1], *to = rings[piece][up < 0.7f ? 1 : 2];
      for (int column = 0; column < COLUMNS * fine; column++) {
        const float angle = 2 * PI * column / (COLUMNS * fine), wide = Lerp(from[1], to[1], s), deep = Lerp(from[2], to[2], s);
        const uint32_t a = vertex_count++, b = column + 1 < COLUMNS * fine ? a + 1 : a + 1 - COLUMNS * fine;
        positions[a] = carry(piece == 0 ? HIPS : CHEST, (Vector3){wide * sinf(angle), Lerp(from[0], to[0], s), deep * cosf(angle)});
        uvs[a] = (Vector2){angle, piece + 0.001f + 0.998f * up};
        if (row == ROWS * fine) continue;
        const uint32_t cell[6] = {a, b, a + COLUMNS * fine, b, b + COLUMNS * fine, a + COLUMNS * fine};
        memcpy(&indices[index_count], cell, sizeof cell);
        index_count += 6;
      }
    }
  }
}

/* Dresses the figure: cloth, colliders, attachments, skin. */
static void dress(void) {
  MuslinMeshDesc desc;
  muslin_mesh_desc_init(&desc);
  sample(1);
  desc.positions = &positions[0].x, desc.uvs = &uvs[0].x, desc.vertex_count = vertex_count;
  desc.indices = indices, desc.index_count = index_count;
  must(muslin_material_preset(&desc.material, MUSLIN_PRESET_COTTON));
  desc.settings.max_stretch = 0.06f;
  desc.settings.self_collision = MUSLIN_SELF_COLLISION_SURFACE, desc.settings.self_distance = 0.005f;
  must(muslin_cloth_create_mesh(&desc, &cloth));
  for (uint32_t piece = 0; piece < 2; piece++) {
    uint32_t top[COLUMNS];
    for (uint32_t i = 0; i < COLUMNS; i++) top[i] = (piece * (ROWS + 1) + ROWS) * COLUMNS + i;
    must(muslin_cloth_attach(cloth, top, COLUMNS, vec(places[piece]), quat(turns[piece]), &held[piece]));
  }
  for (int i = 0; i < 2 * DRESSED; i++) {
    const MuslinColliderDesc capsule = place(i / 2, i % 2);
    must(muslin_cloth_add_collider(cloth, &capsule, &colliders[i]));
  }
  MuslinSkinDesc fine;
  muslin_skin_desc_init(&fine);
  sample(FINE);
  fine.positions = &positions[0].x, fine.uvs = &uvs[0].x, fine.vertex_count = vertex_count;
  fine.indices = indices, fine.index_count = index_count;
  must(muslin_skin_create(cloth, &fine, &skin));
  mesh = (Mesh){.vertexCount = (int)vertex_count, .triangleCount = (int)index_count / 3, .vertices = MemAlloc(12 * vertex_count),
                .normals = MemAlloc(12 * vertex_count), .texcoords = MemAlloc(8 * vertex_count), .indices = MemAlloc(2 * index_count)};
  memcpy(mesh.vertices, positions, 12 * (size_t)vertex_count);
  memcpy(mesh.texcoords, uvs, 8 * (size_t)vertex_count);
  for (uint32_t i = 0; i < index_count; i++) mesh.indices[i] = (unsigned short)indices[i];
  UploadMesh(&mesh, true);
}

/* Advances the pose and the clothes by a frame. */
static void advance(float time, float seconds) {
  pose(time);
  for (int i = 0; i < 2 * DRESSED; i++) {
    const MuslinColliderDesc to = place(i / 2, i % 2);
    must(muslin_cloth_move_collider(cloth, colliders[i], to.position, to.rotation));
  }
  for (int piece = 0; piece < 2; piece++) {
    must(muslin_cloth_move_attachment(cloth, held[piece], vec(places[piece]), quat(turns[piece])));
  }
  must(muslin_cloth_advance(cloth, seconds, NULL));
  MuslinView view;
  muslin_view_init(&view);
  must(muslin_skin_view(skin, &view));
  UpdateMeshBuffer(mesh, 0, view.positions, 12 * (int)view.vertex_count, 0);
  UpdateMeshBuffer(mesh, 2, view.normals, 12 * (int)view.vertex_count, 0);
}

/* Returns the mesh of a capsule along y about its middle, a little smaller than its collider. */
static Mesh shell(const Capsule *c) {
  enum { AROUND = 32, HALF = 9, COUNT = 2 * HALF * AROUND };
  const float half = 0.5f * Vector3Distance(c->top, c->bottom);
  Mesh made = {.vertexCount = COUNT, .triangleCount = 2 * (COUNT - AROUND), .vertices = MemAlloc(12 * COUNT), .normals = MemAlloc(12 * COUNT),
               .texcoords = MemAlloc(8 * COUNT), .indices = MemAlloc(12 * (COUNT - AROUND))};
  for (int i = 0; i < COUNT; i++) {
    const int ring = i / AROUND, is_top = ring / HALF;
    const float angle = 2 * PI * (float)(i % AROUND) / AROUND, radius = (is_top ? c->top_radius : c->radius) - 0.003f;
    const float rise = 0.5f * PI * ((float)(ring % HALF) / (HALF - 1) + (float)(is_top - 1));
    const Vector3 normal = {cosf(rise) * sinf(angle), sinf(rise), cosf(rise) * cosf(angle)};
    const Vector3 at = Vector3Add(Vector3Scale(normal, radius), (Vector3){0, is_top ? half : -half, 0});
    memcpy(&made.vertices[3 * i], &at, sizeof at);
    memcpy(&made.normals[3 * i], &normal, sizeof normal);
    if (i >= COUNT - AROUND) continue;
    const int next = i % AROUND == AROUND - 1 ? i + 1 - AROUND : i + 1;
    const int cell[6] = {i, next, i + AROUND, next, next + AROUND, i + AROUND};
    for (int k = 0; k < 6; k++) made.indices[6 * i + k] = (unsigned short)cell[k];
  }
  UploadMesh(&made, false);
  return made;
}

/* Returns the transform of a capsule in the present pose. */
static Matrix transform(int index, int side) {
  const MuslinColliderDesc c = place(index, side);
  const Quaternion turn = {c.rotation.x, c.rotation.y, c.rotation.z, c.rotation.w};
  return MatrixMultiply(QuaternionToMatrix(turn), MatrixTranslate(c.position.x, c.position.y, c.position.z));
}

int main(int count, char **words) {
  const char *shot = count == 3 && strcmp(words[1], "--shot") == 0 ? words[2] : NULL;
  SetConfigFlags(FLAG_MSAA_4X_HINT);
  InitWindow(720, 720, "Muslin in raylib: a dressed figure");
  SetTargetFPS(60);
  Camera camera = {{-2.2f, 1.4f, 3.6f}, {0, 0.86f, 0}, {0, 1, 0}, 32, CAMERA_PERSPECTIVE};
  Mesh shells[CAPSULES];
  for (int i = 0; i < CAPSULES; i++) shells[i] = shell(&capsules[i]);
  Material dyed = LoadMaterialDefault(), linen = LoadMaterialDefault(), shadow = LoadMaterialDefault();
  dyed.shader = linen.shader = LoadShaderFromMemory(vertex_shader, fragment_shader);
  dyed.maps[MATERIAL_MAP_DIFFUSE].color = (Color){168, 62, 56, 255};
  linen.maps[MATERIAL_MAP_DIFFUSE].color = (Color){216, 203, 182, 255};
  shadow.maps[MATERIAL_MAP_DIFFUSE].color = (Color){176, 172, 166, 255};
  /* Projects along the sun's rays onto the floor. */
  const Matrix flat = {1, 0.5f / 0.9f, 0, 0, 0, 0, 0, 0.002f, 0, -0.7f / 0.9f, 1, 0, 0, 0, 0, 1};
  pose(0);
  dress();
  float time = 0;
  for (int frame = 0; shot != NULL ? frame < 306 : !WindowShouldClose(); frame++) {
    const float seconds = shot != NULL ? 1.0f / 60 : fminf(GetFrameTime(), 0.05f);
    time += seconds;
    advance(time, seconds);
    if (IsMouseButtonDown(MOUSE_BUTTON_LEFT)) UpdateCamera(&camera, CAMERA_THIRD_PERSON);
    BeginDrawing();
    ClearBackground((Color){226, 222, 215, 255});
    DrawRectangleGradientV(0, 0, 720, 420, (Color){150, 170, 190, 255}, (Color){226, 222, 215, 255});
    BeginMode3D(camera);
    rlDisableBackfaceCulling();
    for (int pass = 0; pass < 2; pass++) {
      const Matrix after = pass == 0 ? flat : MatrixIdentity();
      for (int i = 0; i < 2 * CAPSULES; i++) {
        DrawMesh(shells[i / 2], pass == 0 ? shadow : linen, MatrixMultiply(transform(i / 2, i % 2), after));
      }
      DrawMesh(mesh, pass == 0 ? shadow : dyed, after);
    }
    EndMode3D();
    EndDrawing();
  }
  const int failed = shot != NULL && !ExportImage(LoadImageFromScreen(), shot);
  must(muslin_cloth_destroy(cloth));
  CloseWindow();
  return failed;
}
