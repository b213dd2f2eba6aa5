// SPDX-License-Identifier: Apache-2.0
#include "controller/optimise/optimisers/mlsl.h"

#include "controller/optimise/whole_box.h"

namespace chiaro::optimise {
namespace {

class Mlsl final : public Optimiser {
 public:
  Outcome minimise(const Task& task) const override { return whole_box(task, Search::mlsl); }
};

}  // namespace

std::unique_ptr<Optimiser> make_mlsl() { return std::make_unique<Mlsl>(); }

}  // namespace chiaro::optimise
