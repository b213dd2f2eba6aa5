// SPDX-License-Identifier: Apache-2.0
#include "controller/daemon/brain/asked.h"

#include <nlohmann/json.hpp>

namespace chiaro::daemon {

using Json = nlohmann::ordered_json;

std::string asked_to_json(const panel::StartDesign& ask) {
  return Json({{"mood", ask.mood},
               {"own_picture", !ask.picture.empty()},
               {"title", ask.title},
               {"ideal", ask.ideal},
               {"wavelet", ask.wavelet},
               {"seed", ask.seed},
               {"trials", ask.trials},
               {"lock", ask.lock}})
      .dump(-1, ' ', false, Json::error_handler_t::replace);
}

panel::StartDesign asked_from_json(const std::string& text, const std::string& reference) {
  panel::StartDesign ask;
  const Json json = Json::parse(text, nullptr, false);
  if (!json.is_object()) return ask;
  try {
    ask.mood = json.value("mood", "");
    if (json.value("own_picture", false)) ask.picture = reference;
    ask.title = json.value("title", "");
    ask.ideal = json.value("ideal", false);
    ask.wavelet = json.value("wavelet", true);
    ask.seed = json.value("seed", std::uint64_t{1});
    ask.trials = json.value("trials", std::uint64_t{0});
    ask.lock = json.value("lock", std::vector<std::string>{});
  } catch (const Json::exception&) {
    return {};
  }
  return ask;
}

bool can_be_solved(const panel::StartDesign& ask) {
  return ask.ideal || !ask.mood.empty() || !ask.picture.empty();
}

}  // namespace chiaro::daemon
