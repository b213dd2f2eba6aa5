// SPDX-License-Identifier: Apache-2.0
// Light that follows a tracked subject: poses come as fast as the tracker sends them, each frame is
// worked out on a thread of its own, and a pose that is overtaken by a newer one is left out.
#pragma once

#include <atomic>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "controller/daemon/brain/planner.h"
#include "controller/daemon/brain/worker.h"
#include "controller/design/follow.h"

namespace chiaro::daemon {

/// The light to keep, and where. `edition` differs whenever any of it does.
struct TrackedLook {
  std::uint64_t edition = 0, studio_turn = 0;
  studio::Studio studio;  ///< lamps as they stand
  studio::Rig look;
  std::vector<std::string> locked;
};
struct Pose {
  core::Vec3 moved;   ///< metres, since the studio file was written
  double turned = 0;  ///< radians about the upright through the subject's aim, to its left
};
struct Followed {
  studio::Rig rig;
  double seconds = 0;  ///< since the last frame: how long the way to `rig` may take
};

/// Thread-bound to the loop.
class Tracking {
 public:
  Tracking(ports::Clock& clock, Post post) : clock_(clock), post_(std::move(post)) {}
  /// `done` on the loop, once for each pose that was not overtaken.
  void follow(std::shared_ptr<const TrackedLook> look, std::filesystem::path mesh_cache, Pose pose,
              std::function<void(core::Result<Followed>)> done);
  /// Forgets the pose that waits, and the subject.
  void stop();
  /// True: give way to everybody else (the hand lacks real-time rights).
  void be_modest(bool modest) { modest_ = modest; }

 private:
  struct Wanted {
    std::shared_ptr<const TrackedLook> look;
    std::filesystem::path mesh_cache;
    Pose pose;
    std::function<void(core::Result<Followed>)> done;
  };
  void next();
  core::Result<Followed> frame(const Wanted& wanted);

  ports::Clock& clock_;
  Post post_;
  std::atomic<bool> modest_{false};
  std::mutex mutex_;
  std::optional<Wanted> waiting_;  ///< guarded by the mutex
  // Of the worker's thread alone.
  std::shared_ptr<const TrackedLook> look_;
  std::unique_ptr<design::Follower> follower_;
  core::Vec3 about_;
  ports::TimePoint last_;
  Worker worker_;  // last: its thread uses all the others
};

}  // namespace chiaro::daemon
