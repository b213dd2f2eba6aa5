// SPDX-License-Identifier: Apache-2.0
// What every file must carry and what none may: licence lines, guards, and nothing about how, where
// or by whom the project is made.
#include <gtest/gtest.h>
#include <regex>

#include "tests/architecture/project.h"

namespace chiaro::architecture {
namespace {

bool is_code(const File& file) {
  static const std::regex kCode(R"(\.(cpp|h|ts|mjs|js|sh|cmake|css)$|(^|/)CMakeLists\.txt$)");
  return std::regex_search(file.path, kCode) || starts_with(file.lines.front(), "#!");
}

/// `pattern` in no line of no file. The patterns are put together from halves, so that this file
/// may be searched too.
void expect_nowhere(const std::regex& pattern, const std::string& what) {
  for (const auto& file : files())
    for (std::size_t i = 0; i < file.lines.size(); ++i)
      EXPECT_FALSE(std::regex_search(file.lines[i], pattern))
          << file.path << ":" << i + 1 << " " << what << ": " << file.lines[i];
}

std::regex any_case(const std::string& pattern) {
  return std::regex(pattern, std::regex::ECMAScript | std::regex::icase);
}

TEST(Words, TheWalkSeesTheProject) {
  std::size_t cpp = 0;
  for (const auto& file : files()) cpp += is_cpp(file);
  EXPECT_GT(cpp, 40u);
}

TEST(Words, EverySourceNamesItsLicenceFirst) {
  for (const auto& file : files()) {
    if (!is_code(file)) continue;
    const bool script = starts_with(file.lines.front(), "#!");
    ASSERT_GT(file.lines.size(), script ? 1u : 0u) << file.path;
    EXPECT_NE(file.lines[script ? 1 : 0].find("SPDX-License-Identifier: Apache-2.0"),
              std::string::npos)
        << file.path;
  }
}

TEST(Words, EveryHeaderIsReadOnce) {
  for (const auto& file : files()) {
    // Highway reads files called …-inl.h once for every instruction set.
    if (file.extension() != ".h" || file.path.ends_with("-inl.h")) continue;
    bool once = false;
    for (const auto& line : file.lines) once = once || line == "#pragma once";
    EXPECT_TRUE(once) << file.path;
  }
}

TEST(Words, NothingIsLeftForLater) {
  expect_nowhere(std::regex(std::string("\\b(TO") + "DO|FIX" + "ME|XX" + "X|HA" + "CK)\\b"),
                 "left for later");
}

TEST(Words, NothingSpeaksOfHowTheProjectIsMade) {
  const std::string open = "\\b(";
  expect_nowhere(any_case(open + "cla" + "ude|anth" + "ropic|open" + "ai|chat" + "gpt|cop" +
                          "ilot|sub" + "agent|large language" + " model)\\b"),
                 "speaks of a tool");
  expect_nowhere(std::regex(open + "A" + "I|L" + "LM)\\b"), "speaks of a tool");
  expect_nowhere(any_case(std::string("\\bissue") + "s? #?[0-9]"), "speaks of an issue");
}

TEST(Words, NoPathOfOneMachineAndNoRegistryHost) {
  expect_nowhere(std::regex(std::string("(^|[^A-Za-z0-9_.])/(wo") + "rk|ho" + "me)/"),
                 "is a path of one machine");
  expect_nowhere(any_case(std::string("(registry\\.npm") + "js|(deb|security|snapshot)\\.deb" +
                          "ian\\.org|npm" + "js\\.org)"),
                 "names a registry");
}

TEST(Words, LockFilesNameNoHost) {
  for (const auto& file : files()) {
    if (file.name() != "package-lock.json") continue;
    for (const auto& line : file.lines)
      EXPECT_EQ(line.find("\"resolved\""), std::string::npos) << file.path << ": " << line;
  }
}

TEST(Words, UnitTestsNeverSleep) {
  static const std::regex kSleep("sleep_for|sleep_until\\(std|usleep|nanosleep");
  for (const auto& file : files()) {
    if (!starts_with(file.path, "tests/unit/") && !starts_with(file.path, "tests/contract/"))
      continue;
    for (const auto& line : file.lines)
      EXPECT_FALSE(std::regex_search(line, kSleep)) << file.path << ": " << line;
  }
}

}  // namespace
}  // namespace chiaro::architecture
