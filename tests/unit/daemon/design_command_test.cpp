// SPDX-License-Identifier: Apache-2.0
// chiaro design, as a person types it: on the shipped studio, with few trials.
#include <fstream>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "controller/core/picture_file.h"
#include "controller/daemon/command.h"
#include "tests/support/fake_world.h"
#include "tests/support/studio_text.h"

namespace chiaro::daemon {
namespace {

class DesignCommand : public ::testing::Test {
 protected:
  DesignCommand() : fake_(clock_, network_, folder_.path()) {
    fake_.world.config_folder = support::shipped_folders().config;
  }
  ports::Exit run(std::vector<std::string> arguments) {
    fake_.out.str("");
    fake_.err.str("");
    arguments.insert(arguments.begin(), {"design", portrait()});
    return run_chiaro(arguments, fake_.world);
  }
  std::string portrait() const {
    return (support::shipped_folders().studios() / "portrait.yaml").string();
  }
  std::string file(const std::string& name) const { return (folder_.path() / name).string(); }

  support::TemporaryFolder folder_;
  support::FakeClock clock_;
  support::FakeNetwork network_;
  support::FakeWorld fake_;
};

TEST_F(DesignCommand, WritesLookAndPictureAndSaysItInTheTradesWords) {
  ASSERT_EQ(run({"--mood", "rembrandt", "--trials", "30", "--out", file("look.json"), "--picture",
                 file("look.png"), "--threads", "2"}),
            ports::Exit::done)
      << fake_.err.str();
  const auto look = nlohmann::json::parse(std::ifstream(file("look.json")));
  EXPECT_EQ(look["name"], "rembrandt");
  EXPECT_EQ(look["fixtures"].size(), 4u);
  EXPECT_TRUE(look["fixtures"]["key"]["wanted"].contains("azimuth_deg"));
  EXPECT_TRUE(look["fixtures"]["key"]["wanted"].contains("cct_k"));
  EXPECT_EQ(core::read_picture(file("look.png"))->size.height, 256);
  EXPECT_NE(fake_.out.str().find("camera left"), std::string::npos) << fake_.out.str();
  EXPECT_NE(fake_.out.str().find("key to fill"), std::string::npos) << fake_.out.str();
  EXPECT_EQ(fake_.err.str().find('\r'), std::string::npos) << "a log is not a terminal";
}

TEST_F(DesignCommand, JsonIsOneObjectOnStandardOutput) {
  ASSERT_EQ(run({"--mood", "split", "--trials", "10", "--json"}), ports::Exit::done);
  EXPECT_EQ(nlohmann::json::parse(fake_.out.str())["goal"], "by example, wavelet: split");
}

TEST_F(DesignCommand, OnATerminalProgressIsOneLineRedrawnAndWipedAtTheEnd) {
  fake_.world.err_is_terminal = true;
  ASSERT_EQ(run({"--mood", "split", "--trials", "10", "--lock", "fill"}), ports::Exit::done);
  const std::string text = fake_.err.str();
  EXPECT_EQ(text.find('\n'), std::string::npos) << text;
  EXPECT_NE(text.find("search: trial"), std::string::npos) << text;
  EXPECT_EQ(text.substr(text.size() - 4), "\r\x1b[K");
}

TEST_F(DesignCommand, UnknownMoodNamesTheNearestAndAll) {
  EXPECT_EQ(run({"--mood", "rembrant"}), ports::Exit::input_has_problems);
  EXPECT_NE(fake_.err.str().find("did you mean \"rembrandt\"? there are: "), std::string::npos)
      << fake_.err.str();
}

TEST_F(DesignCommand, UnknownLockNamesTheFixtures) {
  EXPECT_EQ(run({"--ideal", "--lock", "kye"}), ports::Exit::input_has_problems);
  EXPECT_NE(fake_.err.str().find("did you mean \"key\"? its fixtures are: key, fill, back, wall"),
            std::string::npos)
      << fake_.err.str();
}

TEST_F(DesignCommand, UsageFaultsAreUsageFaults) {
  EXPECT_EQ(run({}), ports::Exit::usage);
  EXPECT_EQ(run({"--ideal", "--mood", "split"}), ports::Exit::usage);
  EXPECT_EQ(run({"--ideal", "--budget", "2"}), ports::Exit::usage);
  EXPECT_EQ(run({"--ideal", "--budget", "2s", "--trials", "4"}), ports::Exit::usage);
  EXPECT_EQ(run({"--ideal", "--goal", "nice"}), ports::Exit::usage);
  EXPECT_EQ(run({"--mood", "split", "--blend", "loop"}), ports::Exit::usage);
  EXPECT_EQ(run({"--mood", "split", "--blend", "loop=1.5"}), ports::Exit::usage);
  EXPECT_EQ(run({"--ideal", "--blend", "loop=0.5"}), ports::Exit::usage);
}

TEST_F(DesignCommand, AGoalByHandIsSolvedForAndSaysWhatCameOfIt) {
  std::ofstream(file("goal.json"))
      << R"({"wishes": [{"lightness": 55, "region": "face"}], "bounds": {"power": {"at_most": 0.2}}})";
  ASSERT_EQ(run({"--goal", file("goal.json"), "--trials", "20", "--json"}), ports::Exit::done)
      << fake_.err.str();
  const auto components = nlohmann::json::parse(fake_.out.str())["components"];
  EXPECT_NEAR(components["lightness of the face"]["value"].get<double>(), 55, 6);
  EXPECT_LE(components["at most 20 % power"]["value"].get<double>(), 0.2001);
}

TEST_F(DesignCommand, AGoalByHandThatIsWrongIsRefusedWithEveryProblem) {
  std::ofstream(file("goal.json")) << R"({"paint": [{"region": "fce", "stops": 9}], "mve": true})";
  EXPECT_EQ(run({"--goal", file("goal.json")}), ports::Exit::input_has_problems);
  for (const char* each : {"did you mean 'face'?", "-6 to 6", "did you mean 'move'?"})
    EXPECT_NE(fake_.err.str().find(each), std::string::npos) << fake_.err.str();
  std::ofstream(file("like.json")) << R"({"like": "ideal", "impressions": {"clear": 1}})";
  EXPECT_EQ(run({"--mood", "split", "--goal", file("like.json")}), ports::Exit::input_has_problems);
}

TEST_F(DesignCommand, AnExemplarThatIsNoPictureIsRefused) {
  std::ofstream(file("no.png")) << "not a picture";
  EXPECT_EQ(run({"--exemplar", file("no.png")}), ports::Exit::input_has_problems);
  EXPECT_NE(fake_.err.str().find("no.png"), std::string::npos);
}

TEST_F(DesignCommand, AnOutputThatCannotBeWrittenIsSaid) {
  EXPECT_EQ(run({"--ideal", "--trials", "1", "--lock", "key", "--lock", "fill", "--out",
                 file("none/look.json")}),
            ports::Exit::input_has_problems);
  EXPECT_NE(fake_.err.str().find("look.json"), std::string::npos);
}

}  // namespace
}  // namespace chiaro::daemon
