// SPDX-License-Identifier: Apache-2.0
#include "controller/design/foreground.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <vector>

namespace chiaro::design {
namespace {

constexpr int kSide = 96;                      // outlines need no more
constexpr int kRounds = 3;                     // of GrabCut
constexpr int kBorder = 3;                     // pixels of it count as background to begin with
constexpr double kFar = 18;                    // in Lab, from every colour of the border
constexpr double kLeast = 0.02, kMost = 0.92;  // shares of the picture that a subject may fill

cv::Mat encoded_bgr(const core::Picture& picture) {
  const core::EncodedPicture small = core::encoded(core::resized(picture, {kSide, kSide}));
  cv::Mat out(kSide, kSide, CV_8UC3);
  for (int y = 0; y < kSide; ++y)
    for (int x = 0; x < kSide; ++x) {
      const auto& c = small.at(x, y);
      out.at<cv::Vec3b>(y, x) = {c[2], c[1], c[0]};
    }
  return out;
}

/// Head and shoulders about a face: surely, and probably.
void mark_person(cv::Mat& mask, const FaceBox& face) {
  const auto at = [](double v) { return static_cast<int>(std::lround(v * kSide)); };
  const cv::Point middle(at(face.x), at(face.y));
  const double s = face.side;
  const cv::Point chin(at(face.x), at(face.y + 0.75 * s));
  cv::rectangle(mask, {at(face.x - 1.35 * s), chin.y}, {at(face.x + 1.35 * s), kSide},
                cv::Scalar(cv::GC_PR_FGD), cv::FILLED);
  cv::ellipse(mask, {middle.x, at(face.y - 0.08 * s)}, {at(0.68 * s), at(0.88 * s)}, 0, 0, 360,
              cv::Scalar(cv::GC_PR_FGD), cv::FILLED);
  cv::ellipse(mask, middle, {at(0.38 * s), at(0.5 * s)}, 0, 0, 360, cv::Scalar(cv::GC_FGD),
              cv::FILLED);
  cv::rectangle(mask, {at(face.x - 0.6 * s), at(face.y + 1.3 * s)}, {at(face.x + 0.6 * s), kSide},
                cv::Scalar(cv::GC_FGD), cv::FILLED);
}

/// Pixels unlike every colour along the left, right and upper border.
void mark_unlike_border(const cv::Mat& bgr, cv::Mat& mask) {
  cv::Mat lab;
  cv::cvtColor(bgr, lab, cv::COLOR_BGR2Lab);
  std::vector<cv::Vec3b> border;
  for (int i = 0; i < kSide; i += 2) {
    border.push_back(lab.at<cv::Vec3b>(0, i));
    border.push_back(lab.at<cv::Vec3b>(i, 0));
    border.push_back(lab.at<cv::Vec3b>(i, kSide - 1));
  }
  for (int y = 0; y < kSide; ++y)
    for (int x = 0; x < kSide; ++x) {
      const cv::Vec3b c = lab.at<cv::Vec3b>(y, x);
      double nearest = 1e9;
      for (const cv::Vec3b& b : border) {
        const double dl = 0.5 * (c[0] - b[0]), da = c[1] - b[1], db = c[2] - b[2];
        nearest = std::min(nearest, dl * dl + da * da + db * db);
      }
      if (nearest > kFar * kFar / 4) mask.at<std::uint8_t>(y, x) = cv::GC_PR_FGD;
    }
}

double share_of(const core::Plane& plane) {
  double sum = 0;
  for (const float v : plane.values) sum += double{v};
  return sum / static_cast<double>(plane.values.size());
}

core::Plane plane_of(const cv::Mat& mask) {
  core::Plane plane(core::Size{kSide, kSide});
  for (int y = 0; y < kSide; ++y)
    for (int x = 0; x < kSide; ++x)
      plane.at(x, y) = (mask.at<std::uint8_t>(y, x) & 1) ? 1.0f : 0.0f;
  return plane;
}

}  // namespace

core::Plane foreground_of(const core::Picture& central_square, const std::optional<FaceBox>& face) {
  const cv::Mat bgr = encoded_bgr(central_square);
  cv::Mat mask(kSide, kSide, CV_8U, cv::Scalar(cv::GC_PR_BGD));
  if (face)
    mark_person(mask, *face);
  else
    mark_unlike_border(bgr, mask);
  // The border beside and above is background unless the face reaches it.
  for (int i = 0; i < kSide; ++i)
    for (int k = 0; k < kBorder; ++k)
      for (const cv::Point at : {cv::Point(i, k), cv::Point(k, i), cv::Point(kSide - 1 - k, i)})
        if (at.y < kSide / 2 && mask.at<std::uint8_t>(at) == cv::GC_PR_BGD)
          mask.at<std::uint8_t>(at) = cv::GC_BGD;
  const cv::Mat probable = (mask == cv::GC_PR_FGD) | (mask == cv::GC_FGD);
  const int count = cv::countNonZero(probable);
  if (count < kLeast * kSide * kSide || count > kMost * kSide * kSide) return {};
  cv::setRNGSeed(1);  // GrabCut starts from k-means: the same picture, the same outline
  cv::Mat behind, before;
  try {
    cv::grabCut(bgr, mask, {}, behind, before, kRounds, cv::GC_INIT_WITH_MASK);
  } catch (const cv::Exception&) {
    return plane_of(probable & 1);  // one colour all over: nothing to cut along
  }
  core::Plane plane = plane_of(mask);
  const double share = share_of(plane);
  if (share < kLeast || share > kMost) return face ? plane_of(probable & 1) : core::Plane{};
  return plane;
}

std::optional<FaceBox> head_in_outline(const core::Plane& foreground) {
  if (foreground.empty()) return std::nullopt;
  const double share = share_of(foreground);
  if (share < kLeast || share > kMost) return std::nullopt;
  // The crown is the first row with a few pixels of subject; the head's width is the widest run in
  // the rows below it before the shoulders widen beyond 1.35 of it.
  const int side = foreground.size.width, height = foreground.size.height;
  const auto width_at = [&](int y, double& middle) {
    double count = 0, sum = 0;
    for (int x = 0; x < side; ++x)
      if (foreground.at(x, y) > 0.5f) count += 1, sum += x + 0.5;
    middle = count > 0 ? sum / count : 0;
    return count;
  };
  int crown = -1;
  double widest = 0, at = 0, middle = 0;
  for (int y = 0; y < height; ++y) {
    const double width = width_at(y, middle);
    if (crown < 0 && width >= 0.04 * side) crown = y;
    if (crown < 0) continue;
    const bool neck = width < 0.8 * widest && y - crown > 0.8 * widest;
    const bool shoulders = widest > 0 && y - crown > 1.1 * widest;
    if (neck || shoulders) break;
    if (width > widest) widest = width;
    if (y - crown < 0.6 * std::max(widest, 1.0)) at = middle;
  }
  if (crown < 0 || widest <= 0) return std::nullopt;
  // A head is about 1.3 times as high as it is wide, and a face's box 0.95 of its width.
  return FaceBox{at / side, (crown + 0.78 * widest) / height, 0.95 * widest / side};
}

}  // namespace chiaro::design
