// SPDX-License-Identifier: Apache-2.0
#include "controller/design/exposure.h"

namespace chiaro::design {
namespace {

void multiply(core::Picture& picture, core::Rgb factor) {
  for (float& v : picture.red.values) v *= static_cast<float>(factor.r);
  for (float& v : picture.green.values) v *= static_cast<float>(factor.g);
  for (float& v : picture.blue.values) v *= static_cast<float>(factor.b);
}

}  // namespace

ReexposedLayers::ReexposedLayers(const Layers& inner, core::Rgb factor)
    : inner_(inner), factor_(factor), ambient_(inner.ambient()) {
  multiply(ambient_, factor_);
}

void ReexposedLayers::luminance(std::size_t fixture, const core::FixtureState& state,
                                Accuracy accuracy, core::Plane& out) const {
  if (factor_.r == factor_.g && factor_.g == factor_.b) {
    inner_.luminance(fixture, state, accuracy, out);
    for (float& v : out.values) v *= static_cast<float>(factor_.g);
    return;
  }
  core::Layer layer;
  colour(fixture, state, accuracy, layer);
  out = core::luminance(layer.diffuse);
  const core::Plane specular = core::luminance(layer.specular);
  for (std::size_t i = 0; i < out.values.size(); ++i) out.values[i] += specular.values[i];
}

void ReexposedLayers::colour(std::size_t fixture, const core::FixtureState& state,
                             Accuracy accuracy, core::Layer& out) const {
  inner_.colour(fixture, state, accuracy, out);
  multiply(out.diffuse, factor_);
  multiply(out.specular, factor_);
}

void ReexposedLayers::visibility(std::size_t fixture, const core::FixtureState& state,
                                 Accuracy accuracy, core::Plane& out) const {
  inner_.visibility(fixture, state, accuracy, out);
}

std::string ReexposedLayers::infeasible(const studio::Rig& rig, std::size_t fixture) const {
  return inner_.infeasible(rig, fixture);
}

}  // namespace chiaro::design
