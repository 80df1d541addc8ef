/* Muslin for C++17: classes that own a cloth or a skin and wrap the functions of muslin.h. Header only.
 *
 * Functions that can fail return a muslin::Result, which is true if the call succeeded.
 *
 * - With exceptions, Result::value() returns the value or throws a muslin::Error.
 * - Without exceptions (-fno-exceptions, or MUSLIN_NO_EXCEPTIONS defined), Result::value() prints
 *   the message and aborts if the call failed, so test the result first.
 * - Result::why() returns the message of a failed call, until the next failed call on this thread.
 *
 *   muslin::Cloth cloth = muslin::Cloth::grid(muslin::grid_desc()).value();
 *   cloth.advance(1.0f / 60.0f).value();
 *
 * Each member function calls the muslin_cloth_... function of the same name; muslin.h documents its
 * effect, units, ranges and errors.
 */
#pragma once

#include <muslin.h>

#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#if !defined(MUSLIN_NO_EXCEPTIONS) && !defined(__cpp_exceptions) && !defined(_CPPUNWIND)
#define MUSLIN_NO_EXCEPTIONS
#endif
#ifndef MUSLIN_NO_EXCEPTIONS
#include <stdexcept>
#endif

namespace muslin {

#ifndef MUSLIN_NO_EXCEPTIONS
/** Exception of a call that failed and changed nothing. */
class Error : public std::runtime_error {
 public:
  explicit Error(MuslinStatus status) : std::runtime_error(muslin_last_error()), status_(status) {}
  /** The status of the call. */
  MuslinStatus status() const noexcept { return status_; }

 private:
  MuslinStatus status_;
};
#endif

namespace detail {

/** Throws an Error; without exceptions, prints the message and aborts. */
[[noreturn]] inline void fail(MuslinStatus status) {
#ifdef MUSLIN_NO_EXCEPTIONS
  std::fprintf(stderr, "muslin: %s (status %d)\n", muslin_last_error(), static_cast<int>(status));
  std::abort();
#else
  throw Error(status);
#endif
}

}  // namespace detail

/** Result of a call that returns a T. */
template <class T>
class [[nodiscard]] Result {
 public:
  Result(MuslinStatus status, T value) : status_(status), value_(std::move(value)) {}

  /** Whether the call succeeded. */
  explicit operator bool() const noexcept { return status_ == MUSLIN_STATUS_OK; }
  /** The status of the call. */
  MuslinStatus status() const noexcept { return status_; }
  /** The message of the failed call, until the next failed call on this thread. */
  const char *why() const noexcept { return *this ? "" : muslin_last_error(); }

  /** Returns the value; throws or aborts if the call failed. */
  T value() && {
    if (!*this) detail::fail(status_);
    return std::move(value_);
  }
  const T &value() const & {
    if (!*this) detail::fail(status_);
    return value_;
  }

 private:
  MuslinStatus status_;
  T value_;
};

/** Result of a call that returns no value. */
template <>
class [[nodiscard]] Result<void> {
 public:
  Result(MuslinStatus status) noexcept : status_(status) {}

  /** Whether the call succeeded. */
  explicit operator bool() const noexcept { return status_ == MUSLIN_STATUS_OK; }
  /** The status of the call. */
  MuslinStatus status() const noexcept { return status_; }
  /** The message of the failed call, until the next failed call on this thread. */
  const char *why() const noexcept { return *this ? "" : muslin_last_error(); }

  /** Throws or aborts if the call failed. */
  void value() const {
    if (!*this) detail::fail(status_);
  }

 private:
  MuslinStatus status_;
};

/** Result of a call that returns no value. */
using Done = Result<void>;

/* Initialised structs with their defaults. */

inline MuslinGridDesc grid_desc() noexcept {
  MuslinGridDesc desc;
  muslin_grid_desc_init(&desc);
  return desc;
}

inline MuslinMeshDesc mesh_desc() noexcept {
  MuslinMeshDesc desc;
  muslin_mesh_desc_init(&desc);
  return desc;
}

inline MuslinSettings settings() noexcept {
  MuslinSettings settings;
  muslin_settings_init(&settings);
  return settings;
}

/** Returns the material of a fabric, one of MUSLIN_PRESET_.... */
inline Result<MuslinMaterial> material(std::uint32_t preset) noexcept {
  MuslinMaterial material;
  muslin_material_init(&material);
  const MuslinStatus status = muslin_material_preset(&material, preset);
  return {status, material};
}

inline MuslinWind wind() noexcept {
  MuslinWind wind;
  muslin_wind_init(&wind);
  return wind;
}

inline MuslinColliderDesc collider_desc() noexcept {
  MuslinColliderDesc desc;
  muslin_collider_desc_init(&desc);
  return desc;
}

inline MuslinWriteDesc write_desc() noexcept {
  MuslinWriteDesc desc;
  muslin_write_desc_init(&desc);
  return desc;
}

inline MuslinSewDesc sew_desc() noexcept {
  MuslinSewDesc desc;
  muslin_sew_desc_init(&desc);
  return desc;
}

inline MuslinSkinDesc skin_desc() noexcept {
  MuslinSkinDesc desc;
  muslin_skin_desc_init(&desc);
  return desc;
}

/** Owns a skin and destroys it. Movable, not copyable. A skin ends with its cloth: then calls on it
 * fail with MUSLIN_STATUS_BAD_HANDLE. */
class Skin {
 public:
  /** Owns no skin: calls on it fail with MUSLIN_STATUS_BAD_HANDLE. */
  Skin() noexcept = default;
  /** Takes ownership of a skin. */
  explicit Skin(MuslinSkin skin) noexcept : skin_(skin) {}
  Skin(Skin &&other) noexcept : skin_(other.release_handle()) {}
  Skin &operator=(Skin &&other) noexcept {
    if (this != &other) {
      destroy();
      skin_ = other.release_handle();
    }
    return *this;
  }
  Skin(const Skin &) = delete;
  Skin &operator=(const Skin &) = delete;
  ~Skin() { destroy(); }

  /** The C handle. Still owned by this object. */
  MuslinSkin handle() const noexcept { return skin_; }
  /** Whether this object owns a skin. */
  explicit operator bool() const noexcept { return skin_.id != 0; }
  /** Gives up ownership; the caller may call muslin_skin_destroy. */
  MuslinSkin release_handle() noexcept { return std::exchange(skin_, MuslinSkin{}); }

  /** The lists where the cloth is now, valid until the next call on the skin or that changes the
   * cloth. */
  Result<MuslinView> view() const noexcept {
    MuslinView view;
    muslin_view_init(&view);
    const MuslinStatus status = muslin_skin_view(skin_, &view);
    return {status, view};
  }
  /** Writes vertices into your own buffers. */
  template <std::size_t N>
  Done write_vertices(const MuslinStream (&streams)[N], const MuslinWriteDesc &desc) const noexcept {
    return muslin_skin_write_vertices(skin_, streams, static_cast<std::uint32_t>(N), &desc);
  }

 private:
  void destroy() noexcept {
    if (skin_.id != 0) (void)muslin_skin_destroy(skin_);
  }

  MuslinSkin skin_{};
};

/** Owns a cloth and destroys it. Movable, not copyable. */
class Cloth {
 public:
  /** Owns no cloth: calls on it fail with MUSLIN_STATUS_BAD_HANDLE. */
  Cloth() noexcept = default;
  /** Takes ownership of a cloth. */
  explicit Cloth(MuslinCloth cloth) noexcept : cloth_(cloth) {}
  Cloth(Cloth &&other) noexcept : cloth_(other.release_handle()) {}
  Cloth &operator=(Cloth &&other) noexcept {
    if (this != &other) {
      destroy();
      cloth_ = other.release_handle();
    }
    return *this;
  }
  Cloth(const Cloth &) = delete;
  Cloth &operator=(const Cloth &) = delete;
  ~Cloth() { destroy(); }

  /** Makes a cloth from a regular grid. */
  static Result<Cloth> grid(const MuslinGridDesc &desc) noexcept {
    MuslinCloth cloth{};
    const MuslinStatus status = muslin_cloth_create_grid(&desc, &cloth);
    return {status, Cloth(cloth)};
  }

  /** Makes a cloth from any triangle mesh. */
  static Result<Cloth> mesh(const MuslinMeshDesc &desc) noexcept {
    MuslinCloth cloth{};
    const MuslinStatus status = muslin_cloth_create_mesh(&desc, &cloth);
    return {status, Cloth(cloth)};
  }

  /** Makes a cloth from bytes that save() returned. */
  static Result<Cloth> restore(const void *buffer, std::size_t size) noexcept {
    MuslinCloth cloth{};
    const MuslinStatus status = muslin_cloth_restore(buffer, size, &cloth);
    return {status, Cloth(cloth)};
  }

  /** Makes an independent copy in the same state. */
  Result<Cloth> duplicate() const noexcept {
    MuslinCloth cloth{};
    const MuslinStatus status = muslin_cloth_duplicate(cloth_, &cloth);
    return {status, Cloth(cloth)};
  }

  /** The C handle, for functions that this class does not have. Still owned by this object. */
  MuslinCloth handle() const noexcept { return cloth_; }
  /** Whether this object owns a cloth. */
  explicit operator bool() const noexcept { return cloth_.id != 0; }
  /** Gives up ownership; the caller must call muslin_cloth_destroy. */
  MuslinCloth release_handle() noexcept { return std::exchange(cloth_, MuslinCloth{}); }

  Done reset() noexcept { return muslin_cloth_reset(cloth_); }
  Done step(std::uint32_t ticks = 1) noexcept { return muslin_cloth_step(cloth_, ticks); }
  /** Runs the ticks that are due after `seconds` [s]; returns how many ran. */
  Result<std::uint32_t> advance(float seconds) noexcept {
    std::uint32_t ticks = 0;
    const MuslinStatus status = muslin_cloth_advance(cloth_, seconds, &ticks);
    return {status, ticks};
  }

  /**
   * Advances `count` cloths by `seconds` [s], each as advance() does; `out_ticks` (may be null)
   * receives how many ticks each of them ran.
   */
  static Done advance_many(const Cloth *cloths, std::uint32_t count, float seconds,
                           std::uint32_t *out_ticks = nullptr) noexcept {
    static_assert(sizeof(Cloth) == sizeof(MuslinCloth), "a cloth is its handle");
    return muslin_cloths_advance(&cloths->cloth_, count, seconds, out_ticks);
  }

  Result<MuslinSettings> settings() const noexcept {
    MuslinSettings current = muslin::settings();
    const MuslinStatus status = muslin_cloth_get_settings(cloth_, &current);
    return {status, current};
  }
  Done set_settings(const MuslinSettings &settings) noexcept {
    return muslin_cloth_set_settings(cloth_, &settings);
  }
  Result<MuslinMaterial> material() const noexcept {
    MuslinMaterial current;
    muslin_material_init(&current);
    const MuslinStatus status = muslin_cloth_get_material(cloth_, &current);
    return {status, current};
  }
  Done set_material(const MuslinMaterial &material) noexcept {
    return muslin_cloth_set_material(cloth_, &material);
  }
  Result<MuslinWind> wind() const noexcept {
    MuslinWind current;
    muslin_wind_init(&current);
    const MuslinStatus status = muslin_cloth_get_wind(cloth_, &current);
    return {status, current};
  }
  Done set_wind(const MuslinWind &wind) noexcept { return muslin_cloth_set_wind(cloth_, &wind); }

  /** The share of a tick that advance() has not simulated yet, from 0 to 1. */
  Result<float> blend() const noexcept {
    float blend = 0;
    const MuslinStatus status = muslin_cloth_get_blend(cloth_, &blend);
    return {status, blend};
  }
  Result<bool> is_asleep() const noexcept {
    std::uint32_t asleep = 0;
    const MuslinStatus status = muslin_cloth_is_asleep(cloth_, &asleep);
    return {status, asleep != 0};
  }
  /** Simulated time since the cloth was made or reset. */
  struct Time {
    double seconds;
    std::uint64_t ticks;
  };
  Result<Time> time() const noexcept {
    Time time{};
    const MuslinStatus status = muslin_cloth_get_time(cloth_, &time.seconds, &time.ticks);
    return {status, time};
  }
  /** Mass, center of mass and momentum of the whole cloth. */
  struct Mass {
    /** Sum of the masses of all particles [kg]. */
    float total;
    /** Center of mass [m]; sum of mass times velocity [kg m/s]. */
    MuslinVec3 center, momentum;
  };
  Result<Mass> mass() const noexcept {
    Mass mass{};
    const MuslinStatus status =
        muslin_cloth_get_mass(cloth_, &mass.total, &mass.center, &mass.momentum);
    return {status, mass};
  }

  Done pin(std::uint32_t particle) noexcept { return muslin_cloth_pin(cloth_, particle, nullptr); }
  Done pin(std::uint32_t particle, MuslinVec3 target) noexcept {
    return muslin_cloth_pin(cloth_, particle, &target);
  }
  Done unpin(std::uint32_t particle) noexcept { return muslin_cloth_unpin(cloth_, particle); }
  Done unpin_all() noexcept { return muslin_cloth_unpin_all(cloth_); }
  Done set_pin_targets(const std::uint32_t *particles, const void *positions, std::uint32_t stride,
                       std::uint32_t count) noexcept {
    return muslin_cloth_set_pin_targets(cloth_, particles, positions, stride, count);
  }
  /** Returns the pinned particles, in ascending order. */
  Result<std::vector<std::uint32_t>> pins() const {
    std::uint32_t count = 0;
    std::vector<std::uint32_t> pins;
    MuslinStatus status = muslin_cloth_get_pins(cloth_, nullptr, 0, &count);
    pins.resize(count);
    if (count > 0) status = muslin_cloth_get_pins(cloth_, pins.data(), count, &count);
    return {status, std::move(pins)};
  }
  Done get_pin_targets(const std::uint32_t *particles, float *out_positions, std::uint32_t stride,
                       std::uint32_t count) const noexcept {
    return muslin_cloth_get_pin_targets(cloth_, particles, out_positions, stride, count);
  }
  Done set_pin_stiffness(const std::uint32_t *particles, std::uint32_t count, float stiffness) noexcept {
    return muslin_cloth_set_pin_stiffness(cloth_, particles, count, stiffness);
  }
  Done set_mass_scales(const std::uint32_t *particles, const float *scales, std::uint32_t count) noexcept {
    return muslin_cloth_set_mass_scales(cloth_, particles, scales, count);
  }
  /** `map` is a MUSLIN_MAP_ value; with `scales` null the map is taken away. */
  Done set_map(std::uint32_t map, const float *scales, std::uint32_t count) noexcept {
    return muslin_cloth_set_map(cloth_, map, scales, count);
  }
  /** Reads a map into `count` scales; whether it is set. */
  Result<bool> get_map(std::uint32_t map, float *out_scales, std::uint32_t count) const noexcept {
    std::uint32_t is_set = 0;
    const MuslinStatus status = muslin_cloth_get_map(cloth_, map, out_scales, count, &is_set);
    return {status, is_set != 0};
  }
  Result<MuslinAttachment> attach(const std::uint32_t *particles, std::uint32_t count,
                                  MuslinVec3 position, MuslinQuat rotation) noexcept {
    MuslinAttachment attachment{};
    const MuslinStatus status =
        muslin_cloth_attach(cloth_, particles, count, position, rotation, &attachment);
    return {status, attachment};
  }
  Done move_attachment(MuslinAttachment attachment, MuslinVec3 position, MuslinQuat rotation) noexcept {
    return muslin_cloth_move_attachment(cloth_, attachment, position, rotation);
  }
  Done detach(MuslinAttachment attachment) noexcept { return muslin_cloth_detach(cloth_, attachment); }
  Done set_max_distances(const std::uint32_t *particles, const float *distances,
                         std::uint32_t count) noexcept {
    return muslin_cloth_set_max_distances(cloth_, particles, distances, count);
  }
  Done set_backstops(const std::uint32_t *particles, const float *distances, const float *radii,
                     std::uint32_t count) noexcept {
    return muslin_cloth_set_backstops(cloth_, particles, distances, radii, count);
  }
  Done set_anchors(const std::uint32_t *particles, const void *positions, const void *normals,
                   std::uint32_t stride, std::uint32_t count) noexcept {
    return muslin_cloth_set_anchors(cloth_, particles, positions, normals, stride, count);
  }
  Done clear_leashes() noexcept { return muslin_cloth_clear_leashes(cloth_); }
  Done set_frame(MuslinVec3 position, MuslinQuat rotation) noexcept {
    return muslin_cloth_set_frame(cloth_, position, rotation);
  }
  Done teleport(MuslinVec3 position, MuslinQuat rotation) noexcept {
    return muslin_cloth_teleport(cloth_, position, rotation);
  }
  Done move_frame(MuslinVec3 position, MuslinQuat rotation, float inertia) noexcept {
    return muslin_cloth_move_frame(cloth_, position, rotation, inertia);
  }
  Done set_position(std::uint32_t particle, MuslinVec3 position) noexcept {
    return muslin_cloth_set_position(cloth_, particle, position);
  }
  Done set_velocity(std::uint32_t particle, MuslinVec3 velocity) noexcept {
    return muslin_cloth_set_velocity(cloth_, particle, velocity);
  }

  Done set_positions(std::uint32_t first, std::uint32_t count, const float *positions,
                     std::uint32_t stride = 0) noexcept {
    return muslin_cloth_set_positions(cloth_, first, count, positions, stride);
  }
  Done set_velocities(std::uint32_t first, std::uint32_t count, const float *velocities,
                      std::uint32_t stride = 0) noexcept {
    return muslin_cloth_set_velocities(cloth_, first, count, velocities, stride);
  }
  Done get_velocities(std::uint32_t first, std::uint32_t count, float *out_velocities,
                      std::uint32_t stride = 0) const noexcept {
    return muslin_cloth_get_velocities(cloth_, first, count, out_velocities, stride);
  }
  Done get_rest_positions(std::uint32_t first, std::uint32_t count, float *out_positions,
                          std::uint32_t stride = 0) const noexcept {
    return muslin_cloth_get_rest_positions(cloth_, first, count, out_positions, stride);
  }

  /** Returns the first hit of a ray; empty if it hits nothing. */
  Result<std::optional<MuslinHit>> raycast(MuslinVec3 origin, MuslinVec3 direction,
                                           float max_distance) const noexcept {
    MuslinHit hit;
    muslin_hit_init(&hit);
    const MuslinStatus status = muslin_cloth_raycast(cloth_, origin, direction, max_distance, &hit);
    return hit_or_empty(status, hit);
  }
  /** Grabs the particle that a ray points at; empty if there is none. */
  Result<std::optional<MuslinGrab>> grab_ray(MuslinVec3 origin, MuslinVec3 direction, float radius,
                                             MuslinVec3 *out_at = nullptr) noexcept {
    MuslinGrab grab{};
    const MuslinStatus status = muslin_cloth_grab_ray(cloth_, origin, direction, radius, &grab, out_at);
    return hit_or_empty(status, grab);
  }
  Result<MuslinGrab> grab_particle(std::uint32_t particle) noexcept {
    MuslinGrab grab{};
    const MuslinStatus status = muslin_cloth_grab_particle(cloth_, particle, &grab);
    return {status, grab};
  }
  Done move_grab(MuslinGrab grab, MuslinVec3 target) noexcept {
    return muslin_cloth_move_grab(cloth_, grab, target);
  }
  Done release(MuslinGrab grab) noexcept { return muslin_cloth_release(cloth_, grab); }

  /** Cuts with a swept segment; returns the number of opened edges. */
  Result<std::uint32_t> cut(MuslinVec3 from, MuslinVec3 to, MuslinVec3 sweep) noexcept {
    std::uint32_t edges = 0;
    const MuslinStatus status = muslin_cloth_cut(cloth_, from, to, sweep, &edges);
    return {status, edges};
  }
  /** Tears an edge; returns whether it tore. */
  Result<bool> tear_edge(std::uint32_t particle_a, std::uint32_t particle_b) noexcept {
    const MuslinStatus status = muslin_cloth_tear_edge(cloth_, particle_a, particle_b);
    if (status == MUSLIN_STATUS_NOT_TORN) return {MUSLIN_STATUS_OK, false};
    return {status, true};
  }
  /** Sews pairs of particles together; `pairs` has two particles per pair. */
  Done sew(const std::uint32_t *pairs, std::uint32_t pair_count,
           const MuslinSewDesc &desc) noexcept {
    return muslin_cloth_sew(cloth_, pairs, pair_count, &desc);
  }
  Done crease(MuslinVec3 from, MuslinVec3 to, float angle) noexcept {
    return muslin_cloth_crease(cloth_, from, to, angle);
  }
  /** Removes and returns the oldest event; empty if there is none. */
  Result<std::optional<MuslinEvent>> next_event() noexcept {
    MuslinEvent event;
    std::uint32_t is_some = 0;
    muslin_event_init(&event);
    const MuslinStatus status = muslin_cloth_next_event(cloth_, &event, &is_some);
    return {status, is_some != 0 ? std::optional<MuslinEvent>(event) : std::nullopt};
  }

  Result<MuslinCollider> add_collider(const MuslinColliderDesc &desc) noexcept {
    MuslinCollider collider{};
    const MuslinStatus status = muslin_cloth_add_collider(cloth_, &desc, &collider);
    return {status, collider};
  }
  Done move_collider(MuslinCollider collider, MuslinVec3 position, MuslinQuat rotation) noexcept {
    return muslin_cloth_move_collider(cloth_, collider, position, rotation);
  }
  Done teleport_collider(MuslinCollider collider, MuslinVec3 position, MuslinQuat rotation) noexcept {
    return muslin_cloth_teleport_collider(cloth_, collider, position, rotation);
  }
  /** New vertices of a mesh collider, in its frame. */
  Done update_collider(MuslinCollider collider, const float *positions, std::uint32_t count,
                       std::uint32_t stride = 0) noexcept {
    return muslin_cloth_update_collider(cloth_, collider, positions, stride, count);
  }
  /** Makes the surface of another cloth a collider, or updates it: once per frame, between the
   * advance() of `other` and that of this cloth, first with {} and then with what it returned. */
  Result<MuslinCollider> collide_with(const Cloth &other, MuslinCollider collider = {}) noexcept {
    const MuslinStatus status = muslin_cloth_collide_with(cloth_, other.cloth_, &collider);
    return {status, collider};
  }
  Done remove_collider(MuslinCollider collider) noexcept {
    return muslin_cloth_remove_collider(cloth_, collider);
  }
  /** Position and rotation of a collider after the last tick. */
  struct Pose {
    MuslinVec3 position;
    MuslinQuat rotation;
  };
  Result<Pose> collider_pose(MuslinCollider collider) const noexcept {
    Pose pose{};
    const MuslinStatus status =
        muslin_cloth_get_collider_pose(cloth_, collider, &pose.position, &pose.rotation);
    return {status, pose};
  }
  /** Impulse that the cloth applied to a collider in the last tick. */
  struct Impulse {
    /** Linear impulse [kg m/s]; angular impulse about the collider's position [kg m^2/s]. */
    MuslinVec3 linear, angular;
  };
  Result<Impulse> collider_impulse(MuslinCollider collider) const noexcept {
    Impulse impulse{};
    const MuslinStatus status = muslin_cloth_get_collider_impulse(cloth_, collider, &impulse.linear,
                                                                  &impulse.angular);
    return {status, impulse};
  }

  /** Output lists in the cloth's own memory, valid until the next call that changes it. */
  Result<MuslinView> view() const noexcept {
    MuslinView view;
    muslin_view_init(&view);
    const MuslinStatus status = muslin_cloth_view(cloth_, &view);
    return {status, view};
  }
  /** The point that the cloth is simulated relative to, in whole metres. */
  Result<MuslinVec3> origin() const noexcept {
    MuslinVec3 origin{};
    const MuslinStatus status = muslin_cloth_get_origin(cloth_, &origin);
    return {status, origin};
  }
  /** Output ranges that changed after the given topology revision. */
  Result<MuslinChanges> changes(std::uint32_t since_topology_revision) const noexcept {
    MuslinChanges changes;
    muslin_changes_init(&changes);
    const MuslinStatus status = muslin_cloth_changes(cloth_, since_topology_revision, &changes);
    return {status, changes};
  }
  /** Writes vertices into your own buffers. */
  template <std::size_t N>
  Done write_vertices(const MuslinStream (&streams)[N], const MuslinWriteDesc &desc) const noexcept {
    return muslin_cloth_write_vertices(cloth_, streams, static_cast<std::uint32_t>(N), &desc);
  }
  Done write_indices(void *buffer, std::size_t size, std::uint32_t index_format, bool flip = false,
                     std::uint32_t base_vertex = 0) const noexcept {
    return muslin_cloth_write_indices(cloth_, buffer, size, index_format, flip ? 1 : 0, base_vertex);
  }
  /** Binds a render mesh to the cloth as it is now. */
  Result<Skin> skin(const MuslinSkinDesc &desc) noexcept {
    MuslinSkin skin{};
    const MuslinStatus status = muslin_skin_create(cloth_, &desc, &skin);
    return {status, Skin(skin)};
  }
  /** What was repaired in the mesh that the cloth was made from. */
  Result<MuslinMeshReport> mesh_report() const noexcept {
    MuslinMeshReport report;
    muslin_mesh_report_init(&report);
    const MuslinStatus status = muslin_cloth_get_mesh_report(cloth_, &report);
    return {status, report};
  }
  /** What the author of the mesh should know of: one sentence per line, empty for a good mesh. */
  Result<std::string> mesh_warnings() const {
    std::size_t needed = 0;
    std::string text;
    MuslinStatus status = muslin_cloth_get_mesh_warnings(cloth_, nullptr, 0, &needed);
    if (status == MUSLIN_STATUS_OK) {
      text.resize(needed);
      status = muslin_cloth_get_mesh_warnings(cloth_, &text[0], text.size(), &needed);
      text.resize(status == MUSLIN_STATUS_OK ? needed - 1 : 0);  // without the zero byte
    }
    return {status, std::move(text)};
  }
  Result<MuslinStats> stats() const noexcept {
    MuslinStats stats;
    muslin_stats_init(&stats);
    const MuslinStatus status = muslin_cloth_get_stats(cloth_, &stats);
    return {status, stats};
  }
  Result<std::uint64_t> state_hash() const noexcept {
    std::uint64_t hash = 0;
    const MuslinStatus status = muslin_cloth_state_hash(cloth_, &hash);
    return {status, hash};
  }
  /** Returns the complete state as bytes. */
  Result<std::vector<unsigned char>> save() const {
    std::size_t needed = 0;
    std::vector<unsigned char> bytes;
    MuslinStatus status = muslin_cloth_save(cloth_, nullptr, 0, &needed);
    if (status == MUSLIN_STATUS_OK) {
      bytes.resize(needed);
      status = muslin_cloth_save(cloth_, bytes.data(), bytes.size(), &needed);
    }
    return {status, std::move(bytes)};
  }

 private:
  template <class T>
  static Result<std::optional<T>> hit_or_empty(MuslinStatus status, const T &found) noexcept {
    if (status == MUSLIN_STATUS_NOTHING_HIT) return {MUSLIN_STATUS_OK, std::nullopt};
    return {status, found};
  }

  void destroy() noexcept {
    if (cloth_.id != 0) (void)muslin_cloth_destroy(cloth_);
  }

  MuslinCloth cloth_{};
};

}  // namespace muslin
