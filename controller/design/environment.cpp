// SPDX-License-Identifier: Apache-2.0
#include "controller/design/environment.h"

#include <algorithm>
#include <cmath>

#include "controller/design/geometric_layers.h"

namespace chiaro::design {
namespace {

using core::Vec3;

/// Real spherical harmonics up to degree 2.
std::array<double, 9> harmonics(Vec3 d) {
  return {0.282095,
          0.488603 * d.y,
          0.488603 * d.z,
          0.488603 * d.x,
          1.092548 * d.x * d.y,
          1.092548 * d.y * d.z,
          0.315392 * (3 * d.z * d.z - 1),
          1.092548 * d.x * d.z,
          0.546274 * (d.x * d.x - d.y * d.y)};
}

/// The cosine lobe's own, by degree: pi, 2 pi / 3, pi / 4.
double lobe(std::size_t k) {
  return k == 0 ? core::kPi : k < 4 ? 2 * core::kPi / 3 : core::kPi / 4;
}

/// Mean L* of the subject in a picture that is `scale` times as bright.
double lightness_of(const core::Plane& luminance, double scale) {
  double sum = 0, count = 0;
  for (const float y : luminance.values)
    if (y > 0) {
      sum += core::lightness(std::min(1.0, scale * double{y}));
      ++count;
    }
  return count > 0 ? sum / count : 0;
}

double scale_for(const core::Plane& luminance, double lightness) {
  double low = 1e-9, high = 1e9;
  for (int i = 0; i < 80; ++i) {
    const double middle = std::sqrt(low * high);
    (lightness_of(luminance, middle) < lightness ? low : high) = middle;
  }
  return std::sqrt(low * high);
}

}  // namespace

Irradiance::Irradiance(const core::Picture& probe) {
  const core::Size size = probe.size();
  const double column = 2 * core::kPi / size.width;
  for (int y = 0; y < size.height; ++y) {
    const double above = core::kPi * (y + 0.5) / size.height;  // from the zenith
    const double solid = column * (std::cos(core::kPi * y / size.height) -
                                   std::cos(core::kPi * (y + 1.0) / size.height));
    for (int x = 0; x < size.width; ++x) {
      const double turn = column * (x + 0.5) - core::kPi;  // from the middle, to its right
      const Vec3 from{-std::sin(above) * std::sin(turn), -std::sin(above) * std::cos(turn),
                      std::cos(above)};
      const auto basis = harmonics(from);
      for (std::size_t k = 0; k < basis.size(); ++k)
        coefficients_[k] = coefficients_[k] + (solid * basis[k]) * probe.at(x, y);
    }
  }
}

core::Rgb Irradiance::at(Vec3 normal) const {
  const auto basis = harmonics(normal);
  core::Rgb sum;
  for (std::size_t k = 0; k < basis.size(); ++k)
    sum = sum + (lobe(k) * basis[k]) * coefficients_[k];
  return {std::max(0.0, sum.r), std::max(0.0, sum.g), std::max(0.0, sum.b)};
}

core::Result<ExampleGoal> environment_goal(const studio::Studio& studio, const LayersSource& twin,
                                           const core::Picture& probe, const std::string& name,
                                           double lightness, core::Size size) {
  const auto tracer = tracer_of(twin);
  if (!tracer)
    return core::Problem{{},
                         "light like in a place needs the subject's shape",
                         "give the studio file a mesh or a stand-in"};
  const Irradiance irradiance(probe);
  const render::View view = render::see(tracer, studio.main_camera(), size);
  const core::AimFrame& aim = tracer->geometry().aim;
  ExampleGoal goal;
  goal.name = name;
  goal.objective = Objective::painted;
  goal.exemplar = core::Picture(size);
  goal.emphasis = goal.unpainted = core::Plane(size);
  const core::GBuffer& b = view.buffer;
  for (std::size_t i = 0; i < b.samples(); ++i) {
    if (!b.objects[b.object[i] - 1u].subject) continue;
    const Vec3 normal{double{b.normal_x[i]}, double{b.normal_y[i]}, double{b.normal_z[i]}};
    const core::Rgb light = irradiance.at(
        {core::dot(normal, aim.camera_right), -core::dot(normal, aim.towards_camera), normal.z});
    const core::Rgb seen =
        core::Rgb{double{b.diffuse_r[i]}, double{b.diffuse_g[i]}, double{b.diffuse_b[i]}} * light;
    goal.exemplar.red.values[b.pixel[i]] = static_cast<float>(seen.r);
    goal.exemplar.green.values[b.pixel[i]] = static_cast<float>(seen.g);
    goal.exemplar.blue.values[b.pixel[i]] = static_cast<float>(seen.b);
    goal.emphasis.values[b.pixel[i]] = 1;
  }
  const core::Plane light = core::luminance(goal.exemplar);
  if (std::none_of(light.values.begin(), light.values.end(), [](float y) { return y > 0; }))
    return core::Problem{{name},
                         "this environment sheds no light on the subject",
                         "is it a picture of a whole sphere, twice as wide as high?"};
  const auto scale = static_cast<float>(scale_for(light, lightness));
  for (core::Plane* plane : {&goal.exemplar.red, &goal.exemplar.green, &goal.exemplar.blue})
    for (float& v : plane->values) v *= scale;
  return goal;
}

}  // namespace chiaro::design
