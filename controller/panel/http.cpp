// SPDX-License-Identifier: Apache-2.0
#include "controller/panel/http.h"

#include <algorithm>
#include <cctype>

namespace chiaro::panel {
namespace {

std::optional<int> hex_digit(char c) {
  if (c >= '0' && c <= '9') return c - '0';
  if (c >= 'a' && c <= 'f') return c - 'a' + 10;
  if (c >= 'A' && c <= 'F') return c - 'A' + 10;
  return std::nullopt;
}

std::optional<std::string> percent_decoded(std::string_view text, bool plus_is_space) {
  std::string out;
  for (std::size_t i = 0; i < text.size(); ++i) {
    char c = text[i];
    if (c == '%') {
      if (i + 2 >= text.size()) return std::nullopt;
      const auto high = hex_digit(text[i + 1]), low = hex_digit(text[i + 2]);
      if (!high || !low) return std::nullopt;
      c = static_cast<char>(*high * 16 + *low);
      i += 2;
    } else if (c == '+' && plus_is_space) {
      c = ' ';
    }
    if (c == '\0') return std::nullopt;
    out.push_back(c);
  }
  return out;
}

std::string lower(std::string_view text) {
  std::string out(text);
  std::transform(out.begin(), out.end(), out.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return out;
}

std::string_view trimmed(std::string_view text) {
  while (!text.empty() && (text.front() == ' ' || text.front() == '\t')) text.remove_prefix(1);
  while (!text.empty() && (text.back() == ' ' || text.back() == '\t')) text.remove_suffix(1);
  return text;
}

/// The value of `key=` in a header such as `form-data; name="x"; filename="y"`.
std::string attribute(std::string_view header, std::string_view key) {
  std::size_t from = 0;
  while ((from = header.find(';', from)) != std::string_view::npos) {
    std::string_view rest = trimmed(header.substr(++from));
    if (rest.size() <= key.size() || lower(rest.substr(0, key.size())) != key ||
        rest[key.size()] != '=')
      continue;
    rest.remove_prefix(key.size() + 1);
    if (!rest.empty() && rest.front() == '"') {
      const auto end = rest.find('"', 1);
      return std::string(rest.substr(1, end == std::string_view::npos ? end : end - 1));
    }
    return std::string(trimmed(rest.substr(0, rest.find(';'))));
  }
  return "";
}

std::optional<Part> parse_part(std::string_view text) {
  const auto blank = text.find("\r\n\r\n");
  if (blank == std::string_view::npos) return std::nullopt;
  Part part;
  part.body = std::string(text.substr(blank + 4));
  std::string_view head = text.substr(0, blank + 2);
  while (!head.empty()) {
    const auto end = head.find("\r\n");
    const std::string_view line = head.substr(0, end);
    head.remove_prefix(end + 2);
    const auto colon = line.find(':');
    if (colon == std::string_view::npos) continue;
    const std::string name = lower(line.substr(0, colon));
    const std::string_view value = trimmed(line.substr(colon + 1));
    if (name == "content-disposition") {
      part.name = attribute(value, "name");
      part.file_name = attribute(value, "filename");
    } else if (name == "content-type") {
      part.type = std::string(value);
    }
  }
  return part;
}

/// Compares in time that does not depend on where the texts differ.
bool same_secret(std::string_view a, std::string_view b) {
  unsigned difference = a.size() == b.size() ? 0u : 1u;
  for (std::size_t i = 0; i < a.size(); ++i)
    difference |=
        static_cast<unsigned>(static_cast<unsigned char>(a[i]) ^
                              static_cast<unsigned char>(b.empty() ? 1 : b[i % b.size()]));
  return difference == 0;
}

std::string cookie(const std::string& header, std::string_view name) {
  return attribute(";" + header, name);
}

bool names_this_machine(const std::string& host) {
  const std::string name =
      host.starts_with('[') ? host.substr(0, host.find(']') + 1) : host.substr(0, host.find(':'));
  const bool numbers = name.find_first_not_of("0123456789.") == std::string::npos;
  return name == "localhost" || name == "[::1]" || (numbers && name.starts_with("127."));
}

std::optional<Refusal> foreign(const Request& request, const Access& access) {
  const std::string host = lower(request.header("host"));
  if (!access.beyond_loopback && !host.empty() && !names_this_machine(host))
    return Refusal{403, "this daemon answers to localhost only, not to '" + host + "'", "Host",
                   "open it as http://127.0.0.1, or start chiarod with --listen and --token"};
  const std::string origin = lower(request.header("origin"));
  if (origin.empty() || origin == "http://" + host || origin == "https://" + host)
    return std::nullopt;
  return Refusal{403, "the page at '" + origin + "' may not speak to this daemon", "Origin",
                 "use the panel that the daemon itself serves"};
}

}  // namespace

Response refuse(const Refusal& refusal) {
  Response response{refusal.status, "application/json", refusal_to_json(refusal), {}};
  if (refusal.status == 401) response.headers.emplace_back("WWW-Authenticate", "Bearer");
  return response;
}

std::optional<Target> parse_target(std::string_view text) {
  Target target;
  const auto mark = text.find('?');
  const auto path = percent_decoded(text.substr(0, mark), false);
  if (!path || path->empty() || path->front() != '/') return std::nullopt;
  target.path = *path;
  std::string_view rest = mark == std::string_view::npos ? "" : text.substr(mark + 1);
  while (!rest.empty()) {
    const auto end = std::min(rest.find('&'), rest.size());
    const std::string_view pair = rest.substr(0, end);
    rest.remove_prefix(std::min(end + 1, rest.size()));
    const auto equals = std::min(pair.find('='), pair.size());
    const auto key = percent_decoded(pair.substr(0, equals), true);
    const auto value = percent_decoded(pair.substr(std::min(equals + 1, pair.size())), true);
    if (!key || !value) return std::nullopt;
    target.query[*key] = *value;
  }
  return target;
}

std::optional<std::vector<Part>> parse_multipart(std::string_view content_type,
                                                 std::string_view body) {
  const std::string boundary = attribute(content_type, "boundary");
  if (boundary.empty()) return std::nullopt;
  const std::string first = "--" + boundary, next = "\r\n" + first;
  if (!body.starts_with(first)) return std::nullopt;
  body.remove_prefix(first.size());
  std::vector<Part> parts;
  while (!body.starts_with("--")) {
    if (!body.starts_with("\r\n")) return std::nullopt;
    const auto end = body.find(next, 2);
    if (end == std::string_view::npos) return std::nullopt;
    auto part = parse_part(body.substr(2, end - 2));
    if (!part) return std::nullopt;
    parts.push_back(std::move(*part));
    body.remove_prefix(end + next.size());
  }
  return parts;
}

std::optional<std::string> from_base64(std::string_view text) {
  if (text.starts_with("data:")) {
    const auto comma = text.find(";base64,");
    if (comma == std::string_view::npos) return std::nullopt;
    text.remove_prefix(comma + 8);
  }
  while (!text.empty() && text.back() == '=') text.remove_suffix(1);
  if (text.size() % 4 == 1) return std::nullopt;
  static constexpr std::string_view kAlphabet =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string out;
  unsigned bits = 0, held = 0;
  for (const char c : text) {
    const auto digit = kAlphabet.find(c);
    if (digit == std::string_view::npos) return std::nullopt;
    held = (held << 6u) | static_cast<unsigned>(digit);
    bits += 6;
    if (bits < 8) continue;
    bits -= 8;
    out.push_back(static_cast<char>((held >> bits) & 0xffu));
  }
  return out;
}

std::optional<Refusal> forbidden(const Request& request, const Access& access) {
  if (auto refusal = foreign(request, access)) return refusal;
  if (access.token.empty()) return std::nullopt;
  if (!request.path.starts_with("/api/") && request.path != "/metrics") return std::nullopt;
  const std::string authorization = request.header("authorization");
  const std::string given = authorization.starts_with("Bearer ")
                                ? authorization.substr(7)
                                : cookie(request.header("cookie"), "chiaro");
  if (same_secret(given, access.token)) return std::nullopt;
  return Refusal{401, given.empty() ? "a token is needed" : "this is not the right token",
                 "Authorization", "send 'Authorization: Bearer TOKEN' with chiarod's --token"};
}

}  // namespace chiaro::panel
