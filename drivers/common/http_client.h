// SPDX-License-Identifier: Apache-2.0
// One HTTP/1.1 request and its answer, whole or as it comes, for programs of ours that talk to each
// other or to an IP camera: no redirects, no TLS, no keep-alive.
#pragma once

#include <atomic>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>

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

/// What stands before an answer's body.
struct HttpHead {
  int status = 0;
  std::string type;
  std::optional<std::size_t> length;
  bool chunked = false;
};
core::Result<HttpHead> parse_http_head(std::string_view head);
/// The Content-Length among the header lines of a part, whichever case its name is in.
std::optional<std::size_t> http_content_length(std::string_view head);

/// An answer that is read as it comes: a camera's endless one. One thread.
class HttpStream {
 public:
  virtual ~HttpStream() = default;
  virtual int status() const = 0;
  virtual const std::string& type() const = 0;
  /// Nothing: it has no end or does not say.
  virtual std::optional<std::size_t> length() const = 0;
  /// Bytes of the body that came within `timeout`, chunks joined; 0 = none yet, nullopt = the far
  /// end has closed or is gone.
  virtual std::optional<std::size_t> read(std::span<char> into, ports::Duration timeout) = 0;
};
/// Blocks for `timeout` at most, until the answer's head is there. `stop` outlives the stream.
core::Result<std::unique_ptr<HttpStream>> open_http_stream(const std::string& url,
                                                           ports::Duration timeout,
                                                           const std::atomic<bool>* stop = nullptr);

}  // namespace chiaro::drivers
