// SPDX-License-Identifier: Apache-2.0
// chiaro design on what cannot be lit as asked: the answer says so in plain words, is the best
// there is, holds no number that is none, and comes after the trials that were asked for.
#include <cmath>
#include <fstream>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "controller/core/picture_file.h"
#include "controller/daemon/command.h"
#include "tests/support/fake_world.h"
#include "tests/support/studio_text.h"

namespace chiaro::daemon {
namespace {

using Json = nlohmann::json;

/// NaN and infinity become null in JSON. So do advice that is not needed, a ratio of lamps that are
/// dark, and what a component has no target for.
void expect_no_null(const Json& value, const std::string& where) {
  if (where == "/advised_white_balance_k" || where == "/key_fill_ratio" ||
      where.ends_with("/target"))
    return;
  EXPECT_FALSE(value.is_null()) << where;
  if (value.is_structured())
    for (const auto& [key, each] : value.items()) expect_no_null(each, where + "/" + key);
}

class BadInput : public ::testing::Test {
 protected:
  BadInput() : fake_(clock_, network_, folder_.path()) {
    fake_.world.config_folder = support::shipped_folders().config;
    std::ifstream shipped(support::shipped_folders().studios() / "portrait.yaml");
    text_.assign(std::istreambuf_iterator<char>(shipped), {});
    change("mesh: subjects", "mesh: " + support::shipped_folders().subjects().string());
  }
  void change(const std::string& from, const std::string& to) {
    const auto at = text_.find(from);
    ASSERT_NE(at, std::string::npos) << from;
    text_.replace(at, from.size(), to);
  }
  /// Everything that was said, the look as JSON apart.
  std::string designed(std::vector<std::string> arguments,
                       ports::Exit expected = ports::Exit::done) {
    const auto file = folder_.path() / "studio.yaml";
    std::ofstream(file) << text_;
    fake_.out.str("");
    fake_.err.str("");
    arguments.insert(arguments.begin(), {"design", file.string(), "--json", "--threads", "2"});
    EXPECT_EQ(run_chiaro(arguments, fake_.world), expected) << fake_.err.str();
    look_ = Json::parse(fake_.out.str(), nullptr, false);
    if (expected == ports::Exit::done) expect_no_null(look_, "");
    return fake_.err.str();
  }
  std::string plain_picture(core::Rgb colour) const {
    core::Picture picture({64, 64});
    for (int y = 0; y < 64; ++y)
      for (int x = 0; x < 64; ++x) picture.set(x, y, colour);
    const auto file = folder_.path() / "plain.png";
    EXPECT_TRUE(core::write_png(file, core::encoded(picture)));
    return file.string();
  }
  static bool says(const std::string& text, const std::string& words) {
    return text.find(words) != std::string::npos;
  }

  support::TemporaryFolder folder_;
  support::FakeClock clock_;
  support::FakeNetwork network_;
  support::FakeWorld fake_;
  std::string text_;
  Json look_;
};

TEST_F(BadInput, ABlackPictureDarkensEveryLampAndSaysWhy) {
  const std::string said = designed({"--exemplar", plain_picture({0, 0, 0}), "--trials", "20"});
  EXPECT_TRUE(says(said, "the reference picture is black")) << said;
  EXPECT_TRUE(says(said, "key: dark")) << said;
}

TEST_F(BadInput, SaturatedRedIsOutOfReachOfWhiteLampsThatComeAsNearAsTheyCan) {
  change("profile: generic/rgbw", "profile: generic/daylight-dimmer");
  change("mode: 4ch\n", "mode: 1ch\n");
  const std::string said = designed({"--exemplar", plain_picture({1, 0, 0}), "--trials", "20"});
  EXPECT_TRUE(says(said, "not reachable")) << said;
  EXPECT_TRUE(says(said, "far more red than these lamps make it: fit a red gel")) << said;
  EXPECT_LT(look_["fixtures"]["key"]["wanted"]["cct_k"].get<double>(), 4000)
      << "as warm as it goes";
}

TEST_F(BadInput, LampsThatAreTooFarAwaySayHowMuchIsMissing) {
  for (const char* place : {"distance: [1.2 m, 2.4 m]", "distance: [1.2 m, 2.6 m]"})
    change(place, "distance: [4.6 m, 5 m]");
  change("distance: 1.8 m}", "distance: 4.8 m}");
  change("distance: 2.0 m}", "distance: 4.8 m}");
  change("ceiling: 3.2 m", "ceiling: 8 m");
  change("output: 14000 cd", "output: 2000 cd");
  const std::string said = designed({"--mood", "high-key", "--trials", "20", "--lock", "wall"});
  EXPECT_TRUE(says(said, "short: ")) << said;
  EXPECT_FALSE(says(said, ": reached")) << said;
}

TEST_F(BadInput, WhereNoPlaceIsAllowedLampsStayAndEachReasonIsGiven) {
  change("azimuth: [-80 deg, 80 deg]", "azimuth: [-3 deg, 3 deg]");
  change("azimuth: -45 deg, elevation: 35 deg", "azimuth: 0 deg, elevation: 0 deg");
  change("elevation: [-45 deg, 70 deg]", "elevation: [-3 deg, 3 deg]");
  const std::string said = designed({"--mood", "rembrandt", "--trials", "20"});
  EXPECT_TRUE(says(said, "no allowed place was found for the lamps together")) << said;
  EXPECT_TRUE(says(said, "key would show in the picture of camera main")) << said;
}

TEST_F(BadInput, WithEveryLampLockedItSaysToUnlockOne) {
  const std::string said = designed({"--mood", "rembrandt", "--lock", "key", "--lock", "fill",
                                     "--lock", "back", "--lock", "wall"});
  EXPECT_TRUE(says(said, "every lamp is locked: unlock one")) << said;
  EXPECT_TRUE(says(said, "0 trials")) << said;
}

TEST_F(BadInput, NoTrialsAndNoTimeAreRefusedWithWhatWouldDo) {
  EXPECT_TRUE(says(designed({"--mood", "rembrandt", "--trials", "0"}, ports::Exit::usage),
                   "Value 0 not in range"))
      << fake_.err.str();
  EXPECT_TRUE(says(designed({"--mood", "rembrandt", "--budget", "0s"}, ports::Exit::usage),
                   "is not a time such as 2s or 500ms"))
      << fake_.err.str();
}

TEST_F(BadInput, OneTrialIsEnoughForAnAnswer) {
  designed({"--mood", "rembrandt", "--trials", "1"});
  EXPECT_EQ(look_["fixtures"].size(), 4u);
}

TEST_F(BadInput, ASubjectOfOnePixelIsSaidToBeTooSmall) {
  change("height: 0.62 m ", "aim: [0, 0, 1.5]\n  height: 0.012 m ");
  change("at: [0, 0, 1.05]", "at: [0, 0, 1.52]");
  const std::string said = designed({"--mood", "rembrandt", "--trials", "20"});
  EXPECT_TRUE(says(said, "too few to judge its light")) << said;
}

TEST_F(BadInput, ASubjectThatTheCameraDoesNotSeeIsSaid) {
  change("height: 0.62 m ", "aim: [0, 0, 1.5]\n  height: 0.62 m ");
  change("at: [0, 0, 1.05]", "at: [0, -6, 1.05]");
  for (const std::vector<std::string>& goal :
       {std::vector<std::string>{"--mood", "rembrandt"}, {"--ideal"}}) {
    std::vector<std::string> arguments = goal;
    arguments.insert(arguments.end(), {"--trials", "20"});
    const std::string said = designed(arguments);
    EXPECT_TRUE(says(said, "camera main sees nothing of the subject")) << said;
  }
}

}  // namespace
}  // namespace chiaro::daemon
