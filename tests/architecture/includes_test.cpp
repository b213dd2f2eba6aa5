// SPDX-License-Identifier: Apache-2.0
// Who may include whom: the arrows of the architecture, kept by a test instead of by memory.
#include <algorithm>
#include <gtest/gtest.h>
#include <map>
#include <optional>
#include <regex>
#include <set>

#include "tests/architecture/project.h"

namespace chiaro::architecture {
namespace {

const std::map<std::string, std::vector<std::string>>& table() {
  static const std::map<std::string, std::vector<std::string>> kTable{
#define STAGE(folder, ...) {folder, __VA_ARGS__},
#include "tests/architecture/include_table.def"
#undef STAGE
  };
  return kTable;
}

bool lies_in(const std::string& path, const std::string& folder) {
  return starts_with(path, folder + "/");
}

/// The row with the longest folder that holds the file.
std::optional<std::string> stage_of(const std::string& path) {
  std::optional<std::string> best;
  for (const auto& [folder, may] : table())
    if (lies_in(path, folder) && (!best || folder.size() > best->size())) best = folder;
  return best;
}

std::optional<std::string> quoted_include(const std::string& line) {
  static const std::regex kInclude(R"re(^\s*#\s*include\s*"([^"]+)")re");
  std::smatch match;
  if (!std::regex_search(line, match, kInclude)) return std::nullopt;
  return match[1].str();
}

bool allowed(const std::string& stage, const std::string& included) {
  if (lies_in(included, stage)) return true;
  const auto& may = table().at(stage);
  return std::any_of(may.begin(), may.end(),
                     [&](const std::string& folder) { return lies_in(included, folder); });
}

/// "drivers/output/sacn" of a file in it; nothing for drivers/common and the registry.
std::optional<std::string> driver_of(const std::string& path) {
  static const std::regex kDriver("^(drivers/[a-z_]+/[a-z0-9_]+)/");
  std::smatch match;
  if (!std::regex_search(path, match, kDriver) || lies_in(path, "drivers/common"))
    return std::nullopt;
  return match[1].str();
}

TEST(Includes, EverySourceFolderHasARowInTheTable) {
  for (const auto& file : files())
    if (is_cpp(file)) {
      EXPECT_TRUE(stage_of(file.path)) << file.path;
    }
}

TEST(Includes, StayWithinTheTable) {
  for (const auto& file : files()) {
    if (!is_cpp(file)) continue;
    const auto stage = stage_of(file.path);
    if (!stage) continue;  // the test above says so
    for (const auto& line : file.lines)
      if (const auto included = quoted_include(line)) {
        EXPECT_TRUE(allowed(*stage, *included)) << file.path << " must not include " << *included;
      }
  }
}

TEST(Includes, NameFilesFromTheRootAndTheyExist) {
  for (const auto& file : files()) {
    if (!is_cpp(file)) continue;
    for (const auto& line : file.lines)
      if (const auto included = quoted_include(line)) {
        EXPECT_TRUE(std::filesystem::is_regular_file(root() / *included))
            << file.path << ": " << *included;
      }
  }
}

TEST(Includes, NoDriverKnowsAnother) {
  for (const auto& file : files()) {
    const auto mine = is_cpp(file) ? driver_of(file.path) : std::nullopt;
    if (!mine) continue;
    for (const auto& line : file.lines) {
      const auto included = quoted_include(line);
      const auto theirs = included ? driver_of(*included) : std::nullopt;
      EXPECT_TRUE(!theirs || *theirs == *mine) << file.path << ": " << line;
    }
  }
}

/// Headers of ours that pull in a heavy library, themselves or through another of ours.
std::set<std::string> heavy_headers() {
  static const std::regex kHeavy(
      R"(^\s*#\s*include\s*<(opencv2|embree3|Eigen|boost|yaml-cpp|nlohmann|CLI|tbb|oneapi|nlopt|spdlog|assimp|sqlite3|hwy|OpenEXR|Imf))");
  std::set<std::string> heavy;
  for (std::size_t before = 1; before != heavy.size();) {
    before = heavy.size();
    for (const auto& file : files()) {
      if (file.extension() != ".h") continue;
      for (const auto& line : file.lines) {
        const auto included = quoted_include(line);
        if (std::regex_search(line, kHeavy) || (included && heavy.count(*included) > 0))
          heavy.insert(file.path);
      }
    }
    if (heavy.empty()) break;
  }
  return heavy;
}

TEST(Includes, HeadersWithHeavyLibrariesStayInTheirOwnFolder) {
  const auto heavy = heavy_headers();
  for (const auto& file : files()) {
    if (!is_cpp(file)) continue;
    for (const auto& line : file.lines) {
      const auto included = quoted_include(line);
      if (!included || heavy.count(*included) == 0) continue;
      const auto folder = std::filesystem::path(*included).parent_path().generic_string();
      EXPECT_TRUE(lies_in(file.path, folder))
          << file.path << " must not see " << *included << ", which pulls in a heavy library";
    }
  }
}

}  // namespace
}  // namespace chiaro::architecture
