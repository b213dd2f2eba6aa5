// SPDX-License-Identifier: Apache-2.0
#include <bit>
#include <cstdio>
#include <fstream>
#include <sys/resource.h>

#include "controller/daemon/bench/bench.h"
#include "controller/daemon/bench/stopwatch.h"
#include "controller/twin/scene.h"

namespace chiaro::daemon::bench {
namespace {

constexpr std::size_t kManyTriangles = 1'100'000;

double seconds_now(const ports::World& world) {
  return std::chrono::duration<double>(world.clock.now().time_since_epoch()).count();
}

design::Options options_for(const Plan& plan, ports::World& world) {
  design::Options options;
  options.full_size = plan.size;
  if (plan.quick) options.trials = 60;
  options.stop = &world.stop;
  options.seconds = [&world] { return seconds_now(world); };
  return options;
}

/// Each triangle in four, its new corners on the middles of its edges (not shared: the loader welds
/// what coincides), until there are enough.
std::vector<float> divided(std::vector<float> corners, std::size_t triangles) {
  while (corners.size() / 9 < triangles) {
    std::vector<float> finer;
    finer.reserve(corners.size() * 4);
    for (std::size_t t = 0; t < corners.size(); t += 9) {
      float p[6][3];
      for (std::size_t k = 0; k < 3; ++k)
        for (std::size_t c = 0; c < 3; ++c) {
          p[k][c] = corners[t + 3 * k + c];
          p[3 + k][c] = (corners[t + 3 * k + c] + corners[t + 3 * ((k + 1) % 3) + c]) / 2;
        }
      for (const auto& f : {std::array{0, 3, 5}, {3, 1, 4}, {5, 4, 2}, {3, 4, 5}})
        for (const int corner : f) finer.insert(finer.end(), p[corner], p[corner] + 3);
    }
    corners = std::move(finer);
  }
  return corners;
}

std::vector<float> corners_of(const twin::Mesh& mesh) {
  std::vector<float> corners;
  corners.reserve(mesh.indices.size() * 3);
  for (const std::uint32_t i : mesh.indices)
    corners.insert(corners.end(), mesh.positions.begin() + 3 * std::ptrdiff_t{i},
                   mesh.positions.begin() + 3 * std::ptrdiff_t{i} + 3);
  return corners;
}

/// Binary PLY, the format that a scanner delivers.
void write_ply(const std::filesystem::path& file, const std::vector<float>& corners) {
  static_assert(std::endian::native == std::endian::little);
  std::ofstream out(file, std::ios::binary);
  const std::size_t triangles = corners.size() / 9;
  out << "ply\nformat binary_little_endian 1.0\nelement vertex " << triangles * 3
      << "\nproperty float x\nproperty float y\nproperty float z\nelement face " << triangles
      << "\nproperty list uchar int vertex_indices\nend_header\n";
  out.write(reinterpret_cast<const char*>(corners.data()),
            static_cast<std::streamsize>(corners.size() * sizeof(float)));
  for (std::size_t t = 0; t < triangles; ++t) {
    const char three = 3;
    const auto first = static_cast<std::int32_t>(3 * t);
    const std::int32_t corner[3] = {first, first + 1, first + 2};
    out.write(&three, 1);
    out.write(reinterpret_cast<const char*>(corner), sizeof corner);
  }
}

/// The studio with its subject's surface cut into more than a million triangles.
core::Result<studio::Studio> with_many_triangles(const Plan& plan,
                                                 const std::filesystem::path& folder) {
  const auto geometry = twin::build_geometry(plan.studio, {});
  if (!geometry) return geometry.problems();
  std::filesystem::create_directories(folder);
  for (const twin::Mesh& mesh : (*geometry)->meshes) {
    if (!mesh.subject) continue;
    const auto file = folder / "million.ply";
    write_ply(file, divided(corners_of(mesh), kManyTriangles));
    studio::Studio studio = plan.studio;
    studio.subjects.resize(1);
    studio.subjects.front().mesh = file;
    studio.subjects.front().stand_in = false;
    studio.subjects.front().facing = 0;
    studio.subjects.front().up = studio::UpAxis::z;
    studio.subjects.front().front = core::Vec3{0, -1, 0};
    return studio;
  }
  return core::Problem{{plan.studio.file.string()}, "the studio has no subject", "add one"};
}

struct Cold {
  double seconds = 0, twin_s = 0, processor_s = 0;
  std::uint64_t trials = 0;
};

core::Result<Cold> cold_design(const Plan& plan, const studio::Studio& studio,
                               const std::filesystem::path& meshes, ports::World& world) {
  const Stopwatch watch(world.clock);
  const double processor = processor_seconds();
  const auto twin = design::geometric_layers(studio, {.mesh_cache = meshes});
  if (!twin) return twin.problems();
  Cold out;
  out.twin_s = watch.seconds();
  const auto look = design::design(studio, **twin, plan.mood, options_for(plan, world));
  if (!look) return look.problems();
  out.seconds = watch.seconds();
  out.processor_s = processor_seconds() - processor;
  out.trials = look->trials;
  return out;
}

core::Result<core::Done> with_a_million(const Plan& plan, const std::filesystem::path& folder,
                                        ports::World& world, Report& report) {
  const auto studio = with_many_triangles(plan, folder);
  if (!studio) return studio.problems();
  const Stopwatch first(world.clock);
  const auto imported = twin::build_geometry(*studio, folder / "meshes");
  if (!imported) return imported.problems();
  report.add("first import, 1.1 M triangles, binary PLY", first.seconds(), "s", at_most(1.5));
  const auto many = cold_design(plan, *studio, folder / "meshes", world);
  if (!many) return many.problems();
  report.add("cold design, 1.1 M triangles", many->seconds, "s", at_most(1.5),
             "twin " + std::to_string(static_cast<int>(many->twin_s * 1000)) + " ms, " +
                 in_processor_time(many->processor_s));
  return core::Done{};
}

/// Each time from a view that has seen another mood, never this one.
core::Result<Cold> warm_design(const Plan& plan, const std::filesystem::path& meshes,
                               const design::Options& options, ports::World& world) {
  std::vector<double> times, processor;
  for (int round = 0; round < (plan.quick ? 1 : 3) && !world.stop; ++round) {
    const auto twin = design::geometric_layers(plan.studio, {.mesh_cache = meshes});
    if (!twin) return twin.problems();
    if (const auto look = design::design(plan.studio, **twin, plan.mood, options); !look)
      return look.problems();
    const Stopwatch watch(world.clock);
    const double before = processor_seconds();
    if (const auto look = design::design(plan.studio, **twin, plan.other_mood, options); !look)
      return look.problems();
    times.push_back(watch.seconds());
    processor.push_back(processor_seconds() - before);
  }
  Cold out;
  out.seconds = median(std::move(times));
  out.processor_s = median(std::move(processor));
  return out;
}

}  // namespace

double peak_megabytes() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_maxrss) / 1024;
}

double processor_seconds() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  const auto seconds = [](const timeval& t) {
    return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec);
  };
  return seconds(usage.ru_utime) + seconds(usage.ru_stime);
}

std::string in_processor_time(double seconds) {
  char text[48];
  std::snprintf(text, sizeof text,
                seconds < 1 ? "%.0f ms of processor time" : "%.2f s of processor time",
                seconds < 1 ? 1000 * seconds : seconds);
  return text;
}

core::Result<core::Done> designs(const Plan& plan, ports::World& world, Report& report) {
  report.heading("Whole designs, two threads");
  const auto meshes = world.state_folder / "meshes";
  const auto primed = twin::build_geometry(plan.studio, meshes);  // prepares the mesh
  if (!primed) return primed.problems();
  const auto cold = cold_design(plan, plan.studio, meshes, world);
  if (!cold) return cold.problems();
  report.add("cold design, the studio's own subject", cold->seconds, "s", at_most(1.5),
             std::to_string(cold->trials) + " trials, twin " +
                 std::to_string(static_cast<int>(cold->twin_s * 1000)) + " ms, " +
                 in_processor_time(cold->processor_s));

  const auto twin = design::geometric_layers(plan.studio, {.mesh_cache = meshes});
  if (!twin) return twin.problems();
  const design::Options options = options_for(plan, world);
  if (const auto look = design::design(plan.studio, **twin, plan.mood, options); !look)
    return look.problems();
  const auto warm = warm_design(plan, meshes, options, world);
  if (!warm) return warm.problems();
  report.add("warm design, same view, new mood", warm->seconds * 1000, "ms", at_most(100),
             in_processor_time(warm->processor_s));
  const auto again = median_s(world.clock, plan.quick ? 1 : 3, [&] {
    (void)design::design(plan.studio, **twin, plan.mood, options);
  });
  report.add("warm design, a mood asked before", again * 1000, "ms");
  design::Options levels_only = options;
  levels_only.move_stands = false;
  const auto placed = median_s(world.clock, plan.quick ? 1 : 3, [&] {
    (void)design::design(plan.studio, **twin, plan.other_mood, levels_only);
  });
  report.add("warm design, stands left alone", placed * 1000, "ms");
  report.add("peak memory so far", peak_megabytes(), "MB", at_most(1024));
  if (plan.quick) return core::Done{};

  const auto folder = world.state_folder / "bench";
  auto many = with_a_million(plan, folder, world, report);
  std::error_code ignored;
  std::filesystem::remove_all(folder, ignored);
  report.add("peak memory, 1.1 M triangles", peak_megabytes(), "MB", at_most(1024));
  return many;
}

}  // namespace chiaro::daemon::bench
