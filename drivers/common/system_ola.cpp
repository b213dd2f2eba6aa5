// SPDX-License-Identifier: Apache-2.0
// A running olad, by OLA's own client library.
#include "drivers/common/system_devices.h"

#if CHIARO_WITH_OLA
#include <ola/DmxBuffer.h>
#include <ola/Logging.h>
#include <ola/client/StreamingClient.h>
#endif

namespace chiaro::drivers {
#if CHIARO_WITH_OLA
namespace {

class Ola final : public ports::DmxStream {
 public:
  Ola() : client_(options()) {}
  bool open() {
    ::ola::InitLogging(::ola::OLA_LOG_NONE, ::ola::OLA_LOG_STDERR);
    return client_.Setup();
  }
  bool send(std::uint16_t universe, std::span<const std::uint8_t> levels) override {
    ::ola::DmxBuffer buffer(levels.data(), static_cast<unsigned>(levels.size()));
    return client_.SendDmx(universe, buffer);
  }

 private:
  static ::ola::client::StreamingClient::Options options() {
    ::ola::client::StreamingClient::Options options;
    options.auto_start = false;  // a lighting program that nobody started must not start itself
    return options;
  }
  ::ola::client::StreamingClient client_;
};

}  // namespace

core::Result<std::unique_ptr<ports::DmxStream>> SystemDevices::open_ola() {
  auto stream = std::make_unique<Ola>();
  if (!stream->open())
    return core::Problem{{}, "olad does not answer on this machine", "`sudo systemctl start olad`"};
  return std::unique_ptr<ports::DmxStream>(std::move(stream));
}
#else
core::Result<std::unique_ptr<ports::DmxStream>> SystemDevices::open_ola() {
  return built_without("libola", "olad", "libola-dev");
}
#endif
}  // namespace chiaro::drivers
