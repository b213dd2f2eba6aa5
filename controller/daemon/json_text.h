// SPDX-License-Identifier: Apache-2.0
// JSON as the verbs print it. Names come from people, file names and other programs' files: bytes
// that are no UTF-8 are shown as U+FFFD instead of ending the command.
#pragma once

#include <string>

namespace chiaro::daemon {

/// `json` is any of nlohmann's kinds, whose header its callers have. Indented by two.
template <class Json>
std::string json_text(const Json& json) {
  return json.dump(2, ' ', false, Json::error_handler_t::replace);
}

}  // namespace chiaro::daemon
