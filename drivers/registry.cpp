// SPDX-License-Identifier: Apache-2.0
#include "drivers/registry.h"

namespace chiaro::drivers {

#define OUTPUT(name, summary)                                                                    \
  namespace name {                                                                               \
  std::unique_ptr<ports::OutputPort> make(const OutputSettings& settings, Surroundings& around); \
  }
#define INPUT(name, summary)                                                 \
  namespace name {                                                           \
  std::unique_ptr<ports::DmxInput> make_input(const InputSettings& settings, \
                                              Surroundings& around);         \
  }
#define SURFACE(name, summary)                                                  \
  namespace name {                                                              \
  std::unique_ptr<ports::Surface> make_surface(const SurfaceSettings& settings, \
                                               Surroundings& around);           \
  }
#include "drivers/drivers.def"

namespace {

constexpr OutputEntry kOutputs[] = {
#define OUTPUT(name, summary) {#name, summary, name::make},
#include "drivers/drivers.def"
};
constexpr InputEntry kInputs[] = {
#define INPUT(name, summary) {#name, summary, name::make_input},
#include "drivers/drivers.def"
};

constexpr SurfaceEntry kSurfaces[] = {
#define SURFACE(name, summary) {#name, summary, name::make_surface},
#include "drivers/drivers.def"
};

/// The entry called `name`, or why there is none.
template <class Entries>
core::Result<const std::remove_extent_t<Entries>*> entry_in(const Entries& entries,
                                                            const std::string& what,
                                                            const std::string& name) {
  std::vector<std::string> known;
  for (const auto& entry : entries) {
    if (entry.name == name) return &entry;
    known.emplace_back(entry.name);
  }
  const std::string near = core::nearest_name(name, known);
  return core::Problem{{},
                       "there is no " + what + " driver '" + name + "'",
                       near.empty() ? "" : "did you mean '" + near + "'?"};
}

}  // namespace

std::span<const OutputEntry> outputs() { return kOutputs; }
std::span<const InputEntry> inputs() { return kInputs; }
std::span<const SurfaceEntry> surfaces() { return kSurfaces; }

core::Result<std::unique_ptr<ports::OutputPort>> make_output(const std::string& driver,
                                                             const OutputSettings& settings,
                                                             Surroundings& around) {
  const auto entry = entry_in(kOutputs, "output", driver);
  if (!entry) return entry.problems();
  return (*entry)->make(settings, around);
}

core::Result<std::unique_ptr<ports::DmxInput>> make_input(const std::string& driver,
                                                          const InputSettings& settings,
                                                          Surroundings& around) {
  const auto entry = entry_in(kInputs, "input", driver);
  if (!entry) return entry.problems();
  return (*entry)->make(settings, around);
}

core::Result<std::unique_ptr<ports::Surface>> make_surface(const std::string& driver,
                                                           const SurfaceSettings& settings,
                                                           Surroundings& around) {
  const auto entry = entry_in(kSurfaces, "surface", driver);
  if (!entry) return entry.problems();
  return (*entry)->make(settings, around);
}

}  // namespace chiaro::drivers
