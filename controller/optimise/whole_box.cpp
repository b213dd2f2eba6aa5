// SPDX-License-Identifier: Apache-2.0
#include "controller/optimise/whole_box.h"

namespace chiaro::optimise {
namespace {

constexpr double kStep = 0.12;

}  // namespace

Outcome whole_box(const Task& task, Search search) {
  const Problem problem(task);
  Ledger ledger(task);
  Record record(problem);
  if (problem.dimension() == 0) return only_point(problem, ledger, record);
  Point from = best_start(problem, ledger, record);
  for (std::uint64_t k = 0; record.left() > 0 && !record.stopped(); ++k) {
    const Run run = nlopt_search(search, problem, ledger, record.left(), from, kStep,
                                 task.seed + 0x9e3779b9u * k);
    record.absorb(run, true);
    from = spread_point(k, problem.dimension(), task.seed);
    if (run.used() == 0) break;
  }
  return record.finish();
}

}  // namespace chiaro::optimise
