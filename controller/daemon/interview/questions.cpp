// SPDX-License-Identifier: Apache-2.0
#include "controller/daemon/interview/questions.h"

#include <algorithm>
#include <cmath>

#include "controller/studio/reading/text.h"

namespace chiaro::daemon::interview {

using namespace studio::reading;

Dialogue::Understand<double> a_quantity(Measure measure, core::Range bounds) {
  return [=](const std::string& line) -> core::Result<double> {
    const std::string example(words(measure).example);
    auto parsed = parse_quantity(line, measure);
    if (!parsed.value && parsed.why == Misread::no_unit)
      parsed = parse_quantity(line + example.substr(example.find(' ')), measure);
    if (!parsed.value)
      return unclear(in_quotes(line) + " is not " + std::string(words(measure).noun),
                     "for example " + example);
    if (!bounds.contains(*parsed.value))
      return unclear(written(measure, *parsed.value) + " is out of range",
                     written(measure, bounds.least) + " to " + written(measure, bounds.most));
    return *parsed.value;
  };
}

Dialogue::Understand<int> a_whole_number(int least, int most) {
  return [=](const std::string& line) -> core::Result<int> {
    const auto value = parse_number(line);
    if (value && *value == std::floor(*value) && *value >= least && *value <= most)
      return static_cast<int>(*value);
    return unclear(in_quotes(line) + " is not a whole number from " + std::to_string(least) +
                   " to " + std::to_string(most));
  };
}

Dialogue::Understand<std::string> one_of(std::vector<std::string> choices) {
  return [choices = std::move(choices)](const std::string& line) -> core::Result<std::string> {
    if (std::find(choices.begin(), choices.end(), line) != choices.end()) return line;
    const std::string nearest = core::nearest_name(line.substr(0, 100), choices);
    return unclear(in_quotes(line) + " is not one of " + any_of(choices),
                   nearest.empty() ? "" : "did you mean " + in_quotes(nearest) + "?");
  };
}

Dialogue::Understand<std::string> a_name(std::vector<std::string> taken) {
  return [taken = std::move(taken)](const std::string& line) -> core::Result<std::string> {
    const bool plain = std::all_of(line.begin(), line.end(), [](char c) {
      return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') ||
             c == ' ' || c == '-' || c == '_' || c == '.';
    });
    if (!plain || line.empty() || line.size() > 40)
      return unclear("a name has letters, digits, '-', '_', '.' and spaces, at most 40");
    if (std::find(taken.begin(), taken.end(), line) != taken.end())
      return unclear("there is a lamp called " + in_quotes(line) + " already");
    return line;
  };
}

Dialogue::Understand<std::string> a_line() {
  return [](const std::string& line) -> core::Result<std::string> {
    if (!line.empty() && line.size() <= 500 && !first_byte_not_text(line) &&
        line.find('\t') == std::string::npos)
      return line;
    return unclear("please answer with a short line of text");
  };
}

}  // namespace chiaro::daemon::interview
