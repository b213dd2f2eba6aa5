// SPDX-License-Identifier: Apache-2.0
// A camera of Video4Linux: webcams, HDMI grabbers. Its automatic controls are switched off and read
// back, because a camera that corrects itself undoes what the lights do; of the frames that wait
// only the newest is used, with the time at which it was taken.
#include <array>
#include <cerrno>
#include <cstring>
#include <linux/videodev2.h>

#include "controller/core/picture_file.h"
#include "drivers/common/raw_pixels.h"
#include "drivers/common/video_calls.h"
#include "drivers/registry.h"

namespace chiaro::drivers::v4l2 {
namespace {

using namespace std::chrono_literals;

/// In the order we like them: no loss, colour, small.
constexpr std::array<std::uint32_t, 4> kFormats{V4L2_PIX_FMT_YUYV, V4L2_PIX_FMT_NV12,
                                                V4L2_PIX_FMT_MJPEG, V4L2_PIX_FMT_GREY};
constexpr std::uint32_t kBuffers = 4;

/// What a camera does by itself, the value that stops it, and what it then leaves to us.
struct Automatic {
  std::uint32_t id;
  std::int32_t manual;
  std::uint32_t value_id;
  const char* name;
};
constexpr Automatic kAutomatics[] = {
    {V4L2_CID_EXPOSURE_AUTO, V4L2_EXPOSURE_MANUAL, V4L2_CID_EXPOSURE_ABSOLUTE, "exposure"},
    {V4L2_CID_AUTOGAIN, 0, V4L2_CID_GAIN, "gain"},
    {V4L2_CID_AUTO_WHITE_BALANCE, 0, V4L2_CID_WHITE_BALANCE_TEMPERATURE, "white balance"},
    {V4L2_CID_FOCUS_AUTO, 0, V4L2_CID_FOCUS_ABSOLUTE, "focus"},
    {V4L2_CID_EXPOSURE_AUTO_PRIORITY, 0, 0, "frame rate"}};

class V4l2Camera final : public ports::Camera {
 public:
  V4l2Camera(const CameraSettings& settings, ports::Clock& clock)
      : settings_(settings),
        node_(settings.source.substr(settings.source.find(':') + 1)),
        clock_(clock),
        calls_(settings.video != nullptr ? *settings.video : system_video_calls()) {}
  ~V4l2Camera() override { close(); }
  V4l2Camera(const V4l2Camera&) = delete;
  V4l2Camera& operator=(const V4l2Camera&) = delete;

  core::Result<ports::CameraFrame> grab(ports::Duration timeout) override {
    if (descriptor_ < 0)
      if (const auto opened = open(); !opened) return opened.problems();
    const auto end = clock_.now() + timeout;
    while (clock_.now() < end && !(settings_.stop != nullptr && *settings_.stop)) {
      const int any = calls_.poll(descriptor_, kPieceMs);
      if (any < 0) return gone();
      if (any == 0) continue;
      auto newest = take_newest();
      if (!newest) return newest.problems();
      if (!newest->picture.empty()) return newest;
    }
    return refusal("no picture came in time", "is another program using it? `fuser " + node_ + "`");
  }

  core::Problems unlocked() const override { return unlocked_; }

 private:
  static constexpr int kPieceMs = 50;
  struct Buffer {
    void* memory = nullptr;
    std::size_t length = 0;
  };

  core::Problem refusal(const std::string& what, const std::string& remedy) const {
    return {{settings_.source, 0, 0}, node_ + ": " + what, remedy, false};
  }
  core::Problem gone() {
    close();
    return refusal("the camera went away", "plug it in again; it is looked for all the time");
  }
  bool call(unsigned long request, void* argument) {
    return calls_.ioctl(descriptor_, request, argument) == 0;
  }

  core::Result<core::Done> open() {
    descriptor_ = calls_.open(node_);
    if (descriptor_ < 0)
      return refusal(std::string("cannot be opened: ") + std::strerror(errno),
                     errno == EACCES ? "`sudo usermod -aG video $USER`, then log in again"
                                     : "`chiaro doctor` lists what is plugged in");
    auto ready = start();
    if (!ready) close();
    return ready;
  }

  core::Result<core::Done> start() {
    v4l2_capability able{};
    if (!call(VIDIOC_QUERYCAP, &able)) return refusal("is no camera", "choose another device");
    const std::uint32_t caps =
        (able.capabilities & V4L2_CAP_DEVICE_CAPS) != 0 ? able.device_caps : able.capabilities;
    if ((caps & V4L2_CAP_VIDEO_CAPTURE) == 0 || (caps & V4L2_CAP_STREAMING) == 0)
      return refusal("gives no pictures", "many cameras have two devices: try the next one");
    if (!choose_format())
      return refusal("gives none of YUYV, NV12, MJPEG and GREY",
                     "`v4l2-ctl --list-formats` shows its own");
    lock_controls();
    return start_streaming();
  }

  bool choose_format() {
    for (const std::uint32_t wanted : kFormats) {
      v4l2_fmtdesc described{};
      described.type = V4L2_BUF_TYPE_VIDEO_CAPTURE;
      bool offered = false;
      for (; !offered && call(VIDIOC_ENUM_FMT, &described); ++described.index)
        offered = described.pixelformat == wanted;
      if (!offered) continue;
      format_ = {};
      format_.type = V4L2_BUF_TYPE_VIDEO_CAPTURE;
      format_.fmt.pix.width = static_cast<std::uint32_t>(settings_.size.width);
      format_.fmt.pix.height = static_cast<std::uint32_t>(settings_.size.height);
      format_.fmt.pix.pixelformat = wanted;
      format_.fmt.pix.field = V4L2_FIELD_NONE;
      // The driver answers with the nearest size it has.
      if (call(VIDIOC_S_FMT, &format_) && format_.fmt.pix.pixelformat == wanted) return true;
    }
    return false;
  }

  std::optional<std::int32_t> get(std::uint32_t id) {
    v4l2_control control{id, 0};
    if (!call(VIDIOC_G_CTRL, &control)) return std::nullopt;
    return control.value;
  }
  bool set(std::uint32_t id, std::int32_t value) {
    v4l2_control control{id, value};
    return call(VIDIOC_S_CTRL, &control) && get(id) == value;
  }

  /// Everything stays where it is now, or where the studio file wants it; what does not is told.
  void lock_controls() {
    unlocked_.clear();
    for (const Automatic& one : kAutomatics) {
      const auto before = one.value_id != 0 ? get(one.value_id) : std::nullopt;
      const auto automatic = get(one.id);
      if (automatic && *automatic != one.manual && !set(one.id, one.manual)) tell(one.name);
      if (automatic && before && !set(one.value_id, *before)) tell(one.name);
    }
    const auto want = [&](std::uint32_t id, std::optional<std::int32_t> value, const char* name) {
      if (value && !set(id, *value)) tell(name);
    };
    want(V4L2_CID_EXPOSURE_ABSOLUTE, settings_.exposure_100us, "exposure");
    want(V4L2_CID_GAIN, settings_.gain, "gain");
    want(V4L2_CID_WHITE_BALANCE_TEMPERATURE, settings_.white_balance, "white balance");
  }
  void tell(const char* name) {
    core::Problem problem = refusal(std::string("does not hold its ") + name + " still",
                                    "set it by hand in the camera; comparisons would drift");
    problem.warning = true;
    unlocked_.push_back(std::move(problem));
  }

  core::Result<core::Done> start_streaming() {
    v4l2_requestbuffers request{};
    request.count = kBuffers;
    request.type = V4L2_BUF_TYPE_VIDEO_CAPTURE;
    request.memory = V4L2_MEMORY_MMAP;
    if (!call(VIDIOC_REQBUFS, &request) || request.count == 0)
      return refusal(
          "gives no buffers: " + std::string(std::strerror(errno)),
          errno == EBUSY ? "another program has it: `fuser " + node_ + "`" : "plug it in again");
    for (std::uint32_t i = 0; i < request.count; ++i) {
      v4l2_buffer buffer = numbered(i);
      if (!call(VIDIOC_QUERYBUF, &buffer)) return refusal("gives no buffers", "plug it in again");
      void* memory = calls_.map(descriptor_, buffer.length, static_cast<long>(buffer.m.offset));
      if (memory == nullptr) return refusal("its buffers cannot be read", "plug it in again");
      buffers_.push_back({memory, buffer.length});
      if (!call(VIDIOC_QBUF, &buffer)) return refusal("takes no buffers", "plug it in again");
    }
    int type = V4L2_BUF_TYPE_VIDEO_CAPTURE;
    if (!call(VIDIOC_STREAMON, &type))
      return refusal("does not start", "too many cameras on one USB? try another socket");
    streaming_ = true;
    return core::Done{};
  }

  static v4l2_buffer numbered(std::uint32_t index) {
    v4l2_buffer buffer{};
    buffer.index = index;
    buffer.type = V4L2_BUF_TYPE_VIDEO_CAPTURE;
    buffer.memory = V4L2_MEMORY_MMAP;
    return buffer;
  }

  /// Takes every frame that waits, keeps the last good one. An empty picture: none was good.
  core::Result<ports::CameraFrame> take_newest() {
    std::optional<v4l2_buffer> newest;
    while (true) {
      v4l2_buffer buffer = numbered(0);
      if (!call(VIDIOC_DQBUF, &buffer)) {
        if (errno == EAGAIN) break;
        return gone();
      }
      const bool good = (buffer.flags & V4L2_BUF_FLAG_ERROR) == 0 && buffer.bytesused > 0 &&
                        buffer.index < buffers_.size();
      if (good && newest && !call(VIDIOC_QBUF, &*newest)) return gone();
      if (good)
        newest = buffer;
      else if (!call(VIDIOC_QBUF, &buffer))
        return gone();
    }
    if (!newest) return ports::CameraFrame{};
    const Buffer& held = buffers_[newest->index];
    const std::span bytes(static_cast<const std::uint8_t*>(held.memory),
                          std::min<std::size_t>(newest->bytesused, held.length));
    ports::CameraFrame frame{decode(bytes), taken(*newest)};
    if (!call(VIDIOC_QBUF, &*newest)) return gone();
    return frame;
  }

  core::EncodedPicture decode(std::span<const std::uint8_t> bytes) const {
    const auto& pix = format_.fmt.pix;
    const core::Size size{static_cast<int>(pix.width), static_cast<int>(pix.height)};
    const auto range =
        pix.quantization == V4L2_QUANTIZATION_FULL_RANGE ? YcbcrRange::full : YcbcrRange::limited;
    const auto stride = [&](std::size_t least) {
      return std::max<std::size_t>(pix.bytesperline, least);
    };
    switch (pix.pixelformat) {
      case V4L2_PIX_FMT_YUYV:
        return from_yuyv(bytes, size, stride(2u * pix.width), range);
      case V4L2_PIX_FMT_NV12:
        return from_nv12(bytes, size, stride(pix.width), range);
      case V4L2_PIX_FMT_GREY:
        return from_grey(bytes, size, stride(pix.width));
      default: {
        auto picture = core::decode_picture(bytes, settings_.source);
        return picture ? std::move(*picture) : core::EncodedPicture{};  // a torn JPEG: the next one
      }
    }
  }

  ports::TimePoint taken(const v4l2_buffer& buffer) const {
    if ((buffer.flags & V4L2_BUF_FLAG_TIMESTAMP_MASK) != V4L2_BUF_FLAG_TIMESTAMP_MONOTONIC)
      return clock_.now();
    return ports::TimePoint(std::chrono::seconds(buffer.timestamp.tv_sec) +
                            std::chrono::microseconds(buffer.timestamp.tv_usec));
  }

  void close() {
    if (descriptor_ < 0) return;
    int type = V4L2_BUF_TYPE_VIDEO_CAPTURE;
    if (streaming_) call(VIDIOC_STREAMOFF, &type);
    for (const Buffer& buffer : buffers_) calls_.unmap(buffer.memory, buffer.length);
    buffers_.clear();
    calls_.close(descriptor_);
    descriptor_ = -1;
    streaming_ = false;
  }

  const CameraSettings settings_;
  const std::string node_;
  ports::Clock& clock_;
  VideoCalls& calls_;
  int descriptor_ = -1;
  bool streaming_ = false;
  v4l2_format format_{};
  std::vector<Buffer> buffers_;
  core::Problems unlocked_;
};

}  // namespace

std::unique_ptr<ports::Camera> make(const CameraSettings&, ports::Clock&);
std::unique_ptr<ports::Camera> make(const CameraSettings& settings, ports::Clock& clock) {
  return std::make_unique<V4l2Camera>(settings, clock);
}

}  // namespace chiaro::drivers::v4l2
