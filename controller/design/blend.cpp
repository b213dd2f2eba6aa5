// SPDX-License-Identifier: Apache-2.0
#include "controller/design/blend.h"

#include <algorithm>

namespace chiaro::design {
namespace {

core::Picture square_of(const core::Picture& picture, int side) {
  const core::Size size = picture.size();
  const int least = std::min(size.width, size.height);
  const int left = (size.width - least) / 2, top = (size.height - least) / 2;
  core::Picture out({least, least});
  for (int y = 0; y < least; ++y)
    for (int x = 0; x < least; ++x) out.set(x, y, picture.at(left + x, top + y));
  return core::resized(out, {side, side});
}

core::Rgb between(core::Rgb a, core::Rgb b, double share) {
  const auto light = [](core::Rgb c) { return std::clamp(core::luminance(c), 0.0, 1.0); };
  const double wanted = core::luminance_of_lightness((1 - share) * core::lightness(light(a)) +
                                                     share * core::lightness(light(b)));
  const core::Rgb mixed = (1 - share) * a + share * b;
  const double now = core::luminance(mixed);
  return now > 0 ? (wanted / now) * mixed : core::Rgb{wanted, wanted, wanted};
}

using Number = std::optional<double> measure::Targets::*;
constexpr Number kNumbers[] = {&measure::Targets::edge, &measure::Targets::mean,
                               &measure::Targets::gradient, &measure::Targets::variance,
                               &measure::Targets::contrast};

measure::Targets between(const measure::Targets& a, const measure::Targets& b, double share) {
  measure::Targets out;
  for (const Number number : kNumbers)
    if (a.*number && b.*number) out.*number = (1 - share) * *(a.*number) + share * *(b.*number);
  if (a.histogram && b.histogram) {
    out.histogram.emplace();
    for (std::size_t k = 0; k < 256; ++k)
      (*out.histogram)[k] = (1 - share) * (*a.histogram)[k] + share * (*b.histogram)[k];
  }
  return out;
}

}  // namespace

ExampleGoal blended(const ExampleGoal& from, const ExampleGoal& to, double share) {
  if (share <= 0) return from;
  ExampleGoal out = from;
  out.name = from.name + " and " + to.name;
  const int side = std::min(from.exemplar.size().width, from.exemplar.size().height);
  const core::Picture a = square_of(from.exemplar, side), b = square_of(to.exemplar, side);
  out.exemplar = core::Picture({side, side});
  for (int y = 0; y < side; ++y)
    for (int x = 0; x < side; ++x) out.exemplar.set(x, y, between(a.at(x, y), b.at(x, y), share));
  out.drawn_here = from.drawn_here && to.drawn_here;
  if (from.targets3d && to.targets3d)
    out.targets3d = between(*from.targets3d, *to.targets3d, share);
  else
    out.targets3d.reset();
  return out;
}

}  // namespace chiaro::design
