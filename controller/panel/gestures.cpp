// SPDX-License-Identifier: Apache-2.0
// Which address means which gesture.
#include "controller/panel/gestures.h"

#include <algorithm>
#include <array>
#include <fmt/format.h>
#include <sstream>

#include "controller/panel/made.h"

namespace chiaro::panel {
namespace {

constexpr Address kAddresses[] = {
#define ROUTE(method, path, what, example, make) {#method, path, what, example},
#include "controller/panel/routes.def"
#undef ROUTE
};

using Make = Made (*)(const Request&, const Words&, const State&);
constexpr Make kMakers[] = {
#define ROUTE(method, path, what, example, make) make,
#include "controller/panel/routes.def"
#undef ROUTE
};

/// A star in the path stands for any one word.
bool matches(const std::string& path, const Words& words) {
  Words pattern;
  std::istringstream stream(path);
  for (std::string word; std::getline(stream, word, '/');) pattern.push_back(word);
  return std::equal(pattern.begin(), pattern.end(), words.begin(), words.end(),
                    [](const std::string& a, const std::string& b) { return a == "*" || a == b; });
}

std::vector<std::string> names(const auto& items) {
  std::vector<std::string> list;
  for (const auto& item : items) list.push_back(item.name);
  return list;
}

}  // namespace

std::span<const Address> addresses() { return kAddresses; }

Refusal unknown_name(const std::string& kind, const std::string& name,
                     const std::vector<std::string>& known) {
  const std::string nearest = core::nearest_name(name, known);
  std::string list;
  for (const std::string& word : known) list += (list.empty() ? "" : ", ") + word;
  return {404, fmt::format("no {} is called '{}'", kind, name), name,
          !nearest.empty() ? "did you mean '" + nearest + "'?"
          : list.empty()   ? "there is none at all"
                           : "known are: " + list};
}

std::vector<std::string> mood_names(const State& state) { return names(state.moods); }
std::vector<std::string> fixture_names(const State& state) { return names(state.fixtures); }
std::vector<std::string> camera_names(const State& state) { return names(state.cameras); }

Made gesture_of(const Request& request, const Words& words, const State& state) {
  std::string allowed;
  for (std::size_t i = 0; i < std::size(kAddresses); ++i) {
    if (!matches(kAddresses[i].path, words)) continue;
    if (kAddresses[i].method == request.method) return kMakers[i](request, words, state);
    allowed += (allowed.empty() ? "" : ", ") + std::string(kAddresses[i].method);
  }
  if (allowed.empty())
    return Refusal{404, "there is nothing at " + request.path, request.path,
                   "GET /api/v1 lists every address"};
  return Refusal{405, request.path + " does not take " + request.method, request.path,
                 "use " + allowed};
}

}  // namespace chiaro::panel
