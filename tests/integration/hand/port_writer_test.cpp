// SPDX-License-Identifier: Apache-2.0
// Ports that keep their caller waiting: the loop goes on, the device gets the newest frame.
#include <gtest/gtest.h>
#include <mutex>
#include <semaphore>
#include <thread>
#include <vector>

#include "controller/daemon/output/port_slot.h"
#include "tests/support/fake_clock.h"

namespace chiaro::daemon {
namespace {

using namespace std::chrono_literals;

/// A device that takes as long as the test says.
class SlowPort final : public ports::OutputPort {
 public:
  struct Wire {
    std::counting_semaphore<> may_send{0}, sending{0}, opened{0};
    std::mutex mutex;
    std::vector<int> levels;
    std::vector<std::thread::id> threads;
    bool unplugged = false;
    std::vector<int> got() {
      const std::scoped_lock lock(mutex);
      return levels;
    }
  };
  explicit SlowPort(Wire& wire) : wire_(wire) {}

  core::Result<core::Done> open() override {
    const std::scoped_lock lock(wire_.mutex);
    wire_.threads.push_back(std::this_thread::get_id());
    wire_.opened.release();
    report_.health = wire_.unplugged ? ports::PortHealth::lost : ports::PortHealth::good;
    if (wire_.unplugged) return core::Problem{{}, "not there", "plug it in"};
    return core::Done{};
  }
  void send(const ports::DmxFrame& frame, ports::TimePoint) override {
    wire_.sending.release();
    wire_.may_send.acquire();
    const std::scoped_lock lock(wire_.mutex);
    wire_.levels.push_back(frame.levels[0]);
    ++report_.frames_sent;
  }
  void release(ports::TimePoint) override { report_.health = ports::PortHealth::closed; }
  ports::PortReport report() const override { return report_; }
  bool blocks() const override { return true; }
  bool physical() const override { return true; }

 private:
  Wire& wire_;
  ports::PortReport report_;
};

ports::DmxFrame frame_of(int level) {
  ports::DmxFrame frame;
  frame.levels[0] = static_cast<std::uint8_t>(level);
  return frame;
}

class BlockingPort : public testing::Test {
 protected:
  void send(int level) {
    slot_.send(frame_of(level), clock_);
    clock_.sleep_until(slot_.next());
  }
  void until(bool (*condition)(const PortWriter&)) {
    while (!condition(*slot_.writer())) std::this_thread::yield();
  }
  support::FakeClock clock_{support::FakeClock::Sleep::jumps};
  SlowPort::Wire wire_;
  PortSlot slot_{"slow", {}, std::make_unique<SlowPort>(wire_), 40, clock_, false};
};

TEST_F(BlockingPort, KeepsTheLoopWaitingForNothingAndGetsTheNewestFrame) {
  wire_.opened.acquire();
  slot_.start(clock_.now());
  send(1);
  wire_.sending.acquire();  // the device has frame 1 in hand
  for (int level = 2; level <= 9; ++level) send(level);
  EXPECT_TRUE(wire_.got().empty());
  wire_.may_send.release(2);
  wire_.sending.acquire();
  slot_.release(clock_.now());
  EXPECT_EQ(wire_.got(), (std::vector{1, 9}));
  rig::Sent::Port report;
  slot_.report(report);
  EXPECT_EQ(report.missed + report.late, 0u);
  EXPECT_EQ(report.frames, 2u);
}

TEST_F(BlockingPort, IsOpenedAndMendedOnItsOwnThread) {
  wire_.opened.acquire();
  until([](const PortWriter& writer) { return writer.attempted(); });
  EXPECT_EQ(slot_.health(), ports::PortHealth::good);
  slot_.writer()->mend();
  wire_.opened.acquire();
  slot_.release(clock_.now());
  ASSERT_EQ(wire_.threads.size(), 2u);
  EXPECT_EQ(wire_.threads[0], wire_.threads[1]);
  EXPECT_NE(wire_.threads[0], std::this_thread::get_id());
}

TEST(BlockingPortThatIsNotThere, SaysSoOnceAndNotAtEveryAttempt) {
  support::FakeClock clock{support::FakeClock::Sleep::jumps};
  SlowPort::Wire wire;
  wire.unplugged = true;
  PortSlot slot{"slow", {}, std::make_unique<SlowPort>(wire), 40, clock, false};
  const auto attempt = [&] {
    wire.opened.acquire();
    slot.writer()->mend();
    wire.opened.acquire();  // so the attempt before has been published
  };
  attempt();
  EXPECT_EQ(slot.writer()->take_problems().size(), 1u);
  slot.writer()->mend();
  attempt();
  EXPECT_TRUE(slot.writer()->take_problems().empty());
  EXPECT_EQ(slot.health(), ports::PortHealth::lost);
}

/// Its frames leave 23 and 27 ms apart by turns, whatever the loop does.
class SelfTimedPort final : public ports::OutputPort {
 public:
  explicit SelfTimedPort(std::counting_semaphore<>& sent) : sent_(sent) {}
  core::Result<core::Done> open() override {
    report_.health = ports::PortHealth::good;
    return core::Done{};
  }
  void send(const ports::DmxFrame&, ports::TimePoint) override {
    ++report_.frames_sent;
    report_.left += report_.frames_sent % 2 == 0 ? 23ms : 27ms;
    sent_.release();
  }
  void release(ports::TimePoint) override {}
  ports::PortReport report() const override { return report_; }
  bool blocks() const override { return true; }
  bool physical() const override { return true; }

 private:
  std::counting_semaphore<>& sent_;
  ports::PortReport report_;
};

TEST(APortThatTimesItsWire, SaysHowFarItsFramesStray) {
  support::FakeClock clock{support::FakeClock::Sleep::jumps};
  std::counting_semaphore<> sent{0};
  PortSlot slot{"slow", {}, std::make_unique<SelfTimedPort>(sent), 40, clock, false};
  slot.start(clock.now());
  for (int i = 0; i < 50; ++i) {
    slot.send(frame_of(i), clock);
    clock.sleep_until(slot.next());
    sent.acquire();
  }
  rig::Sent::Port report;
  slot.report(report);
  EXPECT_GE(report.jitter_us_p50, 2000);
  EXPECT_LE(report.jitter_us_p50, 2250) << "to the next step up, an eighth of an octave";
  slot.release(clock.now());
}

TEST(NewestFrame, IsNeverTornAndNeverGoesBackBetweenTwoThreads) {
  NewestFrame newest;
  constexpr int kFrames = 20000;
  std::thread putter([&] {
    ports::DmxFrame frame;
    for (int i = 1; i <= kFrames; ++i) {
      frame.levels.fill(static_cast<std::uint8_t>(i));
      frame.universe = static_cast<std::uint16_t>(i);
      newest.put(frame);
    }
  });
  int last = 0;
  while (last < kFrames) {
    const ports::DmxFrame* frame = newest.take();
    if (frame == nullptr) continue;
    ASSERT_GT(frame->universe, last);
    last = frame->universe;
    for (const std::uint8_t level : frame->levels)
      ASSERT_EQ(level, static_cast<std::uint8_t>(last));
  }
  putter.join();
}

}  // namespace
}  // namespace chiaro::daemon
