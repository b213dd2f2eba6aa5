// SPDX-License-Identifier: Apache-2.0
// QLC+ workspaces: fixtures and scenes.
#include <algorithm>
#include <fmt/format.h>
#include <map>

#include "controller/importers/import_fixture.h"
#include "controller/importers/qxf.h"
#include "controller/importers/show.h"
#include "controller/importers/show_names.h"
#include "controller/importers/xml.h"

namespace chiaro::importers {
namespace {

constexpr std::size_t kMostLamps = 2000;

/// Where a fixture of the show begins, for its scenes.
struct Patched {
  int universe = 1, address = 1, channels = 1;
};

class Reader {
 public:
  Reader(const Definitions& definitions, Show& show) : definitions_(definitions), show_(show) {}

  void fixture(pugi::xml_node node) {
    Patched at;
    at.universe = whole_in(node.child_value("Universe"), 0, 63998, 0) + 1;
    at.address = whole_in(node.child_value("Address"), 0, 511, 0) + 1;
    at.channels = whole_in(node.child_value("Channels"), 1, 512, 1);
    patched_[whole_in(node.child_value("ID"), 0, 1'000'000, -1)] = at;
    const std::string maker = node.child_value("Manufacturer"), model = node.child_value("Model");
    const std::string name = node.child_value("Name");
    if (show_.lamps.size() + static_cast<std::size_t>(at.channels) > kMostLamps) return;
    if (maker == "Generic" && model == "Generic") return dimmers(name, at);
    const Imported* known = definition(maker, model);
    if (known == nullptr) {
      show_.left_out.push_back(
          fmt::format("fixture '{}': there is no usable definition of {} {}", name, maker, model));
      return;
    }
    lamp(name, known->profile, node.child_value("Mode"), at);
  }

  void scene(pugi::xml_node node) {
    ShowScene scene{node.attribute("Name").as_string(), {}};
    for (const pugi::xml_node values : node.children("FixtureVal")) {
      const auto at = patched_.find(whole_in(values.attribute("ID").as_string(), 0, 1'000'000, -2));
      if (at != patched_.end()) levels(values.child_value(), at->second, scene);
    }
    if (!scene.levels.empty() && show_.scenes.size() < 1000)
      show_.scenes.push_back(std::move(scene));
  }

 private:
  const Imported* definition(const std::string& maker, const std::string& model) {
    const auto key = std::pair(maker, model);
    const auto known = known_.find(key);
    if (known != known_.end()) return known->second ? &*known->second : nullptr;
    auto& found = known_[key] = definitions_(maker, model);
    if (found) show_.profiles.push_back(found->profile);
    return found ? &*found : nullptr;
  }

  /// A generic fixture is a row of dimmers: each is a lamp.
  void dimmers(const std::string& name, const Patched& at) {
    for (int i = 0; i < at.channels; ++i)
      show_.lamps.push_back(
          {names_.fresh(at.channels > 1 ? fmt::format("{} {}", name, i + 1) : name),
           "generic/dimmer",
           "1ch",
           false,
           at.universe,
           at.address + i,
           {},
           {}});
  }

  void lamp(const std::string& name, const studio::Profile& profile, const std::string& mode,
            const Patched& at) {
    const auto found = std::find_if(profile.modes.begin(), profile.modes.end(),
                                    [&](const studio::Mode& m) { return m.name == mode; });
    if (found == profile.modes.end()) {
      show_.left_out.push_back(
          fmt::format("fixture '{}': its mode '{}' sets no light, or is not known", name, mode));
      return;
    }
    show_.lamps.push_back({names_.fresh(name),
                           profile.name,
                           found->name,
                           profile.pan.width() > 0,
                           at.universe,
                           at.address,
                           {},
                           {}});
  }

  /// "0,255,3,128": channel and value in turn.
  static void levels(std::string_view words, const Patched& at, ShowScene& scene) {
    std::vector<int> numbers;
    while (!words.empty() && numbers.size() < 2048) {
      const std::size_t end = std::min(words.find(','), words.size());
      numbers.push_back(whole_in(words.substr(0, end), 0, 511, -1));
      words.remove_prefix(std::min(end + 1, words.size()));
    }
    for (std::size_t i = 0; i + 1 < numbers.size(); i += 2)
      if (numbers[i] >= 0 && numbers[i] < at.channels && numbers[i + 1] >= 0 &&
          numbers[i + 1] <= 255 && at.address + numbers[i] <= 512)
        scene.levels.push_back({at.universe, at.address + numbers[i], numbers[i + 1]});
  }

  const Definitions& definitions_;
  Show& show_;
  ShowNames names_;
  std::map<int, Patched> patched_;
  std::map<std::pair<std::string, std::string>, std::optional<Imported>> known_;
};

}  // namespace

Definitions definitions_in(const std::filesystem::path& library) {
  return [library](const std::string& maker, const std::string& model) -> std::optional<Imported> {
    namespace fs = std::filesystem;
    // Folders are named like the maker; the file's own words decide.
    std::error_code code;
    for (const char* gap : {"_", " ", "-"}) {
      std::string folder = maker;
      for (std::size_t at; (at = folder.find(' ')) != std::string::npos && *gap != ' ';)
        folder.replace(at, 1, gap);
      if (folder.empty() || folder.find('/') != std::string::npos || folder.front() == '.')
        continue;
      for (fs::directory_iterator entry(library / folder, code), end; !code && entry != end;
           entry.increment(code)) {
        if (entry->path().extension() != ".qxf") continue;
        const auto text = bytes_of(entry->path());
        if (!text || text->find("<Model>" + model + "</Model>") == std::string::npos) continue;
        const auto read = read_qxf(*text, entry->path().string());
        if (!read || read->model != model) continue;
        auto made = profile_of(*read, entry->path().string());
        return made ? std::optional(std::move(*made)) : std::nullopt;
      }
    }
    return std::nullopt;
  };
}

core::Result<Show> read_qxw(const std::string& text, const std::string& file,
                            const Definitions& definitions) {
  pugi::xml_document document;
  if (const auto read = read_xml(text, file, document); !read) return read.problems();
  const pugi::xml_node engine = document.child("Workspace").child("Engine");
  if (!engine)
    return core::Problem{
        {file, 0, 0}, "this is no QLC+ workspace", "a .qxw file holds <Workspace><Engine>", false};
  Show show;
  Reader reader(definitions, show);
  for (const pugi::xml_node node : engine.children("Fixture")) reader.fixture(node);
  std::map<std::string, int> others;
  for (const pugi::xml_node node : engine.children("Function")) {
    const std::string kind = node.attribute("Type").as_string();
    if (kind == "Scene")
      reader.scene(node);
    else
      ++others[kind.substr(0, 40)];
  }
  for (const auto& [kind, count] : others)
    show.left_out.push_back(
        fmt::format("{} of kind {}: looks stand still",
                    count == 1 ? "a function" : std::to_string(count) + " functions", kind));
  if (document.child("Workspace").child("VirtualConsole"))
    show.left_out.emplace_back("the virtual console: Chiaro has its own panel");
  return show;
}

}  // namespace chiaro::importers
