// SPDX-License-Identifier: Apache-2.0
#include "controller/design/objects.h"

#include <algorithm>
#include <cmath>

#include "controller/core/merge.h"
#include "controller/design/geometric_layers.h"
#include "controller/design/levels.h"
#include "controller/design/perceptual_levels.h"
#include "controller/design/variables.h"
#include "controller/design/words.h"
#include "controller/twin/aim.h"

namespace chiaro::design {
namespace {

using core::Vec3;

constexpr core::Size kSize{128, 128}, kPicture{256, 256};
constexpr int kAzimuths = 7, kElevations = 4, kDistances = 2;
// Light on the neighbours costs so much of a goal's worst; a wider cone than this is no spot.
constexpr double kStray = 0.5;
const double kWidest = core::radians(120);
constexpr double kPenumbra = 1.1;  // field over beam: light ends softly

core::Plane luminance_of(const core::Layer& layer) {
  core::Plane out = core::luminance(layer.diffuse);
  const core::Plane more = core::luminance(layer.specular);
  for (std::size_t i = 0; i < out.values.size(); ++i) out.values[i] += more.values[i];
  return out;
}

/// One object's pixels alone count; where its outline is, it is an edge.
measure::PixelMap map_of(const core::GeometryPlanes& planes, std::uint16_t object) {
  measure::PixelMap whole = measure::pixel_map(planes);
  for (std::size_t i = 0; i < whole.type.values.size(); ++i)
    if (planes.object.values[i] != object) {
      whole.type.values[i] = measure::PixelType::background;
      whole.external.values[i] = 0;
    }
  return measure::pixel_map_of(std::move(whole.type), std::move(whole.external), planes.object);
}

/// What one lamp may be tried at.
struct Stand {
  Vec3 at;
  render::SpotCone cone;
  core::Plane light;  ///< at full level
};

class Scene {
 public:
  Scene(const studio::Studio& studio, std::shared_ptr<const render::Tracer> tracer)
      : studio_(studio),
        tracer_(std::move(tracer)),
        view_(render::see(tracer_, studio.main_camera(), kSize)),
        planes_(core::planes(view_.buffer)),
        gain_(studio::exposure_gain(studio.exposure, studio.main_camera())),
        rig_(studio::placed_rig(studio)) {}

  bool shows(std::uint16_t object) const {
    return std::find(view_.buffer.object.begin(), view_.buffer.object.end(), object) !=
           view_.buffer.object.end();
  }

  core::Result<LitObject> light(const ObjectGoal& goal, core::Plane& offset);
  core::Picture picture(const std::vector<LitObject>& objects,
                        const std::vector<ObjectGoal>& goals) const;
  /// Everything that is no object's lamp.
  core::Plane rest(const std::vector<ObjectGoal>& goals, const render::View& view) const {
    return core::luminance(rest_picture(goals, view));
  }
  const render::View& view() const { return view_; }

 private:
  core::Picture rest_picture(const std::vector<ObjectGoal>& goals, const render::View& view) const {
    const std::shared_ptr<const twin::Geometry> geometry(tracer_, &tracer_->geometry());
    twin::Scene scene = twin::lit_by(studio_, geometry, rig_);
    for (const ObjectGoal& goal : goals) scene.levels[goal.fixture] = 0;
    return render::picture(view, scene);
  }
  twin::Light light_at(std::size_t fixture, Vec3 at, const render::SpotCone& cone) const {
    twin::Light light = twin::light(studio_.fixtures[fixture], rig_.states[fixture],
                                    tracer_->geometry().aim, studio_.exposure.white_balance);
    light.kind = studio::Optic::Kind::spot;
    light.position = at;
    light.direction = cone.direction;
    light.cos_beam = std::cos(cone.angle / 2);
    light.cos_field = std::cos(std::min(core::kPi / 2, kPenumbra * cone.angle / 2));
    return light;
  }
  std::optional<Stand> stand(const ObjectGoal& goal, Vec3 at) const;
  std::vector<Vec3> places(const ObjectGoal& goal) const;
  bool allowed(std::size_t fixture, Vec3 at) const;
  Vec3 centre_of(std::uint16_t object) const;
  double stray(const core::Plane& light, std::uint16_t object) const;

  const studio::Studio& studio_;
  const std::shared_ptr<const render::Tracer> tracer_;
  const render::View view_;
  const core::GeometryPlanes planes_;
  const double gain_;
  const studio::Rig rig_;
};

Vec3 Scene::centre_of(std::uint16_t object) const {
  core::Box3 box;
  const core::GBuffer& buffer = view_.buffer;
  for (std::size_t i = 0; i < buffer.samples(); ++i)
    if (buffer.object[i] == object)
      box.include({double{buffer.position_x[i]}, double{buffer.position_y[i]},
                   double{buffer.position_z[i]}});
  return box.centre();
}

bool Scene::allowed(std::size_t fixture, Vec3 at) const {
  const core::Spherical place = core::spherical(tracer_->geometry().aim, at);
  studio::Rig rig = rig_;
  rig.states[fixture].set(core::Dof::azimuth, place.azimuth);
  rig.states[fixture].set(core::Dof::elevation, place.elevation);
  rig.states[fixture].set(core::Dof::distance, place.distance);
  return twin::infeasible(studio_, tracer_->geometry(), rig, fixture).empty();
}

/// A lattice over the region of a stand, about the object; else where the lamp hangs.
std::vector<Vec3> Scene::places(const ObjectGoal& goal) const {
  const studio::Fixture& fixture = studio_.fixtures[goal.fixture];
  const auto* stand = std::get_if<studio::StandMount>(&fixture.mount);
  const auto* free = std::get_if<studio::VirtualMount>(&fixture.mount);
  const Vec3 hangs =
      twin::pose(fixture, rig_.states[goal.fixture], tracer_->geometry().aim).position;
  if (stand == nullptr && free == nullptr) return {hangs};
  const studio::Region& region = stand != nullptr ? stand->region : free->region;
  const core::AimFrame frame = core::aim_frame(
      centre_of(static_cast<std::uint16_t>(goal.subject + 1)), studio_.main_camera().at);
  const auto at = [](core::Range range, int i, int n) {
    return range.least + range.width() * (i + 0.5) / n;
  };
  std::vector<Vec3> places;
  for (int a = 0; a < kAzimuths; ++a)
    for (int e = 0; e < kElevations; ++e)
      for (int d = 0; d < kDistances; ++d) {
        const Vec3 place = core::position(
            frame, {at(region.azimuth, a, kAzimuths), at(region.elevation, e, kElevations),
                    at(region.distance, d, kDistances)});
        if (allowed(goal.fixture, place)) places.push_back(place);
      }
  return places;
}

std::optional<Stand> Scene::stand(const ObjectGoal& goal, Vec3 at) const {
  const auto cone =
      render::cone_over(view_.buffer, static_cast<std::uint16_t>(goal.subject + 1), at);
  if (!cone || cone->angle > kWidest) return std::nullopt;
  return Stand{at, *cone,
               luminance_of(render::layer(view_, light_at(goal.fixture, at, *cone), gain_,
                                          render::Shadows::hard))};
}

double Scene::stray(const core::Plane& light, std::uint16_t object) const {
  double own = 0, others = 0;
  for (std::size_t i = 0; i < light.values.size(); ++i) {
    if (planes_.subject.values[i] == 0) continue;
    (planes_.object.values[i] == object ? own : others) += double{light.values[i]};
  }
  return own + others > 0 ? others / (own + others) : 0;
}

Columns one_lamp(const core::Plane& light, const core::Plane& offset, double limit) {
  Columns columns;
  columns.planes = {&light};
  columns.offset = &offset;
  columns.bounds = {{0, limit}};
  return columns;
}

/// Steepest shading and strongest contrast that the lamp shows at mid grey from any of its places.
measure::IdealTargets most_of(const std::vector<Stand>& stands, const core::Plane& offset,
                              const measure::PixelMap& map, double limit) {
  measure::IdealTargets most;
  double gradient = 0, contrast = 0;
  core::Plane picture;
  for (const Stand& stand : stands) {
    const Columns columns = one_lamp(stand.light, offset, limit);
    mix(columns, scaled_to_mean(columns, map, std::vector<double>{1}, most.mean), picture);
    const auto seen = measure::components_of_luminance(picture, map);
    gradient = std::max(gradient, seen.gradient);
    contrast = std::max(contrast, seen.contrast);
  }
  if (gradient > 0) most.gradient = gradient;
  if (contrast > 0) most.contrast = contrast;
  return most;
}

core::Result<LitObject> Scene::light(const ObjectGoal& goal, core::Plane& offset) {
  const studio::Fixture& fixture = studio_.fixtures[goal.fixture];
  const auto object = static_cast<std::uint16_t>(goal.subject + 1);
  LitObject lit;
  lit.object = studio_.subjects[goal.subject].name;
  lit.lamp = fixture.name;
  std::vector<Stand> stands;
  for (const Vec3 at : places(goal)) {
    ++lit.tries;
    if (auto each = stand(goal, at)) stands.push_back(*std::move(each));
  }
  if (stands.empty())
    return core::Problem{{},
                         fixture.name + " has no place from which a cone holds " + lit.object,
                         "put it further away, or choose another lamp"};
  const measure::PixelMap map = map_of(planes_, object);
  Goal wanted = goal.goal;
  if (auto* example = std::get_if<ExampleGoal>(&wanted)) example->objective = Objective::perceptual;
  Target target = target_of(wanted, kSize, &planes_);
  target.ideal = most_of(stands, offset, map, fixture.limits.most);
  const auto solver = level_solver(target, map);
  double best = std::numeric_limits<double>::infinity();
  std::size_t chosen = 0;
  for (std::size_t i = 0; i < stands.size(); ++i) {
    const Columns columns = one_lamp(stands[i].light, offset, fixture.limits.most);
    const Levels levels = solver->solve(columns, Effort::thorough);
    const double cost = levels.cost + kStray * stray(stands[i].light, object);
    if (cost >= best) continue;
    best = cost;
    chosen = i;
    lit.level = levels.values[0];
    lit.cost = levels.cost;
  }
  const Stand& stand = stands[chosen];
  lit.at = stand.at;
  lit.cone = stand.cone;
  lit.aim_at = stand.at + core::distance(stand.at, centre_of(object)) * stand.cone.direction;
  lit.stray = stray(stand.light, object);
  double own = 0, reached = 0;
  for (std::size_t i = 0; i < stand.light.values.size(); ++i)
    if (planes_.object.values[i] == object) {
      ++own;
      reached += stand.light.values[i] > 0;
    }
  lit.covered = own > 0 ? reached / own : 0;
  for (std::size_t i = 0; i < offset.values.size(); ++i)
    offset.values[i] += static_cast<float>(lit.level) * stand.light.values[i];
  return lit;
}

core::Picture Scene::picture(const std::vector<LitObject>& objects,
                             const std::vector<ObjectGoal>& goals) const {
  const render::View view = render::see(tracer_, studio_.main_camera(), kPicture);
  core::Picture sum = rest_picture(goals, view);
  for (std::size_t k = 0; k < objects.size(); ++k) {
    const core::Layer layer =
        render::layer(view, light_at(goals[k].fixture, objects[k].at, objects[k].cone), gain_);
    const auto add = [&](core::Plane& to, const core::Plane& a, const core::Plane& b) {
      for (std::size_t i = 0; i < to.values.size(); ++i)
        to.values[i] += static_cast<float>(objects[k].level) * (a.values[i] + b.values[i]);
    };
    add(sum.red, layer.diffuse.red, layer.specular.red);
    add(sum.green, layer.diffuse.green, layer.specular.green);
    add(sum.blue, layer.diffuse.blue, layer.specular.blue);
  }
  return sum;
}

/// The lamp's own numbers, and what a person must do where it has no motors for it.
void point(const studio::Studio& studio, const core::AimFrame& aim, std::size_t index,
           LitObject& lit, studio::Rig& rig) {
  const studio::Fixture& fixture = studio.fixtures[index];
  core::FixtureState& state = rig.states[index];
  state.set(core::Dof::intensity, lit.level);
  const std::string cone = number(core::degrees(lit.cone.angle), 0) + "° wide";
  bool zooms = false;
  for (const auto& [dof, range] : fixture.ranges())
    if (dof == core::Dof::zoom) {
      zooms = true;
      state.set(dof, range.clamp(lit.cone.angle));
    }
  if (const auto* head = std::get_if<studio::PanTiltMount>(&fixture.mount)) {
    if (const auto turned = twin::aimed_at(*head, head->pan, head->tilt, lit.aim_at, {})) {
      state.set(core::Dof::pan, turned->pan);
      state.set(core::Dof::tilt, turned->tilt);
      if (!zooms) lit.instruction = "set " + fixture.name + "'s beam to " + cone;
      return;
    }
  }
  std::string move;
  if (region_of(fixture) != nullptr) {
    const core::Spherical place = core::spherical(aim, lit.at);
    state.set(core::Dof::azimuth, place.azimuth);
    state.set(core::Dof::elevation, place.elevation);
    state.set(core::Dof::distance, place.distance);
    move = "move " + fixture.name + " to " + core::place_in_words(place) + " from the face and ";
  }
  lit.instruction = move + "aim " + fixture.name + " at " + lit.object + ", beam " + cone;
}

core::Problems problems_of(const studio::Studio& studio, const Scene& scene,
                           const std::vector<ObjectGoal>& goals) {
  core::Problems problems;
  for (std::size_t k = 0; k < goals.size(); ++k) {
    const std::string& name = studio.subjects[goals[k].subject].name;
    if (!scene.shows(static_cast<std::uint16_t>(goals[k].subject + 1)))
      problems.push_back({{}, "the main camera does not see " + name, "turn the camera to it"});
    for (std::size_t j = 0; j < k; ++j)
      if (goals[j].fixture == goals[k].fixture)
        problems.push_back({{},
                            studio.fixtures[goals[k].fixture].name + " cannot light both " +
                                studio.subjects[goals[j].subject].name + " and " + name,
                            "give each object a lamp of its own"});
  }
  return problems;
}

}  // namespace

core::Result<LitObjects> light_objects(const studio::Studio& studio,
                                       std::shared_ptr<const render::Tracer> tracer,
                                       const std::vector<ObjectGoal>& goals) {
  const core::AimFrame aim = tracer->geometry().aim;
  Scene scene(studio, std::move(tracer));
  core::Problems problems = problems_of(studio, scene, goals);
  if (!problems.empty()) return problems;
  LitObjects out;
  Look& look = out.look;
  look.name = look.goal = "objects";
  look.optimiser = "lattice";
  look.wanted = studio::placed_rig(studio);
  core::Plane offset = scene.rest(goals, scene.view());
  for (const ObjectGoal& goal : goals) {
    auto lit = scene.light(goal, offset);
    if (!lit) {
      problems.insert(problems.end(), lit.problems().begin(), lit.problems().end());
      continue;
    }
    point(studio, aim, goal.fixture, *lit, look.wanted);
    look.trials += lit->tries;
    if (!lit->instruction.empty()) look.instructions.push_back(lit->instruction);
    out.objects.push_back(*std::move(lit));
  }
  if (!problems.empty()) return problems;
  look.placed = look.wanted;
  look.judgement.verdict = look.placed_judgement.verdict = Verdict::reached;
  look.picture = look.placed_picture = scene.picture(out.objects, goals);
  return out;
}

core::Result<MergedObjects> merge_objects(const studio::Studio& studio,
                                          const std::vector<ObjectGoal>& goals,
                                          const GeometricOptions& geometric,
                                          const Options& options) {
  MergedObjects out;
  std::vector<core::Plane> depths;
  for (const ObjectGoal& goal : goals) {
    studio::Studio alone = studio;
    alone.subjects = {studio.subjects[goal.subject]};
    const auto twin = bounced_layers(alone, geometric);
    if (!twin) return twin.problems();
    auto look = design(alone, **twin, goal.goal, options);
    if (!look) return look.problems();
    depths.push_back((*twin)->at(options.full_size).geometry()->depth);
    out.looks.push_back(*std::move(look));
  }
  std::vector<core::Part> parts;
  for (std::size_t k = 0; k < goals.size(); ++k)
    parts.push_back({&out.looks[k].picture, &depths[k]});
  auto picture = core::merged(parts);
  if (!picture) return picture.problems();
  out.picture = *std::move(picture);
  return out;
}

}  // namespace chiaro::design
