// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cctype>
#include <charconv>
#include <optional>
#include <string_view>

#include "drivers/common/http_client.h"

namespace chiaro::drivers {
namespace {

core::Problem broken(const std::string& what) {
  return {
      {}, "the answer is not HTTP: " + what, "check that the address belongs to an HTTP server"};
}

/// The value of a header, its name given in lower case; empty when absent.
std::string_view header(std::string_view head, std::string_view name) {
  std::size_t from = head.find("\r\n");
  while (from != std::string_view::npos) {
    from += 2;
    const auto end = head.find("\r\n", from);
    const auto line = head.substr(from, end == std::string_view::npos ? end : end - from);
    const auto colon = line.find(':');
    const bool same = colon == name.size() &&
                      std::equal(name.begin(), name.end(), line.begin(), [](char a, char b) {
                        return a == std::tolower(static_cast<unsigned char>(b));
                      });
    if (same) {
      const auto start = line.find_first_not_of(" \t", colon + 1);
      return start == std::string_view::npos ? std::string_view() : line.substr(start);
    }
    from = end;
  }
  return {};
}

std::optional<std::size_t> number(std::string_view text, int base) {
  std::size_t value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value, base);
  if (error != std::errc() || end == text.data()) return std::nullopt;
  return value;
}

/// Joins the chunks into `body`; false while the last one is missing.
core::Result<bool> unchunk(std::string_view rest, std::string& body) {
  for (;;) {
    const auto line = rest.find("\r\n");
    if (line == std::string_view::npos) return false;
    const auto size = number(rest.substr(0, line), 16);
    if (!size || *size > kMostHttpBody) return broken("a chunk without a size");
    rest.remove_prefix(line + 2);
    if (*size == 0) return true;
    if (rest.size() < *size + 2) return false;
    body.append(rest.substr(0, *size));
    rest.remove_prefix(*size + 2);
  }
}

}  // namespace

std::optional<std::size_t> http_content_length(std::string_view head) {
  return number(header(head, "content-length"), 10);
}

core::Result<HttpHead> parse_http_head(std::string_view head) {
  const auto status = head.substr(0, 5) == "HTTP/"
                          ? number(head.substr(std::min<std::size_t>(head.size(), 9)), 10)
                          : std::nullopt;
  if (!status || *status < 100 || *status > 599) return broken("no status line");
  return HttpHead{static_cast<int>(*status), std::string(header(head, "content-type")),
                  number(header(head, "content-length"), 10),
                  header(head, "transfer-encoding") == "chunked"};
}

core::Result<HttpReply> parse_http_reply(const std::string& bytes, bool closed) {
  const std::string_view all(bytes);
  const auto blank = all.find("\r\n\r\n");
  if (blank == std::string_view::npos) {
    if (closed) return broken("the connection was closed before the end of its head");
    if (all.size() > 65536) return broken("its head has no end");
    return HttpReply{};
  }
  const auto head = all.substr(0, blank), rest = all.substr(blank + 4);
  const auto parsed = parse_http_head(head);
  if (!parsed) return parsed.problems();
  HttpReply reply{parsed->status, parsed->type, ""};
  bool whole = false;
  if (parsed->chunked) {
    const auto done = unchunk(rest, reply.body);
    if (!done) return done.problems();
    whole = *done;
  } else if (parsed->length) {
    whole = rest.size() >= *parsed->length;
    reply.body = rest.substr(0, *parsed->length);
  } else {
    whole = closed || reply.status == 204 || reply.status == 304;
    reply.body = rest;
  }
  if (whole) return reply;
  if (closed) return broken("the connection was closed before its end");
  return HttpReply{};
}

}  // namespace chiaro::drivers
