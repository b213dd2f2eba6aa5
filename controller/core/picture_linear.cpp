// SPDX-License-Identifier: Apache-2.0
#include <opencv2/imgcodecs.hpp>

#include "controller/core/picture_file.h"

namespace chiaro::core {
namespace {

Result<Picture> read_radiance(const std::filesystem::path& file) {
  const cv::Mat read = cv::imread(file.string(), cv::IMREAD_UNCHANGED);
  if (read.empty() || read.type() != CV_32FC3)
    return Problem{{file.string()},
                   "this is not a Radiance picture that can be read",
                   "export it as .hdr or OpenEXR"};
  Picture out({read.cols, read.rows});
  for (int y = 0; y < read.rows; ++y)
    for (int x = 0; x < read.cols; ++x) {
      const auto& c = read.at<cv::Vec3f>(y, x);
      out.set(x, y, {double{c[2]}, double{c[1]}, double{c[0]}});
    }
  return out;
}

}  // namespace

Result<Picture> read_linear(const std::filesystem::path& file) {
  if (file.extension() == ".exr") return read_exr(file);
  if (file.extension() == ".hdr") return read_radiance(file);
  const auto picture = read_picture(file);
  if (!picture) return picture.problems();
  return linear(*picture);
}

}  // namespace chiaro::core
