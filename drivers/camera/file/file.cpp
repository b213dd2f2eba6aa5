// SPDX-License-Identifier: Apache-2.0
// A picture file in place of a camera, read again whenever it changes: a tethered still camera
// that writes into a folder is one.
#include <filesystem>

#include "controller/core/picture_file.h"
#include "drivers/registry.h"

namespace chiaro::drivers::file {
namespace {

namespace fs = std::filesystem;

class FileCamera final : public ports::Camera {
 public:
  FileCamera(const CameraSettings& settings, ports::Clock& clock)
      : path_(settings.source.substr(settings.source.find(':') + 1)), clock_(clock) {}

  core::Result<ports::CameraFrame> grab(ports::Duration) override {
    std::error_code code;
    const auto written = fs::last_write_time(path_, code);
    if (code) return core::Problem{{path_.string(), 0, 0}, "there is no picture", "check the path"};
    if (written != written_ || frame_.picture.empty()) {
      auto picture = core::read_picture(path_);
      if (!picture) return picture.problems();
      frame_ = {std::move(*picture), clock_.now()};
      written_ = written;
    }
    return frame_;
  }

 private:
  const fs::path path_;
  ports::Clock& clock_;
  fs::file_time_type written_;
  ports::CameraFrame frame_;
};

}  // namespace

std::unique_ptr<ports::Camera> make(const CameraSettings&, ports::Clock&);
std::unique_ptr<ports::Camera> make(const CameraSettings& settings, ports::Clock& clock) {
  return std::make_unique<FileCamera>(settings, clock);
}

}  // namespace chiaro::drivers::file
