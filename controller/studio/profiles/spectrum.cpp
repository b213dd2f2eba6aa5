// SPDX-License-Identifier: Apache-2.0
#include "controller/studio/profiles/spectrum.h"

#include <cmath>

namespace chiaro::studio::profiles {
namespace {

/// A bell whose two sides differ in width; nanometres.
double lobe(double nm, double middle, double below, double above) {
  const double t = (nm - middle) / (nm < middle ? below : above);
  return std::exp(-0.5 * t * t);
}

core::Xyz observer(double nm) {
  return {1.056 * lobe(nm, 599.8, 37.9, 31.0) + 0.362 * lobe(nm, 442.0, 16.0, 26.7) -
              0.065 * lobe(nm, 501.1, 20.4, 26.2),
          0.821 * lobe(nm, 568.8, 46.9, 40.5) + 0.286 * lobe(nm, 530.9, 16.3, 31.1),
          1.217 * lobe(nm, 437.0, 11.8, 36.0) + 0.681 * lobe(nm, 459.0, 26.0, 13.8)};
}

core::Chromaticity projected(core::Xyz sum) {
  const double all = sum.x + sum.y + sum.z;
  return {sum.x / all, sum.y / all};
}

}  // namespace

std::optional<core::Chromaticity> chromaticity_of(const Spectrum& spectrum) {
  constexpr double kLeast = 360, kMost = 830;
  core::Xyz sum;
  for (std::size_t i = 0; i + 1 < spectrum.size(); ++i) {
    const SpectralLine &a = spectrum[i], &b = spectrum[i + 1];
    if (!(b.nm > a.nm)) return std::nullopt;
    const double from = std::fmax(a.nm, kLeast), to = std::fmin(b.nm, kMost);
    const int steps = static_cast<int>(std::ceil(to - from));
    for (int k = 0; k < steps; ++k) {
      const double nm = from + (k + 0.5) * (to - from) / steps;
      const double power = std::lerp(a.power, b.power, (nm - a.nm) / (b.nm - a.nm));
      const core::Xyz seen = observer(nm);
      const double weight = power * (to - from) / steps;
      sum = {sum.x + weight * seen.x, sum.y + weight * seen.y, sum.z + weight * seen.z};
    }
  }
  if (!(sum.y > 1e-9) || !std::isfinite(sum.x + sum.y + sum.z)) return std::nullopt;
  return projected(sum);
}

core::Chromaticity chromaticity_of_wavelength(double nm) { return projected(observer(nm)); }

}  // namespace chiaro::studio::profiles
