// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>

#include "controller/daemon/bench/bench.h"
#include "controller/daemon/bench/stopwatch.h"
#include "controller/design/follow.h"

namespace chiaro::daemon::bench {
namespace {

constexpr std::size_t kTriangles = 70'000;
constexpr double kFrame = 1.0 / 30;

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
  design::Follower follower(studio, *geometry, plan.mood, look, {}, options);
  std::vector<double> frames;
  double change = 0;
  for (int i = 0; i < (plan.quick ? 5 : 150) && !world.stop; ++i) {
    const double t = i * kFrame;
    const render::Motion moved = render::turned_and_moved(
        (*geometry)->aim.origin, 0.4 * std::sin(2 * t), {0.1 * std::sin(1.7 * t), 0, 0});
    const Stopwatch watch(world.clock);
    const auto frame = follower.follow(moved, kFrame);
    if (i == 0) continue;  // the first touches its memory
    frames.push_back(watch.seconds() * 1000);
    change = std::max(change, frame.change);
  }
  if (frames.empty()) return core::Done{};
  std::sort(frames.begin(), frames.end());
  const auto at = [&](double share) {
    return frames[std::min(frames.size() - 1,
                           static_cast<std::size_t>(share * static_cast<double>(frames.size())))];
  };
  report.add("view and levels, median frame", at(0.5), "ms");
  report.add("view and levels, p99", at(0.99), "ms", at_most(33));
  report.add("largest step of a level in a frame", 100 * change, "%", {},
             "bounded: " + std::to_string(options.most_per_s * kFrame * 100).substr(0, 4) + " %");
  return core::Done{};
}

}  // namespace chiaro::daemon::bench
