// SPDX-License-Identifier: Apache-2.0
// Pages that name code drift when code moves: here every path and every name that they put in
// backticks is looked up.
#include <algorithm>
#include <gtest/gtest.h>
#include <regex>
#include <set>
#include <sstream>

#include "tests/architecture/project.h"

namespace chiaro::architecture {
namespace {

const std::vector<std::string> kPages{"controller/README.md", "README.md", "CONTRIBUTING.md"};

const File& page(const std::string& path) {
  for (const auto& file : files())
    if (file.path == path) return file;
  throw std::runtime_error(path + " is missing");
}

/// What stands between single backticks, outside of fenced blocks.
std::vector<std::string> quoted(const File& file) {
  static const std::regex kQuoted("`([^`]+)`");
  std::vector<std::string> found;
  bool fenced = false;
  for (const auto& line : file.lines) {
    if (starts_with(line, "```")) fenced = !fenced;
    if (fenced) continue;
    for (std::sregex_iterator at(line.begin(), line.end(), kQuoted), end; at != end; ++at)
      found.push_back((*at)[1].str());
  }
  return found;
}

bool is_path(const std::string& text) {
  static const std::regex kPath(R"(^[A-Za-z0-9_.-]+(/[A-Za-z0-9_.-]*)+$)");
  return std::regex_match(text, kPath);
}

bool is_name(const std::string& text) {
  static const std::regex kName(R"(^[A-Za-z_][A-Za-z0-9_]*(::[A-Za-z_][A-Za-z0-9_]*)*$)");
  return std::regex_match(text, kName);
}

/// The words of each source, file by file.
const std::vector<std::set<std::string>>& words_of_sources() {
  static const auto kWords = [] {
    static const std::regex kWord("[A-Za-z_][A-Za-z0-9_]*");
    std::vector<std::set<std::string>> all;
    for (const auto& file : files()) {
      if (!is_cpp(file) && file.extension() != ".ts") continue;
      if (starts_with(file.path, "tests/")) continue;
      std::set<std::string> words;
      for (const auto& line : file.lines)
        for (std::sregex_iterator at(line.begin(), line.end(), kWord), end; at != end; ++at)
          words.insert(at->str());
      all.push_back(std::move(words));
    }
    return all;
  }();
  return kWords;
}

/// Whether one source has every part of "Class::function".
bool is_in_the_code(const std::string& name) {
  std::vector<std::string> parts;
  std::istringstream text(name);
  for (std::string part; std::getline(text, part, ':');)
    if (!part.empty()) parts.push_back(part);
  const auto& sources = words_of_sources();
  return std::any_of(sources.begin(), sources.end(), [&](const std::set<std::string>& words) {
    return std::all_of(parts.begin(), parts.end(),
                       [&](const std::string& part) { return words.count(part) > 0; });
  });
}

TEST(Pages, NameOnlyPathsThatExist) {
  std::size_t paths = 0;
  for (const auto& path : kPages)
    for (const auto& text : quoted(page(path))) {
      // Words in capitals stand for a name of the reader's; "lights/" for a folder of a stage.
      const bool pattern =
          std::regex_search(text, std::regex("[A-Z]{3}|^(lights|terms|optimisers)/$"));
      if (!is_path(text) || pattern) continue;
      ++paths;
      EXPECT_TRUE(std::filesystem::exists(root() / text)) << path << ": `" << text << "`";
    }
  EXPECT_GT(paths, 30u);
}

TEST(Pages, NameOnlyFunctionsThatExist) {
  std::size_t names = 0;
  for (const auto& text : quoted(page("controller/README.md"))) {
    if (!is_name(text) || text == "backticks") continue;
    ++names;
    EXPECT_TRUE(is_in_the_code(text)) << "`" << text << "`";
  }
  EXPECT_GT(names, 40u);
}

TEST(Pages, LinkOnlyToFilesThatExist) {
  static const std::regex kLink(R"(\]\(([^)#:]+)\))");
  for (const auto& path : kPages) {
    const auto folder = std::filesystem::path(path).parent_path();
    for (const auto& line : page(path).lines)
      for (std::sregex_iterator at(line.begin(), line.end(), kLink), end; at != end; ++at)
        EXPECT_TRUE(std::filesystem::exists(root() / folder / (*at)[1].str())) << path << line;
  }
}

TEST(Pages, QuickstartsPackagesAreListedOnce) {
  std::set<std::string> names;
  for (const auto& line : page("config/packages.txt").lines) {
    if (line.empty() || line[0] == '#') continue;
    EXPECT_TRUE(names.insert(line).second) << line;
  }
  EXPECT_GT(names.size(), 20u);
}

}  // namespace
}  // namespace chiaro::architecture
