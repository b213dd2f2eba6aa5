// SPDX-License-Identifier: Apache-2.0
#include "controller/camera/watch.h"

#include <algorithm>

namespace chiaro::camera {
namespace {

constexpr ports::Duration kFirstPause = std::chrono::milliseconds(200);
/// A long pause is slept in pieces, so that stopping never waits for it.
constexpr ports::Duration kPiece = std::chrono::milliseconds(50);

}  // namespace

Watch::Watch(std::unique_ptr<ports::Camera> camera, ports::Clock& clock, const Pace& pace,
             std::function<void(const Frame&)> seen)
    : camera_(std::move(camera)),
      clock_(clock),
      pace_(pace),
      seen_(std::move(seen)),
      period_(pace.period),
      thread_([this] { run(); }) {}

Watch::~Watch() {
  stop_ = true;
  thread_.join();
}

Watch::Frame Watch::newest() const {
  const std::lock_guard lock(mutex_);
  return newest_;
}

Report Watch::report() const {
  const std::lock_guard lock(mutex_);
  return report_;
}

void Watch::run() {
  while (!stop_) {
    const ports::TimePoint start = clock_.now();
    const ports::TimePoint next = start + take(camera_->grab(pace_.timeout));
    while (!stop_ && clock_.now() < next) clock_.sleep_until(std::min(clock_.now() + kPiece, next));
  }
}

ports::Duration Watch::take(core::Result<ports::CameraFrame> grabbed) {
  Frame frame;
  {
    const std::lock_guard lock(mutex_);
    if (!grabbed) {
      report_.health = Health::lost;
      report_.trouble = grabbed.problems();
      pause_ = std::clamp(2 * pause_, kFirstPause, std::max(kFirstPause, pace_.longest_pause));
      return pause_;
    }
    if (report_.health == Health::lost) ++report_.reconnects;
    report_.health = Health::good;
    report_.trouble.clear();
    ++report_.frames;
    pause_ = {};
    newest_ = std::make_shared<const ports::CameraFrame>(std::move(*grabbed));
    frame = newest_;
  }
  seen_(frame);
  return period_;
}

}  // namespace chiaro::camera
