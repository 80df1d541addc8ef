/* OGRE 1.12: a flag in strong wind, written by muslin.hpp into a vertex buffer of 32 bytes per vertex, and cut.
 *
 *   c++ -std=c++17 -Iinclude bindings/c/examples/ogre.cpp target/release/libmuslin.a \
 *       -DOGRE_PLUGINS="\"$(pkg-config --variable=plugindir OGRE)\"" $(pkg-config --cflags --libs OGRE)
 *
 * It runs for four seconds. A file name as argument saves the last frame. */
#include <Ogre.h>
#include <OgreHighLevelGpuProgramManager.h>
#include <muslin.hpp>

/* The shadow is the flag, projected along the sun's rays onto the floor. */
static const char *const vertex_shader = R"(#version 330
in vec4 vertex; in vec3 normal; in vec2 uv0; uniform mat4 mvp; uniform float fallen; out vec3 n; out vec2 uv;
void main() {
  vec4 below = vec4(vertex.x + 0.44 * vertex.y, 0, vertex.z - 0.89 * vertex.y, 1);
  n = normal, uv = uv0, gl_Position = mvp * mix(vertex, below, fallen);
})";
/* Two-sided lighting with some translucency; the flag shows a sun between two waves. */
static const char *const fragment_shader = R"(#version 330
in vec3 n; in vec2 uv; uniform vec4 paint; out vec4 colour;
const vec3 sun = normalize(vec3(-0.4, 0.9, 0.8));
void main() {
  vec2 at = (uv - 0.5) * vec2(1.6, 1.0);
  float band = smoothstep(0.212, 0.218, abs(at.y - 0.06 * sin(at.x * 9.0)));
  float disc = 1.0 - smoothstep(0.145, 0.150, length(at));
  vec3 dye = mix(mix(vec3(0.93, 0.90, 0.84), vec3(0.09, 0.28, 0.42), band), vec3(0.90, 0.45, 0.12), disc);
  vec3 side = normalize(gl_FrontFacing ? n : -n), base = pow(dye, vec3(2.2));
  float lit = max(dot(side, sun), 0.0) + 0.3 * max(-dot(side, sun), 0.0);
  vec3 sky = mix(vec3(0.30, 0.28, 0.26), vec3(0.52, 0.60, 0.72), side.y * 0.5 + 0.5);
  colour = vec4(paint.w > 0.0 ? paint.rgb : pow(base * (sky + 1.1 * lit), vec3(1.0 / 2.2)), 1);
})";

/* Adds a pass to a material: the colour `paint`, or the flag's own colours if its alpha is 0. */
static void add_pass(const std::string &material, Ogre::Vector4 paint, float fallen) {
  auto [of, is_new] = Ogre::MaterialManager::getSingleton().createOrRetrieve(material, Ogre::RGN_DEFAULT);
  Ogre::Technique *technique = std::static_pointer_cast<Ogre::Material>(of)->getTechnique(0);
  if (is_new) technique->removeAllPasses();
  Ogre::Pass *pass = technique->createPass();
  const std::string name = material + std::to_string(pass->getIndex());
  auto &programs = Ogre::HighLevelGpuProgramManager::getSingleton();
  auto vertex = programs.createProgram(name + "_v", Ogre::RGN_DEFAULT, "glsl", Ogre::GPT_VERTEX_PROGRAM);
  vertex->setSource(vertex_shader);
  vertex->getDefaultParameters()->setNamedAutoConstant("mvp", Ogre::GpuProgramParameters::ACT_WORLDVIEWPROJ_MATRIX);
  vertex->getDefaultParameters()->setNamedConstant("fallen", fallen);
  auto fragment = programs.createProgram(name + "_f", Ogre::RGN_DEFAULT, "glsl", Ogre::GPT_FRAGMENT_PROGRAM);
  fragment->setSource(fragment_shader);
  fragment->getDefaultParameters()->setNamedConstant("paint", paint);
  pass->setCullingMode(Ogre::CULL_NONE);
  pass->setVertexProgram(vertex->getName());
  pass->setFragmentProgram(fragment->getName());
}

/* The layout of the vertex buffer, and a renderable that owns the cloth. */
struct Vertex { float position[3], normal[3], uv[2]; };
class Flag : public Ogre::SimpleRenderable {
 public:
  explicit Flag(muslin::Cloth made) : cloth(std::move(made)) {
    const MuslinView view = cloth.view().value();
    auto &buffers = Ogre::HardwareBufferManager::getSingleton();
    data_.vertexDeclaration->addElement(0, 0, Ogre::VET_FLOAT3, Ogre::VES_POSITION);
    data_.vertexDeclaration->addElement(0, 12, Ogre::VET_FLOAT3, Ogre::VES_NORMAL);
    data_.vertexDeclaration->addElement(0, 24, Ogre::VET_FLOAT2, Ogre::VES_TEXTURE_COORDINATES, 0);
    vertices_ = buffers.createVertexBuffer(sizeof(Vertex), view.vertex_capacity,
                                           Ogre::HardwareBuffer::HBU_DYNAMIC_WRITE_ONLY_DISCARDABLE);
    data_.vertexBufferBinding->setBinding(0, vertices_);
    order_.indexBuffer = buffers.createIndexBuffer(Ogre::HardwareIndexBuffer::IT_16BIT, view.index_capacity,
                                                   Ogre::HardwareBuffer::HBU_DYNAMIC_WRITE_ONLY);
    mRenderOp.vertexData = &data_;
    mRenderOp.indexData = &order_;
    setMaterial(Ogre::MaterialManager::getSingleton().getByName("flag"));
    setBoundingBox(Ogre::AxisAlignedBox::BOX_INFINITE);
  }
  /* Writes the vertices into the mapped buffer, and the indices if the topology changed. */
  void refresh() {
    const MuslinView view = cloth.view().value();
    auto *at = static_cast<Vertex *>(vertices_->lock(Ogre::HardwareBuffer::HBL_DISCARD));
    const std::size_t size = vertices_->getSizeInBytes();
    const MuslinStream streams[] = {
        muslin_stream(MUSLIN_ATTRIBUTE_POSITION, MUSLIN_FORMAT_F32, at->position, sizeof *at, size),
        muslin_stream(MUSLIN_ATTRIBUTE_NORMAL, MUSLIN_FORMAT_F32, at->normal, sizeof *at, size - 12),
        muslin_stream(MUSLIN_ATTRIBUTE_UV, MUSLIN_FORMAT_F32, at->uv, sizeof *at, size - 24)};
    cloth.write_vertices(streams, muslin::write_desc()).value();
    vertices_->unlock();
    data_.vertexCount = view.vertex_count;
    if (view.topology_revision == seen_) return;
    void *to = order_.indexBuffer->lock(Ogre::HardwareBuffer::HBL_DISCARD);
    cloth.write_indices(to, order_.indexBuffer->getSizeInBytes(), 16).value();
    order_.indexBuffer->unlock();
    order_.indexCount = view.index_count;
    seen_ = view.topology_revision;
  }
  Ogre::Real getBoundingRadius() const override { return 9; }
  Ogre::Real getSquaredViewDepth(const Ogre::Camera *) const override { return 0; }
  muslin::Cloth cloth;
 private:
  Ogre::VertexData data_;
  Ogre::IndexData order_;
  Ogre::HardwareVertexBufferSharedPtr vertices_;
  std::uint32_t seen_ = 0;
};

int main(int count, char **words) {
  Ogre::Root root("", "", "");
  root.loadPlugin(OGRE_PLUGINS "/RenderSystem_GL3Plus");
  root.loadPlugin(OGRE_PLUGINS "/Codec_STBI");
  root.setRenderSystem(root.getAvailableRenderers().at(0));
  root.initialise(false);
  const Ogre::NameValuePairList options{{"FSAA", "4"}};
  Ogre::RenderWindow *window = root.createRenderWindow("Muslin in OGRE", 960, 640, false, &options);
  add_pass("flag", {0.66f, 0.67f, 0.68f, 1}, 1);
  add_pass("flag", {0, 0, 0, 0}, 0);
  add_pass("pole", {0.30f, 0.26f, 0.24f, 1}, 0);

  MuslinGridDesc desc = muslin::grid_desc();
  desc.columns = 70; /* and 40 rows */
  desc.spacing = 0.032f;
  desc.origin = {-1.15f, 2.2f, 0};
  desc.pin_mode = MUSLIN_PIN_NONE;
  desc.material = muslin::material(MUSLIN_PRESET_FLAG_NYLON).value();
  desc.settings.tearing = 1;
  Flag flag(muslin::Cloth::grid(desc).value());
  for (std::uint32_t row = 0; row < desc.rows; row++) flag.cloth.pin(row * desc.columns).value();
  MuslinWind wind = muslin::wind();
  wind.velocity = {9, 0, 1.5f};
  wind.gust = wind.turbulence = 0.5f;
  flag.cloth.set_wind(wind).value();

  Ogre::SceneManager *scene = root.createSceneManager();
  scene->getRootSceneNode()->attachObject(&flag);
  Ogre::Entity *pole = scene->createEntity(Ogre::SceneManager::PT_CUBE);
  pole->setMaterialName("pole");
  Ogre::SceneNode *foot = scene->getRootSceneNode()->createChildSceneNode(Ogre::Vector3(-1.165f, 1.15f, 0));
  foot->setScale(0.0003f, 0.022f, 0.0003f);
  foot->attachObject(pole);
  Ogre::Camera *camera = scene->createCamera("eye");
  camera->setNearClipDistance(0.1f);
  camera->setFOVy(Ogre::Degree(34));
  Ogre::SceneNode *eye = scene->getRootSceneNode()->createChildSceneNode(Ogre::Vector3(0.3f, 1.6f, 4.9f));
  eye->lookAt(Ogre::Vector3(0.1f, 1.15f, 0), Ogre::Node::TS_WORLD);
  eye->attachObject(camera);
  window->addViewport(camera)->setBackgroundColour(Ogre::ColourValue(0.80f, 0.82f, 0.84f));
  for (int frame = 0; frame < 240; frame++) {
    if (frame == 150) flag.cloth.cut({-1, 1.6f, -1}, {-1, 1.6f, 1}, {1.2f, 0.1f, 0}).value();
    flag.cloth.advance(1.0f / 60).value();
    flag.refresh();
    root.renderOneFrame();
  }
  if (count > 1) window->writeContentsToFile(words[1]);
}
