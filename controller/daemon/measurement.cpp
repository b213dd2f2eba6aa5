// SPDX-License-Identifier: Apache-2.0
#include "controller/daemon/measurement.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <nlohmann/json.hpp>

namespace chiaro::daemon {
namespace {

constexpr std::size_t kFirstCoefficients = 64;

double root_mean_square(const std::vector<float>& values) {
  double sum = 0;
  for (const float v : values) sum += double{v} * double{v};
  return values.empty() ? 0 : std::sqrt(sum / static_cast<double>(values.size()));
}

/// Mean, then level by level from the whole picture down: all h, all v.
std::vector<double> first_coefficients(const measure::HaarSpectrum& spectrum) {
  std::vector<double> out{spectrum.mean};
  for (std::size_t level = 0; level < spectrum.horizontal.size(); ++level)
    for (const auto* values : {&spectrum.horizontal[level], &spectrum.vertical[level]})
      for (const float v : *values)
        if (out.size() < kFirstCoefficients) out.push_back(double{v});
  return out;
}

template <class... Values>
std::string line(const char* format, Values... values) {
  char text[256];
  std::snprintf(text, sizeof text, format, values...);
  return std::string(text) + "\n";
}

std::string row(const char* name, bool known, double value, int digits, const char* range,
                const std::string& meaning) {
  char number[32] = "-";
  if (known) std::snprintf(number, sizeof number, "%.*f", digits, value);
  return line("  %-10s %8s  %-8s  %s", name, number, range, meaning.c_str());
}

/// Sixteen bars from dark to light, the tallest full.
std::string bars(const std::array<double, 256>& histogram) {
  static constexpr const char* kBars[] = {" ", "▁", "▂", "▃", "▄", "▅", "▆", "▇", "█"};
  std::array<double, 16> sums{};
  for (std::size_t k = 0; k < 256; ++k) sums[k / 16] += histogram[k];
  const double most = *std::max_element(sums.begin(), sums.end());
  std::string out;
  for (const double sum : sums)
    out += kBars[most > 0 ? static_cast<std::size_t>(std::ceil(8 * sum / most)) : 0];
  return out;
}

std::string percent(double share) {
  char text[16];
  std::snprintf(text, sizeof text, "%.1f %%", 100 * share);
  return text;
}

}  // namespace

Measurement measurement(const core::Picture& picture, const measure::PixelMap& map,
                        const core::Plane* lit) {
  const core::Plane values = measure::working_scalar(core::luminance(picture));
  Measurement out;
  out.size = picture.size();
  out.geometry = measure::knows_geometry(map);
  out.shadow = lit != nullptr;
  out.components = measure::components(values, map, lit);
  out.spectrum = measure::haar_spectrum(values);
  const auto share = [&](auto test) {
    return static_cast<double>(std::count_if(values.values.begin(), values.values.end(), test)) /
           static_cast<double>(std::max<std::size_t>(1, values.values.size()));
  };
  out.black = share([](float v) { return v < 0.5f; });
  out.clipped = share([](float v) { return v >= 254.5f; });
  return out;
}

std::string to_text(const std::string& picture, const std::string& studio, const Measurement& m) {
  const measure::Components& c = m.components;
  const std::string where = m.geometry ? "of the subject" : "of the picture";
  std::string text = picture + ", " + std::to_string(m.size.width) + " x " +
                     std::to_string(m.size.height) + " pixels" +
                     (m.geometry ? ", the subject alone as " + studio + " sees it\n\n" : "\n\n");
  text += row("edge", m.geometry, c.edge, 3, "0..1", "share of the subject's edges that show");
  text += row("mean", true, c.mean, 1, "0..255",
              "average lightness " + where + (m.shadow ? ", the key's cast shadow left out" : ""));
  text += row("gradient", true, c.gradient, 2, "0..255", "strength of the shading, per pixel");
  text += row("variance", true, c.variance, 1, "0..127.5",
              "spread of lightness, one standard deviation");
  text += row("contrast", m.geometry, c.contrast, 3, "0..1",
              "difference of neighbouring parts (Michelson)");
  text += "  histogram  " + bars(c.histogram) + "   dark to light; black " + percent(m.black) +
          ", clipped " + percent(m.clipped) + "\n";
  if (!m.geometry) text += "\n  edge and contrast need the subject's shape: add --studio STUDIO\n";
  const measure::HaarSpectrum& s = m.spectrum;
  text +=
      line("\nwavelet spectrum, lightness 0..255 at %d x %d: mean %.1f", s.side, s.side, s.mean);
  text += "  level  squares    side  left-right  above-below\n";
  for (std::size_t level = 0; level < s.horizontal.size(); ++level)
    text += line("  %5zu  %7zu  %3d px  %10.2f  %11.2f", level, s.horizontal[level].size(),
                 s.side >> level, root_mean_square(s.horizontal[level]),
                 root_mean_square(s.vertical[level]));
  text += "  (root mean square difference of a square's two halves)\n";
  return text;
}

std::string to_json(const std::string& picture, const std::string& studio, const Measurement& m) {
  using nlohmann::json;
  const measure::Components& c = m.components;
  json levels = json::array();
  for (std::size_t level = 0; level < m.spectrum.horizontal.size(); ++level)
    levels.push_back({{"level", level},
                      {"squares", m.spectrum.horizontal[level].size()},
                      {"side_px", m.spectrum.side >> level},
                      {"horizontal_rms", root_mean_square(m.spectrum.horizontal[level])},
                      {"vertical_rms", root_mean_square(m.spectrum.vertical[level])}});
  json out{{"ok", true},
           {"picture", picture},
           {"studio", studio.empty() ? json() : json(studio)},
           {"width_px", m.size.width},
           {"height_px", m.size.height},
           {"geometry", m.geometry},
           {"key_shadow", m.shadow},
           {"components",
            {{"edge", m.geometry ? json(c.edge) : json()},
             {"mean", c.mean},
             {"gradient", c.gradient},
             {"variance", c.variance},
             {"contrast", m.geometry ? json(c.contrast) : json()},
             {"histogram", c.histogram}}},
           {"black_share", m.black},
           {"clipped_share", m.clipped},
           {"wavelet",
            {{"side_px", m.spectrum.side},
             {"mean", m.spectrum.mean},
             {"levels", levels},
             {"first_coefficients", first_coefficients(m.spectrum)}}}};
  return out.dump(2, ' ', false, json::error_handler_t::replace);
}

}  // namespace chiaro::daemon
