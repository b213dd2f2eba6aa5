// SPDX-License-Identifier: Apache-2.0
// Fixture profiles from their files; the format is told in config/fixtures/README.md.
#pragma once

#include <map>
#include <string>

#include "controller/core/result.h"
#include "controller/studio/load.h"
#include "controller/studio/reading/report.h"
#include "controller/studio/reading/tree.h"

namespace chiaro::studio::profiles {

/// Parts of a profile, one file each.
Optic read_optic(const reading::Tree* tree, reading::Report& report);
Emitter read_emitter(const reading::Tree* tree, reading::Report& report);
std::vector<Mode> read_modes(const reading::Tree* tree, const Profile& profile,
                             reading::Report& report);
/// `next_slot`: where it stands when the file does not say.
Channel read_channel(const reading::Tree& tree, int next_slot, const Profile& profile,
                     reading::Report& report);
/// Into channel.segments; the channel's use, DOF and bytes are known.
void read_ranges(const reading::Tree& tree, Channel& channel, reading::Report& report);
/// The greatest raw value of so many bytes.
double full_scale(int bytes);
/// Also the patch's `curve:` in a studio file.
DimmerCurve read_curve(const reading::Tree* tree, reading::Report& report);

/// The range of a degree of freedom that the lamp itself gives (zoom, colour, level); nothing for
/// what only a mount gives or what this lamp lacks.
std::optional<core::Range> own_range(const Profile& profile, core::Dof dof);

core::Result<Profile> parse_profile(const std::string& yaml, const std::string& name,
                                    const std::string& file);

/// Loads each profile once while a studio is read, and keeps the texts for its fingerprint.
class Shelf {
 public:
  explicit Shelf(const Folders& folders) : folders_(folders) {}
  const core::Result<Profile>& get(const std::string& name);
  /// True the first time: a broken profile is reported once, however many lamps use it.
  bool first_mention(const std::string& name) { return mentioned_[name]++ == 0; }
  const std::map<std::string, std::string>& texts() const { return texts_; }

 private:
  const Folders& folders_;
  std::map<std::string, core::Result<Profile>> loaded_;
  std::map<std::string, std::string> texts_;
  std::map<std::string, int> mentioned_;
};

}  // namespace chiaro::studio::profiles
