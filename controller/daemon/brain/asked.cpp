// SPDX-License-Identifier: Apache-2.0
#include "controller/daemon/brain/asked.h"

#include <nlohmann/json.hpp>

namespace chiaro::daemon {

using Json = nlohmann::ordered_json;

namespace {

Json nudges_to_json(const panel::Nudges& nudges) {
  return {{"brighter", nudges.brighter},
          {"softer", nudges.softer},
          {"warmer", nudges.warmer},
          {"contrast", nudges.contrast}};
}

panel::Nudges nudges_in(const Json& json) {
  if (!json.is_object()) return {};
  return {json.value("brighter", 0.0), json.value("softer", 0.0), json.value("warmer", 0.0),
          json.value("contrast", 0.0)};
}

}  // namespace

std::string asked_to_json(const panel::StartDesign& ask) {
  return Json({{"mood", ask.mood},
               {"own_picture", !ask.picture.empty()},
               {"title", ask.title},
               {"ideal", ask.ideal},
               {"wavelet", ask.wavelet},
               {"seed", ask.seed},
               {"trials", ask.trials},
               {"lock", ask.lock},
               {"flat", ask.flat},
               {"nudges", nudges_to_json(ask.nudges)}})
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
    ask.flat = json.value("flat", false);
    ask.nudges = nudges_in(json.value("nudges", Json()));
    ask.lock = json.value("lock", std::vector<std::string>{});
  } catch (const Json::exception&) {
    return {};
  }
  return ask;
}

design::Nudge steps_of(const panel::Nudges& nudges) {
  constexpr double kSteps = 4;  // to a stop
  return {kSteps * nudges.brighter, kSteps * nudges.warmer, kSteps * nudges.contrast,
          kSteps * nudges.softer};
}

bool can_be_solved(const panel::StartDesign& ask) {
  return ask.flat || ask.ideal || !ask.mood.empty() || !ask.picture.empty();
}

}  // namespace chiaro::daemon
