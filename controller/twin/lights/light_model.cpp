// SPDX-License-Identifier: Apache-2.0
#include "controller/twin/lights/light_model.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace chiaro::twin {

#define LIGHT(name, summary) LightModel name##_light();
#include "controller/twin/lights/lights.def"
#undef LIGHT

namespace {
const auto& all() {
  static const std::array kModels = {
#define LIGHT(kind_name, kind_summary)                   \
  [] {                                                   \
    LightModel model = kind_name##_light();              \
    model.kind = studio::Optic::Kind::kind_name;         \
    model.name = #kind_name;                             \
    model.summary = kind_summary;                        \
    return model;                                        \
  }(),
#include "controller/twin/lights/lights.def"
#undef LIGHT
  };
  return kModels;
}
}  // namespace

std::span<const LightModel> light_models() { return all(); }

const LightModel& light_model(studio::Optic::Kind kind) {
  const auto found = std::find_if(all().begin(), all().end(),
                                  [&](const LightModel& m) { return m.kind == kind; });
  return found != all().end() ? *found : all().front();
}

double faded(studio::Optic::Attenuation attenuation, double distance) {
  const double d = std::max(distance, kNearestLight);
  switch (attenuation) {
    case studio::Optic::Attenuation::inverse_square: return 1 / (d * d);
    case studio::Optic::Attenuation::linear: return 1 / d;
    case studio::Optic::Attenuation::none: return 1;
  }
  return 1;
}

double highlight(core::Vec3 normal, core::Vec3 to_light, core::Vec3 viewer, double shininess) {
  if (dot(normal, to_light) <= 0) return 0;
  const core::Vec3 half = to_light + viewer;
  const double size = length(half);
  const double cosine = size > 1e-12 ? dot(normal, half) / size : 0;
  return cosine > 0 ? std::pow(cosine, shininess) : 0;
}

std::span<const FacePoint, 9> face_points() {
  constexpr double kFar = 0.7745966692414834, kEdge = 5.0 / 18, kMiddle = 8.0 / 18;
  static constexpr std::array<FacePoint, 9> kPoints{{{-kFar, -kFar, kEdge * kEdge},
                                                     {0, -kFar, kMiddle * kEdge},
                                                     {kFar, -kFar, kEdge * kEdge},
                                                     {-kFar, 0, kEdge * kMiddle},
                                                     {0, 0, kMiddle * kMiddle},
                                                     {kFar, 0, kEdge * kMiddle},
                                                     {-kFar, kFar, kEdge * kEdge},
                                                     {0, kFar, kMiddle * kEdge},
                                                     {kFar, kFar, kEdge * kEdge}}};
  return kPoints;
}

std::span<const FacePoint, 9> disk_points() {
  // Centre weight 1/4 and eight points at sqrt(2/3): exact for polynomials of degree 5
  // (Abramowitz and Stegun 25.4.61).
  static const std::array<FacePoint, 9> kPoints = [] {
    std::array<FacePoint, 9> points{};
    points[0] = {0, 0, 0.25};
    for (std::size_t k = 0; k < 8; ++k) {
      const double turn = 2 * core::kPi * static_cast<double>(k) / 8;
      points[k + 1] = {std::sqrt(2.0 / 3) * std::cos(turn), std::sqrt(2.0 / 3) * std::sin(turn),
                       0.75 / 8};
    }
    return points;
  }();
  return kPoints;
}

double face_specular(const Light& light, std::span<const FacePoint, 9> points, double half_right,
                     double half_up, core::Vec3 at, core::Vec3 normal, core::Vec3 viewer,
                     double shininess) {
  double sum = 0;
  for (const FacePoint& point : points) {
    const core::Vec3 to = light.position + point.x * half_right * light.right +
                          point.y * half_up * light.up - at;
    const double d = std::max(length(to), kNearestLight);
    const core::Vec3 direction = to / d;
    const double leaving = std::max(0.0, -dot(light.direction, direction));
    sum += point.weight * leaving * faded(light.attenuation, d) *
           highlight(normal, direction, viewer, shininess);
  }
  return light.candela * sum;
}

}  // namespace chiaro::twin
