// SPDX-License-Identifier: Apache-2.0
// What a person asks of the hand itself, over its socket, as it arrives on the wire; no brain
// needed.
#include <nlohmann/json.hpp>

#include "tests/integration/hand/running_hand.h"

namespace chiaro::daemon {
namespace {

using core::Dof;
using rig::Source;
using Json = nlohmann::json;
using support::fixture_line;
using namespace std::chrono_literals;

class Asked : public RunningHand {
 protected:
  Asked() {
    write_studio(
        support::studio_text(fixture_line("a", "generic/daylight-dimmer", "1ch", 1, 1) +
                             fixture_line("b lamp", "generic/daylight-dimmer", "1ch", 1, 2)));
  }
  Json ask(const std::string& line) {
    const auto answer = meanwhile([&] { return hand_request(runtime(), line, 20s); });
    return answer ? Json::parse(*answer) : Json{{"refused", core::to_string(answer.problems())}};
  }
  bool refuses(const std::string& line, const std::string& words) {
    const Json answer = ask(line);
    return answer.value("refused", "").find(words) != std::string::npos;
  }
  void look(double a, double b, std::uint64_t id, double fade_s = 0) {
    rig::Wanted wanted;
    auto& source = wanted.sources[static_cast<std::size_t>(Source::look)];
    source.fade_id = id;
    source.fade_s = fade_s;
    source.fixtures.resize(2);
    source.fixtures[0].set(Dof::intensity, a);
    source.fixtures[1].set(Dof::intensity, b);
    brain_->post(wanted, clock_->now());
  }
  int slot(std::size_t which) {
    hear();
    run(75ms);
    return level(which);
  }
  std::unique_ptr<HandLink> brain_;
};

TEST_F(Asked, HighlightsAndSolosLampsByNameWithoutABrain) {
  start();
  EXPECT_EQ(ask("mark highlight on b lamp")["mark"], "highlight");
  EXPECT_EQ(slot(2), 255);
  EXPECT_EQ(slot(1), 0);
  ask("mark highlight off b lamp");
  EXPECT_EQ(slot(2), 0);
  ask("mark highlight on *");
  EXPECT_EQ(slot(1), 255);
  EXPECT_EQ(ask("status")["lamps"][1]["marks"][0], "highlight");
  ask("marks off");
  EXPECT_EQ(slot(1), 0);
  EXPECT_TRUE(refuses("mark highlight on blamp", "did you mean 'b lamp'?"));
  EXPECT_TRUE(refuses("mark glow on a", "unknown mark"));
}

TEST_F(Asked, RecordsCuesAndPlaysThemWhenTheBrainHasGone) {
  start();
  EXPECT_TRUE(refuses("cue go", "there is no cue yet"));
  brain_ = brain();
  look(1, 0, 1);
  run(200ms);
  ask("cue record 1 fade 0 name First light");
  look(0, 1, 2);
  run(200ms);
  ask("cue record 2 fade 1 follow 20");
  look(0.5, 0.5, 3);
  run(200ms);
  EXPECT_EQ(ask("cue record 3 fade 0")["cues"].size(), 3u);
  brain_.reset();
  EXPECT_EQ(ask("cue to 1")["name"], "First light");
  EXPECT_EQ(slot(1), 255);
  EXPECT_EQ(slot(2), 0);
  EXPECT_EQ(ask("cue go")["playing"], 2.0);
  EXPECT_EQ(ask("cue list")["cues"][1]["playing"], true);
  run(1100ms);
  EXPECT_EQ(slot(1), 0);
  EXPECT_EQ(slot(2), 255);
  run(20s);  // cue 3 follows by itself
  EXPECT_EQ(slot(1), 128);
  EXPECT_TRUE(refuses("cue go", "cue 3 is the last one"));
  ask("cue back");
  run(1100ms);
  EXPECT_EQ(slot(2), 255);
  ask("cue remove 2");
  EXPECT_TRUE(refuses("cue to 2", "there is no cue 2"));
  EXPECT_TRUE(refuses("cue record x", "unknown cue request"));
}

TEST_F(Asked, StaysInItsCueAcrossAPowerCutThoughTheBrainSaysItsOldLookAgain) {
  start();
  brain_ = brain();
  look(0.2, 0.2, 7);
  run(200ms);
  ask("cue record 1 fade 0");
  look(1, 0.5, 8);
  run(200ms);
  ask("cue to 1");
  EXPECT_EQ(slot(1), 51);
  run(2s);
  stop();
  start();
  EXPECT_EQ(slot(1), 51);
  look(1, 0.5, 8);
  run(200ms);
  EXPECT_EQ(slot(1), 51);
  EXPECT_EQ(ask("status")["cue"]["playing"], 1.0);
  look(1, 0.5, 9);
  run(200ms);
  EXPECT_EQ(slot(1), 255);
  EXPECT_EQ(ask("status")["cue"]["playing"], nullptr);
}

TEST_F(Asked, LatchesTheMotionStopAcrossAPowerCutAndArmsOnlyAfterItsRelease) {
  start();
  EXPECT_EQ(ask("motion arm")["armed"], true);
  EXPECT_EQ(ask("motion stop")["armed"], false);
  run(2s);
  stop();
  start();
  run(100ms);
  EXPECT_EQ(ask("status")["motion"]["stopped"], true);
  EXPECT_TRUE(refuses("motion arm", "motion is stopped"));
  EXPECT_EQ(ask("motion release")["stopped"], false);
  EXPECT_EQ(ask("motion arm")["armed"], true);
  stop();
  start();
  run(100ms);
  EXPECT_EQ(ask("status")["motion"]["armed"], false);  // disarmed at every start
  EXPECT_TRUE(refuses("motion dance", "known: stop, release, arm, disarm"));
}

TEST_F(Asked, AnswersTextThatIsNotWholeAndGoesOn) {
  start();
  const std::string astride(79, 'a');
  ask("cue record 1 fade 0 name " + astride + "\xc3\xa4 and more");
  EXPECT_EQ(ask("cue list")["cues"][0]["name"], astride);  // never half a letter
  const std::vector<std::string> verbs{"",     "mark ",   "level ",         "master ",
                                       "cue ", "motion ", "record start /", "cue record 2 name "};
  for (const std::size_t size : {39u, 40u, 60u, 80u})
    for (const std::string& letter : {std::string("\xff"), std::string("\xc3\xa4\xc3\xa4")})
      for (const std::string& verb : verbs) {
        const std::string line = verb + std::string(size, 'b') + letter + " c";
        const auto answer = meanwhile([&] { return hand_request(runtime(), line, 20s); });
        const std::string refused = answer ? "" : core::to_string(answer.problems());
        EXPECT_EQ(refused.find("in time"), std::string::npos) << line << ": " << refused;
      }
  EXPECT_EQ(ask("status")["caution"], "hold");
}

TEST_F(Asked, TakesACueOffInAShortFade) {
  start();
  ask("level 100 a");
  ask("cue record 1 fade 0");
  ask("level release a");
  run(1s);
  ask("cue go");
  EXPECT_EQ(slot(1), 255);
  hear();
  ask("cue off");
  run(1s);
  bool between = false;
  for (const auto& packet : hear())
    between = between || (packet.level(1) > 0 && packet.level(1) < 255);
  EXPECT_TRUE(between);
  EXPECT_EQ(slot(1), 0);
}

TEST_F(Asked, GoesOnThroughAFullDiskAndSaysItOnce) {
  start();
  brain_ = brain();
  std::filesystem::remove_all(state());
  std::ofstream(state()) << "in the way";  // nothing can be written below it
  look(1, 1, 1);
  run(5s);
  look(0.5, 1, 2);
  run(5s);
  const auto heard = hear();
  ASSERT_EQ(heard.size(), 401u);
  EXPECT_EQ(heard.back().level(1), 128);
  EXPECT_TRUE(refuses("cue record 1", "cannot write"));
  stop();
  std::size_t times = 0;
  for (auto at = told_.find("cannot write"); at != std::string::npos;
       at = told_.find("cannot write", at + 1))
    ++times;
  EXPECT_EQ(times, 1u);
  std::filesystem::remove(state());
}

TEST_F(Asked, SetsLevelsAndMastersWithoutABrainAndGivesThemBack) {
  start();
  EXPECT_EQ(ask("level 50 b lamp")["level"], 0.5);
  EXPECT_EQ(slot(2), 128);
  EXPECT_EQ(ask("master grand 50")["level"], 0.5);
  EXPECT_EQ(slot(2), 64);
  EXPECT_EQ(ask("status")["masters"]["grand"], 0.5);
  EXPECT_EQ(ask("level release *")["released"], true);
  run(1s);
  EXPECT_EQ(slot(2), 0);
  EXPECT_TRUE(refuses("level 101 a", "unknown level"));
  EXPECT_TRUE(refuses("level 50 blamp", "did you mean 'b lamp'?"));
  EXPECT_TRUE(refuses("master hair 50", "unknown master"));
}

TEST_F(Asked, KeepsWhatTheBrainSaysBackWhileItIsBlind) {
  start();
  brain_ = brain();
  EXPECT_EQ(ask("blind on")["blind"], true);
  look(1, 0, 1);
  EXPECT_EQ(slot(1), 0);
  EXPECT_EQ(ask("status")["blind"], true);
  ask("blind off");
  look(1, 0, 1);
  EXPECT_EQ(slot(1), 255);
}

TEST_F(Asked, ComesBackFromAPowerCutWithItsOwnFadersThoughTheBrainSaysTheOldLook) {
  start();
  brain_ = brain();
  look(1, 1, 1);
  run(200ms);
  ask("level 20 a");
  EXPECT_EQ(ask("master grand 50")["level"], 0.5);
  run(3s);
  EXPECT_EQ(ask("status")["masters"]["grand"], 0.5);
  EXPECT_EQ(slot(1), 26);  // 0.2 * 0.5 * 255 = 25.5
  stop();
  start();
  look(1, 1, 1);
  EXPECT_EQ(slot(1), 26);
  look(1, 1, 1);
  EXPECT_EQ(slot(1), 26);
  EXPECT_EQ(slot(2), 128);
}

}  // namespace
}  // namespace chiaro::daemon
