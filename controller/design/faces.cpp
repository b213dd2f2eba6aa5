// SPDX-License-Identifier: Apache-2.0
#include "controller/design/faces.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <opencv2/objdetect.hpp>

#include "controller/measure/measure.h"

namespace chiaro::design {
namespace {

constexpr const char* kFolder = "/usr/share/opencv4/haarcascades/haarcascade_";
// Faces are looked for in a picture whose shorter side has this many pixels, from the smallest
// share of it on that still tells light from dark.
constexpr int kShorter = 320;
constexpr double kSmallest = 0.08;
constexpr int kLongest = 3;  // times the shorter side
constexpr double kStep = 1.1;
constexpr int kNeighbours = 4;
// Boxes that share this much are one face; a find on an evened picture is worth a little less.
constexpr double kSameFace = 0.3, kEvened = 0.8;
// A profile's box is wider than the face in it, and lies behind it.
constexpr double kProfileSide = 0.85;

struct Find {
  cv::Rect2d box;
  double weight = 0;
};

cv::Mat working(const core::Plane& grey, double& scale) {
  const int shorter = std::min(grey.size.width, grey.size.height);
  scale = static_cast<double>(kShorter) / shorter;
  const core::Size size{std::max(1, static_cast<int>(std::lround(grey.size.width * scale))),
                        std::max(1, static_cast<int>(std::lround(grey.size.height * scale)))};
  // L* and sRGB's curve are near enough the same for a cascade.
  const core::Plane values = measure::working_scalar(core::resized(grey, size));
  cv::Mat picture(size.height, size.width, CV_8U);
  for (int y = 0; y < size.height; ++y)
    for (int x = 0; x < size.width; ++x)
      picture.at<std::uint8_t>(y, x) =
          static_cast<std::uint8_t>(std::clamp(values.at(x, y), 0.0f, 255.0f));
  return picture;
}

/// Dark halves lifted: contrast made even over tiles.
cv::Mat evened(const cv::Mat& picture) {
  cv::Mat out;
  cv::createCLAHE(4.0, {6, 6})->apply(picture, out);
  return out;
}

/// The other half of a half-dark face: the brighter of each pixel and its mirror image is no face,
/// but a gentle curve that lifts shadows is.
cv::Mat lifted(const cv::Mat& picture) {
  cv::Mat curve(1, 256, CV_8U), out;
  for (int i = 0; i < 256; ++i)
    curve.at<std::uint8_t>(i) =
        static_cast<std::uint8_t>(std::lround(255 * std::pow(i / 255.0, 0.45)));
  cv::LUT(picture, curve, out);
  return out;
}

double overlap(const cv::Rect2d& a, const cv::Rect2d& b) {
  const double both = (a & b).area();
  return both / std::max(1e-9, std::min(a.area(), b.area()));
}

void merge(std::vector<Find>& finds, const Find& find) {
  for (Find& known : finds) {
    if (overlap(known.box, find.box) < kSameFace) continue;
    const double sum = known.weight + find.weight, share = find.weight / sum;
    const auto mixed = [&](double a, double b) { return (1 - share) * a + share * b; };
    known.box = {mixed(known.box.x, find.box.x), mixed(known.box.y, find.box.y),
                 mixed(known.box.width, find.box.width), mixed(known.box.height, find.box.height)};
    known.weight = sum;
    return;
  }
  finds.push_back(find);
}

void look(cv::CascadeClassifier& cascade, const cv::Mat& picture, double worth,
          std::vector<Find>& finds) {
  std::vector<cv::Rect> boxes;
  std::vector<int> levels;
  std::vector<double> weights;
  const int least = static_cast<int>(kSmallest * std::min(picture.rows, picture.cols));
  cascade.detectMultiScale(picture, boxes, levels, weights, kStep, kNeighbours, 0, {least, least},
                           {}, true);
  for (std::size_t i = 0; i < boxes.size(); ++i)
    merge(finds, {cv::Rect2d(boxes[i]), worth * std::max(0.1, weights[i])});
}

bool open(cv::CascadeClassifier& cascade, const std::string& name) {
  try {
    return cascade.load(kFolder + name + ".xml");
  } catch (const cv::Exception&) {
    return false;
  }
}

std::vector<Find> frontal(const std::vector<cv::Mat>& pictures, bool& opened) {
  std::vector<Find> finds;
  for (const char* name : {"frontalface_alt2", "frontalface_default"}) {
    cv::CascadeClassifier cascade;
    if (!open(cascade, name)) continue;
    opened = true;
    for (std::size_t i = 0; i < pictures.size(); ++i)
      look(cascade, pictures[i], i == 0 ? 1 : kEvened, finds);
  }
  return finds;
}

/// The cascade knows one side of a face: the other is found in the mirror.
std::vector<Find> sideways(const std::vector<cv::Mat>& pictures) {
  std::vector<Find> finds;
  cv::CascadeClassifier cascade;
  if (!open(cascade, "profileface")) return finds;
  for (const cv::Mat& picture : pictures) {
    look(cascade, picture, 1, finds);
    cv::Mat mirrored;
    cv::flip(picture, mirrored, 1);
    std::vector<Find> others;
    look(cascade, mirrored, 1, others);
    for (Find& find : others) {
      find.box.x = picture.cols - find.box.x - find.box.width;
      merge(finds, find);
    }
  }
  for (Find& find : finds) {
    const double side = kProfileSide * find.box.width, dx = (find.box.width - side) / 2;
    find.box = {find.box.x + dx, find.box.y + dx, side, side};
  }
  return finds;
}

/// The middle of a picture that is longer than kLongest: beyond it stands no portrait, and a strip
/// brought to kShorter would be as large as its maker likes.
core::Plane middle_of(const core::Plane& grey) {
  const int shorter = std::min(grey.size.width, grey.size.height);
  const core::Size size{std::min(grey.size.width, kLongest * shorter),
                        std::min(grey.size.height, kLongest * shorter)};
  if (size == grey.size) return grey;
  const int left = (grey.size.width - size.width) / 2, top = (grey.size.height - size.height) / 2;
  core::Plane middle(size);
  for (int y = 0; y < size.height; ++y)
    std::copy_n(grey.row(y + top) + left, size.width, middle.row(y));
  return middle;
}

}  // namespace

Faces faces_in(const core::Plane& whole) {
  Faces faces;
  if (whole.empty() || std::min(whole.size.width, whole.size.height) < 16) return faces;
  const core::Plane grey = middle_of(whole);
  double scale = 1;
  const cv::Mat picture = working(grey, scale);
  const std::vector<cv::Mat> pictures{picture, evened(picture), lifted(picture)};
  bool opened = false;
  std::vector<Find> finds = frontal(pictures, opened);
  faces.no_cascades = !opened;
  if (finds.empty() && opened) {
    finds = sideways(pictures);
    faces.profile = !finds.empty();
  }
  std::stable_sort(finds.begin(), finds.end(),
                   [](const Find& a, const Find& b) { return a.weight > b.weight; });
  const double left = (picture.cols - kShorter) / 2.0, top = (picture.rows - kShorter) / 2.0;
  for (const Find& find : finds) {
    const double side = std::sqrt(find.box.area());
    faces.boxes.push_back({(find.box.x + find.box.width / 2 - left) / kShorter,
                           (find.box.y + find.box.height / 2 - top) / kShorter, side / kShorter});
    faces.certainty.push_back(find.weight);
  }
  return faces;
}

}  // namespace chiaro::design
