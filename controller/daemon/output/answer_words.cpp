// SPDX-License-Identifier: Apache-2.0
#include "controller/daemon/output/answer_words.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <nlohmann/json.hpp>

#include "controller/daemon/output/state_json.h"

namespace chiaro::daemon {

using Json = nlohmann::json;

std::string refusal(const core::Problems& problems) {
  Json list = Json::array();
  for (const auto& p : problems)
    list.push_back({{"file", p.where.file},
                    {"line", p.where.line},
                    {"column", p.where.column},
                    {"what", p.what},
                    {"remedy", p.remedy}});
  return text_of(Json{{"problems", list}});
}

std::string refusal(const std::string& what, const std::string& remedy) {
  return refusal(core::Problems{{{}, what, remedy, false}});
}

std::string not_in_time() {
  return refusal("the output loop did not act within a second",
                 "look at `chiaro-output`'s messages");
}

std::string cut(const std::string& text, std::size_t most) {
  if (text.size() <= most) return text;
  while (most > 0 && (static_cast<unsigned char>(text[most]) & 0xc0u) == 0x80u) --most;
  return text.substr(0, most);
}

std::string first_of(std::string& words) {
  const auto end = std::min(words.find(' '), words.size());
  std::string word = words.substr(0, end);
  words.erase(0, std::min(end + 1, words.size()));
  return word;
}

std::optional<double> number_in(const std::string& word) {
  double value = 0;
  const auto [end, code] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (code != std::errc{} || end != word.data() + word.size() || !std::isfinite(value) || value < 0)
    return std::nullopt;
  return value;
}

}  // namespace chiaro::daemon
