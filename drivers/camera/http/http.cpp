// SPDX-License-Identifier: Apache-2.0
// An IP camera: a snapshot address, which answers each GET with one picture, or an MJPEG stream,
// which never ends. The camera says which of them its address is. Of a stream only the newest
// picture counts: what has waited in the socket while nobody looked is dropped.
#include <array>

#include "controller/core/picture_file.h"
#include "drivers/common/http_client.h"
#include "drivers/common/multipart_reader.h"
#include "drivers/registry.h"

namespace chiaro::drivers::http {
namespace {

using namespace std::chrono_literals;

/// Longer than this between two looks, and what waits may be old: the far end stops sending when
/// nobody reads.
constexpr ports::Duration kFresh = 150ms;

class HttpCamera final : public ports::Camera {
 public:
  HttpCamera(const CameraSettings& settings, ports::Clock& clock)
      : settings_(settings), clock_(clock) {}

  core::Result<ports::CameraFrame> grab(ports::Duration timeout) override {
    const ports::TimePoint end = clock_.now() + timeout;
    if (!stream_)
      if (const auto opened = open(timeout); !opened) return opened.problems();
    auto frame = parts_ ? newest_part(end) : single_picture(end);
    if (!frame || !parts_) stream_.reset();
    return frame;
  }

 private:
  core::Problem refusal(const std::string& what, const std::string& remedy) const {
    return {{settings_.source, 0, 0}, what, remedy, false};
  }

  core::Result<core::Done> open(ports::Duration timeout) {
    auto stream = open_http_stream(settings_.source, timeout, settings_.stop);
    if (!stream) return stream.problems();
    if ((*stream)->status() != 200)
      return refusal("the camera answered " + std::to_string((*stream)->status()),
                     "open the address in a browser: it must show a picture");
    stream_ = std::move(*stream);
    parts_.reset();
    if (MultipartReader::is_stream(stream_->type())) parts_.emplace(stream_->type());
    looked_ = clock_.now();
    return core::Done{};
  }

  bool may_go_on(ports::TimePoint end) const {
    return clock_.now() < end && !(settings_.stop != nullptr && *settings_.stop);
  }

  core::Result<ports::CameraFrame> single_picture(ports::TimePoint end) {
    std::string body;
    while (may_go_on(end)) {
      const auto got = stream_->read(bytes_, end - clock_.now());
      if (got) body.append(bytes_.data(), *got);
      if (body.size() > kMostHttpBody) return refusal("its picture has no end", "try another one");
      const bool whole = stream_->length() ? body.size() >= *stream_->length() : !got;
      if (whole) return decoded(body, clock_.now());
      if (!got) return refusal("the camera broke off in its picture", "check its cable");
    }
    return refusal("no whole picture came in time", "check the camera's network");
  }

  /// Everything that waits is read; the newest whole part counts, or the next one to begin when
  /// nobody has looked for a while.
  core::Result<ports::CameraFrame> newest_part(ports::TimePoint end) {
    const bool stale = clock_.now() - looked_ > kFresh;
    bool open = drain(end);
    if (stale) parts_->skip();
    for (;;) {
      looked_ = clock_.now();
      if (const auto part = parts_->newest()) {
        auto frame = decoded(part->body, part->begun);
        if (frame) return frame;  // a torn picture: the next one
      }
      if (!open) return ended();
      if (!may_go_on(end)) break;
      const auto got = stream_->read(bytes_, end - clock_.now());
      open = got && parts_->take({bytes_.data(), *got}, clock_.now()) && drain(end);
    }
    return refusal("no picture came in time", "check the camera's network");
  }
  bool drain(ports::TimePoint end) {
    while (may_go_on(end)) {
      const auto got = stream_->read(bytes_, {});
      if (!got) return false;
      if (*got == 0) return true;
      if (!parts_->take({bytes_.data(), *got}, clock_.now())) return false;
    }
    return true;
  }
  core::Problem ended() const {
    return refusal("the camera ended its stream", "it is asked again; check its network");
  }

  core::Result<ports::CameraFrame> decoded(const std::string& body, ports::TimePoint taken) const {
    const auto* bytes = reinterpret_cast<const std::uint8_t*>(body.data());
    auto picture = core::decode_picture({bytes, body.size()}, settings_.source);
    if (!picture) return picture.problems();
    return ports::CameraFrame{std::move(*picture), taken};
  }

  const CameraSettings settings_;
  ports::Clock& clock_;
  std::unique_ptr<HttpStream> stream_;
  std::optional<MultipartReader> parts_;  ///< the address is a stream
  ports::TimePoint looked_;
  std::array<char, 65536> bytes_;
};

}  // namespace

std::unique_ptr<ports::Camera> make(const CameraSettings&, ports::Clock&);
std::unique_ptr<ports::Camera> make(const CameraSettings& settings, ports::Clock& clock) {
  return std::make_unique<HttpCamera>(settings, clock);
}

}  // namespace chiaro::drivers::http
