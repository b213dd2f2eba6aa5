// SPDX-License-Identifier: Apache-2.0
// Reads the fields of a JSON body: each name once, with its type and range; what nobody asked for
// is refused with the nearest known name. The first fault found is kept.
#pragma once

#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include "controller/core/units.h"
#include "controller/panel/json.h"
#include "controller/panel/state.h"

namespace chiaro::panel {

class Fields {
 public:
  /// An empty body counts as {}.
  explicit Fields(const std::string& body);
  explicit Fields(Json object) : json_(std::move(object)) {}

  bool has(const char* name);
  std::optional<std::string> text(const char* name);
  std::optional<bool> flag(const char* name);
  std::optional<double> number(const char* name, core::Range range);
  std::optional<std::uint64_t> whole(const char* name);
  std::vector<std::string> texts(const char* name);
  /// The raw value, null when absent.
  Json any(const char* name);
  bool required(const char* name);
  void fail(int status, std::string what, std::string where, std::string remedy);
  /// To be asked last: a fault found, or a field that nobody asked for.
  std::optional<Refusal> fault();
  const Json& json() const { return json_; }
  void know(std::string name) { known_.push_back(std::move(name)); }

 private:
  Json json_ = Json::object();
  std::vector<std::string> known_;
  std::optional<Refusal> fault_;
};

}  // namespace chiaro::panel
