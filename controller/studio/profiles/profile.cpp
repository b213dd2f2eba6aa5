// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include "controller/studio/profiles/profiles.h"
#include "controller/studio/reading/files.h"
#include "controller/studio/reading/scalars.h"
#include "controller/studio/reading/section.h"
#include "controller/studio/reading/text.h"

namespace chiaro::studio {

using namespace reading;

namespace profiles {
namespace {

/// assumed: [output, beam] - what the maker does not say. The user is told, and may measure it.
void read_assumed(const Tree* tree, Profile& profile, Report& report) {
  if (tree == nullptr) return;
  if (tree->kind != Tree::Kind::sequence) {
    report.error(*tree, "'assumed' needs a list", "assumed: [output, beam]");
    return;
  }
  const std::vector<std::string> words{"output", "beam", "colours", "cct", "pan", "tilt"};
  for (const Tree& item : tree->items)
    if (const auto index = word_among(&item, words, report))
      profile.assumed.push_back(words[*index]);
}

Profile read_profile(const Tree& tree, const std::string& name, Report& report) {
  Section section(tree, "a profile", report);
  Profile profile;
  profile.name = name;
  const Tree* own_name = section.need("profile", name);
  if (const auto stated = text(own_name, report); stated && *stated != name)
    report.error(
        *own_name,
        "this profile calls itself " + in_quotes(*stated) + ", its file is " + in_quotes(name),
        "a profile's name is its path below the fixtures folder");
  into(profile.maker, text(section.need("maker", "Generic"), report));
  into(profile.model, text(section.need("model", "the lamp's name"), report));
  if (const auto cd =
          quantity(section.need("output", "12000 cd"), Measure::intensity, {0.1, 1e8}, report))
    profile.output = {*cd};
  profile.optic = read_optic(section.need("optic", "{rectangle: [0.3, 0.3]}"), report);
  using Attenuation = Optic::Attenuation;
  into(profile.optic.attenuation,
       choice<Attenuation>(section.find("attenuation"),
                           {{"inverse_square", Attenuation::inverse_square},
                            {"linear", Attenuation::linear},
                            {"none", Attenuation::none}},
                           report));
  profile.emitter = read_emitter(section.need("emitter", "{dimmer: {cct: 3200 K}}"), report);
  profile.curve = read_curve(section.find("curve"), report);
  into(profile.zoom,
       span(section.find("zoom"), Measure::angle, {core::radians(1), core::radians(179)}, report));
  constexpr core::Range kTurns{-8 * core::kPi, 8 * core::kPi};
  into(profile.pan, span(section.find("pan"), Measure::angle, kTurns, report));
  into(profile.tilt, span(section.find("tilt"), Measure::angle, kTurns, report));
  into(profile.on_loss,
       choice<OnLoss>(section.find("on_loss"),
                      {{"hold", OnLoss::hold}, {"dark", OnLoss::dark}, {"full", OnLoss::full}},
                      report));
  read_assumed(section.find("assumed"), profile, report);
  into(profile.body_radius, quantity(section.find("body"), Measure::length, {0.01, 3}, report));
  profile.modes =
      read_modes(section.need("modes", "{1ch: [{controls: intensity}]}"), profile, report);
  section.refuse_unknown();
  return profile;
}

/// Names come from users and become paths: nothing may lead out of the folder.
bool is_profile_name(const std::string& name) {
  const bool plain = std::all_of(name.begin(), name.end(), [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '-' || c == '_' || c == '/' ||
           c == '+' || c == '.';
  });
  return plain && !name.empty() && name.size() < 200 && name.front() != '/' &&
         name.find("..") == std::string::npos;
}

/// The user's own file wins over a shipped one of the same name.
std::filesystem::path file_of(const std::string& name, const Folders& folders) {
  std::error_code code;
  const auto own = folders.own / (name + ".yaml");
  if (!folders.own.empty() && std::filesystem::is_regular_file(own, code)) return own;
  return folders.fixtures() / (name + ".yaml");
}

core::Result<std::string> profile_text(const std::string& name, const Folders& folders) {
  std::error_code code;
  if (is_profile_name(name) && std::filesystem::is_regular_file(file_of(name, folders), code))
    return read_text(file_of(name, folders));
  return core::Problem{{},
                       "there is no fixture profile " + in_quotes(name),
                       suggestion(name, profile_names(folders))};
}

}  // namespace

core::Result<Profile> parse_profile(const std::string& yaml, const std::string& name,
                                    const std::string& file) {
  const auto document = parse_tree(yaml, file);
  if (!document) return document.problems();
  Report report(file);
  report.add(document->problems);
  Profile profile = read_profile(document->root, name, report);
  if (report.any_error()) return report.sorted();
  return profile;
}

const core::Result<Profile>& Shelf::get(const std::string& name) {
  const auto known = loaded_.find(name);
  if (known != loaded_.end()) return known->second;
  const auto yaml = profile_text(name, folders_);
  if (!yaml) return loaded_.emplace(name, yaml.problems()).first->second;
  texts_[name] = *yaml;
  return loaded_.emplace(name, parse_profile(*yaml, name, file_of(name, folders_).string()))
      .first->second;
}

}  // namespace profiles

core::Result<Profile> load_profile(const std::string& name, const Folders& folders) {
  profiles::Shelf shelf(folders);
  return shelf.get(name);
}

std::vector<std::string> profile_names(const Folders& folders) {
  namespace fs = std::filesystem;
  std::vector<std::string> names;
  std::error_code code;
  for (const fs::path& folder : {folders.fixtures(), folders.own}) {
    if (folder.empty()) continue;
    for (fs::recursive_directory_iterator entry(folder, code), end; !code && entry != end;
         entry.increment(code))
      if (entry->path().extension() == ".yaml" && entry->is_regular_file(code))
        names.push_back(
            fs::relative(entry->path(), folder, code).replace_extension().generic_string());
  }
  std::sort(names.begin(), names.end());
  names.erase(std::unique(names.begin(), names.end()), names.end());
  return names;
}

}  // namespace chiaro::studio
