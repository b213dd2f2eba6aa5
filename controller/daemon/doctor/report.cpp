// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <nlohmann/json.hpp>

#include "controller/daemon/doctor/doctor.h"

namespace chiaro::daemon::doctor {
namespace {

const char* name_of(Finding::State state) {
  return state == Finding::State::good ? "good" : state == Finding::State::note ? "note" : "bad";
}

}  // namespace

std::vector<Finding> examine(const std::filesystem::path& root, const Person& person,
                             ports::Devices& devices, const studio::Studio* studio) {
  std::vector<Finding> findings;
  examine_devices(root, person, devices, findings);
  examine_real_time(root, findings);
  examine_network(root, findings);
  if (studio != nullptr) examine_studio(root, *studio, devices, findings);
  return findings;
}

std::string to_text(const std::vector<Finding>& findings) {
  std::string text;
  for (const Finding& finding : findings) {
    const char* sign = finding.state == Finding::State::good   ? "  ok    "
                       : finding.state == Finding::State::note ? "  note  "
                                                               : "  WRONG ";
    text += sign + finding.area + ": " + finding.what + "\n";
    if (!finding.command.empty()) text += "          " + finding.command + "\n";
  }
  const auto bad = std::count_if(findings.begin(), findings.end(), [](const Finding& finding) {
    return finding.state == Finding::State::bad;
  });
  return text + (bad == 0 ? "Nothing stands in the way.\n"
                          : std::to_string(bad) + (bad == 1 ? " thing needs" : " things need") +
                                " mending; the line below each is the command.\n");
}

std::string to_json(const std::vector<Finding>& findings) {
  nlohmann::json list = nlohmann::json::array();
  bool ok = true;
  for (const Finding& finding : findings) {
    ok = ok && finding.state != Finding::State::bad;
    list.push_back({{"state", name_of(finding.state)},
                    {"area", finding.area},
                    {"what", finding.what},
                    {"command", finding.command}});
  }
  return nlohmann::json{{"ok", ok}, {"findings", list}}.dump(
      -1, ' ', false, nlohmann::json::error_handler_t::replace);
}

}  // namespace chiaro::daemon::doctor
