// SPDX-License-Identifier: Apache-2.0
// A request and its answer as values, so that all of the API can be tested without a socket.
#pragma once

#include <functional>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "controller/panel/state.h"

namespace chiaro::panel {

struct Request {
  std::string method = "GET";
  std::string path = "/";  ///< percent-decoded, without the query
  std::map<std::string, std::string> query;
  std::map<std::string, std::string> headers;  ///< names in lower case
  std::string body;

  std::string header(const std::string& name) const {
    const auto found = headers.find(name);
    return found == headers.end() ? std::string() : found->second;
  }
};

struct Response {
  int status = 200;
  std::string type = "application/json";
  std::string body;
  std::vector<std::pair<std::string, std::string>> headers;
};
/// Called exactly once, on the loop's thread.
using Reply = std::function<void(Response)>;

Response refuse(const Refusal& refusal);

/// Splits "/api/v1/moods/low%20key?x=1"; nothing when an escape is broken or a byte is zero.
struct Target {
  std::string path;
  std::map<std::string, std::string> query;
};
std::optional<Target> parse_target(std::string_view target);

/// One part of a multipart/form-data body.
struct Part {
  std::string name, file_name, type, body;
};
/// Nothing when the body is not what its content type says.
std::optional<std::vector<Part>> parse_multipart(std::string_view content_type,
                                                 std::string_view body);
/// Standard alphabet, padding optional, a leading `data:…;base64,` dropped; nothing when broken.
std::optional<std::string> from_base64(std::string_view text);

/// Who may speak to the daemon.
struct Access {
  bool beyond_loopback = false;  ///< listening on more than 127.0.0.1 and ::1
  std::string token;             ///< "" = none needed (loopback only)
};
/// The refusal of a request that must not be looked at: a foreign Origin (403), on loopback a
/// foreign Host (403: a web page that re-bound its name to 127.0.0.1), a missing or wrong token
/// (401). The token comes as `Authorization: Bearer …` or, from the page, as the cookie that
/// POST /api/v1/session gave.
std::optional<Refusal> forbidden(const Request& request, const Access& access);

}  // namespace chiaro::panel
