// SPDX-License-Identifier: Apache-2.0
// Apart from the outputs' half, so that the output process does not load picture codecs.
#include "drivers/registry.h"

namespace chiaro::drivers {

#define CAMERA(name, summary)                                                               \
  namespace name {                                                                          \
  std::unique_ptr<ports::Camera> make(const CameraSettings& settings, ports::Clock& clock); \
  }
#include "drivers/drivers.def"

namespace {
constexpr CameraEntry kCameras[] = {
#define CAMERA(name, summary) {#name, summary, name::make},
#include "drivers/drivers.def"
};
}  // namespace

std::span<const CameraEntry> cameras() { return kCameras; }

core::Result<std::unique_ptr<ports::Camera>> make_camera(const CameraSettings& settings,
                                                         ports::Clock& clock) {
  const std::string scheme = settings.source.substr(0, settings.source.find(':'));
  std::string known;
  for (const CameraEntry& entry : kCameras) {
    if (entry.name == scheme) return entry.make(settings, clock);
    known += (known.empty() ? "" : ", ") + std::string(entry.name);
  }
  return core::Problem{{settings.source, 0, 0},
                       "no camera driver knows '" + scheme + "'",
                       "use a source that begins with one of: " + known};
}

}  // namespace chiaro::drivers
