// SPDX-License-Identifier: Apache-2.0
// How times and memory grow. Each table changes one thing.
#include <cmath>
#include <fstream>

#include "controller/daemon/bench/bench.h"
#include "controller/daemon/bench/stopwatch.h"
#include "controller/design/geometric_layers.h"
#include "controller/design/stages.h"
#include "controller/optimise/search.h"
#include "controller/render/view.h"

namespace chiaro::daemon::bench {
namespace {

/// Triangles of a ball cut into `rings` by twice as many sectors, its poles left open.
std::size_t triangles_of(std::size_t rings) { return 2 * rings * 2 * rings; }

void put(std::ofstream& out, const auto& value) {
  out.write(reinterpret_cast<const char*>(&value), sizeof value);
}

/// Bumps make every part of it shade another.
void write_ball(const std::filesystem::path& file, std::size_t rings) {
  const std::size_t sectors = 2 * rings;
  std::ofstream out(file, std::ios::binary);
  out << "ply\nformat binary_little_endian 1.0\nelement vertex " << (rings + 1) * sectors
      << "\nproperty float x\nproperty float y\nproperty float z\nelement face "
      << triangles_of(rings) << "\nproperty list uchar int vertex_indices\nend_header\n";
  for (std::size_t r = 0; r <= rings; ++r)
    for (std::size_t s = 0; s < sectors; ++s) {
      const double up =
          core::kPi * (0.02 + 0.96 * static_cast<double>(r) / static_cast<double>(rings));
      const double round = 2 * core::kPi * static_cast<double>(s) / static_cast<double>(sectors);
      const double size = 0.3 * (1 + 0.08 * std::sin(7 * up) * std::cos(6 * round));
      put(out, static_cast<float>(size * std::sin(up) * std::cos(round)));
      put(out, static_cast<float>(size * std::sin(up) * std::sin(round)));
      put(out, static_cast<float>(-size * std::cos(up)));
    }
  for (std::size_t r = 0; r < rings; ++r)
    for (std::size_t s = 0; s < sectors; ++s) {
      const auto a = static_cast<std::int32_t>(r * sectors + s);
      const auto b = static_cast<std::int32_t>(r * sectors + (s + 1) % sectors);
      const auto row = static_cast<std::int32_t>(sectors);
      for (const auto& t : {std::array{a, b, b + row}, {a, b + row, a + row}}) {
        put(out, static_cast<char>(3));
        for (const std::int32_t corner : t) put(out, corner);
      }
    }
}

studio::Studio with_lamps(studio::Studio studio, std::size_t count) {
  const auto movable =
      std::find_if(studio.fixtures.begin(), studio.fixtures.end(),
                   [](const studio::Fixture& f) { return design::region_of(f) != nullptr; });
  if (movable == studio.fixtures.end()) return studio;
  const studio::Fixture lamp = *movable;
  studio.fixtures.clear();
  for (std::size_t k = 0; k < count; ++k) {
    studio.fixtures.push_back(lamp);
    studio.fixtures.back().name = "lamp " + std::to_string(k + 1);
  }
  return studio;
}

/// Lamps spread over their region, so that no two columns of the level solve are alike.
studio::Rig spread_rig(const studio::Studio& studio) {
  studio::Rig rig = studio::placed_rig(studio);
  for (std::size_t k = 0; k < rig.states.size(); ++k) {
    const studio::Region* region = design::region_of(studio.fixtures[k]);
    if (region == nullptr) continue;
    const auto at = optimise::spread_point(k, 2, 1);
    const auto within = [](core::Range r, double share) { return r.least + share * r.width(); };
    rig.states[k].set(core::Dof::azimuth, within(region->azimuth, at[0]));
    rig.states[k].set(core::Dof::elevation, within(region->elevation, at[1]));
    rig.states[k].set(core::Dof::intensity, 1);
  }
  return rig;
}

core::Result<core::Done> by_triangles(const Plan& plan, ports::World& world, Report& report) {
  report.heading("Against triangles: tree and view, then one layer traced, two threads");
  const auto folder = world.state_folder / "bench";
  for (const std::size_t triangles : {604u, 10'000u, 70'000u, 400'000u, 1'100'000u}) {
    if (world.stop || (plan.quick && triangles > 10'000)) break;
    const studio::Studio studio = with_points(with_subject_of(plan.studio, triangles, folder));
    const auto meshes = folder / "meshes";
    if (const auto primed = twin::build_geometry(studio, meshes); !primed) return primed.problems();
    const Stopwatch watch(world.clock);
    const auto twin = design::geometric_layers(studio, {.mesh_cache = meshes});
    if (!twin) return twin.problems();
    const design::Layers& layers = (*twin)->at(plan.size);
    const double built = watch.seconds() * 1000;
    core::Plane out(plan.size);
    const Stopwatch traced(world.clock);
    layers.luminance(0, {}, design::Accuracy::exact, out);
    report.add(std::to_string(triangles) + " triangles", built, "ms", {},
               "layer " + std::to_string(traced.seconds() * 1000).substr(0, 4) + " ms, peak " +
                   std::to_string(static_cast<int>(peak_megabytes())) + " MB");
  }
  std::error_code ignored;
  std::filesystem::remove_all(folder, ignored);
  return core::Done{};
}

core::Result<core::Done> by_pixels(const Plan& plan, ports::World& world, Report& report) {
  report.heading("Against pixels: a point lamp's cached layer and all six components, one core");
  const studio::Studio studio = with_points(plan.studio);
  const auto twin =
      design::geometric_layers(studio, {.mesh_cache = world.state_folder / "meshes", .threads = 1});
  if (!twin) return twin.problems();
  for (const core::Size size :
       {core::Size{64, 64}, {128, 128}, {256, 256}, {512, 512}, {1280, 720}, {1920, 1080}}) {
    if (world.stop || (plan.quick && size.width > 128)) break;
    const design::Layers& layers = (*twin)->at(size);
    const measure::PixelMap map = measure::pixel_map(*layers.geometry());
    core::Plane out(size), seen(size);
    const core::FixtureState state;
    const double us = best_us(world.clock, 3, plan.quick ? 1 : 5, [&] {
      layers.luminance_and_visibility(0, state, design::Accuracy::cached, out, seen);
      (void)measure::components_of_luminance(out, map, &seen);
    });
    report.add(std::to_string(size.width) + " x " + std::to_string(size.height), us, "us", {},
               std::to_string(us * 1e3 / static_cast<double>(size.pixels())).substr(0, 4) +
                   " ns a pixel, peak " + std::to_string(static_cast<int>(peak_megabytes())) +
                   " MB");
  }
  return core::Done{};
}

core::Result<core::Done> by_lamps(const Plan& plan, ports::World& world, Report& report) {
  report.heading("Against lamps: levels solved, wavelet in L*, layers known, one core");
  for (const std::size_t lamps : {1u, 2u, 4u, 8u, 16u, 20u, 32u}) {
    if (world.stop || (plan.quick && lamps > 2)) break;
    const studio::Studio studio = with_points(with_lamps(plan.studio, lamps));
    const auto twin = design::geometric_layers(
        studio, {.mesh_cache = world.state_folder / "meshes", .threads = 1});
    if (!twin) return twin.problems();
    const design::Layers& layers = (*twin)->at(plan.size);
    const design::Goal goal = plan.mood;
    const design::Target target = design::target_of(goal, plan.size);
    const measure::PixelMap map = design::map_for(layers, target);
    const design::Variables all = design::variables_of(studio, design::Options{});
    const design::Setting setting{studio, layers, all, target, map, design::Accuracy::cached};
    design::Workspace workspace(setting);
    const design::Columns& columns = workspace.columns(spread_rig(studio));
    const double us = best_us(world.clock, 3, plan.quick ? 1 : 3, [&] {
      (void)workspace.solver().solve(columns, design::Effort::quick);
    });
    report.add(std::to_string(lamps) + " lamps", us, "us", lamps <= 20 ? at_most(2000) : Bar{});
  }
  return core::Done{};
}

core::Result<core::Done> by_threads(const Plan& plan, ports::World& world, Report& report) {
  report.heading("Against threads: a cold design");
  for (const int threads : {1, 2}) {
    if (world.stop) break;
    const Stopwatch watch(world.clock);
    const auto twin = design::geometric_layers(
        plan.studio, {.mesh_cache = world.state_folder / "meshes", .threads = threads});
    if (!twin) return twin.problems();
    design::Options options;
    options.threads = threads;
    options.full_size = plan.size;
    options.stop = &world.stop;
    if (plan.quick) options.trials = 40;
    if (const auto look = design::design(plan.studio, **twin, plan.mood, options); !look)
      return look.problems();
    report.add(std::to_string(threads) + (threads == 1 ? " thread" : " threads"), watch.seconds(),
               "s");
  }
  return core::Done{};
}

}  // namespace

studio::Studio with_subject_of(const studio::Studio& studio, std::size_t triangles,
                               const std::filesystem::path& folder) {
  std::filesystem::create_directories(folder);
  std::size_t rings = 4;
  while (triangles_of(rings) < triangles) ++rings;
  studio::Studio out = studio;
  const auto file = folder / ("ball" + std::to_string(triangles) + ".ply");
  write_ball(file, rings);
  out.subjects.resize(1);
  studio::Subject& subject = out.subjects.front();
  subject.mesh = file;
  subject.stand_in = false;
  subject.up = studio::UpAxis::z;
  subject.front = core::Vec3{0, -1, 0};
  return out;
}

studio::Studio with_points(studio::Studio studio) {
  for (studio::Fixture& fixture : studio.fixtures) {
    fixture.modifiers.clear();
    fixture.profile.optic = {};
  }
  return studio;
}

core::Result<core::Done> scaling(const Plan& plan, ports::World& world, Report& report) {
  for (const auto table : {by_triangles, by_pixels, by_lamps, by_threads})
    if (auto done = table(plan, world, report); !done) return done;
  return core::Done{};
}

}  // namespace chiaro::daemon::bench
