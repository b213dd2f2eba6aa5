// SPDX-License-Identifier: Apache-2.0
#include "controller/camera/watch.h"

#include <condition_variable>
#include <deque>
#include <gtest/gtest.h>

namespace chiaro::camera {
namespace {

using namespace std::chrono_literals;

/// Time passes only where somebody sleeps.
class SleepingClock final : public ports::Clock {
 public:
  ports::TimePoint now() const override { return ports::TimePoint(ports::Duration(ns_.load())); }
  void sleep_until(ports::TimePoint deadline) override {
    ns_ = deadline.time_since_epoch().count();
  }

 private:
  std::atomic<std::int64_t> ns_{0};
};

/// Plays a script; at its end it blocks until released, so that nothing races past the test.
class ScriptedCamera final : public ports::Camera {
 public:
  struct Stage {
    std::mutex mutex;
    std::condition_variable changed;
    std::deque<bool> script;  ///< true: a frame, false: a failure
    std::vector<ports::TimePoint> asked;
    bool over = false, released = false;
    void wait_until_over() {
      std::unique_lock lock(mutex);
      changed.wait(lock, [this] { return over; });
    }
    void release() {
      const std::lock_guard lock(mutex);
      released = true;
      changed.notify_all();
    }
  };
  ScriptedCamera(Stage& stage, ports::Clock& clock) : stage_(stage), clock_(clock) {}

  core::Result<ports::CameraFrame> grab(ports::Duration) override {
    std::unique_lock lock(stage_.mutex);
    if (stage_.script.empty()) {
      stage_.over = true;
      stage_.changed.notify_all();
      stage_.changed.wait(lock, [this] { return stage_.released; });
      return core::Problem{{}, "over", ""};
    }
    stage_.asked.push_back(clock_.now());
    const bool good = stage_.script.front();
    stage_.script.pop_front();
    if (!good) return core::Problem{{"cam", 0, 0}, "no answer", "look at the cable"};
    return ports::CameraFrame{core::EncodedPicture({int(stage_.asked.size()), 1}), clock_.now()};
  }

 private:
  Stage& stage_;
  ports::Clock& clock_;
};

struct Played {
  Report report;
  Watch::Frame newest;
  std::vector<ports::TimePoint> asked;
  int seen = 0;
};

Played played(std::deque<bool> script) {
  SleepingClock clock;
  ScriptedCamera::Stage stage;
  stage.script = std::move(script);
  std::atomic<int> seen{0};
  Played result;
  {
    Watch watch(std::make_unique<ScriptedCamera>(stage, clock), clock, {},
                [&](const Watch::Frame&) { ++seen; });
    stage.wait_until_over();
    result = {watch.report(), watch.newest(), stage.asked, seen};
    stage.release();
  }
  return result;
}

TEST(Watch, KeepsOnlyTheNewestFrame) {
  const Played result = played({true, true, true});
  EXPECT_EQ(result.newest->picture.size.width, 3);
  EXPECT_EQ(result.report.frames, 3u);
  EXPECT_EQ(result.seen, 3);
  EXPECT_EQ(result.report.health, Health::good);
}

TEST(Watch, KeepsItsPace) {
  const Played result = played({true, true});
  EXPECT_EQ(result.asked[1] - result.asked[0], 200ms);
}

TEST(Watch, SaysWhyACameraIsLostAndKeepsItsLastFrame) {
  const Played result = played({true, false});
  EXPECT_EQ(result.report.health, Health::lost);
  ASSERT_EQ(result.report.trouble.size(), 1u);
  EXPECT_EQ(result.report.trouble[0].what, "no answer");
  EXPECT_NE(result.newest, nullptr);
}

TEST(Watch, AsksALostCameraEverMoreSlowlyButNeverGivesUp) {
  const Played result = played({false, false, false, false, false, false, false});
  EXPECT_EQ(result.asked[1] - result.asked[0], 200ms);
  EXPECT_EQ(result.asked[2] - result.asked[1], 400ms);
  EXPECT_EQ(result.asked[6] - result.asked[5], 3s);
}

TEST(Watch, CountsACameraThatCameBackAndForgetsItsTrouble) {
  const Played result = played({true, false, false, true, true});
  EXPECT_EQ(result.report.reconnects, 1u);
  EXPECT_EQ(result.report.health, Health::good);
  EXPECT_TRUE(result.report.trouble.empty());
  EXPECT_EQ(result.asked[4] - result.asked[3], 200ms);
}

TEST(Watch, WaitsForItsFirstFrame) {
  const Played result = played({});
  EXPECT_EQ(result.report.health, Health::waiting);
  EXPECT_EQ(result.newest, nullptr);
}

}  // namespace
}  // namespace chiaro::camera
