// SPDX-License-Identifier: Apache-2.0
// Whether axes may move. Disarmed at start; a person arms. The stop is a latch apart
// from blackout: it freezes axes with the light held, and releasing it moves nothing, because
// stopping disarms (as a machine's emergency stop must: EN ISO 13850 4.1.4). Blackout darkens and
// moves nothing either.
#pragma once

namespace chiaro::rig {

/// Real-time.
class Motion {
 public:
  void stop(bool on) {
    stopped_ = on;
    if (on) armed_ = false;
  }
  void arm(bool on) { armed_ = on && !stopped_; }
  bool stopped() const { return stopped_; }
  bool armed() const { return armed_; }

 private:
  bool stopped_ = false, armed_ = false;
};

}  // namespace chiaro::rig
