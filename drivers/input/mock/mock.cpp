// SPDX-License-Identifier: Apache-2.0
// An input at which nobody ever speaks.
#include "drivers/registry.h"

namespace chiaro::drivers::mock {
namespace {

class MockInput final : public ports::DmxInput {
 public:
  explicit MockInput(const InputSettings& settings) : frames_(settings.universes.size()) {
    for (std::size_t i = 0; i < frames_.size(); ++i) frames_[i].universe = settings.universes[i];
  }
  core::Result<core::Done> open() override { return core::Done{}; }
  std::size_t listen(ports::TimePoint) override { return 0; }
  const ports::DmxFrame& frame(std::size_t i, ports::TimePoint) override { return frames_[i]; }
  std::size_t universes() const override { return frames_.size(); }
  std::vector<std::string> sources(std::size_t) const override { return {}; }
  std::uint64_t out_of_sequence() const override { return 0; }

 private:
  std::vector<ports::DmxFrame> frames_;
};

}  // namespace

std::unique_ptr<ports::DmxInput> make_input(const InputSettings&, Surroundings&);
std::unique_ptr<ports::DmxInput> make_input(const InputSettings& settings, Surroundings&) {
  return std::make_unique<MockInput>(settings);
}

}  // namespace chiaro::drivers::mock
