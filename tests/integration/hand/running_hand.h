// SPDX-License-Identifier: Apache-2.0
// chiaro-output in the test's own process: the real program on fake time and a network in memory.
#pragma once

#include <atomic>
#include <chrono>
#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include "controller/daemon/hand_link.h"
#include "controller/daemon/output/run_output.h"
#include "controller/studio/load.h"
#include "drivers/common/sacn_packet.h"
#include "tests/support/fake_world.h"
#include "tests/support/studios.h"

namespace chiaro::daemon {

/// A datagram as a lamp would hear it.
struct HeardPacket {
  drivers::sacn::Packet bytes{};
  drivers::sacn::DataPacket packet() const { return *drivers::sacn::parse(bytes); }
  int level(std::size_t slot) const { return bytes[drivers::sacn::at::levels + slot - 1]; }
};

/// One place with a clock, a network and a studio file. The hand may be stopped and started again.
class RunningHand : public testing::Test {
 protected:
  static constexpr std::size_t kThreads = 2;  // the loop and the housekeeper sleep on the clock

  RunningHand() {
    for (std::uint16_t universe = 1; universe <= 2; ++universe) listen(universe);
  }
  ~RunningHand() override { stop(); }

  void start(std::vector<std::string> options = {}) {
    options.insert(options.begin(), {file().string(), "--no-real-time"});
    clock_ = std::make_unique<support::FakeClock>();
    if (up_.count() > 0) clock_->advance(up_);
    world_ = std::make_unique<support::FakeWorld>(*clock_, network_, folder_.path());
    program_ = std::thread([this, options] { exit_ = run_output(options, world_->world); });
    ASSERT_TRUE(clock_->wait_for_sleepers(kThreads)) << "the program did not start";
  }
  ports::Exit stop() {
    if (!program_.joinable()) return exit_;
    world_->stop = true;
    up_ = clock_->now() - ports::TimePoint(std::chrono::seconds(1000));
    clock_->let_go();
    program_.join();
    told_ = world_->err.str();
    return exit_;
  }

  /// Lets the loop and its housekeeper do exactly what they do in that time.
  void run(ports::Duration time) { ASSERT_TRUE(clock_->run_for(time, kThreads)); }
  /// The same for a call that waits for the hand: time goes on until it has come back.
  template <class Call>
  auto meanwhile(Call call) {
    std::atomic<bool> done{false};
    decltype(call()) result = core::Problem{{}, "not called", ""};
    std::thread caller([&] {
      result = call();
      done = true;
    });
    while (!done) {
      clock_->run_for(std::chrono::milliseconds(1), kThreads);
      std::this_thread::yield();
    }
    caller.join();
    return result;
  }

  /// Everything that universe has sent since the last call.
  std::vector<HeardPacket> hear(std::uint16_t universe = 1) {
    std::vector<HeardPacket> heard;
    HeardPacket next;
    while (ears_[universe - 1u]->receive(next.bytes, nullptr)) heard.push_back(next);
    return heard;
  }
  /// The newest level of a slot; -1 when nothing came since the last call.
  int level(std::size_t slot, std::uint16_t universe = 1) {
    const auto heard = hear(universe);
    return heard.empty() ? -1 : heard.back().level(slot);
  }

  void write_studio(const std::string& text) { std::ofstream(file()) << text; }
  studio::Studio studio() {
    auto loaded = studio::load_studio(
        file(), studio::Folders{std::filesystem::path(CHIARO_SOURCE) / "config"});
    if (!loaded) throw std::runtime_error(core::to_string(loaded.problems()));
    return std::move(loaded->studio);
  }
  std::unique_ptr<HandLink> brain() {
    auto link = HandLink::open(runtime(), studio());
    if (!link) throw std::runtime_error(core::to_string(link.problems()));
    return std::move(*link);
  }
  std::filesystem::path file() const { return folder_.path() / "studio.yaml"; }
  std::filesystem::path runtime() const { return folder_.path() / "run"; }
  std::filesystem::path state() const { return folder_.path() / "state"; }

  void listen(std::uint16_t universe) {
    ports::Network::Options options;
    options.local_port = drivers::sacn::kPort;
    options.share_port = true;
    auto ear = network_.open_datagram(options);
    (void)(*ear)->join(drivers::sacn::multicast_group(universe));
    ears_.push_back(std::move(*ear));
  }

  support::TemporaryFolder folder_;
  support::FakeNetwork network_;
  std::unique_ptr<support::FakeClock> clock_;
  std::unique_ptr<support::FakeWorld> world_;
  std::vector<std::unique_ptr<ports::DatagramSocket>> ears_;
  std::thread program_;
  ports::Duration up_{};
  ports::Exit exit_ = ports::Exit::done;
  std::string told_;
};

}  // namespace chiaro::daemon
