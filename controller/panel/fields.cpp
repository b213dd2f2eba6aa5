// SPDX-License-Identifier: Apache-2.0
#include "controller/panel/fields.h"

#include <algorithm>
#include <fmt/format.h>

namespace chiaro::panel {

namespace {

/// The parser recurses for each bracket of a hostile body: looked at before it is asked.
int nesting(const std::string& body) {
  int depth = 0, deepest = 0;
  for (const char c : body) {
    if (c == '[' || c == '{') deepest = std::max(deepest, ++depth);
    if (c == ']' || c == '}') --depth;
  }
  return deepest;
}

}  // namespace

Fields::Fields(const std::string& body) {
  if (body.find_first_not_of(" \t\r\n") == std::string::npos) return;
  if (nesting(body) > 64) {
    fail(400, "the body is nested too deeply", "body", "send a flat object");
    return;
  }
  Json parsed = Json::parse(body, nullptr, false);
  if (parsed.is_discarded())
    fail(400, "the body is not JSON", "body",
         "send one JSON object, such as {\"mood\": \"rembrandt\"}");
  else if (!parsed.is_object())
    fail(400, "the body is not a JSON object", "body", "send one JSON object in braces");
  else
    json_ = std::move(parsed);
}

bool Fields::has(const char* name) {
  know(name);
  return json_.contains(name);
}

Json Fields::any(const char* name) { return has(name) ? json_.at(name) : Json(nullptr); }

bool Fields::required(const char* name) {
  if (has(name)) return true;
  fail(400, fmt::format("'{}' is missing", name), name, fmt::format("add \"{}\"", name));
  return false;
}

std::optional<std::string> Fields::text(const char* name) {
  if (!has(name)) return std::nullopt;
  const Json& value = json_.at(name);
  if (value.is_string()) return value.get<std::string>();
  fail(400, fmt::format("'{}' must be a text", name), name, "put it in quotes");
  return std::nullopt;
}

std::optional<bool> Fields::flag(const char* name) {
  if (!has(name)) return std::nullopt;
  const Json& value = json_.at(name);
  if (value.is_boolean()) return value.get<bool>();
  fail(400, fmt::format("'{}' must be true or false", name), name, "send true or false");
  return std::nullopt;
}

std::optional<double> Fields::number(const char* name, core::Range range) {
  if (!has(name)) return std::nullopt;
  const Json& value = json_.at(name);
  if (!value.is_number() || !std::isfinite(value.get<double>())) {
    fail(400, fmt::format("'{}' must be a number", name), name,
         fmt::format("send a number from {:.6g} to {:.6g}", range.least, range.most));
    return std::nullopt;
  }
  const double number = value.get<double>();
  if (range.contains(number)) return number;
  fail(422,
       fmt::format("'{}' is {:.6g}, possible is {:.6g} to {:.6g}", name, number, range.least,
                   range.most),
       name, fmt::format("send a number from {:.6g} to {:.6g}", range.least, range.most));
  return std::nullopt;
}

std::optional<std::uint64_t> Fields::whole(const char* name) {
  if (!has(name)) return std::nullopt;
  const Json& value = json_.at(name);
  if (value.is_number_unsigned()) return value.get<std::uint64_t>();
  fail(400, fmt::format("'{}' must be a whole number from 0 upwards", name), name,
       "send a whole number");
  return std::nullopt;
}

std::vector<std::string> Fields::texts(const char* name) {
  if (!has(name)) return {};
  const Json& value = json_.at(name);
  if (value.is_array() &&
      std::all_of(value.begin(), value.end(), [](const Json& item) { return item.is_string(); }))
    return value.get<std::vector<std::string>>();
  fail(400, fmt::format("'{}' must be a list of names", name), name,
       fmt::format("send \"{}\": [\"key\"]", name));
  return {};
}

void Fields::fail(int status, std::string what, std::string where, std::string remedy) {
  if (!fault_) fault_ = Refusal{status, std::move(what), std::move(where), std::move(remedy)};
}

std::optional<Refusal> Fields::fault() {
  if (fault_) return fault_;
  for (const auto& [key, value] : json_.items()) {
    if (std::find(known_.begin(), known_.end(), key) != known_.end()) continue;
    const std::string nearest = core::nearest_name(key, known_);
    std::string list;
    for (const std::string& name : known_) list += (list.empty() ? "" : ", ") + name;
    return Refusal{400, "'" + key + "' is not known here", key,
                   !nearest.empty() ? "did you mean '" + nearest + "'?"
                   : list.empty()   ? "send an empty object"
                                    : "known are: " + list};
  }
  return std::nullopt;
}

}  // namespace chiaro::panel
