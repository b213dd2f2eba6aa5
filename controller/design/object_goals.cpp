// SPDX-License-Identifier: Apache-2.0
// Goals of objects as they are written.
#include "controller/design/objects.h"
#include "controller/studio/reading/scalars.h"
#include "controller/studio/reading/section.h"
#include "controller/studio/reading/text.h"

namespace chiaro::design {
namespace {

namespace reading = studio::reading;
using reading::Section;
using reading::Tree;

class Reader {
 public:
  Reader(const std::string& file, const studio::Studio& studio, const std::filesystem::path& folder,
         bool lamps, const NamedGoal& named)
      : studio_(studio), folder_(folder), lamps_(lamps), named_(named), report_(file) {}

  core::Result<std::vector<ObjectGoal>> read(const Tree& root, const core::Problems& known) {
    report_.add(known);
    Section top(root, "a file of objects", report_);
    if (const Tree* objects =
            top.need("objects", "\"objects\": {\"vase\": {\"like\": \"ideal\"}}")) {
      Section section(*objects, "the objects", report_);
      for (std::size_t i = 0; i < studio_.subjects.size(); ++i)
        if (const Tree* each = section.find(studio_.subjects[i].name)) read_object(*each, i);
      if (section.valid()) section.refuse_unknown();
      if (section.valid() && goals_.empty() && !report_.any_error())
        report_.error(*objects, "no object is named", "name one of the studio's subjects");
    }
    if (top.valid()) top.refuse_unknown();
    if (report_.any_error()) return report_.sorted();
    return std::move(goals_);
  }

 private:
  void read_object(const Tree& tree, std::size_t subject) {
    Section section(tree, "an object", report_);
    if (!section.valid()) return;
    ObjectGoal goal{subject, 0, IdealGoal{}};
    if (const Tree* lamp =
            lamps_ ? section.need("lamp", "\"lamp\": \"spot\"") : section.find("lamp"))
      if (const auto index = reading::word_among(lamp, lamp_names(), report_))
        goal.fixture = *index;
    Objective objective = Objective::perceptual;
    const std::vector<std::pair<std::string, Objective>> words = {
        {"wavelet", Objective::wavelet}, {"perceptual", Objective::perceptual}};
    if (const Tree* how = section.find("objective"))
      reading::into(objective, reading::choice(how, words, report_));
    if (const Tree* like = section.need("like", "\"like\": \"ideal\""))
      read_like(*like, objective, goal.goal);
    section.refuse_unknown();
    goals_.push_back(std::move(goal));
  }

  void read_like(const Tree& tree, Objective objective, Goal& goal) {
    if (tree.kind == Tree::Kind::scalar) {
      reading::word_among(&tree, {"ideal"}, report_);
      return;
    }
    const auto shape =
        reading::variant(&tree, "what it should be like", {"mood", "exemplar"}, report_);
    if (!shape || shape->body == nullptr) return;
    const auto name = reading::text(shape->body, report_);
    if (!name) return;
    const bool mood = shape->index == 0;
    auto found = named_(mood ? *name : "", mood ? "" : (folder_ / *name).string(), objective);
    if (found)
      goal = *std::move(found);
    else
      for (const core::Problem& problem : found.problems())
        report_.error(*shape->body, problem.what, problem.remedy);
  }

  std::vector<std::string> lamp_names() const {
    std::vector<std::string> names;
    for (const auto& fixture : studio_.fixtures) names.push_back(fixture.name);
    return names;
  }

  const studio::Studio& studio_;
  const std::filesystem::path& folder_;
  const bool lamps_;
  const NamedGoal& named_;
  reading::Report report_;
  std::vector<ObjectGoal> goals_;
};

}  // namespace

core::Result<std::vector<ObjectGoal>> objects_from_json(const std::string& text,
                                                        const std::string& file,
                                                        const studio::Studio& studio,
                                                        const std::filesystem::path& folder,
                                                        bool lamps, const NamedGoal& named) {
  const auto document = reading::parse_tree(text, file);
  if (!document) return document.problems();
  return Reader(file, studio, folder, lamps, named).read(document->root, document->problems);
}

}  // namespace chiaro::design
