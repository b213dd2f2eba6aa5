// SPDX-License-Identifier: Apache-2.0
// What a camera driver implements: the newest frame there is.
#pragma once

#include <memory>
#include <string>

#include "controller/core/picture.h"
#include "controller/core/result.h"
#include "controller/ports/clock.h"

namespace chiaro::ports {

struct CameraFrame {
  core::EncodedPicture picture;
  TimePoint taken;  ///< by the camera where it says so, else when it was received; monotonic
};

/// One camera; thread-bound (its own thread). `grab` may block up to its timeout.
class Camera {
 public:
  virtual ~Camera() = default;
  virtual core::Result<CameraFrame> grab(Duration timeout) = 0;
  /// What the camera still does by itself although it was told not to, as warnings; known after the
  /// first grab.
  virtual core::Problems unlocked() const { return {}; }
};

}  // namespace chiaro::ports
