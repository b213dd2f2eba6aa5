// SPDX-License-Identifier: Apache-2.0
// One HTTP/1.1 request and its whole answer, for programs of ours that talk to each other or to an
// IP camera: no redirects, no TLS, no keep-alive.
#pragma once

#include <atomic>
#include <cstdint>
#include <string>

#include "controller/core/result.h"
#include "controller/ports/clock.h"

namespace chiaro::drivers {

struct HttpUrl {
  std::string host;
  std::uint16_t port = 80;
  std::string target = "/";  ///< path and query, as given
};
/// "http://host[:port][/path]"; the problem names what is wrong with any other text.
core::Result<HttpUrl> parse_http_url(const std::string& url);

struct HttpRequest {
  std::string method = "GET", url{};
  std::string body{}, type = "application/json";  ///< type: of the body, when there is one
  std::string token{};  ///< sent as bearer token; "" = none. No line breaks in it
};
struct HttpReply {
  int status = 0;
  std::string type, body;
};

/// No answer beyond this is read.
inline constexpr std::size_t kMostHttpBody = 64u << 20;

/// Blocks for `timeout` at most, from name to last byte; returns early when `stop` turns true.
/// Any status is a reply; a problem means that no whole answer came. Thread-safe.
core::Result<HttpReply> http_request(const HttpRequest& request, ports::Duration timeout,
                                     const std::atomic<bool>* stop = nullptr);

/// The answer in `bytes`, once it is whole; `closed`: no more bytes will come. Nothing (status 0)
/// while it is not; a problem when it never will be.
core::Result<HttpReply> parse_http_reply(const std::string& bytes, bool closed);

}  // namespace chiaro::drivers
