// SPDX-License-Identifier: Apache-2.0
// What a control surface driver implements: things that people press, turn and slide, and the lamps
// on them that answer.
#pragma once

#include <string>
#include <vector>

#include "controller/core/result.h"
#include "controller/ports/clock.h"
#include "controller/ports/output.h"

namespace chiaro::ports {

/// Something moved. Buttons: 1 pressed, 0 released. Faders: 0..1. Encoders: detents, + clockwise,
/// at most 127 at once. Drivers keep to that whatever their wire says; no value is not a number.
struct SurfaceEvent {
  std::string control;  ///< as its mapping names it
  double value = 0;
  friend bool operator==(const SurfaceEvent&, const SurfaceEvent&) = default;
};

/// One surface; thread-bound. Nothing waits longer than a few milliseconds.
class Surface {
 public:
  virtual ~Surface() = default;
  /// Finds and opens the device; may be called again while `health` is not good.
  virtual core::Result<core::Done> open() = 0;
  /// Everything that has moved since the last call, in order.
  virtual std::vector<SurfaceEvent> listen(TimePoint now) = 0;
  /// Lights the control's lamp, moves its motor or shows it on a display: 0..1, with a word where
  /// there is room for one. A control without either ignores it.
  virtual void show(const std::string& control, double value, const std::string& word) = 0;
  virtual PortHealth health() const = 0;
};

}  // namespace chiaro::ports
