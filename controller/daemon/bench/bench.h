// SPDX-License-Identifier: Apache-2.0
// The parts of `chiaro bench`, in the order in which they run. Ratios compare things measured in
// the same run on the same machine.
#pragma once

#include <cstdint>
#include <filesystem>

#include "controller/core/result.h"
#include "controller/daemon/bench/report.h"
#include "controller/design/design.h"
#include "controller/ports/world.h"
#include "controller/studio/studio.h"

namespace chiaro::daemon::bench {

struct Plan {
  studio::Studio studio;
  design::ExampleGoal mood, other_mood;
  bool quick = false;
  int seeds = 10;
  std::uint64_t reference_trials = 1000;
  core::Size size{256, 256};
};

/// The picture kernels beside what the machine can read.
void kernels(const Plan& plan, ports::World& world, Report& report);
/// Tracer, view, layers, and one trial, fast and reference, with point and with soft lights.
core::Result<core::Done> trials(const Plan& plan, ports::World& world, Report& report);
/// Levels alone, for known layers.
core::Result<core::Done> levels(const Plan& plan, ports::World& world, Report& report);
/// Whole designs, cold and warm, on the studio's subject and on one of a million triangles.
core::Result<core::Done> designs(const Plan& plan, ports::World& world, Report& report);
/// A subject that moves: how long a frame takes to follow.
core::Result<core::Done> moving(const Plan& plan, ports::World& world, Report& report);
/// Time and memory against triangles, pixels, lamps and threads.
core::Result<core::Done> scaling(const Plan& plan, ports::World& world, Report& report);
/// Time to the quality that reference annealing reaches, and what each idea contributes.
core::Result<core::Done> quality(const Plan& plan, ports::World& world, Report& report);

/// The studio with a bumpy ball of at least that many triangles for a subject, written as binary
/// PLY into `folder`.
studio::Studio with_subject_of(const studio::Studio& studio, std::size_t triangles,
                               const std::filesystem::path& folder);
/// Its lamps all points.
studio::Studio with_points(studio::Studio studio);

/// Of this process so far.
double peak_megabytes();
/// Processor time of all threads: on a busy machine it tells more than the clock on the wall.
double processor_seconds();
/// "1.83 s of processor time"
std::string in_processor_time(double seconds);

/// Bytes per second that one core reads from a working set of that size.
double read_bandwidth(const ports::Clock& clock, std::size_t bytes, bool quick);

}  // namespace chiaro::daemon::bench
