// A sheet of cloth in the units and with the triangles of Unreal Engine, in plain C++17: it includes
// nothing of the engine.
//
// Unreal has centimetres, z up and left-handed axes. The formulas of Muslin hold in left-handed axes
// too, so positions, directions and rotations keep their axes; only lengths are scaled. A face of
// Unreal is seen from the side where its corners run the other way round than those of Muslin.

#pragma once

#include <muslin.hpp>

#include <cstdint>
#include <utility>
#include <vector>

/// Both sides of a sheet, as the component of a procedural mesh takes them: the vertices of the
/// front, then as many of the back.
struct SheetMesh {
  std::vector<float> positions;          // 3 per vertex [cm]
  std::vector<float> normals;            // 3 per vertex
  std::vector<float> uvs;                // 2 per vertex
  std::vector<std::uint32_t> triangles;  // 3 per triangle
  bool has_new_triangles = true;         // since the last update: the sheet was torn or cut
};

class ClothSheet {
 public:
  static constexpr float CENTIMETRES = 100;  // per metre

  /// Makes a sheet of `columns` times `rows` particles that are `spacing` [cm] apart and hangs it by
  /// its upper corners. `origin` [cm] is the upper left one; `right` and `down` are unit vectors.
  MuslinStatus make(std::uint32_t columns, std::uint32_t rows, float spacing, MuslinVec3 origin,
                    MuslinVec3 right, MuslinVec3 down) {
    MuslinGridDesc desc = muslin::grid_desc();
    desc.columns = columns;
    desc.rows = rows;
    desc.spacing = spacing / CENTIMETRES;
    desc.origin = metres(origin);
    desc.right = right;
    desc.down = down;
    desc.pin_mode = MUSLIN_PIN_TOP_CORNERS;
    desc.settings.gravity = {0, 0, -9.81f};
    muslin::Result<muslin::Cloth> made = muslin::Cloth::grid(desc);
    if (made) cloth_ = std::move(made).value();
    return made.status();
  }

  /// Adds a sphere of `radius` [cm] at `center` [cm].
  muslin::Result<MuslinCollider> add_sphere(MuslinVec3 center, float radius) {
    MuslinColliderDesc desc = muslin::collider_desc();
    desc.shape = MUSLIN_SHAPE_SPHERE;
    desc.position = metres(center);
    desc.radius = radius / CENTIMETRES;
    return cloth_.add_collider(desc);
  }

  /// Moves a sphere to `center` [cm] over the ticks of the next advance().
  MuslinStatus move_sphere(MuslinCollider sphere, MuslinVec3 center) {
    return cloth_.move_collider(sphere, metres(center), {0, 0, 0, 1}).status();
  }

  /// Sets the velocity of the air [cm/s].
  MuslinStatus set_wind(MuslinVec3 velocity) {
    MuslinWind wind = muslin::wind();
    wind.velocity = metres(velocity);
    wind.gust = 0.5f;
    return cloth_.set_wind(wind).status();
  }

  /// Runs the ticks that `seconds` of frame time are due, on any thread, but on one at a time.
  MuslinStatus advance(float seconds) { return cloth_.advance(seconds).status(); }

  /// Writes both sides into `mesh`.
  MuslinStatus update(SheetMesh &mesh) {
    const muslin::Result<MuslinView> found = cloth_.view();
    if (!found) return found.status();
    const MuslinView &view = found.value();
    const std::size_t count = view.vertex_count;
    mesh.positions.resize(6 * count);
    mesh.normals.resize(6 * count);
    mesh.uvs.resize(4 * count);
    for (std::uint32_t side = 0; side < 2; side++) {
      const MuslinStatus status = write_side(mesh, count, side);
      if (status != MUSLIN_STATUS_OK) return status;
    }
    mesh.has_new_triangles = view.topology_revision != topology_ || mesh.triangles.empty();
    if (!mesh.has_new_triangles) return MUSLIN_STATUS_OK;
    topology_ = view.topology_revision;
    mesh.triangles.resize(2 * std::size_t{view.index_count});
    std::uint32_t *front = mesh.triangles.data(), *back = front + view.index_count;
    const std::size_t size = view.index_count * sizeof(std::uint32_t);
    const MuslinStatus status = muslin_cloth_write_indices(cloth_.handle(), front, size, 32, 1, 0);
    if (status != MUSLIN_STATUS_OK) return status;
    return muslin_cloth_write_indices(cloth_.handle(), back, size, 32, 0, view.vertex_count);
  }

  muslin::Cloth &cloth() { return cloth_; }

 private:
  static MuslinVec3 metres(MuslinVec3 v) {
    return {v.x / CENTIMETRES, v.y / CENTIMETRES, v.z / CENTIMETRES};
  }

  MuslinStatus write_side(SheetMesh &mesh, std::size_t count, std::uint32_t side) {
    MuslinWriteDesc desc = muslin::write_desc();
    desc.blend = cloth_.blend().value();
    desc.flip_normals = side;
    for (const int diagonal : {0, 5, 10}) desc.transform[diagonal] = CENTIMETRES;
    const MuslinStream streams[] = {
        stream(MUSLIN_ATTRIBUTE_POSITION, &mesh.positions[3 * side * count], 3, count),
        stream(MUSLIN_ATTRIBUTE_NORMAL, &mesh.normals[3 * side * count], 3, count),
        stream(MUSLIN_ATTRIBUTE_UV, &mesh.uvs[2 * side * count], 2, count),
    };
    return cloth_.write_vertices(streams, desc).status();
  }

  static MuslinStream stream(std::uint32_t attribute, float *to, std::uint32_t numbers, std::size_t count) {
    const std::uint32_t stride = numbers * static_cast<std::uint32_t>(sizeof(float));
    return muslin_stream(attribute, MUSLIN_FORMAT_F32, to, stride, stride * count);
  }

  muslin::Cloth cloth_;
  std::uint32_t topology_ = 0;
};
