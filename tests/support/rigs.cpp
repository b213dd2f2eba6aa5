// SPDX-License-Identifier: Apache-2.0
#include "tests/support/rigs.h"

namespace chiaro::support {

core::Picture photographed(const studio::Studio& studio, const design::LayersSource& twin,
                           const studio::Rig& rig, core::Size size) {
  const design::Layers& layers = twin.at(size);
  core::Picture picture = layers.ambient();
  for (std::size_t i = 0; i < studio.fixtures.size(); ++i) {
    core::Layer layer;
    layers.colour(i, rig.states[i], design::Accuracy::exact, layer);
    const double level = rig.states[i].get(core::Dof::intensity);
    for (int y = 0; y < size.height; ++y)
      for (int x = 0; x < size.width; ++x)
        picture.set(x, y,
                    picture.at(x, y) + level * (layer.diffuse.at(x, y) + layer.specular.at(x, y)));
  }
  return core::linear(core::encoded(picture));
}

void stand(studio::Rig& rig, std::size_t fixture, double azimuth_deg, double elevation_deg,
           double distance, double level) {
  core::FixtureState& state = rig.states[fixture];
  state.set(core::Dof::azimuth, core::radians(azimuth_deg));
  state.set(core::Dof::elevation, core::radians(elevation_deg));
  state.set(core::Dof::distance, distance);
  state.set(core::Dof::intensity, level);
}

double angle_off(const studio::Rig& a, const studio::Rig& b, std::size_t fixture) {
  const core::AimFrame frame;
  const auto direction = [&](const studio::Rig& rig) {
    const core::FixtureState& state = rig.states[fixture];
    return core::position(frame,
                          {state.get(core::Dof::azimuth), state.get(core::Dof::elevation), 1});
  };
  return core::degrees(core::angle_between(direction(a), direction(b)));
}

design::ExampleGoal like(core::Picture picture, design::Objective objective) {
  design::ExampleGoal goal;
  goal.name = "hidden";
  goal.exemplar = std::move(picture);
  goal.objective = objective;
  return goal;
}

}  // namespace chiaro::support
