// SPDX-License-Identifier: Apache-2.0
#include "controller/studio/reading/files.h"

#include <fstream>
#include <system_error>

#include "controller/studio/reading/scalars.h"
#include "controller/studio/reading/text.h"

namespace chiaro::studio::reading {

core::Result<std::string> read_text(const std::filesystem::path& file) {
  const auto refuse = [&](std::string what, std::string remedy) {
    return core::Problem{{file.string(), 0, 0}, std::move(what), std::move(remedy)};
  };
  std::error_code code;
  const auto status = std::filesystem::status(file, code);
  if (!std::filesystem::exists(status)) return refuse("there is no such file", "check the path");
  if (std::filesystem::is_directory(status))
    return refuse("this is a folder, not a file", "name the .yaml file in it");
  // A device or a pipe might never end.
  if (!std::filesystem::is_regular_file(status))
    return refuse("this is not an ordinary file", "name a .yaml file");
  const auto size = std::filesystem::file_size(file, code);
  if (!code && size > kMostBytes)
    return refuse("the file has " + std::to_string(size >> 20u) + " MiB, at most " +
                      std::to_string(kMostBytes >> 20u) + " are read",
                  "a studio is far smaller: is this the right file?");
  std::ifstream in(file, std::ios::binary);
  std::string content(static_cast<std::size_t>(size), '\0');
  in.read(content.data(), static_cast<std::streamsize>(content.size()));
  if (code || !in) return refuse("this file cannot be read", "check its permissions");
  return content;
}

std::filesystem::path existing_file(const Tree& where, const std::string& name,
                                    const std::string& what, Context& context) {
  namespace fs = std::filesystem;
  std::error_code code;
  std::string looked;
  // Over-long names make the system calls fail: that counts as "not there".
  for (const fs::path& folder : {context.base, context.folders.config}) {
    const fs::path candidate = fs::absolute(folder / name, code).lexically_normal();
    if (!code && fs::is_regular_file(candidate, code)) return candidate;
    if (fs::path(name).is_absolute()) break;
    looked += (looked.empty() ? "" : " and ") + in_quotes(folder.string());
  }
  context.report.error(where, "there is no " + what + " " + in_quotes(name),
                       looked.empty() ? "check the path" : "check the path: looked in " + looked);
  return {};
}

std::filesystem::path existing_file(const Tree* tree, const std::string& what, Context& context) {
  const auto name = text(tree, context.report);
  return name ? existing_file(*tree, *name, what, context) : std::filesystem::path{};
}

}  // namespace chiaro::studio::reading
