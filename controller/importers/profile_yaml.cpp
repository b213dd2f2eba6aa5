// SPDX-License-Identifier: Apache-2.0
// A profile as the file that says it.
#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "controller/importers/library_fixture.h"
#include "controller/studio/profiles/profiles.h"
#include "controller/studio/reading/text.h"

namespace chiaro::importers {
namespace {

using core::Dof;
using studio::Channel;
using studio::ChannelUse;
using studio::Segment;

/// In double quotes; without control characters, and no longer than a name need be.
std::string quoted(const std::string& words) {
  std::string clean;
  for (const char c : words.substr(0, 120))
    clean += static_cast<unsigned char>(c) < 0x20 || c == 0x7f ? ' ' : c;
  const std::string_view trimmed = studio::reading::trimmed(clean);
  return nlohmann::json(trimmed.empty() ? std::string("-") : std::string(trimmed))
      .dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

/// Enough digits that reading gives the number back.
std::string exact(double value) { return fmt::format("{:.10g}", value); }

std::string physical(const Channel& channel, double value) {
  if (!channel.dof) return exact(value) + " Hz";
  switch (core::info(*channel.dof).unit) {
    case core::Unit::degrees:
      return exact(core::degrees(value)) + " deg";
    case core::Unit::kelvin:
      return exact(value) + " K";
    case core::Unit::metres:
      return exact(value) + " m";
    case core::Unit::none:
      break;
  }
  return exact(value);
}

std::string raw(double fraction, int bytes) {
  return fmt::format("{:.0f}", fraction * studio::profiles::full_scale(bytes));
}

std::string range(const Channel& channel, const Segment& s) {
  std::string words = fmt::format("{{dmx: [{}, {}], ", raw(s.dmx_from, channel.bytes),
                                  raw(s.dmx_to, channel.bytes));
  if (s.law == Segment::Law::no_effect) return words + "no_effect: yes}";
  if (s.law == Segment::Law::neutral)
    return words + "neutral: " + physical(channel, s.physical_from) + "}";
  return words + fmt::format("means: [{}, {}]}}", physical(channel, s.physical_from),
                             physical(channel, s.physical_to));
}

bool follows(const studio::Profile& profile, const Channel& channel) {
  if (channel.use == ChannelUse::trims || channel.use == ChannelUse::pwm) return false;
  const auto own = studio::profiles::own_range(profile, *channel.dof);
  if (!own || channel.segments.size() != 1) return false;
  const Segment& s = channel.segments.front();
  return s.law == Segment::Law::continuous && s.dmx_from == 0 && s.dmx_to == 1 &&
         std::abs(s.physical_from - own->least) < 1e-9 &&
         std::abs(s.physical_to - own->most) < 1e-9;
}

std::string verb(const Channel& channel) {
  if (channel.dof) {
    const std::string name(core::info(*channel.dof).name);
    return (channel.use == ChannelUse::trims     ? "trims: "
            : channel.use == ChannelUse::repeats ? "repeats: "
                                                 : "controls: ") +
           name;
  }
  if (channel.use == ChannelUse::pwm) return "pwm: " + exact(channel.pwm_hz) + " Hz";
  return (channel.use == ChannelUse::open ? "open: " : "constant: ") +
         raw(channel.constant, channel.bytes);
}

std::string place(const Channel& channel, int next) {
  if (!channel.finer.empty()) {
    std::string slots = fmt::format(", slots: [{}", channel.offset + 1);
    for (const int slot : channel.finer) slots += fmt::format(", {}", slot + 1);
    return slots + "]";
  }
  std::string words;
  if (channel.bytes > 1) words += fmt::format(", bits: {}", 8 * channel.bytes);
  if (channel.offset != next) words += fmt::format(", slot: {}", channel.offset + 1);
  return words;
}

std::string line(const studio::Profile& profile, const Channel& channel, int next) {
  std::string words =
      "    - {" + verb(channel) + ", name: " + quoted(channel.name) + place(channel, next);
  if (channel.rest && channel.dof) words += ", rest: " + raw(*channel.rest, channel.bytes);
  const bool needs_ranges =
      (channel.dof && !follows(profile, channel)) || channel.use == ChannelUse::pwm;
  if (!needs_ranges || channel.segments.empty()) return words + "}\n";
  words += ", ranges: [";
  for (std::size_t i = 0; i < channel.segments.size(); ++i)
    words += (i > 0 ? ", " : "") + range(channel, channel.segments[i]);
  return words + "]}\n";
}

std::string optic(const studio::Optic& optic) {
  switch (optic.kind) {
    case studio::Optic::Kind::point:
      return "point";
    case studio::Optic::Kind::directional:
      return "directional";
    case studio::Optic::Kind::spot:
      return fmt::format("{{spot: {{beam: {} deg, field: {} deg}}}}",
                         exact(core::degrees(optic.beam)), exact(core::degrees(optic.field)));
    case studio::Optic::Kind::rectangle:
      return fmt::format("{{rectangle: [{}, {}]}}", exact(optic.width), exact(optic.height));
    case studio::Optic::Kind::disk:
      return fmt::format("{{disk: {{radius: {} m}}}}", exact(optic.radius));
  }
  return "point";
}

std::string primaries(const studio::Emitter& emitter) {
  std::string words;
  for (const studio::Primary& primary : emitter.primaries)
    words += fmt::format("    {}: {{chromaticity: [{}, {}], share: {}}}\n",
                         core::info(primary.dof).name, exact(primary.chromaticity.x),
                         exact(primary.chromaticity.y), exact(primary.share));
  return words;
}

std::string white_mix(const studio::Emitter& emitter) {
  std::string words = fmt::format("cct: [{} K, {} K]", exact(emitter.cct_range.least),
                                  exact(emitter.cct_range.most));
  if (emitter.tint_range.width() > 0)
    words += fmt::format(", tint: [{}, {}]", exact(emitter.tint_range.least),
                         exact(emitter.tint_range.most));
  return words;
}

std::string emitter(const studio::Emitter& emitter) {
  using Kind = studio::Emitter::Kind;
  switch (emitter.kind) {
    case Kind::dimmer:
      return fmt::format("emitter: {{dimmer: {{cct: {} K}}}}\n", exact(emitter.cct.value));
    case Kind::bicolour:
      return "emitter: {bicolour: {" + white_mix(emitter) + "}}\n";
    case Kind::mixed:
      return "emitter:\n  mixed:\n" + primaries(emitter);
    case Kind::blend: {
      std::string words = "emitter:\n  blend:\n    cct: ";
      words += fmt::format("[{} K, {} K]\n", exact(emitter.cct_range.least),
                           exact(emitter.cct_range.most));
      if (emitter.tint_range.width() > 0)
        words += fmt::format("    tint: [{}, {}]\n", exact(emitter.tint_range.least),
                             exact(emitter.tint_range.most));
      return words + primaries(emitter);
    }
  }
  return "";
}

std::string span(const char* key, core::Range angles) {
  if (angles.width() <= 0) return "";
  return fmt::format("{}: [{} deg, {} deg]\n", key, exact(core::degrees(angles.least)),
                     exact(core::degrees(angles.most)));
}

std::string curve(const studio::DimmerCurve& curve) {
  using Law = studio::DimmerCurve::Law;
  switch (curve.law) {
    case Law::linear:
      return "curve: linear\n";
    case Law::square:
      return "curve: square\n";
    case Law::s_curve:
      return "curve: s_curve\n";
    case Law::gamma:
      return "curve: {gamma: " + exact(curve.gamma) + "}\n";
    case Law::table: {
      std::string words = "curve: {table: [";
      for (std::size_t i = 0; i < curve.table.size(); ++i)
        words += (i > 0 ? ", " : "") + exact(curve.table[i]);
      return words + "]}\n";
    }
  }
  return "";
}

std::string notes(const studio::Profile& profile) {
  std::string words;
  if (!profile.assumed.empty()) {
    words += "assumed: [";
    for (std::size_t i = 0; i < profile.assumed.size(); ++i)
      words += (i > 0 ? ", " : "") + profile.assumed[i];
    words += "]\n";
  }
  if (profile.on_loss != studio::OnLoss::unknown)
    words += std::string("on_loss: ") + (profile.on_loss == studio::OnLoss::hold   ? "hold\n"
                                         : profile.on_loss == studio::OnLoss::dark ? "dark\n"
                                                                                   : "full\n");
  return words;
}

}  // namespace

std::string profile_yaml(const studio::Profile& profile, const std::string& origin) {
  std::string words;
  if (!origin.empty()) words += "# From " + quoted(origin) + ".\n";
  words += "profile: " + profile.name + "\nmaker: " + quoted(profile.maker) +
           "\nmodel: " + quoted(profile.model) + "\noutput: " + exact(profile.output.value) +
           " cd\noptic: " + optic(profile.optic) + "\n";
  if (profile.optic.attenuation == studio::Optic::Attenuation::linear)
    words += "attenuation: linear\n";
  if (profile.optic.attenuation == studio::Optic::Attenuation::none) words += "attenuation: none\n";
  words += emitter(profile.emitter) + curve(profile.curve) + span("zoom", profile.zoom) +
           span("pan", profile.pan) + span("tilt", profile.tilt) +
           "body: " + exact(profile.body_radius) + " m\n" + notes(profile) + "modes:\n";
  for (const studio::Mode& mode : profile.modes) {
    words += "  " + quoted(mode.name) + ":\n";
    int next = 0;
    for (const Channel& channel : mode.channels) {
      words += line(profile, channel, next);
      next = channel.slot(channel.bytes - 1) + 1;
    }
  }
  return words;
}

}  // namespace chiaro::importers
