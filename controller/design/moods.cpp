// SPDX-License-Identifier: Apache-2.0
#include "controller/design/moods.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <locale>
#include <sstream>
#include <yaml-cpp/yaml.h>

#include "controller/core/picture_file.h"
#include "controller/design/words.h"

namespace chiaro::design {
namespace {

const std::vector<std::string> kKeys{"title",         "sentence",   "tags",
                                     "words",         "attainable", "sitter_turn",
                                     "white_balance", "exposure",   "targets"};

/// One mood.yaml; every complaint has a line.
class MoodFile {
 public:
  MoodFile(const std::filesystem::path& file, core::Problems& problems)
      : folder_(file.parent_path()), file_(file.string()), problems_(problems) {}

  std::optional<measure::Targets> read_targets() {
    const std::size_t before = problems_.size();
    const auto root = load();
    if (!root) return std::nullopt;
    const measure::Targets found = targets((*root)["targets"] ? (*root)["targets"] : *root);
    if (!found.mean && !found.edge && !found.histogram)
      complain(*root, "there are no targets in this file", "see targets: in a shipped mood.yaml");
    return problems_.size() == before ? std::optional(found) : std::nullopt;
  }

  std::optional<Mood> read() {
    const std::size_t before = problems_.size();
    const auto loaded = load();
    if (!loaded) return std::nullopt;
    const YAML::Node& root = *loaded;
    Mood mood;
    mood.name = folder_.filename().string();
    mood.picture = folder_ / "picture.png";
    refuse_unknown(root);
    read_into(root, mood);
    if (!std::filesystem::exists(mood.picture))
      problems_.push_back({{file_}, "there is no picture.png beside it", "put the picture there"});
    return problems_.size() == before ? std::optional(mood) : std::nullopt;
  }

 private:
  std::optional<YAML::Node> load() {
    try {
      YAML::Node root = YAML::LoadFile(file_);
      if (root.IsMap()) return root;
      complain(root, "expected a mapping with title, sentence and tags", "see the shipped moods");
    } catch (const YAML::Exception& error) {
      problems_.push_back(
          {place(error.mark), "the file cannot be read: " + error.msg, "mend or remove it"});
    }
    return std::nullopt;
  }
  core::Place place(const YAML::Mark& mark) const {
    return mark.is_null() ? core::Place{file_} : core::Place{file_, mark.line + 1, mark.column + 1};
  }
  void complain(const YAML::Node& node, std::string what, std::string remedy) {
    problems_.push_back({place(node.Mark()), std::move(what), std::move(remedy)});
  }
  void refuse_unknown(const YAML::Node& root) {
    for (const auto& entry : root) {
      const std::string key = entry.first.Scalar();
      if (std::find(kKeys.begin(), kKeys.end(), key) != kKeys.end()) continue;
      const std::string near = core::nearest_name(key, kKeys);
      complain(entry.first, "a mood has no \"" + key + "\"",
               near.empty() ? "remove it" : "did you mean \"" + near + "\"?");
    }
  }
  template <class T>
  std::optional<T> get(const YAML::Node& node, const char* expected) {
    if (!node) return std::nullopt;
    try {
      return node.as<T>();
    } catch (const YAML::Exception&) {
      complain(node, std::string("expected ") + expected, "see the shipped moods");
      return std::nullopt;
    }
  }
  void read_into(const YAML::Node& root, Mood& mood) {
    mood.title = get<std::string>(root["title"], "a title").value_or(mood.name);
    mood.sentence = get<std::string>(root["sentence"], "a sentence").value_or("");
    if (root["tags"]) mood.tags = tags(root["tags"]);
    mood.words = get<std::vector<std::string>>(root["words"], "a list of words")
                     .value_or(std::vector<std::string>{});
    mood.sitter_turn = core::radians(quantity(root["sitter_turn"], "deg", {-180, 180}).value_or(0));
    if (const auto cct = quantity(root["white_balance"], "K", {1500, 20000}))
      mood.white_balance = core::Kelvin{*cct};
    mood.exposure_stops = quantity(root["exposure"], "stops", {-20, 20});
    mood.attainable = get<bool>(root["attainable"], "true or false").value_or(true);
    if (root["targets"]) mood.targets = targets(root["targets"]);
  }
  core::MoodTags tags(const YAML::Node& node) {
    core::MoodTags said;
    const auto& kinds = core::mood_tag_kinds();
    std::vector<std::string> names;
    for (const auto& kind : kinds) names.push_back(kind.name);
    if (!node.IsMap()) {
      complain(node, "tags name the light's pattern, tone, hardness and colour",
               "tags: {pattern: loop, tone: mid key, hardness: hard, colour: warm}");
      return said;
    }
    for (const auto& entry : node) {
      const std::size_t kind = index_among(entry.first, "kind of tag", names);
      if (kind == names.size()) continue;
      const std::size_t word = index_among(entry.second, names[kind], kinds[kind].words);
      if (word < kinds[kind].words.size()) said.at(kind) = kinds[kind].words[word];
    }
    return said;
  }
  /// The place of what stands there among `known`; known.size() after a complaint.
  std::size_t index_among(const YAML::Node& node, const std::string& what,
                          const std::vector<std::string>& known) {
    const std::string word = node.IsScalar() ? node.Scalar() : "";
    const auto found = std::find(known.begin(), known.end(), word);
    if (found != known.end()) return static_cast<std::size_t>(found - known.begin());
    const std::string near = core::nearest_name(word, known);
    std::string all;
    for (const std::string& each : known) all += (all.empty() ? "" : ", ") + each;
    complain(node, "\"" + word + "\" is no " + what,
             near.empty() ? "one of: " + all : "did you mean \"" + near + "\"?");
    return known.size();
  }
  /// "12 deg": a number with the one unit that is expected here.
  std::optional<double> quantity(const YAML::Node& node, const std::string& unit,
                                 core::Range range) {
    const auto text = get<std::string>(node, ("a number in " + unit).c_str());
    if (!text) return std::nullopt;
    std::istringstream words(*text);
    words.imbue(std::locale::classic());
    double value = 0;
    std::string said, more;
    if (words >> value >> said && said == unit && !(words >> more) && range.contains(value))
      return value;
    complain(node,
             "expected a number in " + unit + ", from " + number(range.least, 0) + " to " +
                 number(range.most, 0),
             "write it as in \"" + number((range.least + range.most) / 2, 0) + " " + unit + "\"");
    return std::nullopt;
  }
  measure::Targets targets(const YAML::Node& node) {
    measure::Targets targets;
    targets.edge = get<double>(node["edge"], "a number");
    targets.mean = get<double>(node["mean"], "a number");
    targets.gradient = get<double>(node["gradient"], "a number");
    targets.variance = get<double>(node["variance"], "a number");
    targets.contrast = get<double>(node["contrast"], "a number");
    const auto shares = get<std::vector<double>>(node["histogram"], "256 numbers");
    if (!shares) return targets;
    if (shares->size() == 256)
      std::copy(shares->begin(), shares->end(), targets.histogram.emplace().begin());
    else
      complain(node["histogram"],
               "a histogram has 256 numbers, this one " + std::to_string(shares->size()),
               "draw the mood again");
    return targets;
  }

  const std::filesystem::path folder_;
  const std::string file_;
  core::Problems& problems_;
};

}  // namespace

std::string turn_in_words(double sitter_turn) {
  const long turn = std::lround(core::degrees(sitter_turn));
  if (turn == 0) return "";
  return std::to_string(std::abs(turn)) + "° to camera " + (turn < 0 ? "left" : "right");
}

Moods load_moods(const std::filesystem::path& folder) {
  Moods result;
  std::error_code error;
  std::vector<std::filesystem::path> folders;
  for (const auto& entry : std::filesystem::directory_iterator(folder, error))
    if (std::filesystem::exists(entry.path() / "mood.yaml", error)) folders.push_back(entry.path());
  std::sort(folders.begin(), folders.end());
  for (const auto& each : folders)
    if (auto mood = MoodFile(each / "mood.yaml", result.problems).read())
      result.moods.push_back(std::move(*mood));
  return result;
}

core::Result<measure::Targets> load_targets(const std::filesystem::path& file) {
  core::Problems problems;
  if (const auto targets = MoodFile(file, problems).read_targets()) return *targets;
  return problems;
}

core::Result<ExampleGoal> goal_of(const Mood& mood, Objective objective) {
  auto picture = core::read_picture(mood.picture);
  if (!picture) return picture.problems();
  ExampleGoal goal;
  goal.name = mood.name;
  goal.exemplar = core::linear_at_most(*picture);
  goal.objective = objective;
  goal.targets3d = mood.targets;
  goal.drawn_here = mood.targets.has_value();
  goal.sitter_turn = mood.sitter_turn;
  return goal;
}

}  // namespace chiaro::design
