// SPDX-License-Identifier: Apache-2.0
// The planner: keeps the layers of the studio warm and turns design jobs into looks, on a thread
// of its own (the design engine takes more for itself). Results are handed to the loop.
#pragma once

#include <atomic>
#include <filesystem>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>

#include "controller/daemon/brain/worker.h"
#include "controller/design/design.h"
#include "controller/design/layers.h"
#include "controller/ports/clock.h"

namespace chiaro::daemon {

/// Runs work on the loop's thread. Thread-safe.
using Post = std::function<void(std::function<void()>)>;

/// How a job stands; written by the planner, read by the loop. Thread-safe.
class JobBoard {
 public:
  std::atomic<bool> stop{false};
  std::atomic<bool> started{false};
  void tell(const design::Progress& progress, double seconds);
  struct Seen {
    design::Progress progress;
    double seconds = 0;
  };
  Seen seen() const;

 private:
  mutable std::mutex mutex_;
  Seen seen_;
};

struct DesignTask {
  studio::Studio studio;  ///< lamps placed where they stand, locked ones at their present level
  design::Goal goal;
  design::Options options;
  std::shared_ptr<JobBoard> board;
};
/// A look with what a store wants of it.
struct Designed {
  design::Look look;
  std::string json, picture_png, placed_png;
};

class Planner {
 public:
  Planner(ports::Clock& clock, Post post) : clock_(clock), post_(std::move(post)) {}
  /// Prepares the studio's layers; jobs added later wait for them. `ready` on the loop: the
  /// problems, none when all is well.
  void prepare(const studio::Studio& studio, const std::filesystem::path& mesh_cache,
               std::function<void(core::Problems)> ready);
  /// `done` on the loop, exactly once unless the planner goes first.
  void add(DesignTask task, std::function<void(core::Result<Designed>)> done);
  /// True: give way to everybody else (the hand lacks real-time rights).
  void be_modest(bool modest) { modest_ = modest; }

 private:
  core::Result<Designed> solve(DesignTask& task) const;

  ports::Clock& clock_;
  Post post_;
  std::atomic<bool> modest_{false};
  // Of the worker's thread alone.
  std::unique_ptr<design::LayersSource> layers_;
  core::Problems no_layers_;
  Worker worker_;  // last: its thread uses all the others
};

}  // namespace chiaro::daemon
