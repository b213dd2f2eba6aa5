// SPDX-License-Identifier: Apache-2.0
// OSC surfaces over UDP: tablets, media servers. Feedback goes to whoever spoke last. Messages are
// read and built by liblo; the socket is ours, so that tests need no network.
#include <algorithm>
#include <array>
#include <cmath>

#include "drivers/common/system_devices.h"
#include "drivers/registry.h"

#if CHIARO_WITH_OSC
#include <lo/lo.h>
#endif

namespace chiaro::drivers::osc {
#if CHIARO_WITH_OSC
namespace {

struct Freer {
  void operator()(void* message) const { lo_message_free(static_cast<lo_message>(message)); }
};
using Message = std::unique_ptr<void, Freer>;

class OscSurface final : public ports::Surface {
 public:
  OscSurface(const SurfaceSettings& settings, Surroundings& around)
      : settings_(settings), around_(around) {}

  core::Result<core::Done> open() override {
    socket_.reset();
    ports::Network::Options options;
    options.interface = settings_.interface;
    options.local_port = settings_.port;
    auto socket = around_.network.open_datagram(options);
    if (!socket) return socket.problems();
    socket_ = std::move(*socket);
    health_ = ports::PortHealth::good;
    return core::Done{};
  }

  std::vector<ports::SurfaceEvent> listen(ports::TimePoint) override {
    std::vector<ports::SurfaceEvent> events;
    std::array<std::uint8_t, 1472> datagram;
    ports::Endpoint from;
    while (socket_) {
      const auto size = socket_->receive(datagram, &from);
      if (!size) break;
      if (hear(std::span(datagram).first(*size), events)) speaker_ = from;
    }
    return events;
  }

  void show(const std::string& name, double value, const std::string& word) override {
    if (!socket_ || speaker_.port == 0) return;
    for (const SurfaceControl& control : settings_.controls) {
      if (control.name != name || control.osc.empty()) continue;
      Message message(lo_message_new());
      lo_message_add_float(message.get(), static_cast<float>(value));
      if (!word.empty()) lo_message_add_string(message.get(), word.c_str());
      std::array<std::uint8_t, 1472> bytes;
      std::size_t size = lo_message_length(message.get(), control.osc.c_str());
      if (size > bytes.size()) continue;
      lo_message_serialise(message.get(), control.osc.c_str(), bytes.data(), &size);
      socket_->send(speaker_, std::span(bytes).first(size));
    }
  }
  ports::PortHealth health() const override { return health_; }

 private:
  bool hear(std::span<std::uint8_t> datagram, std::vector<ports::SurfaceEvent>& events) const {
    if (datagram.empty() || datagram[0] != '/') return false;  // bundles are not taken
    int result = 0;
    const Message message(lo_message_deserialise(datagram.data(), datagram.size(), &result));
    if (!message) return false;
    const std::string path(reinterpret_cast<const char*>(datagram.data()));
    const double value = value_of(message.get());
    if (!std::isfinite(value)) return true;
    for (const SurfaceControl& control : settings_.controls)
      if (control.osc == path) events.push_back({control.name, within_range(control, value)});
    return true;
  }
  static double within_range(const SurfaceControl& control, double value) {
    using Kind = SurfaceControl::Kind;
    if (control.kind == Kind::button) return value >= 0.5 ? 1 : 0;
    const double least = control.kind == Kind::fader ? 0 : -127;
    return std::clamp(value, least, control.kind == Kind::fader ? 1.0 : 127.0);
  }
  /// The first argument as a number; a message without any is a button pressed.
  static double value_of(lo_message message) {
    if (lo_message_get_argc(message) == 0) return 1;
    const char type = lo_message_get_types(message)[0];
    if (type == 'T') return 1;
    if (type == 'F') return 0;
    if (!lo_is_numerical_type(static_cast<lo_type>(type))) return 1;
    return static_cast<double>(
        lo_hires_val(static_cast<lo_type>(type), lo_message_get_argv(message)[0]));
  }

  const SurfaceSettings settings_;
  Surroundings& around_;
  std::unique_ptr<ports::DatagramSocket> socket_;
  ports::Endpoint speaker_;
  ports::PortHealth health_ = ports::PortHealth::closed;
};

}  // namespace
#else
namespace {

class OscSurface final : public ports::Surface {
 public:
  OscSurface(const SurfaceSettings&, Surroundings&) {}
  core::Result<core::Done> open() override { return built_without("liblo", "OSC", "liblo-dev"); }
  std::vector<ports::SurfaceEvent> listen(ports::TimePoint) override { return {}; }
  void show(const std::string&, double, const std::string&) override {}
  ports::PortHealth health() const override { return ports::PortHealth::closed; }
};

}  // namespace
#endif

std::unique_ptr<ports::Surface> make_surface(const SurfaceSettings&, Surroundings&);
std::unique_ptr<ports::Surface> make_surface(const SurfaceSettings& settings,
                                             Surroundings& around) {
  return std::make_unique<OscSurface>(settings, around);
}

}  // namespace chiaro::drivers::osc
