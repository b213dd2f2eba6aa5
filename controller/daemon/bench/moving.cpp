// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <optional>

#include "controller/daemon/bench/bench.h"
#include "controller/daemon/bench/stopwatch.h"
#include "controller/design/follow.h"

namespace chiaro::daemon::bench {
namespace {

constexpr std::size_t kTriangles = 70'000;
constexpr double kFrame = 1.0 / 30;

struct Ridden {
  std::vector<double> frames_ms;  ///< sorted
  double processor_ms = 0;        ///< of a frame
  double change = 0;              ///< the largest of a level from frame to frame
  double at(double share) const {
    const auto k = static_cast<std::size_t>(share * static_cast<double>(frames_ms.size()));
    return frames_ms.empty() ? 0 : frames_ms[std::min(frames_ms.size() - 1, k)];
  }
};

/// The subject sways and turns for five seconds.
Ridden ride(design::Follower& follower, core::Vec3 about, bool quick, ports::World& world) {
  Ridden out;
  double processor = 0;
  for (int i = 0; i < (quick ? 5 : 150) && !world.stop; ++i) {
    const double t = i * kFrame;
    const render::Motion moved =
        render::turned_and_moved(about, 0.4 * std::sin(2 * t), {0.1 * std::sin(1.7 * t), 0, 0});
    if (i == 1) processor = processor_seconds();
    const Stopwatch watch(world.clock);
    const auto frame = follower.follow(moved, kFrame);
    if (i == 0) continue;  // the first touches its memory
    out.frames_ms.push_back(watch.seconds() * 1000);
    out.change = std::max(out.change, frame.change);
  }
  if (!out.frames_ms.empty())
    out.processor_ms =
        1000 * (processor_seconds() - processor) / static_cast<double>(out.frames_ms.size());
  std::sort(out.frames_ms.begin(), out.frames_ms.end());
  return out;
}

}  // namespace

core::Result<core::Done> moving(const Plan& plan, ports::World& world, Report& report) {
  report.heading("A moving subject, 70 k triangles, " + std::to_string(plan.size.width) + " x " +
                 std::to_string(plan.size.height) + ", two threads");
  const auto folder = world.state_folder / "bench";
  const studio::Studio studio = with_subject_of(plan.studio, kTriangles, folder);
  const auto geometry = twin::build_geometry(studio, {});
  std::error_code ignored;
  std::filesystem::remove_all(folder, ignored);
  if (!geometry) return geometry.problems();
  studio::Rig look = studio::placed_rig(studio);
  for (core::FixtureState& state : look.states) state.set(core::Dof::intensity, 0.3);
  design::FollowOptions options;
  options.size = plan.size;
  const core::Vec3 about = (*geometry)->aim.origin;
  design::Follower keeping(studio, *geometry, look, {}, options);
  design::Follower matching(studio, *geometry, design::Goal(plan.mood), look, {}, options);
  for (auto* follower : {&keeping, &matching}) {
    const Ridden ridden = ride(*follower, about, plan.quick, world);
    const std::string what = follower == &keeping ? "look kept" : "mood matched";
    report.add(what + ", median frame", ridden.at(0.5), "ms", {},
               in_processor_time(ridden.processor_ms / 1000));
    report.add(what + ", p99", ridden.at(0.99), "ms", at_most(33));
    report.add("  largest step of a level", 100 * ridden.change, "%",
               at_most(100 * options.most_per_s * kFrame + 1e-6));
  }
  return core::Done{};
}

}  // namespace chiaro::daemon::bench
