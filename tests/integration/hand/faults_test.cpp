// SPDX-License-Identifier: Apache-2.0
// Faults of the machine around the hand: a disk that is really full, a network interface that goes
// down, comes up, vanishes and returns. No frame is missed, nothing dips, levels are as before.
// These need root (a mount, a network namespace of their own): as another user they say so and are
// skipped; as root, as CI runs them, they must pass.
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <sched.h>
#include <sys/mount.h>
#include <unistd.h>

#include "controller/ports/output.h"
#include "drivers/common/system_network.h"
#include "tests/integration/hand/running_hand.h"

namespace chiaro::daemon {
namespace {

using namespace std::chrono_literals;
using support::fixture_line;

rig::Wanted want(double level, std::uint64_t fade_id) {
  rig::Wanted wanted;
  auto& look = wanted.sources[static_cast<std::size_t>(rig::Source::look)];
  look.fade_id = fade_id;
  look.fixtures.resize(2);
  for (auto& state : look.fixtures) state.set(core::Dof::intensity, level);
  return wanted;
}

std::string two_lamps() {
  return support::studio_text(fixture_line("a", "generic/daylight-dimmer", "1ch", 1, 1) +
                              fixture_line("c", "generic/daylight-dimmer", "1ch", 2, 1));
}

#define CHIARO_NEEDS_ROOT()                                                                \
  if (::geteuid() != 0)                                                                    \
  GTEST_SKIP() << "needs root, to mount a small disk and to make network interfaces in a " \
                  "namespace of its own: run ctest as root"

/// The state folder is a disk of its own, of 64 KB.
class FullDisk : public RunningHand {
 protected:
  void SetUp() override {
    CHIARO_NEEDS_ROOT();
    write_studio(two_lamps());
    std::filesystem::create_directories(state());
    ASSERT_EQ(::mount("chiaro", state().c_str(), "tmpfs", 0, "size=64k"), 0)
        << std::strerror(errno) << ": root without CAP_SYS_ADMIN cannot mount a disk";
    mounted_ = true;
  }
  void TearDown() override {
    stop();
    if (mounted_) ::umount2(state().c_str(), MNT_DETACH);
  }
  /// To the last byte.
  void fill() {
    std::ofstream ballast(state() / "ballast", std::ios::binary);
    const std::string page(4096, 'x');
    while (ballast << page << std::flush) {
    }
  }
  std::size_t told_times(const std::string& words) const {
    std::size_t times = 0;
    for (auto at = told_.find(words); at != std::string::npos; at = told_.find(words, at + 1))
      ++times;
    return times;
  }
  bool mounted_ = false;
};

TEST_F(FullDisk, CostsNoFrameAndLevelsAreKeptAgainOnceThereIsRoom) {
  start();
  auto brain = this->brain();
  brain->post(want(0.3, 1), clock_->now());
  run(3s);
  hear();
  fill();
  brain->post(want(0.8, 2), clock_->now());
  run(5s);
  auto heard = hear();
  ASSERT_EQ(heard.size(), 200u);
  for (std::size_t i = 1; i < heard.size(); ++i)
    ASSERT_EQ(heard[i].packet().sequence,
              static_cast<std::uint8_t>(heard[i - 1].packet().sequence + 1));
  EXPECT_EQ(heard.back().level(1), 204);
  std::filesystem::remove(state() / "ballast");
  brain->post(want(0.6, 3), clock_->now());
  run(3s);
  stop();
  EXPECT_EQ(told_times("cannot write"), 1u) << told_;
  brain.reset();
  hear();
  start();
  run(1s);
  for (const auto& packet : hear()) EXPECT_EQ(packet.level(1), 153);
}

TEST_F(FullDisk, LeavesTheLastLevelsThatWereWrittenWhole) {
  start();
  auto brain = this->brain();
  brain->post(want(0.3, 1), clock_->now());
  run(3s);
  fill();
  brain->post(want(0.8, 2), clock_->now());
  run(3s);
  stop();
  brain.reset();
  std::filesystem::remove_all(runtime());  // as a power cut does: no box is left
  hear();
  start();
  run(500ms);
  EXPECT_EQ(level(1), 77);  // 0.3: the newest that could be kept, not darkness
}

TEST_F(FullDisk, EndsARecordingWithAWordAndNotTheShow) {
  start();
  auto brain = this->brain();
  const auto tape = state() / "show.tape";
  ASSERT_TRUE(meanwhile([&] { return hand_request(runtime(), "record start " + tape.string()); }));
  fill();
  rig::Wanted moving = want(1, 1);
  for (std::uint64_t second = 1; second <= 10; ++second) {
    auto& look = moving.sources[static_cast<std::size_t>(rig::Source::look)];
    look.fade_id = second;
    look.fade_s = 1;
    for (auto& state : look.fixtures) state.set(core::Dof::intensity, second % 2 == 0 ? 0.1 : 1);
    brain->post(moving, clock_->now());
    run(1s);
  }
  EXPECT_GE(hear().size(), 400u);
  stop();
  EXPECT_EQ(told_times("the recording cannot be written"), 1u) << told_;
}

/// The hand on real sockets, in a network namespace of this thread's own: universe 1 leaves by
/// `wire0`, universe 2 by the loopback. Time is the test's.
class Interface : public RunningHand {
 protected:
  void SetUp() override { CHIARO_NEEDS_ROOT(); }
  void TearDown() override { stop(); }
  static bool ip(const std::string& words) {
    return std::system(("ip " + words + " >/dev/null 2>&1").c_str()) == 0;
  }
  static void make_wire() {
    ASSERT_TRUE(ip("link add wire0 type veth peer name wire1")) << "needs the package iproute2";
    ASSERT_TRUE(ip("addr add 10.9.9.1/24 dev wire0") && ip("link set wire0 up") &&
                ip("link set wire1 up"));
  }
  /// A thread in a namespace of its own; what it starts lives there too.
  template <class Body>
  void apart(Body body) {
    std::thread([&] {
      ASSERT_EQ(::unshare(CLONE_NEWNET), 0)
          << std::strerror(errno) << ": root without CAP_SYS_ADMIN cannot make a namespace";
      ASSERT_TRUE(ip("link set lo up")) << "needs the package iproute2";
      make_wire();
      body();
      stop();
      real_ears_.clear();
    }).join();
  }
  void start_on_the_wire() {
    std::string text = two_lamps();
    text.replace(text.find("interface: lo"), 13, "interface: wire0");
    write_studio(text);
    clock_ = std::make_unique<support::FakeClock>();
    world_ = std::make_unique<support::FakeWorld>(*clock_, real_, folder_.path());
    program_ = std::thread([this] {
      const std::vector<std::string> words{file().string(), "--no-real-time"};
      exit_ = run_output(words, world_->world);
    });
    ASSERT_TRUE(clock_->wait_for_sleepers(kThreads));
    listen_on("wire0", 1);
    listen_on("lo", 2);
  }
  void listen_on(const std::string& interface, std::uint16_t universe) {
    auto ear = real_.open_datagram({interface, drivers::sacn::kPort, true, false});
    ASSERT_TRUE(ear) << core::to_string(ear.problems());
    ASSERT_TRUE((*ear)->join(drivers::sacn::multicast_group(universe)));
    real_ears_[universe] = std::move(*ear);
  }
  /// Everything of that universe since the last call; a socket hears what others joined, too.
  std::vector<HeardPacket> heard(std::uint16_t universe) {
    std::vector<HeardPacket> all;
    HeardPacket next;
    while (real_ears_[universe]->receive(next.bytes, nullptr))
      if (drivers::sacn::parse(next.bytes) && next.packet().universe == universe)
        all.push_back(next);
    return all;
  }
  /// In steps short enough for the sockets' buffers.
  void run_and_hear(ports::Duration time) {
    for (; time > 0s; time -= 500ms) {
      run(500ms);
      for (const std::uint16_t universe : {std::uint16_t{1}, std::uint16_t{2}})
        for (const auto& packet : heard(universe)) all_[universe].push_back(packet);
    }
  }
  void expect_unbroken(std::uint16_t universe, int level) {
    const auto& packets = all_[universe];
    ASSERT_FALSE(packets.empty());
    for (std::size_t i = 0; i < packets.size(); ++i) {
      EXPECT_EQ(packets[i].level(1), level) << i;
      if (i == 0) continue;
      EXPECT_EQ(packets[i].packet().sequence,
                static_cast<std::uint8_t>(packets[i - 1].packet().sequence + 1));
    }
  }
  drivers::SystemNetwork real_;
  std::map<std::uint16_t, std::unique_ptr<ports::DatagramSocket>> real_ears_;
  std::map<std::uint16_t, std::vector<HeardPacket>> all_;
};

TEST_F(Interface, DownAndUpCostsTheOthersNothingAndComesBackAtTheSameLevels) {
  apart([&] {
    start_on_the_wire();
    auto brain = this->brain();
    brain->post(want(0.5, 1), clock_->now());
    run(500ms);
    heard(1);
    heard(2);
    run_and_hear(1s);
    expect_unbroken(1, 128);
    const std::size_t before = all_[1].size();
    ASSERT_TRUE(ip("link set wire0 down"));
    run_and_hear(3s);
    EXPECT_EQ(all_[1].size(), before);
    auto report = brain->report();
    ASSERT_TRUE(report);
    EXPECT_EQ(report->ports[0].health, static_cast<std::uint8_t>(ports::PortHealth::lost));
    EXPECT_GT(report->ports[0].failed, 80u);
    EXPECT_EQ(report->ports[1].failed + report->ports[1].missed, 0u);
    ASSERT_TRUE(ip("link set wire0 up"));
    run_and_hear(3s);
    EXPECT_GE(all_[1].size(), before + 40);
    for (const auto& packet : all_[1]) EXPECT_EQ(packet.level(1), 128);
    expect_unbroken(2, 128);
    EXPECT_EQ(all_[2].size(), 280u);  // 7 s
    report = brain->report();
    EXPECT_EQ(report->ports[0].health, static_cast<std::uint8_t>(ports::PortHealth::good));
  });
}

TEST_F(Interface, ThatVanishesAndReturnsIsTakenUpAgain) {
  apart([&] {
    start_on_the_wire();
    auto brain = this->brain();
    brain->post(want(0.5, 1), clock_->now());
    run_and_hear(1s);
    ASSERT_TRUE(ip("link del wire0"));
    run_and_hear(3s);
    make_wire();
    listen_on("wire0", 1);
    all_[1].clear();
    run_and_hear(5s);
    ASSERT_GE(all_[1].size(), 80u);
    for (const auto& packet : all_[1]) EXPECT_EQ(packet.level(1), 128);
    EXPECT_EQ(brain->report()->ports[1].missed, 0u);
  });
}

}  // namespace
}  // namespace chiaro::daemon
