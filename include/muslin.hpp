/* Muslin for C++17: the calls of muslin.h by a class that destroys its cloth. Header only, nothing added.
 *
 * Whatever may be refused gives a muslin::Result. With exceptions, value() throws a muslin::Error that says
 * why; without them (-fno-exceptions, or MUSLIN_NO_EXCEPTIONS defined) it prints that and aborts, so ask
 * the result first: it is true if the call was done, and why() says why it was not, until the next
 * refusal on this thread.
 *
 *   muslin::Cloth cloth = muslin::Cloth::grid(muslin::grid_desc()).value();
 *   cloth.advance(1.0f / 60.0f).value();
 */
#pragma once

#include <muslin.h>

#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <optional>
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
/** A call that was refused, and changed nothing. */
class Error : public std::runtime_error {
 public:
  explicit Error(MuslinStatus status) : std::runtime_error(muslin_last_error()), status_(status) {}
  MuslinStatus status() const noexcept { return status_; }

 private:
  MuslinStatus status_;
};
#endif

namespace detail {

[[noreturn]] inline void refuse(MuslinStatus status) {
#ifdef MUSLIN_NO_EXCEPTIONS
  std::fprintf(stderr, "muslin: %s (status %d)\n", muslin_last_error(), static_cast<int>(status));
  std::abort();
#else
  throw Error(status);
#endif
}

}  // namespace detail

/** What became of a call that gives a T. */
template <class T>
class [[nodiscard]] Result {
 public:
  Result(MuslinStatus status, T value) : status_(status), value_(std::move(value)) {}

  explicit operator bool() const noexcept { return status_ == MUSLIN_STATUS_OK; }
  MuslinStatus status() const noexcept { return status_; }
  const char *why() const noexcept { return *this ? "" : muslin_last_error(); }

  /** What the call gave; throws or aborts if it was refused. */
  T value() && {
    if (!*this) detail::refuse(status_);
    return std::move(value_);
  }
  const T &value() const & {
    if (!*this) detail::refuse(status_);
    return value_;
  }

 private:
  MuslinStatus status_;
  T value_;
};

/** What became of a call that gives nothing. */
template <>
class [[nodiscard]] Result<void> {
 public:
  Result(MuslinStatus status) noexcept : status_(status) {}

  explicit operator bool() const noexcept { return status_ == MUSLIN_STATUS_OK; }
  MuslinStatus status() const noexcept { return status_; }
  const char *why() const noexcept { return *this ? "" : muslin_last_error(); }

  /** Throws or aborts if the call was refused. */
  void value() const {
    if (!*this) detail::refuse(status_);
  }

 private:
  MuslinStatus status_;
};

using Done = Result<void>;

/* Descriptors that have begun. */

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

/** The figures of a fabric: MUSLIN_PRESET_... */
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

/** A cloth that goes when this does. It may be moved, not copied. */
class Cloth {
 public:
  /** None; every call but this and those that make one is refused. */
  Cloth() noexcept = default;
  /** Takes a cloth over. */
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

  static Result<Cloth> grid(const MuslinGridDesc &desc) noexcept {
    MuslinCloth cloth{};
    const MuslinStatus status = muslin_cloth_create_grid(&desc, &cloth);
    return {status, Cloth(cloth)};
  }

  static Result<Cloth> mesh(const MuslinMeshDesc &desc) noexcept {
    MuslinCloth cloth{};
    const MuslinStatus status = muslin_cloth_create_mesh(&desc, &cloth);
    return {status, Cloth(cloth)};
  }

  static Result<Cloth> restore(const void *buffer, std::size_t size) noexcept {
    MuslinCloth cloth{};
    const MuslinStatus status = muslin_cloth_restore(buffer, size, &cloth);
    return {status, Cloth(cloth)};
  }

  /** For what is not here. */
  MuslinCloth handle() const noexcept { return cloth_; }
  explicit operator bool() const noexcept { return cloth_.id != 0; }
  /** Gives the cloth away; destroy it with muslin_cloth_destroy. */
  MuslinCloth release_handle() noexcept { return std::exchange(cloth_, MuslinCloth{}); }

  Done reset() noexcept { return muslin_cloth_reset(cloth_); }
  Done step(std::uint32_t ticks = 1) noexcept { return muslin_cloth_step(cloth_, ticks); }
  /** How many ticks ran. */
  Result<std::uint32_t> advance(float seconds) noexcept {
    std::uint32_t ticks = 0;
    const MuslinStatus status = muslin_cloth_advance(cloth_, seconds, &ticks);
    return {status, ticks};
  }

  Result<MuslinSettings> settings() const noexcept {
    MuslinSettings told = muslin::settings();
    const MuslinStatus status = muslin_cloth_get_settings(cloth_, &told);
    return {status, told};
  }
  Done set_settings(const MuslinSettings &settings) noexcept {
    return muslin_cloth_set_settings(cloth_, &settings);
  }
  Result<MuslinMaterial> material() const noexcept {
    MuslinMaterial told;
    muslin_material_init(&told);
    const MuslinStatus status = muslin_cloth_get_material(cloth_, &told);
    return {status, told};
  }
  Done set_material(const MuslinMaterial &material) noexcept {
    return muslin_cloth_set_material(cloth_, &material);
  }
  Done set_wind(const MuslinWind &wind) noexcept { return muslin_cloth_set_wind(cloth_, &wind); }

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
  Done set_pin_stiffness(const std::uint32_t *particles, std::uint32_t count, float stiffness) noexcept {
    return muslin_cloth_set_pin_stiffness(cloth_, particles, count, stiffness);
  }
  Done set_mass_scales(const std::uint32_t *particles, const float *scales, std::uint32_t count) noexcept {
    return muslin_cloth_set_mass_scales(cloth_, particles, scales, count);
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

  /** Nothing if the ray meets nothing. */
  Result<std::optional<MuslinHit>> raycast(MuslinVec3 origin, MuslinVec3 direction,
                                           float max_distance) const noexcept {
    MuslinHit hit;
    muslin_hit_init(&hit);
    const MuslinStatus status = muslin_cloth_raycast(cloth_, origin, direction, max_distance, &hit);
    return some(status, hit);
  }
  /** Nothing if the ray meets nothing. */
  Result<std::optional<MuslinGrab>> grab_ray(MuslinVec3 origin, MuslinVec3 direction, float radius,
                                             MuslinVec3 *out_at = nullptr) noexcept {
    MuslinGrab grab{};
    const MuslinStatus status = muslin_cloth_grab_ray(cloth_, origin, direction, radius, &grab, out_at);
    return some(status, grab);
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

  /** How many edges opened. */
  Result<std::uint32_t> cut(MuslinVec3 from, MuslinVec3 to, MuslinVec3 sweep) noexcept {
    std::uint32_t edges = 0;
    const MuslinStatus status = muslin_cloth_cut(cloth_, from, to, sweep, &edges);
    return {status, edges};
  }
  /** Whether the edge gave way. */
  Result<bool> tear_edge(std::uint32_t particle_a, std::uint32_t particle_b) noexcept {
    const MuslinStatus status = muslin_cloth_tear_edge(cloth_, particle_a, particle_b);
    if (status == MUSLIN_STATUS_NOT_TORN) return {MUSLIN_STATUS_OK, false};
    return {status, true};
  }
  Done crease(MuslinVec3 from, MuslinVec3 to, float angle) noexcept {
    return muslin_cloth_crease(cloth_, from, to, angle);
  }
  /** Nothing if all were read. */
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
  Done remove_collider(MuslinCollider collider) noexcept {
    return muslin_cloth_remove_collider(cloth_, collider);
  }
  /** What a cloth did to a collider in a tick. */
  struct Impulse {
    /** Momentum [kg m/s], and angular momentum about the collider's position [kg m2/s]. */
    MuslinVec3 linear, angular;
  };
  Result<Impulse> collider_impulse(MuslinCollider collider) const noexcept {
    Impulse impulse{};
    const MuslinStatus status = muslin_cloth_get_collider_impulse(cloth_, collider, &impulse.linear,
                                                                  &impulse.angular);
    return {status, impulse};
  }

  /** The cloth's own memory, valid until the next call that changes it. */
  Result<MuslinView> view() const noexcept {
    MuslinView view;
    muslin_view_init(&view);
    const MuslinStatus status = muslin_cloth_view(cloth_, &view);
    return {status, view};
  }
  Result<MuslinChanges> changes(std::uint32_t since_topology_revision) const noexcept {
    MuslinChanges changes;
    muslin_changes_init(&changes);
    const MuslinStatus status = muslin_cloth_changes(cloth_, since_topology_revision, &changes);
    return {status, changes};
  }
  template <std::size_t N>
  Done write_vertices(const MuslinStream (&streams)[N], const MuslinWriteDesc &desc) const noexcept {
    return muslin_cloth_write_vertices(cloth_, streams, static_cast<std::uint32_t>(N), &desc);
  }
  Done write_indices(void *buffer, std::size_t size, std::uint32_t index_format, bool flip = false,
                     std::uint32_t base_vertex = 0) const noexcept {
    return muslin_cloth_write_indices(cloth_, buffer, size, index_format, flip ? 1 : 0, base_vertex);
  }
  /** What had to be repaired of the mesh that it was made of. */
  Result<MuslinMeshReport> mesh_report() const noexcept {
    MuslinMeshReport report;
    muslin_mesh_report_init(&report);
    const MuslinStatus status = muslin_cloth_get_mesh_report(cloth_, &report);
    return {status, report};
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
  static Result<std::optional<T>> some(MuslinStatus status, const T &found) noexcept {
    if (status == MUSLIN_STATUS_NOTHING_HIT) return {MUSLIN_STATUS_OK, std::nullopt};
    return {status, found};
  }

  void destroy() noexcept {
    if (cloth_.id != 0) (void)muslin_cloth_destroy(cloth_);
  }

  MuslinCloth cloth_{};
};

}  // namespace muslin
