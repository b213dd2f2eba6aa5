// SPDX-License-Identifier: Apache-2.0
#include "controller/daemon/study/strangers.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "controller/design/words.h"
#include "controller/studio/load.h"
#include "simulator/path_tracer/path_tracer.h"
#include "simulator/virtual_studio/noise.h"

namespace chiaro::daemon::study {
namespace {

namespace fs = std::filesystem;
using core::Vec3;

struct Known {
  const char* file;
  std::optional<double> height;
  double turn;  ///< degrees, so that the face looks at the camera: some look aside
};
// Of sweethome3d-furniture: people in centimetres, Y up. Of inventor-data: faces scanned by
// Cyberware, in metres, made OBJ by tests/support/quad_mesh.awk.
const std::array<Known, 12> kKnown{{{"scopia/mannequinMale/mannequinMale.obj", 1.78, 0},
                                    {"scopia/mannequinBrunette/mannequinBrunette.obj", 1.70, 0},
                                    {"reallusion/male01/male01.obj", 1.78, 38},
                                    {"reallusion/male02/male02.obj", 1.78, 38},
                                    {"reallusion/male03/male03.obj", 1.78, 0},
                                    {"reallusion/female01/female01.obj", 1.68, -72},
                                    {"reallusion/female02/female02.obj", 1.68, 0},
                                    {"reallusion/female03/female03.obj", 1.68, 0},
                                    {"reallusion/girlStanding/girlStanding.obj", 1.40, 0},
                                    {"cyber/josie/josie.obj", {}, 0},
                                    {"cyber/paul/paul.obj", {}, 0},
                                    {"cyber/rikk/rikk.obj", {}, 0}}};

const std::array<Head, 4> kRelatives{{{"bust, wide", {}, {}, 0, {1.12, 1.0, 0.96}, -0.1},
                                      {"bust, narrow", {}, {}, 0, {0.9, 1.02, 1.04}, 0.12},
                                      {"bust, flat", {}, {}, 0, {1.05, 0.85, 1.0}, 0.0},
                                      {"bust, long", {}, {}, 0, {0.95, 1.1, 1.1}, 0.2}}};

/// The bust about its head's centre, stretched and tapered; its normals made anew.
void change(twin::Mesh& mesh, const Head& head, Vec3 centre) {
  const std::size_t vertices = mesh.normals.size() / 3;
  for (std::size_t i = 0; i < vertices; ++i) {
    float* p = &mesh.positions[3 * i];
    const double below = std::clamp((centre.z - double{p[2]}) / 0.12, 0.0, 1.0);
    const double across = head.stretch.x * (1 - head.taper * below);
    p[0] = static_cast<float>(centre.x + across * (double{p[0]} - centre.x));
    p[1] = static_cast<float>(centre.y + head.stretch.y * (double{p[1]} - centre.y));
    p[2] = static_cast<float>(centre.z + head.stretch.z * (double{p[2]} - centre.z));
  }
  std::fill(mesh.normals.begin(), mesh.normals.end(), 0.0f);
  const auto at = [&](std::uint32_t v) {
    const float* p = &mesh.positions[3 * std::size_t{v}];
    return Vec3{double{p[0]}, double{p[1]}, double{p[2]}};
  };
  for (std::size_t t = 0; t < mesh.triangles(); ++t) {
    const std::uint32_t* v = &mesh.indices[3 * t];
    const Vec3 face = core::cross(at(v[1]) - at(v[0]), at(v[2]) - at(v[0]));
    for (int k = 0; k < 3; ++k) {
      float* n = &mesh.normals[3 * std::size_t{v[k]}];
      n[0] += static_cast<float>(face.x);
      n[1] += static_cast<float>(face.y);
      n[2] += static_cast<float>(face.z);
    }
  }
  for (std::size_t i = 0; i < vertices; ++i) {
    float* n = &mesh.normals[3 * i];
    const Vec3 u = core::unit(Vec3{double{n[0]}, double{n[1]}, double{n[2]}});
    n[0] = static_cast<float>(u.x), n[1] = static_cast<float>(u.y), n[2] = static_cast<float>(u.z);
  }
}

using Geometry = core::Result<std::shared_ptr<const twin::Geometry>>;

/// The middle of a figure's head: what is in the upper 23 cm of it, a scanned face as a whole.
Vec3 head_centre(const twin::Geometry& geometry) {
  constexpr double kHead = 0.23;
  core::Box3 head;
  for (const twin::Mesh& mesh : geometry.meshes)
    for (std::size_t i = 0; mesh.subject && i < mesh.normals.size(); i += 3)
      if (double{mesh.positions[i + 2]} > geometry.subject_bounds.most.z - kHead)
        head.include({double{mesh.positions[i]}, double{mesh.positions[i + 1]},
                      double{mesh.positions[i + 2]}});
  return head.centre();
}

/// The studio with that head where our sitter's is.
Geometry geometry_with(studio::Studio& studio, const Head& head, ports::World& world) {
  const fs::path cache = world.state_folder / "meshes";
  auto ours = twin::build_geometry(studio, cache);
  if (!ours || head.mesh.empty()) return ours;
  const Vec3 aim = (*ours)->aim.origin;
  studio::Subject subject;
  subject.name = "subject";
  subject.mesh = head.mesh;
  subject.height = head.height;
  subject.facing = head.turn;
  studio.subjects = {subject};
  auto there = twin::build_geometry(studio, cache);
  if (!there) return there;
  studio.subjects.front().at = aim - head_centre(**there);
  studio.subjects.front().aim = aim;
  return twin::build_geometry(studio, cache);
}

void paint(twin::Geometry& geometry, const Sitting& sitting, Vec3 aim) {
  std::vector<bool> skin(geometry.materials.size(), false), wall = skin;
  for (twin::Mesh& mesh : geometry.meshes) {
    for (const std::uint16_t m : mesh.material) (mesh.subject ? skin : wall)[m] = true;
    if (mesh.subject && sitting.head.mesh.empty()) change(mesh, sitting.head, aim);
  }
  for (std::size_t m = 0; m < geometry.materials.size(); ++m) {
    core::Rgb& diffuse = geometry.materials[m].diffuse;
    if (skin[m])
      diffuse = sitting.skin * diffuse;
    else if (wall[m])
      diffuse = sitting.wall;
  }
}

void frame(studio::Camera& camera, const Sitting& sitting) {
  const Vec3 forward = core::unit(camera.look_at - camera.at);
  const Vec3 right = core::unit(core::cross(forward, {0, 0, 1})), up = core::cross(right, forward);
  const double half = std::tan(camera.vertical_fov / 2) / sitting.scale;
  const double side = 2 * half * core::distance(camera.at, camera.look_at);
  camera.vertical_fov = 2 * std::atan(half);
  camera.look_at =
      camera.look_at + (sitting.shift_x * side) * right + (sitting.shift_y * side) * up;
}

void put(studio::Rig& rig, const studio::Studio& studio, const char* name, double azimuth,
         double elevation, double distance, double lux) {
  const std::size_t i = *studio.fixture_index(name);
  core::FixtureState& state = rig.states[i];
  state.set(core::Dof::azimuth, core::radians(azimuth));
  state.set(core::Dof::elevation, core::radians(elevation));
  state.set(core::Dof::distance, distance);
  state.set(core::Dof::intensity, 1);
  state.set(core::Dof::intensity, std::min(1.0, lux / design::lux_at_face(studio, rig, i)));
}

core::Picture flipped(const core::Picture& picture) {
  core::Picture out(picture.size());
  const int last = picture.size().width - 1;
  for (int y = 0; y < picture.size().height; ++y)
    for (int x = 0; x <= last; ++x) out.set(last - x, y, picture.at(x, y));
  return out;
}

}  // namespace

std::vector<Head> heads_in(const fs::path& assets) {
  std::vector<Head> heads;
  std::error_code error;
  for (const Known& known : kKnown)
    if (!assets.empty() && fs::exists(assets / known.file, error))
      heads.push_back({fs::path(known.file).stem().string(), assets / known.file, known.height,
                       core::radians(known.turn)});
  if (heads.empty()) heads.assign(kRelatives.begin(), kRelatives.end());
  return heads;
}

Sitting sitting(const studio::Studio& studio, Head head, core::Random& random) {
  Sitting out;
  out.head = std::move(head);
  out.rig = studio::placed_rig(studio);
  const double side = random.uniform() < 0.5 ? -1 : 1;
  const double key = 800 * std::exp2(random.uniform(-0.5, 0.5));
  put(out.rig, studio, "key", side * random.uniform(15, 70), random.uniform(5, 55),
      random.uniform(1.4, 2.2), key);
  put(out.rig, studio, "fill", -side * random.uniform(-10, 55), random.uniform(0, 25),
      random.uniform(1.6, 2.4), key * std::exp2(-random.uniform(0.7, 3.0)));
  const auto level = [&](const char* name, double most) {
    const double lit = random.uniform() < 0.5 ? 0 : random.uniform(0.1, most);
    out.rig.states[*studio.fixture_index(name)].set(core::Dof::intensity, lit);
  };
  level("back", 0.6);
  level("wall", 0.8);
  out.skin = std::exp2(random.uniform(-2, 1));
  const double grey = std::exp2(random.uniform(-4, -0.6));
  out.wall = {grey * random.uniform(0.7, 1.3), grey * random.uniform(0.7, 1.3),
              grey * random.uniform(0.7, 1.3)};
  out.shift_x = random.uniform(-0.2, 0.2);
  out.shift_y = random.uniform(-0.2, 0.2);
  out.scale = random.uniform(0.7, 1.4);
  out.mirrored = random.uniform() < 0.5;
  return out;
}

core::Result<Portrait> drawn(const studio::Studio& studio, const Sitting& sitting, const Shot& shot,
                             ports::World& world) {
  studio::Studio there = studio;
  const auto built = geometry_with(there, sitting.head, world);
  if (!built) return built.problems();
  twin::Geometry changed = **built;
  paint(changed, sitting, (*built)->aim.origin);
  const auto geometry = std::make_shared<const twin::Geometry>(std::move(changed));
  const render::Tracer tracer(geometry);
  studio::Camera camera = studio.main_camera();
  frame(camera, sitting);
  simulator::TraceOptions options;
  options.samples = shot.samples;
  options.bounces = 4;
  options.seed = shot.seed;
  options.threads = shot.threads;
  const auto traced = simulator::trace(tracer, twin::lit_by(there, geometry, sitting.rig), camera,
                                       shot.size, options);
  const core::Picture seen =
      core::linear(simulator::exposed(traced.picture, simulator::Sensor{}, shot.seed, 0));
  if (!sitting.mirrored) return Portrait{seen, sitting.rig};
  return Portrait{flipped(seen), mirrored(sitting.rig)};
}

core::Result<studio::Studio> portrait_studio(ports::World& world) {
  const studio::Folders folders{world.config_folder};
  auto loaded = studio::load_studio(world.config_folder / "studios/portrait.yaml", folders);
  if (!loaded) return loaded.problems();
  return std::move(loaded->studio);
}

studio::Rig mirrored(studio::Rig rig) {
  for (core::FixtureState& state : rig.states)
    if (state.has(core::Dof::azimuth))
      state.set(core::Dof::azimuth, -state.get(core::Dof::azimuth));
  return rig;
}

}  // namespace chiaro::daemon::study
