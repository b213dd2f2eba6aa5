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
#include "controller/design/nudge.h"
#include "controller/ports/clock.h"
#include "controller/render/bounce.h"
#include "controller/render/view.h"

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

/// What a look is to be like, with the picture as a store keeps it (empty: nothing to keep).
struct ReadGoal {
  design::Goal goal;
  std::string reference;
};
/// Called once, on the planner's thread: a large photograph takes a second to read.
using GoalReader = std::function<core::Result<ReadGoal>()>;

struct DesignTask {
  studio::Studio studio;  ///< lamps placed where they stand, locked ones at their present level
  GoalReader goal;        ///< not asked when there is a look to bend
  design::Options options;
  std::shared_ptr<JobBoard> board;
  /// Told on the loop before places are looked for: levels and colours for where the lamps stand.
  std::function<void(const studio::Rig&)> first_light;
  std::optional<design::Look> from;  ///< no search: this look is bent by the nudge
  design::Nudge nudge;               ///< done to what was found, or to `from`
};
/// A look with what a store wants of it.
struct Designed {
  design::Look look;
  std::string json, picture_png, placed_png;
  std::string reference;             ///< of the goal that was read
  std::vector<std::string> by_hand;  ///< what lamps alone cannot do of a nudge
};

/// A look as the whole camera will see it, larger than what the search looks at.
struct DrawTask {
  studio::Studio studio;
  studio::Rig wanted, placed;
};
struct Drawn {
  std::string wanted_png, placed_png;
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
  /// `done` on the loop, unless a newer drawing was asked for or there is nothing to draw with.
  void draw(DrawTask task, std::function<void(Drawn)> done);
  /// True: give way to everybody else (the hand lacks real-time rights).
  void be_modest(bool modest) { modest_ = modest; }

 private:
  core::Result<Designed> solve(DesignTask& task) const;
  /// The look that a task bends or searches for, before its nudge.
  core::Result<design::Look> found(DesignTask& task, std::string& reference) const;
  void tell_first_light(const DesignTask& task, const design::Goal& goal) const;
  std::optional<Drawn> draw_now(const DrawTask& task, std::uint64_t number);

  ports::Clock& clock_;
  Post post_;
  std::atomic<bool> modest_{false};
  // Of the worker's thread alone.
  std::unique_ptr<design::LayersSource> layers_;
  core::Problems no_layers_;
  // The painter's: the tracer is handed over by the worker.
  std::mutex tracer_mutex_;
  std::shared_ptr<const render::Tracer> tracer_;
  struct Easel {
    std::shared_ptr<const render::Tracer> tracer;
    render::View view;
    render::BounceField field;
    render::BounceMap map;
    Easel(std::shared_ptr<const render::Tracer> with, const studio::Camera& camera);
    core::Picture picture(const studio::Studio& studio, const studio::Rig& rig) const;
  };
  std::unique_ptr<const Easel> easel_;
  std::atomic<std::uint64_t> drawings_{0};
  Worker painter_, worker_;  // last: their threads use all the others
};

}  // namespace chiaro::daemon
