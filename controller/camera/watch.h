// SPDX-License-Identifier: Apache-2.0
// One camera watched by a thread of its own: only the newest frame counts. A camera that went away
// is asked again, ever more slowly, until it comes back.
#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <thread>

#include "controller/ports/camera.h"

namespace chiaro::camera {

enum class Health { waiting, good, lost };

struct Report {
  Health health = Health::waiting;
  std::uint64_t frames = 0, reconnects = 0;
  core::Problems trouble;  ///< why it is lost; empty while good
};

/// Thread-safe.
class Watch {
 public:
  using Frame = std::shared_ptr<const ports::CameraFrame>;
  struct Pace {
    ports::Duration period = std::chrono::milliseconds(200), timeout = std::chrono::seconds(3),
                    longest_pause = std::chrono::seconds(3);
  };
  /// `seen` is called on the watch's thread for each frame.
  Watch(std::unique_ptr<ports::Camera> camera, ports::Clock& clock, const Pace& pace,
        std::function<void(const Frame&)> seen);
  /// Sets `stop` and waits for the thread; the camera's own stop flag must be set before, or this
  /// waits for the grab's timeout.
  ~Watch();
  Watch(const Watch&) = delete;
  Watch& operator=(const Watch&) = delete;

  Frame newest() const;
  Report report() const;
  /// From the next frame on: slower while nobody looks or the processor is wanted elsewhere.
  void set_period(ports::Duration period) { period_ = period; }

 private:
  void run();
  /// Takes the result of one grab; gives the pause until the next.
  ports::Duration take(core::Result<ports::CameraFrame> grabbed);

  std::unique_ptr<ports::Camera> camera_;
  ports::Clock& clock_;
  Pace pace_;
  std::function<void(const Frame&)> seen_;
  mutable std::mutex mutex_;
  Frame newest_;
  Report report_;
  ports::Duration pause_{};
  std::atomic<ports::Duration> period_;
  std::atomic<bool> stop_{false};
  std::thread thread_;
};

}  // namespace chiaro::camera
