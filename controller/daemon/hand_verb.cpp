// SPDX-License-Identifier: Apache-2.0
#include "controller/daemon/hand_verb.h"

#include <nlohmann/json.hpp>
#include <ostream>

#include "controller/daemon/hand_link.h"
#include "controller/daemon/json_text.h"

namespace chiaro::daemon {

using Json = nlohmann::json;

ports::Exit ask_hand(ports::World& world, bool json, const std::string& line,
                     std::string (*in_words)(const Json& answer)) {
  const auto answer = hand_request(world.runtime_folder, line);
  if (answer) {
    if (json)
      world.out << *answer << "\n";
    else
      world.err << in_words(Json::parse(*answer)) << "\n";
    return ports::Exit::done;
  }
  world.err << core::to_string(answer.problems());
  const auto& problem = answer.problems().front();
  if (json)
    world.out << json_text(Json{{"error",
                                 {{"what", problem.what},
                                  {"where", core::to_string(problem.where)},
                                  {"remedy", problem.remedy}}}})
              << "\n";
  // Who could not be reached is named by its socket; a refusal names no file, or one of its own.
  const bool reached = problem.where.file.find("output.sock") == std::string::npos;
  return reached ? ports::Exit::input_has_problems : ports::Exit::out_of_reach;
}

}  // namespace chiaro::daemon
