// SPDX-License-Identifier: Apache-2.0
// Serial lines through the kernel's tty layer. Any baud rate by termios2 (DMX needs 250000), break
// by TIOCSBRK: tcsendbreak lasts a quarter of a second at least.
#include <asm/ioctls.h>
#include <asm/termbits.h>
#include <cerrno>
#include <cstring>
#include <fcntl.h>
#include <poll.h>
#include <sys/file.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include "drivers/common/system_devices.h"

namespace chiaro::drivers {
namespace {

class Tty final : public ports::SerialPort {
 public:
  explicit Tty(int descriptor) : descriptor_(descriptor) {}
  ~Tty() override { ::close(descriptor_); }
  Tty(const Tty&) = delete;
  Tty& operator=(const Tty&) = delete;

  bool write(std::span<const std::uint8_t> bytes) override {
    while (!bytes.empty()) {
      pollfd room{descriptor_, POLLOUT, 0};
      if (::poll(&room, 1, kPatienceMs) <= 0 || (room.revents & (POLLERR | POLLHUP)) != 0)
        return false;
      const auto wrote = ::write(descriptor_, bytes.data(), bytes.size());
      if (wrote < 0 && (errno == EAGAIN || errno == EINTR)) continue;
      if (wrote <= 0) return false;
      bytes = bytes.subspan(static_cast<std::size_t>(wrote));
    }
    return true;
  }
  std::optional<std::size_t> read(std::span<std::uint8_t> into, ports::Duration timeout) override {
    pollfd ready{descriptor_, POLLIN, 0};
    const auto wait = std::chrono::ceil<std::chrono::milliseconds>(timeout).count();
    const int any = ::poll(&ready, 1, static_cast<int>(wait));
    if (any == 0) return 0;
    if (any < 0) return errno == EINTR ? std::optional<std::size_t>(0) : std::nullopt;
    const auto got = ::read(descriptor_, into.data(), into.size());
    if (got < 0 && (errno == EAGAIN || errno == EINTR)) return 0;
    if (got <= 0) return std::nullopt;
    return static_cast<std::size_t>(got);
  }
  bool set_break(bool on) override {
    return ::ioctl(descriptor_, on ? TIOCSBRK : TIOCCBRK, 0) == 0;
  }
  bool drain() override { return ::ioctl(descriptor_, TCSBRK, 1) == 0; }

 private:
  static constexpr int kPatienceMs = 500;
  const int descriptor_;
};

bool configure(int descriptor, const ports::SerialSettings& settings) {
  termios2 line{};
  if (::ioctl(descriptor, TCGETS2, &line) != 0) return false;
  line.c_iflag = 0;
  line.c_oflag = 0;
  line.c_lflag = 0;
  line.c_cflag = CREAD | CLOCAL | BOTHER | (settings.data_bits == 7 ? CS7 : CS8);
  if (settings.stop_bits == 2) line.c_cflag |= CSTOPB;
  if (settings.parity != 'N') line.c_cflag |= PARENB;
  if (settings.parity == 'O') line.c_cflag |= PARODD;
  line.c_ispeed = line.c_ospeed = static_cast<speed_t>(settings.baud);
  line.c_cc[VMIN] = 0;
  line.c_cc[VTIME] = 0;
  if (::ioctl(descriptor, TCSETS2, &line) != 0) return false;
  (void)::ioctl(descriptor, TCFLSH, TCIOFLUSH);
  // Many adapters enable their line driver while RTS is clear; a pty has no such line.
  const int rts = TIOCM_RTS;
  (void)::ioctl(descriptor, TIOCMBIC, &rts);
  return true;
}

core::Problem refusal(const std::string& node) {
  const std::string why = std::strerror(errno);
  if (errno == EACCES)
    return {{},
            "may not open " + node + ": " + why,
            "`sudo usermod -aG dialout $USER`, then log in again; `chiaro doctor` checks it"};
  return {{}, "cannot open " + node + ": " + why, "`chiaro doctor` lists what is plugged in"};
}

}  // namespace

core::Result<std::unique_ptr<ports::SerialPort>> open_tty(const std::string& node,
                                                          const ports::SerialSettings& settings) {
  const int descriptor = ::open(node.c_str(), O_RDWR | O_NOCTTY | O_NONBLOCK | O_CLOEXEC);
  if (descriptor < 0) return refusal(node);
  auto port = std::make_unique<Tty>(descriptor);
  // Two masters on one line destroy each other's messages: whoever came first keeps it.
  if (::flock(descriptor, LOCK_EX | LOCK_NB) != 0)
    return core::Problem{
        {}, node + " is in use by another program", "`fuser " + node + "` shows which"};
  (void)::ioctl(descriptor, TIOCEXCL, 0);
  if (!configure(descriptor, settings))
    return core::Problem{{},
                         node + " cannot be set to " + std::to_string(settings.baud) +
                             " baud: " + std::strerror(errno),
                         "is it a serial line?"};
  return std::unique_ptr<ports::SerialPort>(std::move(port));
}

core::Problem built_without(const std::string& library, const std::string& what,
                            const std::string& package) {
  return {{},
          "built without " + library + ": " + what + " cannot be used",
          "install " + package + " and build Chiaro again"};
}

core::Result<std::unique_ptr<ports::SerialPort>> SystemDevices::open_serial(
    const ports::DeviceMatch& match, const ports::SerialSettings& settings) {
  const bool only_node = match == ports::DeviceMatch{.node = match.node} && !match.node.empty();
  if (only_node) return open_tty(match.node, settings);
  const auto chosen = ports::choose(match, usb());
  if (!chosen) return chosen.problems();
  if (!chosen->identity.node.empty()) return open_tty(chosen->identity.node, settings);
  if (!chosen->kernel_driver.empty() && chosen->kernel_driver != "usbfs")
    return core::Problem{{},
                         to_string(chosen->identity) + " is held by the driver '" +
                             chosen->kernel_driver + "', which is no serial one",
                         "choose another device"};
  return open_ftdi(chosen->identity, settings);
}

}  // namespace chiaro::drivers
