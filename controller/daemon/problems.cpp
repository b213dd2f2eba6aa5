// SPDX-License-Identifier: Apache-2.0
#include "controller/daemon/problems.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <ostream>

namespace chiaro::daemon {
namespace {

nlohmann::json as_json(const core::Problems& problems) {
  nlohmann::json list = nlohmann::json::array();
  for (const core::Problem& problem : problems)
    list.push_back({{"file", problem.where.file},
                    {"line", problem.where.line},
                    {"column", problem.where.column},
                    {"what", problem.what},
                    {"remedy", problem.remedy},
                    {"warning", problem.warning}});
  return list;
}

/// What people named need not be UTF-8; an answer always is.
std::string dumped(const nlohmann::json& json) {
  return json.dump(2, ' ', false, nlohmann::json::error_handler_t::replace);
}

}  // namespace

std::string problems_to_json(const core::Problems& problems) { return dumped(as_json(problems)); }

ports::Exit refuse(const core::Problems& problems, ports::World& world, bool json) {
  const auto errors = std::count_if(problems.begin(), problems.end(),
                                    [](const core::Problem& problem) { return !problem.warning; });
  world.err << core::to_string(problems);
  if (errors > 1) world.err << errors << " problems\n";
  if (json) world.out << dumped({{"ok", false}, {"problems", as_json(problems)}}) << "\n";
  return ports::Exit::input_has_problems;
}

}  // namespace chiaro::daemon
