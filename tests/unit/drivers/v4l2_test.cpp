// SPDX-License-Identifier: Apache-2.0
// A Video4Linux camera whose kernel is this file.
#include <cerrno>
#include <cstring>
#include <deque>
#include <gtest/gtest.h>
#include <linux/videodev2.h>
#include <map>

#include "drivers/common/raw_pixels.h"
#include "drivers/common/video_calls.h"
#include "drivers/registry.h"
#include "tests/support/fake_clock.h"

namespace chiaro::drivers {
namespace {

using namespace std::chrono_literals;

/// A 4 x 2 camera with controls, four buffers and frames that the test lays down.
class FakeVideo final : public VideoCalls {
 public:
  std::uint32_t format = V4L2_PIX_FMT_GREY;
  std::map<std::uint32_t, std::int32_t> controls{
      {V4L2_CID_EXPOSURE_AUTO, V4L2_EXPOSURE_APERTURE_PRIORITY},
      {V4L2_CID_EXPOSURE_ABSOLUTE, 156},
      {V4L2_CID_AUTO_WHITE_BALANCE, 1},
      {V4L2_CID_WHITE_BALANCE_TEMPERATURE, 4600}};
  std::uint32_t stubborn = 0;  ///< this control says yes and does not change
  struct Frame {
    std::uint8_t grey;
    long seconds;
    bool broken;
  };
  std::deque<Frame> frames;
  bool plugged = true, streaming = false;
  int opens = 0, closes = 0, mapped = 0;

  int open(const std::string& node) override {
    if (!plugged || node != "/dev/video3") return errno = ENOENT, -1;
    return ++opens, 7;
  }
  void close(int) override {
    ++closes;
    queued_.clear();
  }
  void* map(int, std::size_t, long offset) override {
    ++mapped;
    return memory_[static_cast<std::size_t>(offset)].data();
  }
  void unmap(void*, std::size_t) override { --mapped; }
  int poll(int, int) override { return !plugged ? -1 : frames.empty() ? 0 : 1; }

  int ioctl(int, unsigned long request, void* argument) override {
    if (!plugged) return errno = ENODEV, -1;
    switch (request) {
      case VIDIOC_QUERYCAP:
        static_cast<v4l2_capability*>(argument)->capabilities =
            V4L2_CAP_VIDEO_CAPTURE | V4L2_CAP_STREAMING;
        return 0;
      case VIDIOC_ENUM_FMT: {
        auto* described = static_cast<v4l2_fmtdesc*>(argument);
        if (described->index > 0) return errno = EINVAL, -1;
        described->pixelformat = format;
        return 0;
      }
      case VIDIOC_S_FMT: {
        auto& pix = static_cast<v4l2_format*>(argument)->fmt.pix;
        pix.width = 4;
        pix.height = 2;
        pix.bytesperline = 4;
        return 0;
      }
      case VIDIOC_G_CTRL:
      case VIDIOC_S_CTRL: {
        auto* control = static_cast<v4l2_control*>(argument);
        const auto known = controls.find(control->id);
        if (known == controls.end()) return errno = EINVAL, -1;
        if (request == VIDIOC_G_CTRL)
          control->value = known->second;
        else if (control->id != stubborn)
          known->second = control->value;
        return 0;
      }
      case VIDIOC_REQBUFS:
        return 0;
      case VIDIOC_QUERYBUF: {
        auto* buffer = static_cast<v4l2_buffer*>(argument);
        buffer->length = 8;
        buffer->m.offset = buffer->index;
        return 0;
      }
      case VIDIOC_QBUF:
        queued_.push_back(static_cast<v4l2_buffer*>(argument)->index);
        return 0;
      case VIDIOC_DQBUF:
        return fill(*static_cast<v4l2_buffer*>(argument));
      case VIDIOC_STREAMON:
      case VIDIOC_STREAMOFF:
        streaming = request == VIDIOC_STREAMON;
        return 0;
      default:
        return errno = ENOTTY, -1;
    }
  }
  std::size_t queued() const { return queued_.size(); }

 private:
  int fill(v4l2_buffer& buffer) {
    if (frames.empty() || queued_.empty()) return errno = EAGAIN, -1;
    buffer.index = queued_.front();
    queued_.pop_front();
    memory_[buffer.index].fill(frames.front().grey);
    buffer.bytesused = 8;
    buffer.flags = V4L2_BUF_FLAG_TIMESTAMP_MONOTONIC;
    if (frames.front().broken) buffer.flags |= V4L2_BUF_FLAG_ERROR;
    buffer.timestamp = {frames.front().seconds, 500000};
    frames.pop_front();
    return 0;
  }
  std::array<std::array<std::uint8_t, 8>, 4> memory_{};
  std::deque<std::uint32_t> queued_;
};

class AWebcam : public testing::Test {
 protected:
  AWebcam() {
    settings_.source = "v4l2:/dev/video3";
    settings_.video = &video_;
    camera_ = std::move(*make_camera(settings_, clock_));
  }
  support::FakeClock clock_{support::FakeClock::Sleep::jumps};
  FakeVideo video_;
  CameraSettings settings_;
  std::unique_ptr<ports::Camera> camera_;
};

TEST_F(AWebcam, GivesTheNewestOfTheFramesThatWaitWithTheTimeItWasTaken) {
  video_.frames = {{10, 1, false}, {20, 2, false}, {30, 3, false}};
  const auto frame = camera_->grab(1s);
  ASSERT_TRUE(frame) << core::to_string(frame.problems());
  EXPECT_EQ(frame->picture.size, (core::Size{4, 2}));
  EXPECT_EQ(frame->picture.at(0, 0)[1], 30);
  EXPECT_EQ(frame->taken, ports::TimePoint(3500ms));
  EXPECT_EQ(video_.queued(), 4u) << "every buffer goes back";
}

TEST_F(AWebcam, PassesOverAFrameThatIsMarkedAsBroken) {
  video_.frames = {{10, 1, false}, {99, 2, true}};
  const auto frame = camera_->grab(1s);
  ASSERT_TRUE(frame);
  EXPECT_EQ(frame->picture.at(3, 1)[0], 10);
}

TEST_F(AWebcam, HoldsItsAutomaticControlsWhereTheyStand) {
  video_.frames = {{10, 1, false}};
  ASSERT_TRUE(camera_->grab(1s));
  EXPECT_EQ(video_.controls[V4L2_CID_EXPOSURE_AUTO], V4L2_EXPOSURE_MANUAL);
  EXPECT_EQ(video_.controls[V4L2_CID_EXPOSURE_ABSOLUTE], 156);
  EXPECT_EQ(video_.controls[V4L2_CID_AUTO_WHITE_BALANCE], 0);
  EXPECT_TRUE(camera_->unlocked().empty());
}

TEST_F(AWebcam, TellsWhatItDoesNotHoldStill) {
  video_.stubborn = V4L2_CID_AUTO_WHITE_BALANCE;
  video_.frames = {{10, 1, false}};
  ASSERT_TRUE(camera_->grab(1s));
  ASSERT_EQ(camera_->unlocked().size(), 1u);
  EXPECT_NE(camera_->unlocked()[0].what.find("white balance"), std::string::npos);
}

TEST_F(AWebcam, IsLostWhenItIsPulledAndComesBackWithoutALeak) {
  video_.frames = {{10, 1, false}};
  ASSERT_TRUE(camera_->grab(1s));
  video_.plugged = false;
  EXPECT_FALSE(camera_->grab(1s));
  EXPECT_FALSE(camera_->grab(1s));
  EXPECT_EQ(video_.mapped, 0);
  EXPECT_EQ(video_.closes, video_.opens);
  video_.plugged = true;
  video_.frames = {{77, 9, false}};
  const auto frame = camera_->grab(1s);
  ASSERT_TRUE(frame);
  EXPECT_EQ(frame->picture.at(0, 0)[0], 77);
}

TEST_F(AWebcam, WithAFormatThatWeDoNotReadSaysSo) {
  video_.format = V4L2_PIX_FMT_SBGGR8;
  const auto frame = camera_->grab(1s);
  ASSERT_FALSE(frame);
  EXPECT_NE(frame.problems()[0].what.find("YUYV"), std::string::npos);
  EXPECT_EQ(video_.closes, 1);
}

TEST(RawPixels, BecomeTheColoursThatBt601Says) {
  // Limited range: black 16, white 235; pure red is Y 81, Cb 90, Cr 240.
  const std::vector<std::uint8_t> yuyv{16, 128, 235, 128, 81, 90, 81, 240};
  const auto picture = from_yuyv(yuyv, {4, 1}, 8, YcbcrRange::limited);
  EXPECT_EQ(picture.at(0, 0), (std::array<std::uint8_t, 3>{0, 0, 0}));
  EXPECT_EQ(picture.at(1, 0), (std::array<std::uint8_t, 3>{255, 255, 255}));
  EXPECT_NEAR(picture.at(2, 0)[0], 255, 2);
  EXPECT_NEAR(picture.at(2, 0)[1], 0, 2);
  const std::vector<std::uint8_t> nv12{81, 81, 81, 81, 90, 240};
  EXPECT_NEAR(from_nv12(nv12, {2, 2}, 2, YcbcrRange::limited).at(1, 1)[0], 255, 2);
  EXPECT_TRUE(from_nv12(nv12, {4, 2}, 4, YcbcrRange::limited).empty()) << "too few bytes";
  EXPECT_TRUE(from_yuyv(yuyv, {4, 2}, 8, YcbcrRange::limited).empty());
}

}  // namespace
}  // namespace chiaro::drivers
