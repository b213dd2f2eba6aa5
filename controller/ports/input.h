// SPDX-License-Identifier: Apache-2.0
// What a DMX input driver implements: universes that somebody else sends.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "controller/core/result.h"
#include "controller/ports/output.h"

namespace chiaro::ports {

/// One thread at a time; nothing waits.
class DmxInput {
 public:
  virtual ~DmxInput() = default;
  virtual core::Result<core::Done> open() = 0;
  /// Takes everything that has arrived. Returns the number of packets that carried levels.
  virtual std::size_t listen(TimePoint now) = 0;
  /// The merged levels of universe number i of the settings' list. Without any live source the
  /// last levels stay.
  virtual const DmxFrame& frame(std::size_t i, TimePoint now) = 0;
  virtual std::size_t universes() const = 0;
  /// The names of the live sources of universe number i.
  virtual std::vector<std::string> sources(std::size_t i) const = 0;
  /// Packets that came too late to count.
  virtual std::uint64_t out_of_sequence() const = 0;
};

}  // namespace chiaro::ports
