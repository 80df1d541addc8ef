// muslin.h compiles as C++17, and a short simulation runs.
#include <muslin.h>

#include <cstdio>
#include <cstring>
#include <type_traits>

static_assert(std::is_standard_layout<MuslinGridDesc>::value && std::is_trivial<MuslinView>::value,
              "structs of the header are plain");
static_assert(sizeof(MuslinStatus) == 4, "a status is as wide as in C");

namespace {

// Destroys its cloth when it goes out of scope.
class Cloth {
 public:
  explicit Cloth(const MuslinGridDesc &desc) {
    if (muslin_cloth_create_grid(&desc, &cloth_) != MUSLIN_STATUS_OK) cloth_.id = 0;
  }
  ~Cloth() { (void)muslin_cloth_destroy(cloth_); }
  Cloth(const Cloth &) = delete;
  Cloth &operator=(const Cloth &) = delete;
  MuslinCloth get() const { return cloth_; }

 private:
  MuslinCloth cloth_{};
};

}  // namespace

int main() {
  MuslinGridDesc desc;
  muslin_grid_desc_init(&desc);
  desc.pin_mode = MUSLIN_PIN_TOP_CORNERS;
  desc.extra_particles = MUSLIN_AS_MANY_AGAIN;
  if (muslin_material_preset(&desc.material, MUSLIN_PRESET_SILK) != MUSLIN_STATUS_OK) return 1;
  const Cloth cloth(desc);
  if (muslin_cloth_step(cloth.get(), 60) != MUSLIN_STATUS_OK) return 1;
  MuslinView view;
  muslin_view_init(&view);
  if (muslin_cloth_view(cloth.get(), &view) != MUSLIN_STATUS_OK) return 1;
  const float lowest = view.positions[3 * view.vertex_count - 2];
  const bool refused = muslin_cloth_advance(cloth.get(), -1.0f, nullptr) == MUSLIN_STATUS_BAD_VALUE &&
                       std::strstr(muslin_last_error(), "`seconds`") != nullptr;
  const bool hangs = view.vertex_count == 1600 && lowest < -1.5f && lowest > -3.0f;
  std::printf("%s a short cloth in C++, its corner at y = %.2f m\n", refused && hangs ? "  ok" : "FAIL",
              static_cast<double>(lowest));
  return refused && hangs ? 0 : 1;
}
