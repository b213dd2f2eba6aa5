// SPDX-License-Identifier: Apache-2.0
// The brain without sockets: its planner is real, its clock is the test's, and the hand is the
// other end of the boxes or nobody.
#pragma once

#include <condition_variable>
#include <deque>
#include <fstream>
#include <gtest/gtest.h>
#include <mutex>
#include <nlohmann/json.hpp>

#include "controller/core/picture_file.h"
#include "controller/daemon/brain/brain.h"
#include "controller/panel/gestures.h"
#include "tests/support/fake_brain.h"
#include "tests/support/fake_world.h"

namespace chiaro::daemon {

using Json = nlohmann::json;
using namespace std::chrono_literals;

/// What the loop would run, run by the test.
class Queue {
 public:
  void post(std::function<void()> work) {
    const std::lock_guard lock(mutex_);
    work_.push_back(std::move(work));
    changed_.notify_all();
  }
  /// One piece of work, waited for.
  void run_one() {
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [this] { return !work_.empty(); });
    const auto work = std::move(work_.front());
    work_.pop_front();
    lock.unlock();
    work();
  }

 private:
  std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<std::function<void()>> work_;
};

inline constexpr const char* kStudio = R"(studio: test
subject: {mesh: box.obj, height: 0.6 m, at: [0, 0, 1]}
background:
  - {plane: wall, through: [0, 2, 0], normal: [0, -1, 0], size: [6, 4], diffuse: [0.3, 0.3, 0.3]}
cameras:
  main: {at: [0, -2.6, 1.3], look_at: [0, 0, 1.3], vertical_fov: 20 deg, size: [64, 48]}
fixtures:
  key:
    role: key
    profile: generic/bicolour-panel
    mode: 4ch-16bit
    mount:
      stand:
        at: {azimuth: -45 deg, elevation: 35 deg, distance: 1.8 m}
        azimuth: [-80 deg, 80 deg]
        elevation: [-10 deg, 60 deg]
        distance: [1.2 m, 2.4 m]
    patch: {universe: 1, address: 1}
  back:
    role: back
    profile: generic/daylight-dimmer
    mode: 1ch
    mount: {fixed: {at: [-0.8, 1.1, 2.3], aim_at: [0, 0, 1.3]}}
    patch: {universe: 1, address: 9}
outputs:
  universe 1: {sacn: {interface: lo, rate: 40 Hz}}
exposure: {grey_card: 800 lx, white_balance: 5600 K}
)";

inline constexpr const char* kBox = R"(v -1 -1 0
v 1 -1 0
v 1 1 0
v -1 1 0
v -1 -1 3
v 1 -1 3
v 1 1 3
v -1 1 3
f 1 2 6 5
f 2 3 7 6
f 3 4 8 7
f 4 1 5 8
f 5 6 7 8
f 4 3 2 1
)";

class BrainTest : public testing::Test {
 protected:
  BrainTest() {
    std::ofstream(folder_.path() / "studio.yaml") << kStudio;
    std::ofstream(folder_.path() / "box.obj") << kBox;
  }
  void open() {
    brain_.reset();
    auto brain = Brain::open(fake_.world, folder_.path() / "studio.yaml",
                             [this](std::function<void()> work) { queue_.post(std::move(work)); });
    ASSERT_TRUE(brain) << core::to_string(brain.problems());
    brain_ = std::move(*brain);
    brain_->tick(clock_.now());
  }
  panel::Outcome perform(const panel::Gesture& gesture) {
    std::optional<panel::Outcome> outcome;
    brain_->perform(gesture, [&](panel::Outcome given) { outcome = std::move(given); });
    EXPECT_TRUE(outcome) << "this gesture is answered at once";
    brain_->tick(clock_.now());
    return outcome.value_or(panel::Outcome{});
  }
  /// The same for a gesture that is answered once a worker has done its part.
  panel::Outcome perform_and_wait(const panel::Gesture& gesture) {
    std::optional<panel::Outcome> outcome;
    brain_->perform(gesture, [&](panel::Outcome given) { outcome = std::move(given); });
    while (!outcome) queue_.run_one();
    brain_->tick(clock_.now());
    return *outcome;
  }
  /// A small design like a picture that is bright on the left.
  panel::StartDesign like_a_picture(std::optional<double> apply = 0.0) {
    panel::StartDesign ask;
    core::EncodedPicture picture({32, 32});
    for (int y = 0; y < 32; ++y)
      for (int x = 0; x < 32; ++x)
        picture.at(x, y) = {static_cast<std::uint8_t>(200 - 5 * x), 120, 90};
    const auto png = core::encode_png(picture);
    ask.picture.assign(png.begin(), png.end());
    ask.title = "Window";
    ask.trials = 20;
    ask.apply_fade_s = apply;
    return ask;
  }
  /// Runs what workers hand in until `enough`.
  template <class Enough>
  void settle(Enough enough) {
    for (brain_->tick(clock_.now()); !enough(brain_->state()); brain_->tick(clock_.now()))
      queue_.run_one();
  }
  void design(const panel::StartDesign& ask) {
    EXPECT_EQ(perform(ask).status, 202);
    settle([](const panel::State& state) {
      return state.design && state.design->status > panel::JobStatus::running;
    });
    ASSERT_EQ(brain_->state().design->status, panel::JobStatus::done)
        << (brain_->state().design->error ? brain_->state().design->error->what : "");
  }
  const panel::FixtureView& key() { return brain_->state().fixtures[0]; }

  support::FakeClock clock_;
  support::FakeNetwork network_;
  support::TemporaryFolder folder_;
  support::FakeWorld fake_{clock_, network_, folder_.path()};
  Queue queue_;
  std::unique_ptr<Brain> brain_;
};

}  // namespace chiaro::daemon
