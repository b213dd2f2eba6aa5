// SPDX-License-Identifier: Apache-2.0
#include "drivers/registry.h"

#include <vector>

namespace chiaro::drivers {

#define OUTPUT(name, summary)                                             \
  namespace name {                                                        \
  std::unique_ptr<ports::OutputPort> make(const OutputSettings& settings, \
                                          ports::Network& network);       \
  }
#include "drivers/drivers.def"

namespace {
constexpr OutputEntry kOutputs[] = {
#define OUTPUT(name, summary) {#name, summary, name::make},
#include "drivers/drivers.def"
};
}  // namespace

std::span<const OutputEntry> outputs() { return kOutputs; }

core::Result<std::unique_ptr<ports::OutputPort>> make_output(const std::string& driver,
                                                             const OutputSettings& settings,
                                                             ports::Network& network) {
  std::vector<std::string> known;
  for (const OutputEntry& entry : kOutputs) {
    if (entry.name == driver) return entry.make(settings, network);
    known.emplace_back(entry.name);
  }
  const std::string near = core::nearest_name(driver, known);
  return core::Problem{{},
                       "there is no output driver '" + driver + "'",
                       near.empty() ? "" : "did you mean '" + near + "'?"};
}

}  // namespace chiaro::drivers
