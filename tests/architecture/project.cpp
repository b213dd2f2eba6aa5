// SPDX-License-Identifier: Apache-2.0
#include "tests/architecture/project.h"

#include <algorithm>
#include <array>
#include <fstream>
#include <sstream>

namespace chiaro::architecture {
namespace {

namespace fs = std::filesystem;

// Folders that hold what was built or fetched, and git's own.
constexpr std::array kNotOurs{"build", "node_modules", "dist", ".git"};

bool is_text(const std::string& content) { return content.find('\0') == std::string::npos; }

File read(const fs::path& file) {
  std::ifstream stream(file, std::ios::binary);
  std::stringstream content;
  content << stream.rdbuf();
  File result{fs::relative(file, root()).generic_string(), {}};
  if (!is_text(content.str())) return result;
  for (std::string line; std::getline(content, line);) result.lines.push_back(line);
  return result;
}

std::vector<File> walk() {
  std::vector<File> found;
  for (auto at = fs::recursive_directory_iterator(root()); at != fs::end(at); ++at) {
    const auto name = at->path().filename().string();
    if (std::find(kNotOurs.begin(), kNotOurs.end(), name) != kNotOurs.end()) {
      if (at->is_directory()) at.disable_recursion_pending();
      continue;
    }
    if (!at->is_regular_file()) continue;
    auto file = read(at->path());
    if (!file.lines.empty()) found.push_back(std::move(file));
  }
  std::sort(found.begin(), found.end(),
            [](const File& a, const File& b) { return a.path < b.path; });
  return found;
}

}  // namespace

fs::path root() { return CHIARO_SOURCE; }

const std::vector<File>& files() {
  static const auto kFiles = walk();
  return kFiles;
}

bool is_cpp(const File& file) { return file.extension() == ".cpp" || file.extension() == ".h"; }

bool starts_with(const std::string& text, const std::string& start) {
  return text.compare(0, start.size(), start) == 0;
}

}  // namespace chiaro::architecture
