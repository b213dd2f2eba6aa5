// SPDX-License-Identifier: Apache-2.0
// `chiaro new`, answered through a pipe.
#include <cmath>
#include <fstream>
#include <gtest/gtest.h>

#include "controller/daemon/command.h"
#include "controller/studio/load.h"
#include "tests/support/fake_world.h"
#include "tests/support/studio_text.h"

namespace chiaro::daemon {
namespace {

class NewCommand : public ::testing::Test {
 protected:
  NewCommand() : fake_(clock_, network_, folder_.path()) {
    fake_.world.config_folder = support::shipped_folders().config;
  }
  ports::Exit run(const std::string& answers, std::vector<std::string> more = {}) {
    fake_.in.clear();
    fake_.in.str(answers);
    fake_.err.str("");
    std::vector<std::string> arguments{"new", "--out", file().string()};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return run_chiaro(arguments, fake_.world);
  }
  std::filesystem::path file() const { return folder_.path() / "studio.yaml"; }
  studio::Studio loaded() const {
    const auto loaded = studio::load_studio(file(), support::shipped_folders());
    EXPECT_TRUE(loaded.ok()) << core::to_string(loaded.problems());
    if (!loaded.ok()) return {};
    EXPECT_TRUE(loaded->warnings.empty()) << core::to_string(loaded->warnings);
    return loaded->studio;
  }
  bool said(const std::string& words) const {
    return fake_.err.str().find(words) != std::string::npos;
  }
  support::TemporaryFolder folder_;
  support::FakeClock clock_{support::FakeClock::Sleep::jumps};
  support::FakeNetwork network_;
  support::FakeWorld fake_;
};

/// Name, sitter, eyes, ceiling, wall, camera (distance, height, angle, picture), lux, balance,
/// wire.
const std::string kRoom = "Attic\n\n1.3 m\n2.8 m\n\n\n\n\n\n\n\n\n";

TEST_F(NewCommand, EnterAloneMakesAStudioThatLoads) {
  ASSERT_EQ(run(std::string(60, '\n')), ports::Exit::done) << fake_.err.str();
  const studio::Studio studio = loaded();
  EXPECT_EQ(studio.name, "my studio");
  ASSERT_EQ(studio.fixtures.size(), 3u);
  EXPECT_EQ(studio.fixtures[0].role, studio::Role::key);
  EXPECT_TRUE(studio.subjects[0].stand_in);
  EXPECT_EQ(std::get<studio::SacnOutput>(studio.outputs[0].driver).interface, "lo");
}

TEST_F(NewCommand, AnswersEndUpInTheFile) {
  const std::string lamp =
      "main light\nkey\ngeneric/rgbw\n8ch-16bit\n7\n100\nstand\n47 left, 38 up, 1.6 m\n";
  ASSERT_EQ(run(kRoom + "1\n" + lamp), ports::Exit::done) << fake_.err.str();
  const studio::Studio studio = loaded();
  EXPECT_EQ(studio.name, "Attic");
  EXPECT_DOUBLE_EQ(studio.subjects[0].eye_height, 1.3);
  EXPECT_DOUBLE_EQ(*studio.ceiling, 2.8);
  const studio::Fixture& lamp_read = studio.fixtures.at(0);
  EXPECT_EQ(lamp_read.name, "main light");
  EXPECT_EQ(lamp_read.profile.modes[lamp_read.mode].name, "8ch-16bit");
  EXPECT_EQ(std::get<studio::DmxPatch>(lamp_read.patch).universe, 7);
  EXPECT_EQ(std::get<studio::DmxPatch>(lamp_read.patch).address, 100);
  const auto& stand = std::get<studio::StandMount>(lamp_read.mount);
  EXPECT_NEAR(core::degrees(stand.at.azimuth), -47, 1e-9);
  EXPECT_NEAR(core::degrees(stand.at.elevation), 38, 1e-9);
  EXPECT_NEAR(stand.at.distance, 1.6, 1e-9);
}

TEST_F(NewCommand, ALampThatHangsStandsWhereItWasSaidToBe) {
  const std::string lamp = "back\nback\n\n\n\n\nhung\nstraight behind, level, 1.5 m\n";
  ASSERT_EQ(run(kRoom + "1\n" + lamp), ports::Exit::done) << fake_.err.str();
  const auto mount = std::get<studio::FixedMount>(loaded().fixtures.at(0).mount);
  EXPECT_NEAR(mount.at.x, 0, 1e-3);
  EXPECT_NEAR(mount.at.y, 1.5, 1e-3);
  EXPECT_NEAR(mount.at.z, 1.3, 1e-3);
}

TEST_F(NewCommand, BadAnswersAreAskedAgainWithAReason) {
  const std::string first =
      "key\nkei\nkey\ngeneric/bicolor-panel\n\n5ch\n2ch\n0\n1\n512\n1\nmaybe\nstand\nover there\n"
      "47 left, 38 up, 0.2 m\n47 left, 80 up, 3 m\n47 left, 38 up, 1.6 m\n";
  const std::string second = "key\nfill\n\n\n\n\n2\n3\n\n\n";
  ASSERT_EQ(run("\nnobody.ply\nperson\n9 m\n1.2 m\n" + std::string(9, '\n') + "none\n2\n" + first +
                second),
            ports::Exit::done)
      << fake_.err.str();
  for (const char* words :
       {"there is no file 'nobody.ply' (answer 'person', or the path of a mesh)",
        "9 m is out of range (0.3 m to 2.5 m)", "'kei' is not one of key, fill",
        "did you mean 'generic/bicolour-panel'?", "'5ch' is not one of 2ch",
        "'0' is not a whole number from 1 to 63999", "it needs 2 slots and would run past 512",
        "'maybe' is not one of stand, hung, arc or track", "what does 'over' mean?",
        "a lamp comes no nearer to a sitter than 0.6 m", "above the ceiling (3 m)",
        "there is a lamp called 'key' already", "that overlaps 'key' (1 to 2) (address 3 is free)"})
    EXPECT_TRUE(said(words)) << words << "\n" << fake_.err.str();
  EXPECT_EQ(loaded().fixtures.size(), 2u);
}

TEST_F(NewCommand, WhenTheAnswersEndNothingIsWritten) {
  for (int lines = 0; lines < 20; lines += 3) {
    EXPECT_EQ(run(std::string(static_cast<std::size_t>(lines), '\n')),
              ports::Exit::input_has_problems);
    EXPECT_TRUE(said("the answers ended before the last question: nothing was written"));
    EXPECT_TRUE(std::filesystem::is_empty(folder_.path()) || !std::filesystem::exists(file()));
  }
}

TEST_F(NewCommand, AFileThatIsThereStaysUnlessForced) {
  std::ofstream(file()) << "mine\n";
  EXPECT_EQ(run(std::string(60, '\n')), ports::Exit::input_has_problems);
  EXPECT_TRUE(
      said("this file is there already (name another with --out, or overwrite it with "
           "--force)"));
  std::ifstream in(file());
  std::string word;
  in >> word;
  EXPECT_EQ(word, "mine");
  EXPECT_EQ(run(std::string(60, '\n'), {"--force"}), ports::Exit::done);
  EXPECT_EQ(loaded().name, "my studio");
}

TEST_F(NewCommand, QuotesAndBackslashesInANameSurvive) {
  ASSERT_EQ(run("The \"big\" C:\\room # 1\n" + std::string(60, '\n')), ports::Exit::done);
  EXPECT_EQ(loaded().name, "The \"big\" C:\\room # 1");
}

TEST_F(NewCommand, ALampWithoutAProfileIsLearnedSlotBySlot) {
  const std::string lamp =
      "odd panel\nkey\nlearn\n3\n1\n21\ndimmer\nagain\nfine\ncct\n4000 cd\nstand\n\n";
  ASSERT_EQ(run(kRoom + "1\n" + lamp), ports::Exit::done) << fake_.err.str();
  const studio::Studio studio = loaded();
  const studio::Fixture& learned = studio.fixtures.at(0);
  EXPECT_EQ(learned.profile.name, "own/odd-panel");
  EXPECT_EQ(learned.profile.modes.at(0).footprint, 3);
  EXPECT_EQ(learned.profile.emitter.kind, studio::Emitter::Kind::bicolour);
  EXPECT_EQ(std::get<studio::DmxPatch>(learned.patch).address, 21);
  // Four times three seconds at 20 Hz, each with its zeros and its goodbyes.
  EXPECT_GE(network_.sent(), 4u * 61u);
  EXPECT_TRUE(std::filesystem::exists(folder_.path() / "fixtures/own/odd-panel.yaml"));
}

TEST_F(NewCommand, AnArcRoundTheSitterGoesThroughWhereItsLampIsNow) {
  const std::string lamp =
      "key\nkey\ngeneric/dimmer\n1ch\n1\n21\narc\n45 left, 30 up, 2 m\nround\n50 deg\n16\n3\n";
  const std::string next = "fill\nfill\ngeneric/dimmer\n1ch\n1\n24\n25\nstand\n\n";
  ASSERT_EQ(run(kRoom + "2\n" + lamp + next), ports::Exit::done) << fake_.err.str();
  const studio::Studio studio = loaded();
  const auto& arc = std::get<studio::ArcMount>(studio.fixtures.at(0).mount);
  EXPECT_FALSE(arc.vertical);
  EXPECT_NEAR(arc.radius, 2 * std::cos(core::radians(30)), 1e-3);
  EXPECT_NEAR(arc.centre.z, 1.3 + 2 * std::sin(core::radians(30)), 1e-3);
  EXPECT_NEAR(core::degrees(arc.at), -45, 0.1);
  EXPECT_NEAR(core::degrees(arc.angle.least), -95, 1);
  EXPECT_EQ(arc.axis.universe, 0);
  EXPECT_EQ(arc.axis.slot, 3);
  EXPECT_EQ(arc.axis.bytes, 2);
  EXPECT_EQ(studio.fixtures.at(0).footprint(), 4);
  EXPECT_TRUE(said("that overlaps 'key' (21 to 24)")) << "the motor's slots are taken";
}

TEST_F(NewCommand, AnArcOverTheSitterStandsUpright) {
  const std::string lamp =
      "key\nkey\ngeneric/dimmer\n1ch\n\n\narc\n40 right, 50 up, 1.5 m\nover\n20\n8\n\n";
  ASSERT_EQ(run(kRoom + "1\n" + lamp), ports::Exit::done) << fake_.err.str();
  const auto arc = std::get<studio::ArcMount>(loaded().fixtures.at(0).mount);
  EXPECT_TRUE(arc.vertical);
  EXPECT_NEAR(arc.centre.x, 1.5 * std::cos(core::radians(50)) * std::sin(core::radians(40)), 1e-3);
  EXPECT_NEAR(arc.centre.z, 1.3, 1e-3);
  EXPECT_EQ(arc.axis.universe, 0);
  EXPECT_EQ(arc.axis.slot, 2);
  EXPECT_EQ(arc.axis.bytes, 1);
}

TEST_F(NewCommand, ATrackRunsFromOneEndToTheOther) {
  const std::string lamp =
      "rail\nback\ngeneric/dimmer\n1ch\n\n\ntrack\n150 left, 30 up, 1.6 m\n"
      "150 left, 30 up, 1.6 m\n150 right, 30 up, 1.6 m\n25\n16\n\n";
  ASSERT_EQ(run(kRoom + "1\n" + lamp), ports::Exit::done) << fake_.err.str();
  const auto track = std::get<studio::TrackMount>(loaded().fixtures.at(0).mount);
  EXPECT_NEAR(track.from.x, -track.to.x, 1e-3);
  EXPECT_NEAR(track.from.y, track.to.y, 1e-3);
  EXPECT_NEAR(track.at, 0.25, 1e-9);
  EXPECT_EQ(track.axis.universe, 0);
  EXPECT_EQ(track.axis.slot, 2);
  EXPECT_TRUE(said("both ends are in the same place"));
}

TEST_F(NewCommand, WhatGivesNoLightIsAskedAgain) {
  const std::string lamp = "odd\nkey\nlearn\n1\n\n\npan\n\ndimmer\n\nstand\n\n";
  ASSERT_EQ(run(kRoom + "1\n" + lamp), ports::Exit::done) << fake_.err.str();
  EXPECT_TRUE(said("no slot gave light"));
}

TEST_F(NewCommand, AFolderThatIsNotThereIsSaidBeforeAnythingIsAsked) {
  EXPECT_EQ(
      run_chiaro(std::vector<std::string>{"new", "--out", "/nowhere/at/all.yaml"}, fake_.world),
      ports::Exit::input_has_problems);
  EXPECT_EQ(
      fake_.err.str(),
      "/nowhere/at/all.yaml: its folder is not there (make it, or name another with --out)\n");
}

}  // namespace
}  // namespace chiaro::daemon
