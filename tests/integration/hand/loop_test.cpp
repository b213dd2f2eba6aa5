// SPDX-License-Identifier: Apache-2.0
// What the loop's thread may not do, watched: it allocates and frees nothing.
#include <gtest/gtest.h>

#include "controller/daemon/box_words.h"
#include "controller/daemon/file_lock.h"
#include "controller/daemon/hand_link.h"
#include "controller/daemon/output/hand.h"
#include "drivers/common/surroundings.h"
#include "tests/support/allocation_guard.h"
#include "tests/support/fake_world.h"
#include "tests/support/studios.h"

namespace chiaro::daemon {
namespace {

using namespace std::chrono_literals;
using support::fixture_line;

class Loop : public testing::Test {
 protected:
  static studio::Studio lamps(int count) {
    std::string fixtures;
    for (int i = 0; i < count; ++i)
      fixtures += fixture_line("lamp" + std::to_string(i), "generic/rgbw", "8ch-16bit", 1 + i / 60,
                               1 + 8 * (i % 60));
    return support::studio_from(support::studio_text(fixtures));
  }
  std::unique_ptr<Show> show(const studio::Studio& studio, const Show* before = nullptr) {
    core::Problems warnings;
    Show::Options options;
    options.around = &around_;
    auto made = Show::make(studio, options, world_.world, nullptr, before, warnings);
    if (!made) throw std::runtime_error(core::to_string(made.problems()));
    return std::move(*made);
  }
  void frames(Hand& hand, int count) {
    for (int i = 0; i < count; ++i) {
      hand.frame(clock_);
      clock_.sleep_until(hand.next_deadline());
    }
  }

  support::TemporaryFolder folder_;
  support::FakeClock clock_{support::FakeClock::Sleep::jumps};
  support::FakeNetwork network_;
  support::FakeWorld world_{clock_, network_, folder_.path()};
  drivers::Surroundings around_{world_.world.network, world_.world.devices, world_.world.clock};
};

TEST_F(Loop, AllocatesNothingWhileItFadesReportsAndIsSwapped) {
  const auto studio = lamps(100);
  auto link = HandLink::open(world_.world.runtime_folder, studio);
  ASSERT_TRUE(link);
  Hand hand(show(studio));
  auto reader = BoxReader::open(world_.world.runtime_folder / "wanted.box", wanted_format(studio));
  ASSERT_TRUE(reader);
  hand.show().give_reader(std::move(*reader));
  rig::Wanted wanted;
  auto& look = wanted.sources[static_cast<std::size_t>(rig::Source::look)];
  look.fixtures.resize(100);
  look.fade_s = 1;
  LiveTape tape(studio.outputs.size());
  hand.record_to(tape);
  hand.start(clock_.now());
  long allocations = 0;
  for (int round = 0; round < 20; ++round) {
    look.fade_id = static_cast<std::uint64_t>(round) + 1;
    for (auto& state : look.fixtures) state.set(core::Dof::intensity, round % 2);
    (*link)->post(wanted, clock_.now());
    if (round == 2) tape.begin();
    if (round == 7) hand.wish_blackout(true);
    if (round == 9) hand.wish_blackout(false);
    if (round == 11) network_.unplug(true);
    if (round == 13) network_.unplug(false);
    std::unique_ptr<Show> next = round == 15 ? show(lamps(90), &hand.show()) : nullptr;
    if (next) hand.offer(std::move(next));
    const support::AllocationCount count;
    frames(hand, 30);
    allocations += count.count();
  }
  EXPECT_EQ(allocations, 0);
  EXPECT_NE(hand.collect(), nullptr);
}

TEST_F(Loop, SkipsTheDeadlinesItMissedAndCountsThemInsteadOfSendingABurst) {
  const auto studio = lamps(1);
  Hand hand(show(studio));
  hand.start(clock_.now());
  frames(hand, 10);
  const auto before = network_.sent();
  clock_.advance(1s);  // the machine was asleep
  frames(hand, 1);
  EXPECT_EQ(network_.sent() - before, 2u);  // two universes, once each
  hand.finish();
  auto reader = BoxReader::open(world_.world.runtime_folder / "sent.box", sent_format(studio));
  ASSERT_TRUE(reader);
  std::vector<std::uint64_t> words(sent_format(studio).words);
  ASSERT_TRUE((*reader)->read(words));
  rig::Sent sent = sized_sent(studio);
  from_words(words, sent);
  EXPECT_EQ(sent.ports[0].missed, 40u);
  EXPECT_EQ(sent.ports[0].late, 1u);
  EXPECT_EQ(sent.ports[0].frames, 11u);
}

TEST_F(Loop, CarriesEveryWordOfBothDirectionsThroughTheBoxes) {
  const auto studio = lamps(2);
  rig::Sent sent = sized_sent(studio);
  sent.studio_fingerprint = 1;
  sent.sent_ns = -2;
  sent.fixtures[1].set(core::Dof::zoom, 0.25);
  sent.held[0].set(core::Dof::intensity, 0.125);
  sent.sources[3].fixtures[1].set(core::Dof::red, 1);
  sent.sources[3].fade_id = 77;
  sent.masters[4] = 0.5;
  sent.fade_progress[1] = 0.75;
  sent.caution = rig::Caution::fade_to_safe;
  sent.blackout = true;
  sent.blackout_id = 9;
  sent.ports[1] = {2, 1, 40, 100, 1, 2, 3, 0.5, 4, 12};
  sent.ports[1].slots[0] = 7;
  sent.ports[1].slots[511] = 255;
  sent.dry_run = true;
  std::vector<std::uint64_t> words(sent_format(studio).words);
  to_words(sent, words);
  rig::Sent back = sized_sent(studio);
  from_words(words, back);
  EXPECT_EQ(back.sent_ns, -2);
  EXPECT_EQ(back.fixtures, sent.fixtures);
  EXPECT_EQ(back.held, sent.held);
  EXPECT_EQ(back.sources[3].fixtures, sent.sources[3].fixtures);
  EXPECT_EQ(back.sources[3].fade_id, 77u);
  EXPECT_EQ(back.masters, sent.masters);
  EXPECT_EQ(back.fade_progress, sent.fade_progress);
  EXPECT_EQ(back.caution, sent.caution);
  EXPECT_TRUE(back.blackout && back.dry_run && !back.real_time && !back.refused);
  EXPECT_EQ(back.blackout_id, 9u);
  EXPECT_EQ(back.ports[1].universe, 2);
  EXPECT_EQ(back.ports[1].missed, 3u);
  EXPECT_EQ(back.ports[1].jitter_us_p999, 12);
  EXPECT_EQ(back.ports[1].slots, sent.ports[1].slots);
}

TEST_F(Loop, CarriesTheSlotsThatAPersonTries) {
  const auto studio = lamps(1);
  rig::Wanted wanted = sized_wanted(studio);
  wanted.tried[31] = {2, 512, 255};
  wanted.tried_until_ns = -5;
  std::vector<std::uint64_t> words(wanted_format(studio).words);
  to_words(wanted, 1, words);
  rig::Wanted back = sized_wanted(studio);
  from_words(words, back);
  EXPECT_EQ(back.tried[31].universe, 2);
  EXPECT_EQ(back.tried[31].slot, 512);
  EXPECT_EQ(back.tried[31].level, 255);
  EXPECT_EQ(back.tried_until_ns, -5);
}

TEST(Jitter, FindsTheShareOfGapsWithinItsSteps) {
  Jitter jitter;
  for (int i = 0; i < 990; ++i) jitter.add(10us);
  for (int i = 0; i < 10; ++i) jitter.add(-3ms);
  EXPECT_NEAR(jitter.microseconds(0.5), 10, 1.3);
  EXPECT_NEAR(jitter.microseconds(0.99), 10, 1.3);
  EXPECT_NEAR(jitter.microseconds(0.999), 3000, 375);
  EXPECT_EQ(Jitter().microseconds(0.5), 0);
}

}  // namespace
}  // namespace chiaro::daemon
