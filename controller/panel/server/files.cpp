// SPDX-License-Identifier: Apache-2.0
#include "controller/panel/server/files.h"

#include <array>
#include <fstream>
#include <iterator>

namespace chiaro::panel {
namespace {

constexpr const char* kNotBuilt =
    "<!doctype html><html lang=\"en\"><title>Chiaro</title><body style=\"background:#141414;"
    "color:#ddd;font:16px/1.5 sans-serif;max-width:40em;margin:4em auto\"><h1>The page is not "
    "built yet</h1><p>The daemon runs and its API answers at "
    "<a style=\"color:#fc9\" href=\"/api/v1/state\">/api/v1/state</a>.</p><p>To build the page: "
    "<code>cd controller/panel/web &amp;&amp; npm ci &amp;&amp; npm run build</code>, then load "
    "this address again.</p></body></html>";

const char* type_of(const std::filesystem::path& file) {
  static constexpr std::array<std::pair<const char*, const char*>, 8> kTypes = {
      {{".html", "text/html; charset=utf-8"},
       {".js", "text/javascript; charset=utf-8"},
       {".css", "text/css; charset=utf-8"},
       {".svg", "image/svg+xml"},
       {".png", "image/png"},
       {".jpg", "image/jpeg"},
       {".woff2", "font/woff2"},
       {".json", "application/json"}}};
  const std::string extension = file.extension();
  for (const auto& [suffix, type] : kTypes)
    if (extension == suffix) return type;
  return "application/octet-stream";
}

std::vector<std::pair<std::string, std::string>> headers(bool immutable) {
  return {{"Cache-Control", immutable ? "public, max-age=31536000, immutable" : "no-cache"},
          {"Content-Security-Policy",
           "default-src 'self'; img-src 'self' data: blob:; style-src 'self' 'unsafe-inline'; "
           "frame-ancestors 'none'"}};
}

}  // namespace

Response file_answer(const std::filesystem::path& web, const std::string& path) {
  const std::filesystem::path relative = path == "/" ? "index.html" : path.substr(1);
  bool inside = !relative.is_absolute();
  for (const auto& part : relative) inside = inside && part != ".." && part != ".";
  std::error_code code;
  const auto file = web / relative;
  if (inside && std::filesystem::is_regular_file(file, code)) {
    std::ifstream stream(file, std::ios::binary);
    return {200, type_of(file),
            std::string(std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()),
            headers(path.starts_with("/assets/"))};
  }
  if (path == "/") return {200, "text/html; charset=utf-8", kNotBuilt, headers(false)};
  return refuse({404, "there is nothing at " + path, path, "the panel is at /"});
}

}  // namespace chiaro::panel
