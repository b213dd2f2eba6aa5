// SPDX-License-Identifier: Apache-2.0
#include "controller/optimise/optimisers/crs2.h"

#include "controller/optimise/nlopt_search.h"

namespace chiaro::optimise {
namespace {

constexpr double kStep = 0.12;

/// Searches of the whole box, again with other random numbers when one has shrunk to a point.
class Crs2 final : public Optimiser {
 public:
  Outcome minimise(const Task& task) const override {
    const Problem problem(task);
    Ledger ledger(task);
    Record record(problem);
    if (problem.dimension() == 0) return only_point(problem, ledger, record);
    Point from = best_start(problem, ledger, record);
    for (std::uint64_t k = 0; record.left() > 0 && !record.stopped(); ++k) {
      const Run run = nlopt_search(Search::crs2, problem, ledger, record.left(), from, kStep,
                                   task.seed + 0x9e3779b9u * k);
      record.absorb(run, true);
      from = spread_point(k, problem.dimension(), task.seed);
      if (run.used() == 0) break;
    }
    return record.finish();
  }
};

}  // namespace

std::unique_ptr<Optimiser> make_crs2() { return std::make_unique<Crs2>(); }

}  // namespace chiaro::optimise
