// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <nlohmann/json.hpp>

#include "controller/ports/output.h"
#include "tests/integration/hand/running_hand.h"

namespace chiaro::daemon {
namespace {

using core::Dof;
using rig::Source;
using support::fixture_line;
using namespace std::chrono_literals;

/// Universe 1: lamp "a" in slot 1, "b" in 2; universe 2: "c" in 1.
std::string three_lamps(const std::string& more = "", const std::string& a = "") {
  return support::studio_text(fixture_line("a", "generic/daylight-dimmer", "1ch", 1, 1, a) +
                                  fixture_line("b", "generic/daylight-dimmer", "1ch", 1, 2) +
                                  fixture_line("c", "generic/daylight-dimmer", "1ch", 2, 1),
                              more);
}

rig::Wanted want(double level, std::uint64_t fade_id = 1, double fade_s = 0) {
  rig::Wanted wanted;
  auto& look = wanted.sources[static_cast<std::size_t>(Source::look)];
  look.fade_id = fade_id;
  look.fade_s = fade_s;
  look.fixtures.resize(3);
  for (auto& state : look.fixtures) state.set(Dof::intensity, level);
  return wanted;
}

class HandTest : public RunningHand {
 protected:
  HandTest() { write_studio(three_lamps()); }
  bool told(const std::string& words) const { return told_.find(words) != std::string::npos; }
};

TEST_F(HandTest, SendsEveryUniverseAtAConstantRateInUnbrokenSequenceUnderOneName) {
  start();
  run(10s);
  for (std::uint16_t universe = 1; universe <= 2; ++universe) {
    const auto heard = hear(universe);
    ASSERT_EQ(heard.size(), 401u);
    for (std::size_t i = 0; i < heard.size(); ++i) {
      const auto packet = heard[i].packet();
      ASSERT_EQ(packet.sequence, static_cast<std::uint8_t>(i + 1));
      ASSERT_EQ(packet.universe, universe);
      ASSERT_EQ(packet.source_name, "Chiaro: test");
      ASSERT_EQ(packet.cid, heard[0].packet().cid);
      ASSERT_FALSE(packet.preview || packet.terminated);
    }
  }
}

TEST_F(HandTest, KeepsItsCidAcrossRestarts) {
  start();
  run(50ms);
  const auto first = hear().back().packet().cid;
  stop();
  hear();
  start();
  run(50ms);
  EXPECT_EQ(hear().back().packet().cid, first);
}

TEST_F(HandTest, FadesToTheBytesThatTheClockAsksFor) {
  start();
  auto brain = this->brain();
  run(100ms);
  brain->post(want(1, 1, 2), clock_->now());
  run(500ms);
  // When the fade began, from the hand's own report; its frames lie on a grid of 25 ms.
  const auto report = brain->report();
  ASSERT_TRUE(report);
  const double gone = 2 * report->fade_progress[static_cast<std::size_t>(Source::look)];
  ASSERT_GT(gone, 0);
  const ports::TimePoint begun{ports::Duration(report->sent_ns - std::llround(gone * 1e9))};
  run(begun + 1s + 1us - clock_->now());
  EXPECT_EQ(level(1), 47);  // L* 50: Y 0.184187 * 255 = 46.97
  run(500ms);
  EXPECT_EQ(level(1), 123);  // L* 75: Y = (91/116)^3 = 0.482781 * 255 = 123.1
  run(500ms);
  EXPECT_EQ(level(1), 255);
}

TEST_F(HandTest, FinishesTheFadeAndHoldsWhenTheBrainDies) {
  start();
  auto brain = this->brain();
  brain->post(want(1, 1, 5), clock_->now());
  run(500ms);
  brain.reset();
  run(6s);
  EXPECT_EQ(level(1), 255);
  run(1min);
  EXPECT_EQ(level(1), 255);
  stop();
  EXPECT_TRUE(told("no word from chiarod: holding the levels"));
}

TEST_F(HandTest, LetsABrainThatComesBackAdoptWhatItFindsSoThatNothingChanges) {
  start();
  auto brain = this->brain();
  rig::Wanted wanted = want(0.5, 7, 0);
  wanted.masters[0] = 0.5;
  brain->post(wanted, clock_->now());
  run(200ms);
  const int before = level(1);
  EXPECT_EQ(before, 64);  // 0.25 * 255
  brain.reset();
  run(5s);
  brain = this->brain();
  run(100ms);
  const auto adopted = brain->adopted();
  ASSERT_TRUE(adopted);
  EXPECT_EQ(adopted->masters[0], 0.5);
  EXPECT_EQ(adopted->sources[static_cast<std::size_t>(Source::look)].fade_id, 7u);
  hear();
  brain->post(*adopted, clock_->now());
  run(500ms);
  for (const auto& packet : hear()) EXPECT_EQ(packet.level(1), before);
  EXPECT_TRUE(brain->hand_alive(clock_->now()));
  EXPECT_EQ(brain->report()->caution, rig::Caution::normal);
}

TEST_F(HandTest, LeavesNoGapInTheSequenceHoweverOftenTheBrainIsReplaced) {
  start();
  for (int i = 0; i < 20; ++i) {
    auto brain = this->brain();
    brain->post(want(0.5, static_cast<std::uint64_t>(i) + 1), clock_->now());
    run(130ms);
  }
  const auto heard = hear();
  for (std::size_t i = 1; i < heard.size(); ++i)
    ASSERT_EQ(heard[i].packet().sequence,
              static_cast<std::uint8_t>(heard[i - 1].packet().sequence + 1));
}

TEST_F(HandTest, DarkensWithinOneFrameOfABlackoutThoughNoBrainRuns) {
  write_studio(three_lamps("", "initial: {intensity: 60 %}, limits: {house_light: yes}"));
  start();
  {
    auto brain = this->brain();
    brain->post(want(0.8), clock_->now());
    run(200ms);
  }
  EXPECT_EQ(level(2), 204);
  const auto asked = clock_->now();
  ASSERT_TRUE(meanwhile([&] { return hand_blackout(runtime(), true, 30s); }));
  const auto heard = hear();
  EXPECT_EQ(heard.back().level(2), 0);    // dark before the answer came
  EXPECT_EQ(heard.back().level(1), 204);  // but not over the ladder
  EXPECT_EQ(level(1, 2), 0);
  std::size_t lit = 0;
  for (const auto& packet : heard) lit += packet.level(2) > 0 ? 1 : 0;
  EXPECT_LE(lit * 25ms, (clock_->now() - asked));
  run(2s);
  EXPECT_EQ(level(2), 0);  // latched
  ASSERT_TRUE(meanwhile([&] { return hand_blackout(runtime(), false, 30s); }));
  EXPECT_EQ(level(2), 204);
}

TEST_F(HandTest, ComesBackFromAPowerCutAtExactlyTheLevelsItHadWithoutADip) {
  start();
  auto brain = this->brain();
  brain->post(want(0.3), clock_->now());
  run(3s);
  stop();
  brain.reset();
  std::filesystem::remove_all(runtime());
  hear();
  start();
  run(1s);
  const auto heard = hear();
  ASSERT_FALSE(heard.empty());
  for (const auto& packet : heard) EXPECT_EQ(packet.level(1), 77);  // 0.3 * 255 = 76.5
}

TEST_F(HandTest, StaysDarkAcrossAPowerCutWhenItWasBlackedOut) {
  start();
  auto brain = this->brain();
  brain->post(want(0.3), clock_->now());
  run(1s);
  ASSERT_TRUE(meanwhile([&] { return hand_blackout(runtime(), true, 30s); }));
  run(2s);
  stop();
  brain.reset();
  std::filesystem::remove_all(runtime());
  hear();
  start();
  run(1s);
  EXPECT_EQ(level(1), 0);
  ASSERT_TRUE(meanwhile([&] { return hand_blackout(runtime(), false, 30s); }));
  EXPECT_EQ(level(1), 77);
}

TEST_F(HandTest, ComesUpDarkWhenTheStudioFileSaysSo) {
  write_studio(three_lamps("safety: {power_up: dark}\n"));
  start();
  auto brain = this->brain();
  brain->post(want(0.3), clock_->now());
  run(3s);
  stop();
  brain.reset();
  std::filesystem::remove_all(runtime());
  hear();
  start();
  run(1s);
  EXPECT_EQ(level(1), 0);
}

TEST_F(HandTest, SurvivesAnyLastLevelsFile) {
  for (const char* text :
       {"", "{", "[]", "{\"studio\":\"test\",\"fixtures\":3}",
        "{\"studio\":\"test\",\"fixtures\":{\"a\":{\"intensity\":\"x\"}},"
        "\"masters\":[null,\"x\"],\"blackout\":7}",
        "{\"studio\":\"test\",\"fixtures\":{},\"masters\":\"abc\",\"fade_ids\":{},"
        "\"master_ids\":7,\"latch_ids\":\"x\",\"own\":[],\"marks\":[],\"cue\":\"y\"}",
        "{\"studio\":\"test\",\"fixtures\":{\"a\":{\"intensity\":1e999}}}"}) {
    std::filesystem::create_directories(state());
    std::ofstream(state() / "last-levels.json") << text;
    start();
    run(50ms);
    EXPECT_EQ(level(1), 0) << text;
    EXPECT_EQ(stop(), ports::Exit::done);
  }
}

TEST_F(HandTest, RefusesTheBoxOfAnotherStudioAndHolds) {
  start();
  auto brain = this->brain();
  brain->post(want(0.5), clock_->now());
  run(200ms);
  EXPECT_EQ(level(1), 128);
  brain.reset();
  const auto other = support::studio_from(three_lamps("ceiling: 3 m\n"));
  auto stranger = HandLink::open(runtime(), other);
  ASSERT_TRUE(stranger);
  (*stranger)->post(want(1, 9), clock_->now());
  run(500ms);
  EXPECT_EQ(level(1), 128);
  EXPECT_FALSE((*stranger)->report());
  EXPECT_NE((*stranger)->silence().find("another studio file"), std::string::npos);
  stop();
  EXPECT_TRUE(told("another studio file"));
  EXPECT_TRUE(told("holding"));
}

TEST_F(HandTest, CarriesLevelsByNameOverAReloadWithoutABreakInTheStream) {
  start();
  auto brain = this->brain();
  brain->post(want(0.5), clock_->now());
  run(200ms);
  hear();
  // "a" moves to slot 11, "b" is gone, "d" is new.
  write_studio(support::studio_text(fixture_line("d", "generic/daylight-dimmer", "1ch", 1, 3) +
                                    fixture_line("a", "generic/daylight-dimmer", "1ch", 1, 11) +
                                    fixture_line("c", "generic/daylight-dimmer", "1ch", 2, 1)));
  ASSERT_TRUE(meanwhile([&] { return hand_reload(runtime(), 30s); }));
  run(100ms);
  const auto heard = hear();
  EXPECT_EQ(heard.back().level(11), 128);
  EXPECT_EQ(heard.back().level(1), 0);
  EXPECT_EQ(heard.back().level(3), 0);
  for (std::size_t i = 1; i < heard.size(); ++i) {
    EXPECT_EQ(heard[i].packet().sequence,
              static_cast<std::uint8_t>(heard[i - 1].packet().sequence + 1));
    EXPECT_TRUE(heard[i].level(1) == 128 || heard[i].level(11) == 128);
  }
  brain.reset();
  brain = this->brain();
  rig::Wanted again = want(0.5, 1);
  again.sources[static_cast<std::size_t>(Source::look)].fixtures[1].set(Dof::intensity, 1);
  brain->post(again, clock_->now());
  run(200ms);
  EXPECT_EQ(level(11), 255);
}

TEST_F(HandTest, ChangesNothingForABadStudioFileAndNamesEveryProblem) {
  start();
  auto brain = this->brain();
  brain->post(want(0.5), clock_->now());
  run(200ms);
  write_studio("studio: test\nsubjekt: {}\nfixtures: 3\n");
  const auto outcome = meanwhile([&] { return hand_reload(runtime(), 30s); });
  ASSERT_FALSE(outcome);
  EXPECT_GE(outcome.problems().size(), 2u);
  EXPECT_GT(outcome.problems()[0].where.line, 0);
  run(100ms);
  EXPECT_EQ(level(1), 128);
}

TEST_F(HandTest, ReloadsOnSighup) {
  start();
  run(100ms);
  write_studio(three_lamps("", "initial: {intensity: 40 %}"));
  world_->reload = true;
  run(500ms);
  stop();
  EXPECT_TRUE(told("read again"));
}

TEST_F(HandTest, CountsFramesThatAnUnpluggedLinkLosesAndRecovers) {
  start();
  auto brain = this->brain();
  brain->post(want(0.5), clock_->now());
  run(500ms);
  network_.unplug(true);
  run(2s);
  auto report = brain->report();
  ASSERT_TRUE(report);
  EXPECT_GT(report->ports[0].failed, 60u);
  EXPECT_EQ(report->ports[0].health, static_cast<std::uint8_t>(ports::PortHealth::lost));
  hear();
  network_.unplug(false);
  run(3s);
  const auto heard = hear();
  EXPECT_GE(heard.size(), 100u);
  EXPECT_EQ(heard.back().level(1), 128);
  report = brain->report();
  EXPECT_EQ(report->ports[0].health, static_cast<std::uint8_t>(ports::PortHealth::good));
  stop();
  EXPECT_TRUE(told("universe 1 cannot be sent; trying again"));
  EXPECT_TRUE(told("universe 1 is back"));
}

TEST_F(HandTest, StartsWithoutItsInterfaceAndSendsWhenItAppears) {
  write_studio([] {
    std::string text = three_lamps();
    for (auto at = text.find("interface: lo"); at != std::string::npos;
         at = text.find("interface: lo"))
      text.replace(at, 13, "interface: eth7");
    return text;
  }());
  start();
  run(1s);
  EXPECT_EQ(network_.sent(), 0u);
  network_.add_interface("eth7");
  run(5s);
  EXPECT_GT(hear().size(), 50u);
  stop();
  EXPECT_TRUE(told("there is no network interface 'eth7'"));
}

TEST_F(HandTest, SendsNotAByteInADryRunAndOtherwiseBehavesTheSame) {
  start({"--dry-run"});
  auto brain = this->brain();
  brain->post(want(0.5), clock_->now());
  run(2s);
  EXPECT_EQ(network_.sent(), 0u);
  const auto report = brain->report();
  ASSERT_TRUE(report);
  EXPECT_TRUE(report->dry_run);
  EXPECT_EQ(report->fixtures[0].get(Dof::intensity), 0.5);
  EXPECT_GE(report->ports[0].frames, 70u);
  stop();
  EXPECT_EQ(network_.sent(), 0u);
  EXPECT_TRUE(told("dry run"));
}

TEST_F(HandTest, SaysGoodbyeWithThreeTerminatedPacketsThatKeepTheLevels) {
  start();
  auto brain = this->brain();
  brain->post(want(0.5), clock_->now());
  run(500ms);
  EXPECT_EQ(stop(), ports::Exit::done);
  const auto heard = hear();
  ASSERT_GE(heard.size(), 4u);
  for (std::size_t i = 0; i < heard.size(); ++i)
    EXPECT_EQ(heard[i].packet().terminated, i + 3 >= heard.size());
  EXPECT_EQ(heard.back().level(1), 128);
  EXPECT_EQ(heard.back().packet().sequence,
            static_cast<std::uint8_t>(heard[heard.size() - 2].packet().sequence + 1));
}

TEST_F(HandTest, LetsTheLampsHoldWhenToldSo) {
  start({"--on-stop", "hold"});
  run(100ms);
  stop();
  for (const auto& packet : hear()) EXPECT_FALSE(packet.packet().terminated);
  EXPECT_TRUE(told("the lamps hold"));
}

TEST_F(HandTest, RefusesASecondHandAndASecondBrain) {
  start();
  run(50ms);
  support::FakeWorld other(*clock_, network_, folder_.path());
  const std::vector<std::string> words{file().string(), "--no-real-time"};
  EXPECT_EQ(run_output(words, other.world), ports::Exit::out_of_reach);
  EXPECT_NE(other.err.str().find("another chiaro-output is running"), std::string::npos);
  const auto brain = this->brain();
  const auto second = HandLink::open(runtime(), studio());
  ASSERT_FALSE(second);
  EXPECT_NE(second.problems()[0].what.find("another chiarod is running"), std::string::npos);
}

TEST_F(HandTest, AnswersItsStatusAndRefusesWhatItDoesNotKnow) {
  start();
  run(200ms);
  const auto status = meanwhile([&] { return hand_status(runtime(), 30s); });
  ASSERT_TRUE(status);
  const auto json = nlohmann::json::parse(*status);
  EXPECT_EQ(json["caution"], "hold");
  EXPECT_EQ(json["ports"].size(), 2u);
  EXPECT_EQ(json["ports"][0]["health"], "good");
}

TEST_F(HandTest, IsReportedMissingInOneClearSentence) {
  const auto outcome = hand_blackout(runtime(), true);
  ASSERT_FALSE(outcome);
  EXPECT_NE(outcome.problems()[0].what.find("chiaro-output is not running"), std::string::npos);
}

TEST_F(HandTest, GivesTheContractsExitCodes) {
  support::FakeClock clock(support::FakeClock::Sleep::jumps);
  support::FakeWorld world(clock, network_, folder_.path());
  const auto run_with = [&](std::vector<std::string> words) {
    return run_output(words, world.world);
  };
  EXPECT_EQ(run_with({}), ports::Exit::usage);
  EXPECT_EQ(run_with({"x.yaml", "--nonsense"}), ports::Exit::usage);
  EXPECT_EQ(run_with({(folder_.path() / "none.yaml").string()}), ports::Exit::input_has_problems);
  EXPECT_EQ(run_with({"--help"}), ports::Exit::done);
}

}  // namespace
}  // namespace chiaro::daemon
