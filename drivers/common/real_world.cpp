// SPDX-License-Identifier: Apache-2.0
#include "drivers/common/real_world.h"

#include <csignal>
#include <cstdlib>
#include <ctime>
#include <iostream>
#include <unistd.h>

#include "drivers/common/system_devices.h"
#include "drivers/common/system_network.h"

namespace chiaro::drivers {
namespace {

std::atomic<bool> stop_asked{false}, reload_asked{false};

class SystemClock final : public ports::Clock {
 public:
  ports::TimePoint now() const override {
    return ports::TimePoint(std::chrono::steady_clock::now());
  }
  void sleep_until(ports::TimePoint deadline) override {
    const auto ns = deadline.time_since_epoch().count();
    const timespec at{static_cast<time_t>(ns / 1000000000), static_cast<long>(ns % 1000000000)};
    while (clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &at, nullptr) == EINTR && !stop_asked) {
    }
  }
};

std::string variable(const char* name) {
  const char* value = std::getenv(name);
  return value == nullptr ? "" : value;
}

/// The installed config beside the program's prefix, else the source tree's.
std::filesystem::path config_folder(const char* program_path) {
  if (const auto given = variable("CHIARO_CONFIG"); !given.empty()) return given;
  std::error_code code;
  auto program = std::filesystem::read_symlink("/proc/self/exe", code);
  if (code) program = program_path;
  const auto installed = program.parent_path().parent_path() / "share/chiaro/config";
  if (std::filesystem::exists(installed, code)) return installed;
  for (auto folder = program.parent_path(); folder != folder.root_path();
       folder = folder.parent_path())
    if (std::filesystem::exists(folder / "config/fixtures", code)) return folder / "config";
  return installed;
}

std::filesystem::path state_folder() {
  if (const auto given = variable("CHIARO_STATE"); !given.empty()) return given;
  if (const auto service = variable("STATE_DIRECTORY"); !service.empty()) return service;
  if (const auto xdg = variable("XDG_STATE_HOME"); !xdg.empty())
    return std::filesystem::path(xdg) / "chiaro";
  if (const auto home = variable("HOME"); !home.empty())
    return std::filesystem::path(home) / ".local/state/chiaro";
  return "/var/lib/chiaro";
}

std::filesystem::path runtime_folder() {
  if (const auto given = variable("CHIARO_RUNTIME"); !given.empty()) return given;
  if (const auto service = variable("RUNTIME_DIRECTORY"); !service.empty()) return service;
  // The installed services' folder, so that `chiaro blackout` reaches them from anybody's shell.
  std::error_code code;
  if (std::filesystem::exists("/run/chiaro", code)) return "/run/chiaro";
  if (const auto xdg = variable("XDG_RUNTIME_DIR"); !xdg.empty())
    return std::filesystem::path(xdg) / "chiaro";
  return "/tmp/chiaro-" + std::to_string(::getuid());
}

}  // namespace

ports::World& real_world(const char* program_path) {
  static SystemClock clock;
  static drivers::SystemNetwork network;
  static drivers::SystemDevices devices;
  static ports::World world{clock,
                            network,
                            devices,
                            std::cin,
                            std::cout,
                            std::cerr,
                            ::isatty(STDERR_FILENO) == 1,
                            config_folder(program_path),
                            state_folder(),
                            runtime_folder(),
                            stop_asked,
                            reload_asked};
  struct sigaction action {};
  action.sa_handler = [](int) { stop_asked = true; };
  sigaction(SIGINT, &action, nullptr);
  sigaction(SIGTERM, &action, nullptr);
  action.sa_handler = [](int) { reload_asked = true; };
  sigaction(SIGHUP, &action, nullptr);
  signal(SIGPIPE, SIG_IGN);
  return world;
}

}  // namespace chiaro::drivers
