// SPDX-License-Identifier: Apache-2.0
#include "controller/render/shadow.h"

#include <algorithm>
#include <array>

#include "controller/render/work.h"
#include "controller/twin/lights/light_model.h"

namespace chiaro::render {
namespace {

using core::Vec3;

/// Shadow rays start this far off the surface, metres: beyond float's grain at studio distances,
/// below what a camera resolves.
constexpr double kLiftOff = 2e-4;
/// Least sine of elevation of a shadow ray over the surface.
constexpr double kGrazing = 0.02;

struct Sample {
  Vec3 position, normal, face;
};
Sample sample(const core::GBuffer& b, std::size_t i) {
  return {{b.position_x[i], b.position_y[i], b.position_z[i]},
          {b.normal_x[i], b.normal_y[i], b.normal_z[i]},
          {b.face_x[i], b.face_y[i], b.face_z[i]}};
}

class Fraction {
 public:
  Fraction(const View& view, const twin::Light& light, int across)
      : view_(view),
        light_(light),
        model_(twin::light_model(light.kind)),
        across_(model_.has_area ? across : 1) {}

  float of(std::size_t i) {
    const Sample s = sample(view_.buffer, i);
    if (across_ == 1) return seen(s, model_.target(light_, s.position, 0.5, 0.5)) ? 1.0f : 0.0f;
    const int few = std::min(across_, 4);
    const Sum first = sum(s, few);
    if (first.all == 0)  // the face is below the horizon or turned away: its centre stands for it
      return seen(s, light_.position) ? 1.0f : 0.0f;
    if (few == across_ || first.unanimous) return static_cast<float>(first.visible / first.all);
    const Sum full = sum(s, across_);
    return static_cast<float>(full.visible / full.all);
  }
  std::uint64_t rays = 0;

 private:
  struct Sum {
    double visible = 0, all = 0;
    bool unanimous = true;
  };

  bool seen(const Sample& s, Vec3 target) {
    const Vec3 from = s.position + kLiftOff * s.face;
    Vec3 along = target - from;
    const double size = length(along);
    const double above = dot(along, s.face);
    if (above < kGrazing * size) along = along + (kGrazing * size - above) * s.face;
    ++rays;
    return !view_.tracer->blocked(from, from + along);
  }

  Sum sum(const Sample& s, int strata) {
    Sum out;
    int traced = 0, visible = 0;
    for (int k = 0; k < strata * strata; ++k) {
      const Vec3 target = model_.target(light_, s.position, (k % strata + 0.5) / strata,
                                        (k / strata + 0.5) / strata);
      const Vec3 to = target - s.position;
      const double dd = std::max(dot(to, to), 1e-6);
      const double weight =
          std::max(0.0, dot(to, s.normal)) * std::max(0.0, -dot(to, light_.direction)) / (dd * dd);
      if (weight <= 0) continue;
      const bool open = seen(s, target);
      out.all += weight;
      if (open) out.visible += weight;
      ++traced;
      visible += open;
    }
    out.unanimous = visible == 0 || visible == traced;
    return out;
  }

  const View& view_;
  const twin::Light& light_;
  const twin::LightModel& model_;
  int across_;
};

}  // namespace

void trace_fraction(const View& view, const twin::Light& light, int across, std::size_t first,
                    std::span<float> out) {
  Fraction fraction(view, light, across);
  for (std::size_t k = 0; k < out.size(); ++k) out[k] = fraction.of(first + k);
  work().shadow_rays += fraction.rays;
}

}  // namespace chiaro::render
