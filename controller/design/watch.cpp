// SPDX-License-Identifier: Apache-2.0
#include "controller/design/watch.h"

namespace chiaro::design {
namespace {

// Of a budget; the rest is for exact levels, colours and the two predictions.
constexpr double kSearchShare = 0.7;

}  // namespace

Watch::Watch(const Options& options)
    : options_(options), started_(options.seconds ? options.seconds() : 0) {}

double Watch::elapsed() const { return options_.seconds ? options_.seconds() - started_ : 0; }

bool Watch::over() {
  if (over_) return true;
  if (options_.stop != nullptr && options_.stop->load(std::memory_order_relaxed)) over_ = true;
  if (options_.budget_s && elapsed() >= kSearchShare * *options_.budget_s) {
    out_of_time_ = true;
    over_ = true;
  }
  return over_;
}

void Watch::begin(const std::string& stage, std::uint64_t trials) {
  const std::lock_guard lock(mutex_);
  stage_ = stage;
  expected_ = done_ + trials;
}

void Watch::report(std::uint64_t trials, double best) {
  if (!options_.progress) return;
  const std::lock_guard lock(mutex_);
  options_.progress({done_ + trials, expected_, best, stage_});
}

void Watch::end(std::uint64_t trials) {
  const std::lock_guard lock(mutex_);
  done_ += trials;
}

}  // namespace chiaro::design
