// SPDX-License-Identifier: Apache-2.0
// From any library's description to our profile: which channel carries what, and what to assume
// where the library is silent.
#include "controller/importers/library_fixture.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <fmt/format.h>

#include "controller/studio/profiles/profiles.h"

namespace chiaro::importers {
namespace {

using core::Dof;
using studio::Channel;
using studio::ChannelUse;
using studio::Emitter;
using studio::Segment;

/// An LED of that colour: chromaticity, and how bright it is beside the others in usual lamps.
struct Usual {
  Meaning meaning;
  Dof dof;
  core::Chromaticity colour;
  double weight;
};
const std::array<Usual, 8>& usual_leds() {
  static const std::array<Usual, 8> kLeds{
      Usual{Meaning::red, Dof::red, {0.690, 0.308}, 1.0},
      Usual{Meaning::green, Dof::green, {0.170, 0.700}, 2.4},
      Usual{Meaning::blue, Dof::blue, {0.140, 0.045}, 0.32},
      Usual{Meaning::white, Dof::white, core::white_chromaticity({5600}), 3.9},
      Usual{Meaning::warm_white, Dof::warm_white, core::white_chromaticity({3000}), 3.4},
      Usual{Meaning::amber, Dof::amber, {0.570, 0.420}, 1.4},
      Usual{Meaning::lime, Dof::lime, {0.410, 0.560}, 2.8},
      Usual{Meaning::cyan, Dof::cyan, {0.080, 0.440}, 1.2}};
  return kLeds;
}

const Usual* usual(Dof dof) {
  for (const Usual& led : usual_leds())
    if (led.dof == dof) return &led;
  return nullptr;
}

struct Carried {
  Dof dof;
  bool inverted = false;
};
/// The degree of freedom that a channel of this meaning carries.
std::optional<Carried> carried(Meaning meaning) {
  switch (meaning) {
    case Meaning::master:
    case Meaning::intensity:
      return Carried{Dof::intensity};
    case Meaning::cut_red:
      return Carried{Dof::red, true};
    case Meaning::cut_green:
      return Carried{Dof::green, true};
    case Meaning::cut_blue:
      return Carried{Dof::blue, true};
    case Meaning::cct:
      return Carried{Dof::cct};
    case Meaning::tint:
      return Carried{Dof::tint};
    case Meaning::crossfade:
      return Carried{Dof::crossfade};
    case Meaning::pan:
      return Carried{Dof::pan};
    case Meaning::tilt:
      return Carried{Dof::tilt};
    case Meaning::zoom:
      return Carried{Dof::zoom};
    default:
      break;
  }
  for (const Usual& led : usual_leds())
    if (led.meaning == meaning) return Carried{led.dof};
  return std::nullopt;
}

bool is_drive(Dof dof) { return dof >= Dof::red && dof <= Dof::cyan; }

/// What the whole lamp has, over all its modes.
struct Abilities {
  core::Range zoom{0, 0}, pan{0, 0}, tilt{0, 0};
};

bool has_any(const LibraryMode& mode, Meaning meaning) {
  return std::any_of(mode.channels.begin(), mode.channels.end(),
                     [&](const LibraryChannel& c) { return c.meaning == meaning; });
}

/// One mode on its way: which channels take part, and as what.
class ModeMaker {
 public:
  ModeMaker(const LibraryMode& mode, const Abilities& abilities)
      : mode_(mode), abilities_(abilities), meanings_(mode.channels.size()) {
    for (std::size_t i = 0; i < meanings_.size(); ++i) meanings_[i] = mode.channels[i].meaning;
    settle_colours();
    settle_level();
  }
  bool gives_light() const { return light_; }

  studio::Mode made() const {
    studio::Mode made{mode_.name, std::max(1, mode_.footprint), {}};
    std::array<bool, core::kDofs> led{};
    for (std::size_t i = 0; i < mode_.channels.size(); ++i)
      made.channels.push_back(channel(mode_.channels[i], meanings_[i], led));
    std::sort(made.channels.begin(), made.channels.end(),
              [](const Channel& a, const Channel& b) { return a.offset < b.offset; });
    return made;
  }

 private:
  std::size_t of(Meaning meaning) const {
    return static_cast<std::size_t>(std::count(meanings_.begin(), meanings_.end(), meaning));
  }
  void turn(Meaning from, Meaning to) {
    std::replace(meanings_.begin(), meanings_.end(), from, to);
  }

  /// Filters mix a colour when all three are there; one LED colour alone is the lamp's light.
  void settle_colours() {
    const bool filters =
        of(Meaning::cut_red) > 0 && of(Meaning::cut_green) > 0 && of(Meaning::cut_blue) > 0;
    const bool leds = of(Meaning::red) > 0 || of(Meaning::green) > 0 || of(Meaning::blue) > 0;
    if (!filters || leds)
      for (const Meaning cut : {Meaning::cut_red, Meaning::cut_green, Meaning::cut_blue})
        turn(cut, Meaning::unknown);
    std::size_t colours = filters && !leds ? 3 : 0;
    Meaning only = Meaning::unknown;
    for (const Usual& led : usual_leds())
      if (of(led.meaning) > 0) ++colours, only = led.meaning;
    if (colours != 1 || only == Meaning::unknown) return;
    const bool dimmer = of(Meaning::master) + of(Meaning::intensity) > 0;
    if (!dimmer) {
      turn(only, Meaning::intensity);
    } else {
      full_ = only;
    }
  }

  /// One master dims; cells then stay full. Without any dimmer the colours are the dimmers, or the
  /// shutter at least switches.
  void settle_level() {
    if (of(Meaning::master) > 0) cells_full_ = of(Meaning::intensity) > 0;
    const bool colours = std::any_of(meanings_.begin(), meanings_.end(), [](Meaning m) {
      const auto what = carried(m);
      return what && is_drive(what->dof) && !what->inverted;
    });
    light_ = of(Meaning::master) + of(Meaning::intensity) > 0 || colours;
    if (light_) return;
    if (of(Meaning::uv) > 0) {
      turn(Meaning::uv, Meaning::intensity);
      light_ = true;
      return;
    }
    for (std::size_t i = 0; i < meanings_.size(); ++i) {
      const LibraryChannel& channel = mode_.channels[i];
      if (!channel.closed || !channel.lit || *channel.closed == *channel.lit) continue;
      if (!switched_ || channel.meaning == Meaning::shutter) switched_ = i;
    }
    // A lamp that burns for as long as it has mains can at least be aimed.
    light_ = switched_ || of(Meaning::pan) + of(Meaning::tilt) > 0;
  }

  Channel held(Channel channel, const LibraryChannel& from, double fraction) const {
    channel.use = from.meaning == Meaning::shutter ? ChannelUse::open : ChannelUse::constant;
    channel.dof.reset();
    channel.constant = fraction;
    return channel;
  }

  /// Where the library does not say what raw values mean.
  std::vector<Segment> whole_range(const LibraryChannel& from, Carried what) const {
    core::Range range{0, 1};
    if (what.dof == Dof::pan) range = abilities_.pan;
    if (what.dof == Dof::tilt) range = abilities_.tilt;
    if (what.dof == Dof::zoom) range = abilities_.zoom;
    if (what.inverted != from.backwards) std::swap(range.least, range.most);
    return {{0, 1, range.least, range.most, Segment::Law::continuous}};
  }

  Channel switched(Channel channel, const LibraryChannel& from) const {
    channel.dof = Dof::intensity;
    const double low = std::min(*from.closed, *from.lit), high = std::max(*from.closed, *from.lit);
    const bool rises = *from.closed < *from.lit;
    channel.segments = {{low, low, rises ? 0.0 : 1.0, rises ? 0.0 : 1.0, Segment::Law::neutral},
                        {high, high, rises ? 1.0 : 0.0, rises ? 1.0 : 0.0, Segment::Law::neutral}};
    return channel;
  }

  Channel channel(const LibraryChannel& from, Meaning meaning,
                  std::array<bool, core::kDofs>& led) const {
    Channel channel;
    channel.name = from.name;
    channel.bytes = static_cast<int>(from.slots.size());
    channel.offset = from.slots.front();
    bool apart = false;
    for (std::size_t i = 1; i < from.slots.size(); ++i)
      apart = apart || from.slots[i] != from.slots[i - 1] + 1;
    if (apart) channel.finer.assign(from.slots.begin() + 1, from.slots.end());
    if (switched_ && &mode_.channels[*switched_] == &from) return switched(channel, from);
    const auto what = carried(meaning);
    if (meaning == Meaning::pwm && !from.segments.empty()) {
      channel.use = ChannelUse::pwm;
      channel.segments = from.segments;
      channel.pwm_hz = fastest(from.segments);
      channel.constant = studio::fraction_of(from.segments, channel.pwm_hz);
      return channel;
    }
    if (!what || (what->dof == Dof::cct && from.segments.empty()) ||
        (what->dof == Dof::zoom && from.segments.empty() && abilities_.zoom.width() <= 0))
      return held(channel, from, from.held);
    if ((cells_full_ && meaning == Meaning::intensity) || (full_ && meaning == *full_))
      return held(channel, from, 1);
    channel.dof = what->dof;
    channel.segments = from.segments.empty() ? whole_range(from, *what) : from.segments;
    if (what->dof == Dof::pan || what->dof == Dof::tilt)
      channel.rest = studio::fraction_of(channel.segments, 0);
    bool& seen = led[core::index_of(what->dof)];
    if (seen) channel.use = ChannelUse::repeats;
    seen = true;
    return channel;
  }

  static double fastest(const std::vector<Segment>& segments) {
    double most = 1;
    for (const Segment& s : segments)
      if (s.law == Segment::Law::continuous)
        most = std::max({most, s.physical_from, s.physical_to});
    return most;
  }

  const LibraryMode& mode_;
  const Abilities& abilities_;
  std::vector<Meaning> meanings_;
  std::optional<Meaning> full_;          ///< the lamp's only colour, dimmed by a dimmer
  std::optional<std::size_t> switched_;  ///< the shutter that must do for a dimmer
  bool cells_full_ = false, light_ = false;
};

bool any_mode_has(const std::vector<studio::Mode>& modes, Dof dof) {
  for (const studio::Mode& mode : modes)
    for (const Channel& channel : mode.channels)
      if (channel.dof == dof) return true;
  return false;
}

void assume(studio::Profile& profile, const std::string& what) {
  if (std::find(profile.assumed.begin(), profile.assumed.end(), what) == profile.assumed.end())
    profile.assumed.push_back(what);
}

/// The range over which a channel of that DOF is continuous.
core::Range reach(const std::vector<studio::Mode>& modes, Dof dof) {
  core::Range range{1e9, -1e9};
  for (const studio::Mode& mode : modes)
    for (const Channel& channel : mode.channels)
      if (channel.dof == dof)
        for (const Segment& s : channel.segments) {
          if (s.law == Segment::Law::no_effect) continue;
          range.least = std::min({range.least, s.physical_from, s.physical_to});
          range.most = std::max({range.most, s.physical_from, s.physical_to});
        }
  return range.least <= range.most ? range : core::Range{0, 0};
}

std::vector<studio::Primary> primaries(const LibraryFixture& fixture, studio::Profile& profile) {
  std::vector<studio::Primary> all;
  double sum = 0;
  for (const core::DofInfo& dof : core::dofs()) {
    if (!is_drive(dof.dof) || !any_mode_has(profile.modes, dof.dof)) continue;
    const Usual& led = *usual(dof.dof);
    studio::Primary primary{dof.dof, led.colour, led.weight};
    const auto known = std::find_if(fixture.primaries.begin(), fixture.primaries.end(),
                                    [&](const studio::Primary& p) { return p.dof == dof.dof; });
    if (known != fixture.primaries.end()) {
      primary.chromaticity = known->chromaticity;
      if (fixture.shares_known) primary.share = known->share;
    }
    if (known == fixture.primaries.end() || !fixture.shares_known) assume(profile, "colours");
    sum += primary.share;
    all.push_back(primary);
  }
  for (studio::Primary& primary : all)
    primary.share = sum > 0 ? primary.share / sum : 1.0 / static_cast<double>(all.size());
  return all;
}

void set_emitter(const LibraryFixture& fixture, studio::Profile& profile) {
  Emitter& emitter = profile.emitter;
  emitter.primaries = primaries(fixture, profile);
  const bool cct = any_mode_has(profile.modes, Dof::cct);
  if (cct) emitter.cct_range = reach(profile.modes, Dof::cct);
  emitter.tint_range = reach(profile.modes, Dof::tint);
  const bool colours = emitter.primaries.size() >= 2;
  const bool fades = any_mode_has(profile.modes, Dof::crossfade);
  emitter.kind = colours && cct && fades ? Emitter::Kind::blend
                 : colours               ? Emitter::Kind::mixed
                 : cct                   ? Emitter::Kind::bicolour
                                         : Emitter::Kind::dimmer;
  if (emitter.kind != Emitter::Kind::dimmer) return;
  emitter.cct = {std::clamp(fixture.cct.value_or(5600), 1000.0, 25000.0)};
  if (!fixture.cct) assume(profile, "cct");
}

/// Channels that this kind of emitter cannot answer to are held: white mixes at neutral, a
/// crossfade at the colours.
void hold_what_the_emitter_lacks(studio::Profile& profile) {
  const Emitter::Kind kind = profile.emitter.kind;
  for (studio::Mode& mode : profile.modes)
    for (Channel& channel : mode.channels) {
      if (!channel.dof) continue;
      const Dof dof = *channel.dof;
      const bool white = dof == Dof::cct || dof == Dof::tint;
      const bool lost = (white && !profile.emitter.has_white_mix()) ||
                        (dof == Dof::crossfade && kind != Emitter::Kind::blend) ||
                        (is_drive(dof) && profile.emitter.primaries.size() < 2);
      if (!lost) continue;
      const double at = dof == Dof::cct ? 5600 : is_drive(dof) || dof == Dof::crossfade ? 1 : 0;
      channel.constant = studio::fraction_of(channel.segments, at);
      channel.dof.reset();
      channel.rest.reset();
      channel.segments.clear();
      channel.use = ChannelUse::constant;
    }
}

double usual_lumens(const LibraryFixture& fixture) {
  // Lumens out of the lens per watt at the plug: LEDs and discharge lamps about 35, halogen 10.
  const bool halogen = fixture.cct && *fixture.cct < 3400;
  return fixture.watts.value_or(100) * (halogen ? 10 : 35);
}

void set_optic(const LibraryFixture& fixture, studio::Profile& profile) {
  studio::Optic& optic = profile.optic;
  optic.kind = studio::Optic::Kind::spot;
  const core::Range beam = fixture.beam.value_or(core::Range{core::radians(25), core::radians(25)});
  if (!fixture.beam) assume(profile, "beam");
  const auto sane = [](double angle) {
    return std::clamp(angle, core::radians(1), core::radians(170));
  };
  optic.beam = sane(0.5 * (beam.least + beam.most));
  optic.field = sane(std::max(optic.beam, fixture.field.value_or(1.5 * optic.beam)));
  if (fixture.optic) {
    const studio::Optic shape = *fixture.optic;
    optic.kind = shape.kind;
    optic.width = shape.width;
    optic.height = shape.height;
    optic.radius = shape.radius;
  }
  const double lumens = fixture.lumens.value_or(usual_lumens(fixture));
  // The same over the cone within which half of the intensity is left.
  const double cone = 2 * core::kPi * (1 - std::cos(0.5 * optic.beam));
  profile.output = {std::clamp(fixture.candela.value_or(0.6 * lumens / cone), 1.0, 1e8)};
  if (!fixture.candela && !fixture.lumens) assume(profile, "output");
}

std::string mode_name(const std::string& given, const std::vector<studio::Mode>& modes) {
  const std::string wish = given.empty() ? "mode" : given;
  std::string name = wish;
  const auto taken = [&] {
    return std::any_of(modes.begin(), modes.end(), [&](const auto& m) { return m.name == name; });
  };
  for (int i = 2; taken(); ++i) name = fmt::format("{} ({})", wish, i);
  return name;
}

Abilities abilities_of(const LibraryFixture& fixture, studio::Profile& profile) {
  Abilities can;
  const auto has = [&](Meaning meaning) {
    return std::any_of(fixture.modes.begin(), fixture.modes.end(),
                       [&](const LibraryMode& mode) { return has_any(mode, meaning); });
  };
  const auto turn = [&](Meaning meaning, double known, double usual_turn, const char* word) {
    if (!has(meaning)) return core::Range{0, 0};
    if (known <= 0) assume(profile, word);
    const double half = 0.5 * (known > 0 ? std::min(known, 8 * core::kPi) : usual_turn);
    return core::Range{-half, half};
  };
  can.pan = turn(Meaning::pan, fixture.pan_turn, core::radians(540), "pan");
  can.tilt = turn(Meaning::tilt, fixture.tilt_turn, core::radians(270), "tilt");
  if (has(Meaning::zoom) && fixture.beam && fixture.beam->width() > core::radians(0.5))
    can.zoom = {std::clamp(fixture.beam->least, core::radians(1), core::radians(170)),
                std::clamp(fixture.beam->most, core::radians(1), core::radians(170))};
  return can;
}

core::Problem refused(const std::string& file, std::string what) {
  return {{file, 0, 0},
          std::move(what),
          "Chiaro sets the level, colour and aim of lamps; patch this in a lighting desk",
          false};
}

}  // namespace

std::string slug(const std::string& words) {
  std::string out;
  for (const char c : words) {
    const auto u = static_cast<unsigned char>(c);
    if (u < 128 && std::isalnum(u) != 0)
      out += static_cast<char>(std::tolower(u));
    else if (c == '+' || c == '.')
      out += c;
    else if (!out.empty() && out.back() != '-')
      out += '-';
    if (out.size() >= 60) break;
  }
  while (!out.empty() && (out.back() == '-' || out.back() == '.')) out.pop_back();
  while (!out.empty() && (out.front() == '-' || out.front() == '.')) out.erase(0, 1);
  for (std::size_t at; (at = out.find("..")) != std::string::npos;) out.erase(at, 1);
  return out.empty() ? "unnamed" : out;
}

core::Result<Imported> profile_of(const LibraryFixture& fixture, const std::string& file) {
  Imported out;
  studio::Profile& profile = out.profile;
  profile.name = slug(fixture.maker) + "/" + slug(fixture.model);
  profile.maker = fixture.maker.empty() ? "Unknown" : fixture.maker;
  profile.model = fixture.model.empty() ? "Unnamed" : fixture.model;
  profile.assumed = fixture.assumed;
  if (fixture.modes.empty()) return refused(file, "this fixture has no mode");
  const Abilities abilities = abilities_of(fixture, profile);
  for (const LibraryMode& mode : fixture.modes) {
    const ModeMaker maker(mode, abilities);
    if (mode.channels.empty() || !maker.gives_light()) {
      out.left_out.push_back("mode '" + mode.name +
                             "': no channel of it sets the level or colour of light");
      continue;
    }
    if (mode.footprint > 512) {
      out.left_out.push_back(fmt::format("mode '{}': it takes {} slots, a universe has 512",
                                         mode.name, mode.footprint));
      continue;
    }
    profile.modes.push_back(maker.made());
    profile.modes.back().name =
        mode_name(mode.name, {profile.modes.begin(), profile.modes.end() - 1});
  }
  if (profile.modes.empty())
    return refused(file, "no channel of this " +
                             (fixture.kind.empty() ? std::string("fixture") : fixture.kind) +
                             " sets the level or colour of light");
  profile.zoom = abilities.zoom.width() > 0 ? abilities.zoom : reach(profile.modes, Dof::zoom);
  profile.pan = reach(profile.modes, Dof::pan);
  profile.tilt = reach(profile.modes, Dof::tilt);
  set_emitter(fixture, profile);
  hold_what_the_emitter_lacks(profile);
  set_optic(fixture, profile);
  if (fixture.widest > 0) profile.body_radius = std::clamp(0.5 * fixture.widest, 0.05, 1.5);
  // What the reader of profiles would refuse must be refused here, where the file is known.
  auto read = studio::profiles::parse_profile(profile_yaml(profile, ""), profile.name, file);
  if (!read) return read.problems();
  out.profile = std::move(*read);
  return out;
}

}  // namespace chiaro::importers
