// SPDX-License-Identifier: Apache-2.0
#include "controller/twin/lights/light_model.h"

#include <algorithm>
#include <array>
#include <cmath>

// Lamp types and how their light falls with distance [I-2].
namespace chiaro::twin {

#define LIGHT(name, summary) LightModel name##_light();
#include "controller/twin/lights/lights.def"
#undef LIGHT

namespace {
const auto& all() {
  static const std::array kModels = {
#define LIGHT(kind_name, kind_summary)           \
  [] {                                           \
    LightModel model = kind_name##_light();      \
    model.kind = studio::Optic::Kind::kind_name; \
    model.name = #kind_name;                     \
    model.summary = kind_summary;                \
    return model;                                \
  }(),
#include "controller/twin/lights/lights.def"
#undef LIGHT
  };
  return kModels;
}
}  // namespace

std::span<const LightModel> light_models() { return all(); }

const LightModel& light_model(studio::Optic::Kind kind) {
  const auto found =
      std::find_if(all().begin(), all().end(), [&](const LightModel& m) { return m.kind == kind; });
  return found != all().end() ? *found : all().front();
}

double faded(studio::Optic::Attenuation attenuation, double distance) {
  const double d = std::max(distance, kNearestLight);
  switch (attenuation) {
    case studio::Optic::Attenuation::inverse_square:
      return 1 / (d * d);
    case studio::Optic::Attenuation::linear:
      return 1 / d;
    case studio::Optic::Attenuation::none:
      return 1;
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

std::span<const FacePoint> face_points(double shininess) {
  constexpr double kNear = 0.5773502691896258;
  static constexpr std::array<FacePoint, 4> kFew{
      {{-kNear, -kNear, 0.25}, {kNear, -kNear, 0.25}, {-kNear, kNear, 0.25}, {kNear, kNear, 0.25}}};
  constexpr double kFar = 0.7745966692414834, kEdge = 5.0 / 18, kMiddle = 8.0 / 18;
  static constexpr std::array<FacePoint, 9> kMany{{{-kFar, -kFar, kEdge * kEdge},
                                                   {0, -kFar, kMiddle * kEdge},
                                                   {kFar, -kFar, kEdge * kEdge},
                                                   {-kFar, 0, kEdge * kMiddle},
                                                   {0, 0, kMiddle * kMiddle},
                                                   {kFar, 0, kEdge * kMiddle},
                                                   {-kFar, kFar, kEdge * kEdge},
                                                   {0, kFar, kMiddle * kEdge},
                                                   {kFar, kFar, kEdge * kEdge}}};
  if (shininess <= kFewPointsUpTo) return kFew;
  return kMany;
}

std::span<const FacePoint> disk_points(double shininess) {
  static constexpr double kHalf = 0.5, kRing = 0.8164965809277260, kSide = 0.5773502691896258;
  static constexpr std::array<FacePoint, 4> kFew{
      {{-kHalf, -kHalf, 0.25}, {kHalf, -kHalf, 0.25}, {-kHalf, kHalf, 0.25}, {kHalf, kHalf, 0.25}}};
  static constexpr double kW = 0.75 / 8;
  static constexpr std::array<FacePoint, 9> kMany{{{0, 0, 0.25},
                                                   {kRing, 0, kW},
                                                   {kSide, kSide, kW},
                                                   {0, kRing, kW},
                                                   {-kSide, kSide, kW},
                                                   {-kRing, 0, kW},
                                                   {-kSide, -kSide, kW},
                                                   {0, -kRing, kW},
                                                   {kSide, -kSide, kW}}};
  if (shininess <= kFewPointsUpTo) return kFew;
  return kMany;
}

double face_specular(const Light& light, std::span<const FacePoint> points, double half_right,
                     double half_up, core::Vec3 at, core::Vec3 normal, core::Vec3 viewer,
                     double shininess) {
  double sum = 0;
  for (const FacePoint& point : points) {
    const core::Vec3 to =
        light.position + point.x * half_right * light.right + point.y * half_up * light.up - at;
    const double d = std::max(length(to), kNearestLight);
    const core::Vec3 direction = to / d;
    const double leaving = std::max(0.0, -dot(light.direction, direction));
    sum += point.weight * leaving * faded(light.attenuation, d) *
           highlight(normal, direction, viewer, shininess);
  }
  return light.candela * sum;
}

}  // namespace chiaro::twin
