// SPDX-License-Identifier: Apache-2.0
// Files that nobody wrote in good faith, or that a full disk cut short: each is refused with a
// sentence, in little time and memory.
#include <fstream>
#include <gtest/gtest.h>

#include "controller/studio/load.h"
#include "tests/support/fake_world.h"
#include "tests/support/studio_text.h"

namespace chiaro::studio {
namespace {

std::string first_problem(const std::string& text) {
  support::TemporaryFolder folder;
  const auto loaded = parse_studio(text, folder.path(), support::shipped_folders());
  return loaded.ok() ? "" : core::to_string(loaded.problems().front());
}

TEST(HostileStudio, EmptyOrNothingButComments) {
  for (const char* text : {"", " \n\t\n"})
    EXPECT_EQ(first_problem(text),
              "studio.yaml: the file is empty (`chiaro new` writes a first one)");
  EXPECT_EQ(first_problem("# nothing\n"),
            "studio.yaml: the file holds nothing but comments (`chiaro new` writes a first one)");
}

TEST(HostileStudio, BytesThatAreNotText) {
  const std::string expected =
      "this is not text (byte 12 of the file) (is this the right file? Save it as UTF-8 text)";
  EXPECT_EQ(first_problem(std::string("studio: abc\0def\n", 16)), "studio.yaml:1: " + expected);
  EXPECT_EQ(first_problem("studio: abc\xff\n"), "studio.yaml:1: " + expected);
  EXPECT_EQ(first_problem("studio: a\nb\xc0\x80\n"), "studio.yaml:2: " + expected);
  EXPECT_EQ(first_problem("studio: abc\x1b[2J\n"), "studio.yaml:1: " + expected);
}

TEST(HostileStudio, ThousandsOfBracketsInOneAnother) {
  for (const char* open : {"[", "{a: ", "- "}) {
    std::string text = "studio: ";
    if (*open == '-') text = "";
    for (int i = 0; i < 20000; ++i) text += open;
    const std::string said = first_problem(text);
    EXPECT_NE(said, "");
    EXPECT_LT(said.size(), 400u) << said;
  }
}

TEST(HostileStudio, AnAliasBombIsDefusedBeforeItUnfolds) {
  std::string text = "a0: &a0 [x, x, x, x, x, x, x, x, x, x]\n";
  for (int i = 1; i < 12; ++i) {
    const std::string before = "*a" + std::to_string(i - 1);
    text += "a" + std::to_string(i) + ": &a" + std::to_string(i) + " [";
    for (int k = 0; k < 10; ++k) text += (k > 0 ? ", " : "") + before;
    text += "]\n";
  }
  EXPECT_NE(first_problem(text).find("the file holds more than 100000 values"), std::string::npos);
}

TEST(HostileStudio, AnAliasWithinWhatItRepeats) {
  const std::string said = first_problem("studio: &me {name: *me}\n");
  EXPECT_NE(said.find("studio.yaml:1:20: "), std::string::npos) << said;
}

TEST(HostileStudio, AliasesOfGoodSizeAreUnderstood) {
  support::TemporaryFolder folder;
  support::write_full_studio_files(folder.path());
  std::string text = support::edited(support::full_studio_text(), "at: {azimuth: -45 deg",
                                     "at: &front {azimuth: -45 deg");
  text = support::edited(text, "at: {azimuth: 10 deg, elevation: 20 deg, distance: 2 m}",
                         "at: *front");
  const auto loaded = parse_studio(text, folder.path(), support::shipped_folders());
  ASSERT_TRUE(loaded.ok()) << core::to_string(loaded.problems());
  EXPECT_DOUBLE_EQ(std::get<VirtualMount>(loaded->studio.fixture("free")->mount).at.distance, 1.8);
}

TEST(HostileStudio, NotAMappingAtAll) {
  for (const char* text : {"just words\n", "[1, 2, 3]\n", "42\n", "~\n"})
    EXPECT_NE(first_problem(text), "") << text;
  EXPECT_NE(first_problem("? [a, b]\n: c\n"), "");
}

TEST(HostileStudio, TwoDocumentsInOneFile) {
  EXPECT_NE(first_problem(support::full_studio_text() + "---\nstudio: another\n")
                .find("the file holds a second document"),
            std::string::npos);
}

TEST(HostileStudio, SyntaxErrorsHaveTheirPlace) {
  EXPECT_EQ(first_problem("studio: a\ncameras: {main: [1, 2\n").rfind("studio.yaml:", 0), 0u);
  EXPECT_EQ(first_problem("studio: \"a\nb: c\n").rfind("studio.yaml:", 0), 0u);
  EXPECT_EQ(first_problem("studio: a\n\tb: c\n").rfind("studio.yaml:2:", 0), 0u);
}

TEST(HostileStudio, LongNamesAreCutInMessages) {
  const std::string said = first_problem("studio: a\n" + std::string(100000, 'k') + ": 1\n");
  EXPECT_LT(said.size(), 400u);
}

TEST(HostileStudio, ThousandsOfProblemsEndInOneSentence) {
  std::string text = "studio: a\n";
  for (int i = 0; i < 5000; ++i) text += "key" + std::to_string(i) + ": 1\n";
  support::TemporaryFolder folder;
  const auto loaded = parse_studio(text, folder.path(), support::shipped_folders());
  ASSERT_FALSE(loaded.ok());
  EXPECT_EQ(loaded.problems().size(), 501u);
  EXPECT_EQ(loaded.problems().back().what, "there are more problems than these");
}

TEST(HostileStudio, FiftyMegabytesAreRefusedByTheirSize) {
  support::TemporaryFolder folder;
  const auto file = folder.path() / "big.yaml";
  std::ofstream(file) << "studio: big\n";
  std::filesystem::resize_file(file, 50u << 20u);
  const auto loaded = load_studio(file, support::shipped_folders());
  ASSERT_FALSE(loaded.ok());
  EXPECT_EQ(core::to_string(loaded.problems().front()),
            file.string() +
                ": the file has 50 MiB, at most 2 are read (a studio is far smaller: is this the "
                "right file?)");
  EXPECT_NE(first_problem(std::string(50u << 20u, 'a')).find("50 MiB"), std::string::npos);
}

TEST(HostileStudio, TwoMegabytesOfNonsenseAreAnswered) {
  EXPECT_NE(first_problem(std::string((2u << 20u) - 1, '[')), "");
  EXPECT_NE(first_problem(std::string((2u << 20u) - 1, '-')), "");
  EXPECT_NE(first_problem(std::string((2u << 20u) - 1, '"')), "");
  std::string keys;
  while (keys.size() < (2u << 20u) - 10) keys += "a: b\n";
  EXPECT_NE(first_problem(keys), "");
}

TEST(HostileStudio, MissingFilesFoldersAndDevices) {
  support::TemporaryFolder folder;
  const auto said = [&](const std::filesystem::path& file) {
    const auto loaded = load_studio(file, support::shipped_folders());
    return loaded.ok() ? "" : core::to_string(loaded.problems().front());
  };
  const auto nowhere = folder.path() / "nowhere.yaml";
  EXPECT_EQ(said(nowhere), nowhere.string() + ": there is no such file (check the path)");
  EXPECT_EQ(said(folder.path()),
            folder.path().string() + ": this is a folder, not a file (name the .yaml file in it)");
  EXPECT_EQ(said("/dev/zero"), "/dev/zero: this is not an ordinary file (name a .yaml file)");
}

TEST(HostileStudio, ProfileNamesDoNotLeadOutOfTheFolder) {
  for (const char* name : {"../../../etc/passwd", "/etc/passwd", "generic/../generic/dimmer", ""}) {
    const auto profile = load_profile(name, support::shipped_folders());
    ASSERT_FALSE(profile.ok()) << name;
    EXPECT_NE(profile.problems().front().what.find("there is no fixture profile"),
              std::string::npos);
  }
}

TEST(HostileStudio, CutShortAnywhereItLoadsOrReports) {
  support::TemporaryFolder folder;
  support::write_full_studio_files(folder.path());
  const std::string& text = support::full_studio_text();
  for (std::size_t length = 0; length < text.size(); length += 13) {
    const auto loaded =
        parse_studio(text.substr(0, length), folder.path(), support::shipped_folders());
    if (!loaded.ok()) {
      EXPECT_TRUE(core::any_error(loaded.problems())) << length;
    }
  }
}

}  // namespace
}  // namespace chiaro::studio
