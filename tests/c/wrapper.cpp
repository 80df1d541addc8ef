// muslin.hpp: every function, ownership, and errors as results and as exceptions.
#include <muslin.hpp>

#include <cmath>
#include <cstdio>
#include <cstring>
#include <type_traits>

namespace {

int failures = 0;

void check(bool holds, const char *claim) {
  if (holds) return;
  failures++;
  std::fprintf(stderr, "not so: %s (last error: %s)\n", claim, muslin_last_error());
}

#define CHECK(claim) check(static_cast<bool>(claim), #claim)

static_assert(!std::is_copy_constructible<muslin::Cloth>::value, "a cloth must not be copyable");
static_assert(std::is_nothrow_move_constructible<muslin::Cloth>::value, "a cloth must be movable");
static_assert(sizeof(muslin::Cloth) == sizeof(MuslinCloth), "a cloth must be as small as its handle");

// Attachments, anchors and teleports.
void worn(muslin::Cloth &cloth) {
  const MuslinQuat as_it_is{0, 0, 0, 1}, half_round{0, 1, 0, 0};
  const std::uint32_t edge[] = {0, 1}, last[] = {379};
  const auto before = cloth.view().value().positions[0];
  const MuslinAttachment body = cloth.attach(edge, 2, {0, 0, 0}, as_it_is).value();
  cloth.move_attachment(body, {0.01f, 0, 0}, as_it_is).value();
  cloth.set_pin_stiffness(&edge[1], 1, 50.0f).value();
  const float scale = 3, distance = 0.2f, behind = 0, radius = 1;
  const MuslinVec3 anchor{1, -1, 0}, normal{0, 0, 2};
  cloth.set_mass_scales(last, &scale, 1).value();
  const std::vector<float> painted(400, 2.0f);
  cloth.set_map(MUSLIN_MAP_BEND, painted.data(), 400).value();
  CHECK(cloth.set_map(MUSLIN_MAP_BEND, painted.data(), 399).status() == MUSLIN_STATUS_BAD_VALUE);
  std::vector<float> read(400);
  CHECK(cloth.get_map(MUSLIN_MAP_BEND, read.data(), 400).value() && read == painted);
  cloth.set_map(MUSLIN_MAP_BEND, nullptr, 0).value();
  CHECK(!cloth.get_map(MUSLIN_MAP_BEND, nullptr, 0).value());
  cloth.set_max_distances(last, &distance, 1).value();
  cloth.set_backstops(last, &behind, &radius, 1).value();
  cloth.set_anchors(last, &anchor, &normal, 0, 1).value();
  cloth.step().value();
  const float *x = cloth.view().value().positions;
  CHECK(std::fabs(x[0] - before - 0.01f) < 1e-6f);
  const float to[] = {x[3 * 379] - 1, x[3 * 379 + 1] + 1, x[3 * 379 + 2]};
  CHECK(std::sqrt(to[0] * to[0] + to[1] * to[1] + to[2] * to[2]) < 0.2001f);
  cloth.clear_leashes().value();
  const float was = x[3 * 399];
  cloth.set_frame({0, 0, 0}, as_it_is).value();
  cloth.teleport({10, 0, 0}, half_round).value();
  CHECK(std::fabs(cloth.view().value().positions[3 * 399] - (10 - was)) < 1e-5f);
  cloth.move_frame({0, 0, 0}, as_it_is, 0).value();
  CHECK(std::fabs(cloth.view().value().positions[3 * 399] - was) < 1e-5f);
  cloth.detach(body).value();
  CHECK(cloth.detach(body).status() == MUSLIN_STATUS_BAD_HANDLE);
  for (const std::uint32_t particle : edge) cloth.pin(particle).value();
}

// Whole poses, and cheap questions.
void posed(muslin::Cloth &cloth) {
  std::vector<float> rest(3 * 400), velocities(3 * 400);
  cloth.get_rest_positions(0, 400, rest.data()).value();
  CHECK(rest[3 * 399] > rest[0] && rest[2] == 0.0f);
  cloth.get_velocities(0, 400, velocities.data()).value();
  cloth.set_positions(380, 20, rest.data() + 3 * 380).value();
  CHECK(cloth.view().value().positions[3 * 399 + 1] == rest[3 * 399 + 1]);
  const float up[] = {0, 1, 0};
  cloth.set_velocities(399, 1, up).value();
  CHECK(cloth.mass().value().momentum.y > -1.0f && cloth.mass().value().total > 0.01f);
  cloth.set_velocities(0, 400, velocities.data()).value();
  const std::vector<std::uint32_t> pins = cloth.pins().value();
  CHECK(pins.size() == 20 && pins.back() == 19);
  std::vector<float> targets(3 * pins.size());
  cloth.get_pin_targets(pins.data(), targets.data(), 0, 20).value();
  CHECK(targets[3] == rest[3]);
  CHECK(cloth.time().value().ticks == 22 && cloth.time().value().seconds > 0.3);
  CHECK(cloth.blend().value() < 1e-3f && !cloth.is_asleep().value());
  CHECK(cloth.wind().value().velocity.z == 1.0f);
}

void a_cloth_does_all_that_c_does() {
  MuslinGridDesc desc = muslin::grid_desc();
  desc.columns = desc.rows = 20;
  desc.material = muslin::material(MUSLIN_PRESET_SILK).value();
  muslin::Cloth cloth = muslin::Cloth::grid(desc).value();
  CHECK(cloth && cloth.handle().id != 0);
  MuslinSettings settings = cloth.settings().value();
  settings.iterations = 3;
  cloth.set_settings(settings).value();
  CHECK(cloth.settings().value().iterations == 3);
  cloth.set_material(cloth.material().value()).value();
  MuslinWind wind = muslin::wind();
  wind.velocity.z = 1.0f;
  cloth.set_wind(wind).value();
  MuslinColliderDesc floor = muslin::collider_desc();
  floor.position.y = -9.0f;
  const MuslinCollider collider = cloth.add_collider(floor).value();
  CHECK(cloth.advance(1.0f / 30.0f).value() == 2);
  cloth.step(20).value();
  posed(cloth);
  CHECK(cloth.collider_pose(collider).value().position.y == -9.0f);
  cloth.move_collider(collider, {0, -8, 0}, {0, 0, 0, 1}).value();
  CHECK(cloth.collider_impulse(collider).value().linear.y == 0.0f);
  cloth.teleport_collider(collider, {0, -9, 0}, {0, 0, 0, 1}).value();
  cloth.remove_collider(collider).value();
  CHECK(cloth.collider_impulse(collider).status() == MUSLIN_STATUS_BAD_HANDLE);

  const MuslinVec3 eye{0.5f, -0.5f, 5.0f}, ahead{0, 0, -1}, away{0, 0, 1};
  CHECK(cloth.raycast(eye, ahead, 50.0f).value().has_value());
  CHECK(!cloth.raycast(eye, away, 50.0f).value().has_value());
  const auto grab = cloth.grab_ray(eye, ahead, 0.1f).value();
  CHECK(grab.has_value());
  if (grab) {
    cloth.move_grab(*grab, {0.5f, -0.5f, 0.5f}).value();
    cloth.step().value();
    cloth.release(*grab).value();
  }
  CHECK(cloth.release(cloth.grab_particle(77).value()));
  cloth.pin(399).value();
  cloth.pin(380, {0, -1, 0}).value();
  const std::uint32_t pins[] = {380};
  const float targets[] = {0, -1, 0.1f};
  cloth.set_pin_targets(pins, targets, 0, 1).value();
  cloth.unpin(399).value();
  worn(cloth);
  cloth.set_position(200, {0, -0.5f, 0.1f}).value();
  cloth.set_velocity(200, {0, 0, 0}).value();

  const std::uint32_t seen = cloth.view().value().topology_revision;
  CHECK(cloth.tear_edge(210, 230).value());
  CHECK(!cloth.tear_edge(0, 1).value());
  CHECK(cloth.cut({-1, -0.7f, -9}, {3, -0.7f, -9}, {0, 0, 18}).value() > 5);
  CHECK(cloth.changes(seen).value().index_count > 0);
  int torn = 0;
  for (auto event = cloth.next_event().value(); event; event = cloth.next_event().value()) {
    torn += event->kind == MUSLIN_EVENT_EDGE_TORN;
  }
  CHECK(torn > 5);

  const MuslinView view = cloth.view().value();
  std::vector<float> positions(3 * view.vertex_count);
  std::vector<std::uint16_t> indices(view.index_count);
  const MuslinStream streams[] = {muslin_stream(MUSLIN_ATTRIBUTE_POSITION, MUSLIN_FORMAT_F32,
                                                positions.data(), 0, 4 * positions.size())};
  cloth.write_vertices(streams, muslin::write_desc()).value();
  CHECK(std::memcmp(positions.data(), view.positions, 4 * positions.size()) == 0);
  cloth.write_indices(indices.data(), 2 * indices.size(), 16).value();
  CHECK(indices.back() == view.indices[view.index_count - 1]);
  CHECK(cloth.stats().value().particles == view.vertex_count);
  CHECK(cloth.origin().value().x == 0.0f);

  const std::vector<unsigned char> saved = cloth.save().value();
  muslin::Cloth same = muslin::Cloth::restore(saved.data(), saved.size()).value();
  CHECK(same.state_hash().value() == cloth.state_hash().value());
  muslin::Cloth twins[] = {same.duplicate().value(), cloth.duplicate().value()};
  std::uint32_t ticks[] = {7, 7};
  muslin::Cloth::advance_many(twins, 2, 0.04f, ticks).value();
  CHECK(ticks[0] == 2 && ticks[1] == 2);
  CHECK(twins[0].state_hash().value() == twins[1].state_hash().value());
  CHECK(twins[0].state_hash().value() != cloth.state_hash().value());
  twins[1] = muslin::Cloth();
  CHECK(muslin::Cloth::advance_many(twins, 2, 0.04f).status() == MUSLIN_STATUS_BAD_HANDLE);
  CHECK(cloth.mesh_warnings().value().empty());
  cloth.crease({0, -2, 0}, {1, 2, 0}, 0.5f).value();
  CHECK(same.state_hash().value() != cloth.state_hash().value());
  CHECK(cloth.crease({0, 0, 0}, {0, 0, 0}, 0.5f).status() == MUSLIN_STATUS_BAD_VALUE);
  const std::uint32_t pairs[] = {0, 19, 20, 39}, twice[] = {7, 7};
  cloth.sew(pairs, 2, muslin::sew_desc()).value();
  CHECK(cloth.sew(twice, 1, muslin::sew_desc()).status() == MUSLIN_STATUS_BAD_VALUE);
  const MuslinCollider layer = cloth.collide_with(same).value();
  CHECK(cloth.collide_with(same, layer).value().id == layer.id);
  CHECK(cloth.collide_with(cloth).status() == MUSLIN_STATUS_BAD_VALUE);
  cloth.unpin_all().value();
  cloth.reset().value();
  CHECK(cloth.stats().value().particles == 400);
}

void a_skin_goes_with_its_owner_or_its_cloth() {
  muslin::Cloth cloth = muslin::Cloth::grid(muslin::grid_desc()).value();
  const MuslinView coarse = cloth.view().value();
  MuslinSkinDesc desc = muslin::skin_desc();
  desc.positions = coarse.positions;
  desc.vertex_count = coarse.vertex_count;
  desc.indices = coarse.indices;
  desc.index_count = coarse.index_count;
  MuslinSkin handle{};
  {
    muslin::Skin first = cloth.skin(desc).value();
    handle = first.handle();
    muslin::Skin second = std::move(first);
    CHECK(!first && second && first.view().status() == MUSLIN_STATUS_BAD_HANDLE);
    cloth.step(3).value();
    const MuslinView view = second.view().value();
    CHECK(std::memcmp(view.positions, cloth.view().value().positions, 12 * view.vertex_count) == 0);
    std::vector<float> written(3 * view.vertex_count);
    const MuslinStream streams[] = {muslin_stream(MUSLIN_ATTRIBUTE_POSITION, MUSLIN_FORMAT_F32,
                                                  written.data(), 0, 4 * written.size())};
    second.write_vertices(streams, muslin::write_desc()).value();
    CHECK(std::memcmp(written.data(), view.positions, 4 * written.size()) == 0);
  }
  MuslinView view;
  muslin_view_init(&view);
  CHECK(muslin_skin_view(handle, &view) == MUSLIN_STATUS_BAD_HANDLE);
  muslin::Skin late = cloth.skin(desc).value();
  cloth = muslin::Cloth();
  CHECK(late.view().status() == MUSLIN_STATUS_BAD_HANDLE);
}

void a_cloth_goes_with_its_owner() {
  MuslinCloth handle{};
  {
    muslin::Cloth first = muslin::Cloth::grid(muslin::grid_desc()).value();
    handle = first.handle();
    muslin::Cloth second = std::move(first);
    CHECK(!first && second.handle().id == handle.id);
    CHECK(first.step().status() == MUSLIN_STATUS_BAD_HANDLE);
    first = std::move(second);
    CHECK(first.step());
  }
  CHECK(muslin_cloth_step(handle, 1) == MUSLIN_STATUS_BAD_HANDLE);
  muslin::Cloth given = muslin::Cloth::grid(muslin::grid_desc()).value();
  CHECK(muslin_cloth_destroy(given.release_handle()) == MUSLIN_STATUS_OK && !given);
}

void refusals_say_why() {
  MuslinGridDesc desc = muslin::grid_desc();
  desc.spacing = -1.0f;
  const auto refused = muslin::Cloth::grid(desc);
  CHECK(!refused && refused.status() == MUSLIN_STATUS_BAD_VALUE);
  CHECK(std::strstr(refused.why(), "`spacing`") != nullptr);
#ifndef MUSLIN_NO_EXCEPTIONS
  bool is_caught = false;
  try {
    muslin::Cloth::grid(desc).value();
  } catch (const muslin::Error &error) {
    is_caught = error.status() == MUSLIN_STATUS_BAD_VALUE && std::strstr(error.what(), "`spacing`") != nullptr;
  }
  CHECK(is_caught);
#endif
}

}  // namespace

int main() {
  a_cloth_does_all_that_c_does();
  a_skin_goes_with_its_owner_or_its_cloth();
  a_cloth_goes_with_its_owner();
  refusals_say_why();
  std::printf("%s the wrapper does all that C does\n", failures == 0 ? "  ok" : "FAIL");
  return failures != 0;
}
