// SPDX-License-Identifier: Apache-2.0
// The handful of system calls that Video4Linux is made of, so that tests can be the kernel.
#pragma once

#include <cstddef>
#include <string>

namespace chiaro::drivers {

/// Each as its namesake in the C library; -1 and errno on failure.
class VideoCalls {
 public:
  virtual ~VideoCalls() = default;
  virtual int open(const std::string& node) = 0;
  virtual void close(int descriptor) = 0;
  virtual int ioctl(int descriptor, unsigned long request, void* argument) = 0;
  /// MAP_FAILED's stand-in is null.
  virtual void* map(int descriptor, std::size_t length, long offset) = 0;
  virtual void unmap(void* memory, std::size_t length) = 0;
  /// > 0 when a frame waits.
  virtual int poll(int descriptor, int timeout_ms) = 0;
};
VideoCalls& system_video_calls();

}  // namespace chiaro::drivers
