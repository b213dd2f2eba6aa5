// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include "controller/studio/reading/text.h"
#include "controller/studio/sections/sections.h"

namespace chiaro::studio::sections {

bool check_name(const Tree::Key& key, Context& context) {
  const bool good = !key.text.empty() && key.text.size() <= 40 && key.text.front() != ' ' &&
                    std::all_of(key.text.begin(), key.text.end(), [](char c) {
                      return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') ||
                             (c >= '0' && c <= '9') || c == ' ' || c == '-' || c == '_' || c == '.';
                    });
  if (!good)
    context.report.error(key, reading::in_quotes(key.text) + " cannot be a name",
                         "use letters, digits, '-', '_', '.' and spaces, at most 40");
  return good;
}

bool bus_exists(const Tree& where, const std::string& name, const Studio& studio,
                Context& context) {
  std::vector<std::string> names;
  for (const Bus& bus : studio.buses) names.push_back(bus.name);
  if (std::find(names.begin(), names.end(), name) != names.end()) return true;
  context.report.error(where, "there is no bus " + reading::in_quotes(name),
                       names.empty() ? "add it: buses: {" + name + ": {device: /dev/ttyUSB0}}"
                                     : reading::suggestion(name, names));
  return false;
}

}  // namespace chiaro::studio::sections
