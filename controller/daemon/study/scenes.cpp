// SPDX-License-Identifier: Apache-2.0
#include "controller/daemon/study/scenes.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <functional>

#include "controller/daemon/study/shapes.h"
#include "controller/design/geometric_layers.h"
#include "controller/studio/load.h"
#include "simulator/bust/bust_mesh.h"
#include "simulator/path_tracer/path_tracer.h"
#include "simulator/virtual_studio/noise.h"

namespace chiaro::daemon::study {
namespace {

namespace fs = std::filesystem;
using core::Vec3;

constexpr std::array<std::string_view, 3> kNames{"bust", "still life", "vase"};

/// One body of a scene: a mesh file, where it stands, what it is made of.
struct Body {
  std::string name, file, at, height, diffuse, specular;
  simulator::TriangleMesh (*make)();
};

const std::vector<Body>& bodies_of(std::string_view name) {
  static const std::vector<Body> kBust{{"sitter", "subjects/bust.ply", "[0, 0, 1.05]", "0.62 m",
                                        "[0.62, 0.48, 0.40]", "0.12", nullptr}};
  static const std::vector<Body> kStill{
      {"box", "box.ply", "[-0.13, 0.02, 1.32]", "0.20 m", "[0.55, 0.35, 0.25]", "0.02",
       [] {
         return box({0.14, 0.14, 0.20});
       }},
      {"ball", "ball.ply", "[0.03, -0.09, 1.32]", "0.15 m", "[0.60, 0.58, 0.52]", "0.20",
       [] { return ball(0.075); }},
      {"ring", "ring.ply", "[0.14, 0.06, 1.32]", "0.07 m", "[0.30, 0.42, 0.55]", "0.10",
       [] { return ring(0.075, 0.035); }}};
  static const std::vector<Body> kVase{
      {"vase", "vase.ply", "[-0.09, 0, 1.30]", "0.34 m", "[0.50, 0.52, 0.56]", "0.15",
       [] { return vase(0.34); }},
      {"knot", "knot.ply", "[0.13, -0.04, 1.30]", "0.20 m", "[0.60, 0.44, 0.30]", "0.06",
       [] { return knot(0.08, 0.022); }}};
  return name == kNames[0] ? kBust : name == kNames[1] ? kStill : kVase;
}

/// Written beside and then renamed, so that nobody reads half a mesh.
core::Result<core::Done> write_mesh(const fs::path& file, const simulator::TriangleMesh& mesh) {
  if (fs::exists(file)) return core::Done{};
  std::error_code failed;
  fs::create_directories(file.parent_path(), failed);
  const fs::path half = file.string() + ".half";
  if (auto written = simulator::write_ply(half, mesh); !written) return written;
  fs::rename(half, file, failed);
  return core::Done{};
}

std::string subject_text(const Body& body, const fs::path& meshes) {
  const std::string file = body.make != nullptr ? (meshes / body.file).string() : body.file;
  return "  " + body.name + ": {mesh: \"" + file + "\", up: z, at: " + body.at +
         ", height: " + body.height + ", material: {diffuse: " + body.diffuse +
         ", specular: " + body.specular + ", shininess: 24}}\n";
}

std::string lamp_text(int k, double candela) {
  static constexpr const char* kRoles[] = {"key", "fill", "kicker"};
  const std::string role = kRoles[std::min(k, 2)];
  const int azimuth = k == 0 ? -45 : k == 1 ? 40 : 10 * k - 30;
  return "  lamp" + std::to_string(k + 1) + ": {role: " + role +
         ", profile: generic/daylight-dimmer, mode: 1ch, output: " +
         std::to_string(static_cast<int>(candela)) +
         " cd, mount: {stand: {at: {azimuth: " + std::to_string(azimuth) +
         " deg, elevation: " + std::to_string(k == 1 ? 15 : 35) +
         " deg, distance: 1.8 m}, azimuth: [-85 deg, 85 deg], elevation: [0 deg, 75 deg], "
         "distance: [1.2 m, 2.4 m]}}, patch: {universe: 1, address: " +
         std::to_string(k + 1) + "}}\n";
}

std::string scene_text(std::string_view name, const Lamps& lamps, const fs::path& meshes) {
  std::string text = "studio: " + std::string(name) + "\nsubjects:\n";
  for (const Body& body : bodies_of(name)) text += subject_text(body, meshes);
  text +=
      "background:\n"
      "  - {plane: wall, through: [0, 2.0, 0], normal: [0, -1, 0], size: [6, 4], diffuse: 0.35}\n"
      "  - {plane: floor, through: [0, 0, 0], normal: [0, 0, 1], size: [8, 8], diffuse: 0.3}\n";
  if (name == kNames[1])
    text +=
        "  - {plane: table, through: [0, 0.1, 1.32], normal: [0, 0, 1], size: [0.9, 0.7], "
        "diffuse: [0.42, 0.34, 0.28]}\n";
  const bool bust = name == kNames[0];
  text += std::string("cameras:\n  main: {at: [0, -2.6, ") + (bust ? "1.5" : "1.75") +
          "], look_at: [0, 0, " + (bust ? "1.49" : "1.43") +
          "], vertical_fov: " + (bust ? "13" : "10") + " deg, size: [512, 512]}\nfixtures:\n";
  for (int k = 0; k < lamps.count; ++k) text += lamp_text(k, lamps.candela);
  return text +
         "outputs:\n  universe 1: mock\n"
         "exposure: {grey_card: 800 lx, white_balance: 5600 K}\n";
}

/// A smooth field of small vectors: a few waves of random direction, 3 to 12 cm long.
std::function<Vec3(Vec3)> waves(core::Random& random) {
  struct Wave {
    Vec3 k, a;
    double phase;
  };
  const auto direction = [&random] {
    return core::unit(Vec3{random.normal(), random.normal(), random.normal()});
  };
  std::vector<Wave> all;
  for (int i = 0; i < 12; ++i) {
    const double length = random.uniform(0.03, 0.12);
    all.push_back(
        {(2 * core::kPi / length) * direction(), direction(), random.uniform(0, 2 * core::kPi)});
  }
  return [all](Vec3 p) {
    Vec3 sum;
    for (const Wave& w : all) sum = sum + std::sin(core::dot(w.k, p) + w.phase) * w.a;
    return sum;
  };
}

/// Tilts the normals by the field, scaled to the root mean square angle over the mesh.
void tilt_normals(twin::Mesh& mesh, double rms_angle, core::Random& random) {
  const auto field = waves(random);
  const std::size_t n = mesh.normals.size() / 3;
  std::vector<Vec3> tilts(n);
  double sum = 0;
  for (std::size_t i = 0; i < n; ++i) {
    const float *p = &mesh.positions[3 * i], *m = &mesh.normals[3 * i];
    const Vec3 normal{double{m[0]}, double{m[1]}, double{m[2]}};
    const Vec3 push = field({double{p[0]}, double{p[1]}, double{p[2]}});
    tilts[i] = push - core::dot(push, normal) * normal;
    sum += core::dot(tilts[i], tilts[i]);
  }
  const double scale = sum > 0 ? rms_angle / std::sqrt(sum / static_cast<double>(n)) : 0;
  for (std::size_t i = 0; i < n; ++i) {
    float* m = &mesh.normals[3 * i];
    const Vec3 tilted =
        core::unit(Vec3{double{m[0]}, double{m[1]}, double{m[2]}} + scale * tilts[i]);
    m[0] = static_cast<float>(tilted.x);
    m[1] = static_cast<float>(tilted.y);
    m[2] = static_cast<float>(tilted.z);
  }
}

}  // namespace

std::span<const std::string_view> scene_names() { return kNames; }

core::Result<studio::Studio> scene(std::string_view name, const Lamps& lamps, ports::World& world) {
  const fs::path meshes = world.state_folder / "study";
  for (const Body& body : bodies_of(name))
    if (body.make != nullptr)
      if (auto written = write_mesh(meshes / body.file, body.make()); !written)
        return written.problems();
  auto loaded = studio::parse_studio(scene_text(name, lamps, meshes), world.config_folder,
                                     studio::Folders{world.config_folder});
  if (!loaded) return loaded.problems();
  for (studio::Fixture& fixture : loaded->studio.fixtures) fixture.profile.optic = lamps.optic;
  return std::move(loaded->studio);
}

Reality reality(const studio::Studio& studio, const Errors& errors, core::Random& random,
                ports::World& world) {
  // The studio was read and built before: only a broken disk can fail here, and value() says so.
  twin::Geometry geometry = *twin::build_geometry(studio, world.state_folder / "meshes").value();
  for (twin::SurfaceMaterial& material : geometry.materials)
    for (double* c : {&material.diffuse.r, &material.diffuse.g, &material.diffuse.b})
      *c = std::min(0.98, *c * (1 + random.uniform(-errors.albedo, errors.albedo)));
  if (errors.normals > 0)
    for (twin::Mesh& mesh : geometry.meshes)
      if (mesh.subject) tilt_normals(mesh, errors.normals, random);
  return {std::make_shared<const render::Tracer>(
              std::make_shared<const twin::Geometry>(std::move(geometry))),
          errors};
}

core::Picture photograph(const studio::Studio& studio, const Reality& real, const studio::Rig& rig,
                         const Shot& shot) {
  const auto geometry =
      std::shared_ptr<const twin::Geometry>(real.tracer, &real.tracer->geometry());
  simulator::TraceOptions options;
  options.samples = shot.samples;
  options.bounces = real.errors.bounces;
  options.seed = shot.seed;
  options.threads = shot.threads;
  const auto traced = simulator::trace(*real.tracer, twin::lit_by(studio, geometry, rig),
                                       studio.main_camera(), shot.size, options);
  simulator::Sensor sensor;
  sensor.on = real.errors.noise;
  return core::linear(simulator::exposed(traced.picture, sensor, shot.seed, 0));
}

core::Vec3 direction_of(const core::FixtureState& state) {
  return core::position({}, {state.get(core::Dof::azimuth), state.get(core::Dof::elevation), 1});
}

double lux_of(const studio::Fixture& fixture, const core::FixtureState& state) {
  const double distance = state.get(core::Dof::distance, 1);
  return fixture.fitted_output().value * state.get(core::Dof::intensity) / (distance * distance);
}

studio::Rig hidden_rig(const studio::Studio& studio, const twin::Geometry& geometry, double apart,
                       double most_stops, core::Random& random) {
  constexpr int kTries = 1000;
  studio::Rig rig = studio::placed_rig(studio);
  for (std::size_t i = 0; i < rig.states.size(); ++i) {
    const auto& region = std::get<studio::StandMount>(studio.fixtures[i].mount).region;
    core::FixtureState& state = rig.states[i];
    for (int t = 0; t < kTries; ++t) {
      state.set(core::Dof::azimuth, random.uniform(region.azimuth.least, region.azimuth.most));
      state.set(core::Dof::elevation,
                random.uniform(region.elevation.least, region.elevation.most));
      state.set(core::Dof::distance, random.uniform(region.distance.least, region.distance.most));
      bool good = twin::infeasible(studio, geometry, rig, i).empty();
      for (std::size_t j = 0; j < i; ++j)
        good =
            good && core::angle_between(direction_of(state), direction_of(rig.states[j])) > apart;
      if (good) break;
    }
    const double lux =
        random.uniform(500, 900) * std::exp2(-(i > 0 ? random.uniform(0, most_stops) : 0));
    state.set(core::Dof::intensity, 1);
    state.set(core::Dof::intensity, std::min(1.0, lux / lux_of(studio.fixtures[i], state)));
  }
  return rig;
}

core::Result<std::unique_ptr<design::LayersSource>> twin_of(const studio::Studio& studio,
                                                            ports::World& world, int threads,
                                                            bool bounced) {
  design::GeometricOptions options;
  options.mesh_cache = world.state_folder / "meshes";
  options.threads = threads;
  return bounced ? design::bounced_layers(studio, options)
                 : design::geometric_layers(studio, options);
}

design::Options plain_options(std::uint64_t seed, int threads, ports::World& world) {
  design::Options options;
  options.seed = seed;
  options.threads = threads;
  options.stop = &world.stop;
  options.seconds = [&world] {
    return std::chrono::duration<double>(world.clock.now().time_since_epoch()).count();
  };
  return options;
}

}  // namespace chiaro::daemon::study
