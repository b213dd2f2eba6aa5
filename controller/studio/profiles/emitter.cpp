// SPDX-License-Identifier: Apache-2.0
// emitter: {dimmer: {cct: 3200 K}}, {bicolour: {cct: [2700 K, 6500 K], tint: [-20, 20]}},
// {mixed: {red: {chromaticity: [0.69, 0.31], share: 0.2}, …}} or {blend: …}, which is both.
#include <cmath>

#include "controller/studio/profiles/profiles.h"
#include "controller/studio/profiles/spectrum.h"
#include "controller/studio/reading/scalars.h"
#include "controller/studio/reading/section.h"
#include "controller/studio/reading/text.h"

namespace chiaro::studio::profiles {

using namespace reading;

namespace {

constexpr core::Range kCct{1000, 25000};

void read_dimmer(const Tree& body, Emitter& emitter, Report& report) {
  Section dimmer(body, "a dimmer emitter", report);
  if (const auto cct = quantity(dimmer.need("cct", "3200 K"), Measure::temperature, kCct, report))
    emitter.cct = {*cct};
  dimmer.refuse_unknown();
}

void read_bicolour(const Tree& body, Emitter& emitter, Report& report) {
  Section bicolour(body, "a bicolour emitter", report);
  into(emitter.cct_range,
       span(bicolour.need("cct", "[2700 K, 6500 K]"), Measure::temperature, kCct, report));
  into(emitter.tint_range, number_span(bicolour.find("tint"), {-50, 50}, report));
  bicolour.refuse_unknown();
}

/// [[nm, power], …], rising.
core::Chromaticity read_spectrum(const Tree& tree, Report& report) {
  Spectrum lines;
  if (tree.kind == Tree::Kind::sequence && tree.items.size() <= 2048)
    for (const Tree& item : tree.items)
      if (const auto v = numbers(&item, 2, {0, 1e6}, "[nanometres, power]", report))
        lines.push_back({(*v)[0], (*v)[1]});
  const auto colour = chromaticity_of(lines);
  if (!colour)
    report.error(tree, "this spectrum gives no light that can be seen",
                 "list [nanometres, power] from the shortest wavelength to the longest, between "
                 "380 and 780 nm");
  return colour.value_or(core::Chromaticity{});
}

core::Chromaticity read_chromaticity(Section& section, const Tree& where, Report& report) {
  const Tree* xy = section.find("chromaticity");
  const Tree* cct = section.find("cct");
  const Tree* spectrum = section.find("spectrum");
  if ((xy != nullptr) + (cct != nullptr) + (spectrum != nullptr) != 1) {
    report.error(where, "an emitter needs either its chromaticity or its cct",
                 "chromaticity: [0.69, 0.31] for a coloured one, cct: 5600 K for a white one, or "
                 "spectrum: [[450, 0.2], [460, 0.9], …] in nanometres and relative power");
    return {};
  }
  if (spectrum != nullptr) return read_spectrum(*spectrum, report);
  if (cct != nullptr) {
    const auto kelvin = quantity(cct, Measure::temperature, kCct, report);
    return kelvin ? core::white_chromaticity({*kelvin}) : core::Chromaticity{};
  }
  const auto v = numbers(xy, 2, {0.01, 0.85}, "CIE [x, y]", report);
  if (v && (*v)[0] + (*v)[1] > 1.0001)
    report.error(*xy, "x and y add up to more than 1",
                 "no colour lies there: check the data sheet");
  return v ? core::Chromaticity{(*v)[0], (*v)[1]} : core::Chromaticity{};
}

void read_primaries(Section& mixed, const Tree& body, Emitter& emitter, Report& report) {
  double shares = 0;
  for (const core::DofInfo& dof : core::dofs()) {
    if (dof.dof < core::Dof::red || dof.dof > core::Dof::cyan) continue;
    const Tree* tree = mixed.find(dof.name);
    if (tree == nullptr) continue;
    Section section(*tree, "an emitter", report);
    Primary primary{dof.dof, read_chromaticity(section, *tree, report), 0};
    into(primary.share, fraction(section.need("share", "0.25"), report));
    section.refuse_unknown();
    shares += primary.share;
    emitter.primaries.push_back(primary);
  }
  if (emitter.primaries.size() < 2)
    report.error(body, "a mixed emitter needs two colours or more",
                 "for example red, green and blue");
  else if (std::abs(shares - 1) > 0.01)
    report.error(body, "the shares of the emitters add up to " + digits(shares) + ", expected 1",
                 "each share is that emitter's part of the light when all are full");
}

void read_mixed(const Tree& body, Emitter& emitter, Report& report) {
  Section mixed(body, "a mixed emitter", report);
  read_primaries(mixed, body, emitter, report);
  mixed.refuse_unknown();
}

/// Both at once: {blend: {cct: […], tint: […], red: …, green: …}}.
void read_blend(const Tree& body, Emitter& emitter, Report& report) {
  Section blend(body, "a blend emitter", report);
  into(emitter.cct_range,
       span(blend.need("cct", "[2800 K, 10000 K]"), Measure::temperature, kCct, report));
  into(emitter.tint_range, number_span(blend.find("tint"), {-50, 50}, report));
  read_primaries(blend, body, emitter, report);
  blend.refuse_unknown();
}

}  // namespace

Emitter read_emitter(const Tree* tree, Report& report) {
  Emitter emitter;
  const std::vector<std::string> kinds{"dimmer", "bicolour", "mixed", "blend"};
  const auto kind = variant(tree, "a kind of emitter", kinds, report);
  if (!kind) return emitter;
  emitter.kind = static_cast<Emitter::Kind>(kind->index);
  if (kind->body == nullptr) {
    report.error(*tree, "an emitter needs its colour", "for example {dimmer: {cct: 3200 K}}");
  } else if (emitter.kind == Emitter::Kind::dimmer) {
    read_dimmer(*kind->body, emitter, report);
  } else if (emitter.kind == Emitter::Kind::bicolour) {
    read_bicolour(*kind->body, emitter, report);
  } else if (emitter.kind == Emitter::Kind::mixed) {
    read_mixed(*kind->body, emitter, report);
  } else {
    read_blend(*kind->body, emitter, report);
  }
  return emitter;
}

}  // namespace chiaro::studio::profiles
