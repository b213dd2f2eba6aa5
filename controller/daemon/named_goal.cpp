// SPDX-License-Identifier: Apache-2.0
#include "controller/daemon/named_goal.h"

#include <fstream>
#include <ostream>
#include <sstream>

#include "controller/core/picture_file.h"
#include "controller/design/moods.h"

namespace chiaro::daemon {

core::Result<design::Goal> mood_goal(const std::string& wanted, const studio::Folders& folders,
                                     design::Objective objective, ports::World& world) {
  const design::Moods moods = design::load_moods(folders.moods());
  std::vector<std::string> names;
  std::string list;
  for (const design::Mood& mood : moods.moods) {
    names.push_back(mood.name);
    list += (list.empty() ? "" : ", ") + mood.name;
    if (mood.name != wanted) continue;
    auto goal = design::goal_of(mood, objective);
    if (!goal) return goal.problems();
    return design::Goal(*std::move(goal));
  }
  for (const core::Problem& problem : moods.problems) world.err << core::to_string(problem) << "\n";
  const std::string near = core::nearest_name(wanted, names);
  return core::Problem{{},
                       "no mood is called \"" + wanted + "\"",
                       list.empty() ? "there are none in " + folders.moods().string()
                                    : (near.empty() ? "" : "did you mean \"" + near + "\"? ") +
                                          "there are: " + list};
}

core::Result<design::Goal> picture_goal(const std::string& file, design::Objective objective) {
  auto picture = core::read_picture(file);
  if (!picture) return picture.problems();
  design::ExampleGoal goal;
  goal.name = std::filesystem::path(file).stem().string();
  goal.exemplar = core::linear_at_most(*picture);
  goal.objective = objective;
  return design::Goal(std::move(goal));
}

core::Result<std::string> text_of(const std::string& file) {
  std::ifstream in(file, std::ios::binary);
  if (!in) return core::Problem{{file}, "the file cannot be read", "is there such a file?"};
  std::ostringstream text;
  text << in.rdbuf();
  return text.str();
}

}  // namespace chiaro::daemon
