// SPDX-License-Identifier: Apache-2.0
#include "drivers/common/video_calls.h"

#include <cerrno>
#include <fcntl.h>
#include <poll.h>
#include <sys/ioctl.h>
#include <sys/mman.h>
#include <unistd.h>

namespace chiaro::drivers {
namespace {

class SystemVideoCalls final : public VideoCalls {
 public:
  int open(const std::string& node) override {
    return ::open(node.c_str(), O_RDWR | O_NONBLOCK | O_CLOEXEC);
  }
  void close(int descriptor) override { ::close(descriptor); }
  int ioctl(int descriptor, unsigned long request, void* argument) override {
    int done = 0;
    do done = ::ioctl(descriptor, request, argument);
    while (done < 0 && errno == EINTR);
    return done;
  }
  void* map(int descriptor, std::size_t length, long offset) override {
    void* memory = ::mmap(nullptr, length, PROT_READ, MAP_SHARED, descriptor, offset);
    return memory == MAP_FAILED ? nullptr : memory;
  }
  void unmap(void* memory, std::size_t length) override { ::munmap(memory, length); }
  int poll(int descriptor, int timeout_ms) override {
    pollfd ready{descriptor, POLLIN, 0};
    const int any = ::poll(&ready, 1, timeout_ms);
    return any > 0 && (ready.revents & POLLIN) == 0 ? -1 : any;
  }
};

}  // namespace

VideoCalls& system_video_calls() {
  static SystemVideoCalls calls;
  return calls;
}

}  // namespace chiaro::drivers
