// SPDX-License-Identifier: Apache-2.0
#include "controller/optimise/optimisers/crs2.h"

#include "controller/optimise/whole_box.h"

namespace chiaro::optimise {
namespace {

class Crs2 final : public Optimiser {
 public:
  Outcome minimise(const Task& task) const override { return whole_box(task, Search::crs2); }
};

}  // namespace

std::unique_ptr<Optimiser> make_crs2() { return std::make_unique<Crs2>(); }

}  // namespace chiaro::optimise
