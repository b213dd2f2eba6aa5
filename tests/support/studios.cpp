// SPDX-License-Identifier: Apache-2.0
#include "tests/support/studios.h"

#include <algorithm>
#include <chrono>
#include <stdexcept>

#include "controller/studio/load.h"

namespace chiaro::support {

std::string studio_text(const std::string& fixtures, const std::string& more) {
  return "studio: test\n"
         "subject: {stand_in: person, eye_height: 1.55 m, at: [0, 0, 0]}\n"
         "cameras:\n"
         "  main: {at: [0, -2.6, 1.45], look_at: [0, 0, 1.35], vertical_fov: 22 deg}\n"
         "fixtures:\n" +
         fixtures +
         "outputs:\n"
         "  universe 1: {sacn: {interface: lo, rate: 40 Hz}}\n"
         "  universe 2: {sacn: {interface: lo, rate: 40 Hz}}\n"
         "exposure: {grey_card: 800 lx, white_balance: 5600 K}\n" +
         more;
}

std::string fixture_line(const std::string& name, const std::string& profile,
                         const std::string& mode, int universe, int address,
                         const std::string& more) {
  return "  " + name + ": {role: key, profile: " + profile + ", mode: " + mode +
         ", mount: {fixed: {at: [-1.5, -1.5, 2.2], aim_at: [0, 0, 1.4]}}, patch: {universe: " +
         std::to_string(universe) + ", address: " + std::to_string(address) + "}" +
         (more.empty() ? "" : ", " + more) + "}\n";
}

studio::Studio studio_from(const std::string& text) {
  const std::filesystem::path config = std::filesystem::path(CHIARO_SOURCE) / "config";
  auto loaded = studio::parse_studio(text, config, studio::Folders{config});
  if (!loaded) throw std::runtime_error(core::to_string(loaded.problems()));
  return std::move(loaded->studio);
}

const rig::AllowedLevels& allow(rig::Governor& governor, const studio::Studio& studio,
                                const std::vector<core::FixtureState>& states,
                                ports::TimePoint now) {
  static std::uint64_t fade = 0;
  rig::Wanted wanted;
  wanted.studio_fingerprint = studio.fingerprint;
  wanted.posted_ns = now.time_since_epoch().count();
  auto& hand = wanted.sources[static_cast<std::size_t>(rig::Source::manual)];
  hand.fixtures = states;
  hand.fade_id = ++fade;
  // Axes travel at a person's leave and at their speed: time passes until they have arrived.
  governor.arm_motion(true);
  governor.take(wanted, now);
  static ports::TimePoint later{};
  later = std::max(later, now);
  const rig::AllowedLevels* levels = &governor.step(later);
  const auto arrived = [&] {
    for (std::size_t i = 0; i < states.size(); ++i)
      for (const core::Dof dof :
           {core::Dof::pan, core::Dof::tilt, core::Dof::arc, core::Dof::track})
        if (states[i].has(dof) && levels->fixtures()[i].has(dof) &&
            levels->fixtures()[i].get(dof) != states[i].get(dof))
          return false;
    return true;
  };
  for (int step = 0; step < 2000 && !arrived(); ++step)
    levels = &governor.step(later += std::chrono::milliseconds(50));
  return *levels;
}

}  // namespace chiaro::support
