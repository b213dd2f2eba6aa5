// SPDX-License-Identifier: Apache-2.0
#include "controller/importers/gdtf_emitters.h"

#include <algorithm>
#include <array>
#include <optional>

#include "controller/importers/xml.h"
#include "controller/studio/profiles/spectrum.h"

namespace chiaro::importers {
namespace {

std::optional<core::Dof> dof_of(Meaning meaning) {
  using core::Dof;
  constexpr std::array kPairs{
      std::pair{Meaning::red, Dof::red},     std::pair{Meaning::green, Dof::green},
      std::pair{Meaning::blue, Dof::blue},   std::pair{Meaning::white, Dof::white},
      std::pair{Meaning::amber, Dof::amber}, std::pair{Meaning::warm_white, Dof::warm_white},
      std::pair{Meaning::lime, Dof::lime},   std::pair{Meaning::cyan, Dof::cyan}};
  for (const auto& [m, dof] : kPairs)
    if (m == meaning) return dof;
  return std::nullopt;
}

/// The measurement at full: the one with the greatest Physical.
pugi::xml_node at_full(pugi::xml_node emitter) {
  pugi::xml_node best;
  double most = -1;
  for (const pugi::xml_node node : emitter.children("Measurement")) {
    const double physical = number_in(node.attribute("Physical"), 0, 100, 0);
    if (physical > most) most = physical, best = node;
  }
  return best;
}

std::optional<core::Chromaticity> from_spectrum(pugi::xml_node measurement) {
  studio::profiles::Spectrum lines;
  for (const pugi::xml_node point : measurement.children("MeasurementPoint"))
    if (lines.size() < 4096)
      lines.push_back({number_in(point.attribute("WaveLength"), 100, 2000, 0),
                       number_in(point.attribute("Energy"), 0, 1e12, 0)});
  std::sort(lines.begin(), lines.end(), [](const auto& a, const auto& b) { return a.nm < b.nm; });
  return studio::profiles::chromaticity_of(lines);
}

/// "0.6401,0.3300,21.26": CIE xyY. White is the format's default, and says nothing.
std::optional<core::Chromaticity> from_xyy(std::string_view words) {
  const std::size_t comma = words.find(',');
  if (comma == std::string_view::npos) return std::nullopt;
  const double x = number_in(words.substr(0, comma), 0.01, 0.85, 0);
  words.remove_prefix(comma + 1);
  const double y = number_in(words.substr(0, words.find(',')), 0.01, 0.85, 0);
  if (x <= 0 || y <= 0 || x + y > 1) return std::nullopt;
  return core::Chromaticity{x, y};
}

std::optional<core::Chromaticity> colour_of(pugi::xml_node emitter) {
  if (const auto colour = from_spectrum(at_full(emitter))) return colour;
  if (const auto colour = from_xyy(emitter.attribute("Color").as_string())) return colour;
  const double nm = number_in(emitter.attribute("DominantWaveLength"), 400, 700, 0);
  if (nm > 0) return studio::profiles::chromaticity_of_wavelength(nm);
  return std::nullopt;
}

}  // namespace

void GdtfEmitters::note(Meaning meaning, const std::string& emitter) {
  if (!emitter.empty() && dof_of(meaning)) names_.emplace(meaning, emitter);
}

std::vector<studio::Primary> GdtfEmitters::primaries(bool& shares_known) const {
  std::vector<studio::Primary> all;
  shares_known = !names_.empty();
  for (const auto& [meaning, name] : names_) {
    const pugi::xml_node node =
        collection_.find_child_by_attribute("Emitter", "Name", name.c_str());
    const auto colour = node ? colour_of(node) : std::nullopt;
    const double candela = number_in(at_full(node).attribute("LuminousIntensity"), 1e-6, 1e9, 0);
    shares_known = shares_known && candela > 0 && colour.has_value();
    if (colour) all.push_back({*dof_of(meaning), *colour, candela > 0 ? candela : 1});
  }
  return all;
}

}  // namespace chiaro::importers
