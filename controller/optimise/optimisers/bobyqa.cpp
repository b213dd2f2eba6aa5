// SPDX-License-Identifier: Apache-2.0
#include "controller/optimise/optimisers/bobyqa.h"

#include "controller/optimise/multi_start.h"
#include "controller/optimise/nlopt_search.h"

namespace chiaro::optimise {
namespace {

class Bobyqa final : public Optimiser {
 public:
  Outcome minimise(const Task& task) const override {
    return multi_start(task, [](const Problem& problem, Ledger& ledger, std::uint64_t budget,
                                Point from, double step) {
      return nlopt_search(Search::quadratic, problem, ledger, budget, std::move(from), step);
    });
  }
};

}  // namespace

std::unique_ptr<Optimiser> make_bobyqa() { return std::make_unique<Bobyqa>(); }

}  // namespace chiaro::optimise
