// SPDX-License-Identifier: Apache-2.0
// A camera that answers each GET with one picture, as every IP camera's snapshot address does.
#include "controller/core/picture_file.h"
#include "drivers/common/http_client.h"
#include "drivers/registry.h"

namespace chiaro::drivers::http {
namespace {

class HttpCamera final : public ports::Camera {
 public:
  HttpCamera(const CameraSettings& settings, ports::Clock& clock)
      : settings_(settings), clock_(clock) {}

  core::Result<ports::CameraFrame> grab(ports::Duration timeout) override {
    auto reply = http_request({.url = settings_.source}, timeout, settings_.stop);
    if (!reply) return reply.problems();
    if (reply->status != 200)
      return core::Problem{{settings_.source, 0, 0},
                           "the camera answered " + std::to_string(reply->status),
                           "open the address in a browser: it must show one picture"};
    const auto* bytes = reinterpret_cast<const std::uint8_t*>(reply->body.data());
    auto picture = core::decode_picture({bytes, reply->body.size()}, settings_.source);
    if (!picture) return picture.problems();
    return ports::CameraFrame{std::move(*picture), clock_.now()};
  }

 private:
  CameraSettings settings_;
  ports::Clock& clock_;
};

}  // namespace

std::unique_ptr<ports::Camera> make(const CameraSettings&, ports::Clock&);
std::unique_ptr<ports::Camera> make(const CameraSettings& settings, ports::Clock& clock) {
  return std::make_unique<HttpCamera>(settings, clock);
}

}  // namespace chiaro::drivers::http
