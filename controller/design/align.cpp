// SPDX-License-Identifier: Apache-2.0
#include "controller/design/align.h"

#include <algorithm>
#include <cmath>

#include "controller/design/foreground.h"
#include "controller/design/words.h"

namespace chiaro::design {
namespace {

// The shipped sitter's face as its outline tells, measured on the shipped studio's camera; and how
// far a view may differ from that for the moods' pixels to lie on ours.
constexpr FaceBox kDrawn{0.5, 0.484, 0.39};
constexpr double kSamePlace = 0.025, kSameSize = 0.05;
// Exemplars are looked at in this size; their faces need no more.
constexpr core::Size kLooked{384, 384};
constexpr double kCertainEnough = 0.5;  // of the best face, to count as another one

float bilinear(const core::Plane& plane, double x, double y) {
  const auto cell = [](double at, int n) {
    const double inside = std::clamp(at - 0.5, 0.0, n - 1.0);
    const int low = std::min(static_cast<int>(inside), std::max(0, n - 2));
    return std::pair{low, inside - low};
  };
  const auto [x0, fx] = cell(x, plane.size.width);
  const auto [y0, fy] = cell(y, plane.size.height);
  const int x1 = std::min(x0 + 1, plane.size.width - 1),
            y1 = std::min(y0 + 1, plane.size.height - 1);
  const double top = (1 - fx) * plane.at(x0, y0) + fx * plane.at(x1, y0);
  const double bottom = (1 - fx) * plane.at(x0, y1) + fx * plane.at(x1, y1);
  return static_cast<float>((1 - fy) * top + fy * bottom);
}

core::Plane sampled(const core::Plane& plane, const Window& window, core::Size size) {
  const double side = std::min(plane.size.width, plane.size.height);
  const double left = (plane.size.width - side) / 2, top = (plane.size.height - side) / 2;
  core::Plane out(size);
  for (int y = 0; y < size.height; ++y)
    for (int x = 0; x < size.width; ++x) {
      double across = (x + 0.5) / size.width - 0.5;
      if (window.mirrored) across = -across;
      const double down = (y + 0.5) / size.height - 0.5;
      out.at(x, y) = bilinear(plane, left + side * (window.x + window.side * across),
                              top + side * (window.y + window.side * down));
    }
  return out;
}

/// Shrunk to about twice the size at which it will be sampled: bilinear steps then skip nothing.
core::Picture shrunk(const core::Picture& picture, core::Size wanted) {
  const int shorter = std::min(picture.size().width, picture.size().height);
  const double factor = 2.0 * wanted.height / shorter;
  if (factor >= 1) return picture;
  return core::resized(
      picture, {std::max(1, static_cast<int>(std::lround(picture.size().width * factor))),
                std::max(1, static_cast<int>(std::lround(picture.size().height * factor)))});
}

/// Our subject as a lamp on the camera would show it: the shape alone.
core::Plane lit_from_the_camera(const studio::Studio& studio, const core::GeometryPlanes& planes) {
  const studio::Camera& camera = studio.main_camera();
  const core::Vec3 towards = core::unit(camera.at - camera.look_at);
  core::Plane light(planes.subject.size, 0.02f);
  for (std::size_t i = 0; i < light.values.size(); ++i) {
    if (!planes.subject.values[i]) continue;
    const core::Vec3 normal{planes.normal_x.values[i], planes.normal_y.values[i],
                            planes.normal_z.values[i]};
    light.values[i] = static_cast<float>(0.45 * std::max(0.0, core::dot(normal, towards)));
  }
  return light;
}

core::Plane subject_mask(const core::GeometryPlanes& planes) {
  core::Plane mask(planes.subject.size);
  for (std::size_t i = 0; i < mask.values.size(); ++i)
    mask.values[i] = planes.subject.values[i] ? 1.0f : 0.0f;
  return mask;
}

/// The shipped bust has a bare head: its outline tells to a pixel where the cascade boxes its face.
FaceBox face_of_bust(const FaceBox& head) {
  return {head.x, head.y + 0.01 * head.side, 1.05 * head.side};
}

bool is_the_bust(const studio::Studio& studio) {
  const studio::Subject& subject = studio.subjects.front();
  return subject.stand_in || subject.mesh.filename() == "bust.ply";
}

core::Picture central_square(const core::Picture& picture, core::Size size) {
  return seen_through(picture, Window{}, size);
}

std::string how_many(std::size_t faces) {
  return std::to_string(faces) +
         " faces were found in the reference picture: the largest clear one "
         "is followed";
}

/// The largest of those that are about as certain as the best.
std::size_t chosen(const Faces& faces) {
  std::size_t best = 0;
  for (std::size_t i = 1; i < faces.boxes.size(); ++i)
    if (faces.certainty[i] > kCertainEnough * faces.certainty[0] &&
        faces.boxes[i].side > faces.boxes[best].side)
      best = i;
  return best;
}

void find_by_face(const Faces& faces, Alignment& alignment) {
  if (faces.boxes.empty()) return;
  const std::size_t best = chosen(faces);
  std::size_t clear = 0;
  for (const double certainty : faces.certainty)
    clear += certainty > kCertainEnough * faces.certainty[0] ? 1 : 0;
  alignment.by = Alignment::By::face;
  alignment.theirs = faces.boxes[best];
  if (clear > 1) alignment.words.push_back(how_many(clear));
  if (faces.profile)
    alignment.words.push_back(
        "the face in the reference picture is seen from the side: placed only roughly");
}

void find_by_outline(Alignment& alignment) {
  const auto head = head_in_outline(alignment.foreground);
  if (!head) {
    alignment.words.push_back(
        "no face was found in the reference picture and nothing stands out from its background: "
        "compared as it is framed");
    return;
  }
  alignment.by = Alignment::By::outline;
  alignment.theirs = *head;
  alignment.words.push_back(
      "no face was found in the reference picture: laid on the subject by its outline");
}

}  // namespace

core::Plane seen_through(const core::Plane& plane, const Window& window, core::Size size) {
  return sampled(plane, window, size);
}

core::Picture seen_through(const core::Picture& exemplar, const Window& window, core::Size size) {
  const core::Picture source = shrunk(exemplar, size);
  core::Picture out;
  out.red = sampled(source.red, window, size);
  out.green = sampled(source.green, window, size);
  out.blue = sampled(source.blue, window, size);
  return out;
}

Window window_for(const FaceBox& ours, const FaceBox& theirs) {
  const double side = theirs.side / ours.side;
  return {theirs.x - side * (ours.x - 0.5), theirs.y - side * (ours.y - 0.5), side, false};
}

std::optional<OurFace> our_face(const studio::Studio& studio, const core::GeometryPlanes& planes) {
  if (studio.subjects.empty()) return std::nullopt;
  const auto head = head_in_outline(subject_mask(planes));
  OurFace face;
  face.turn = studio.subjects.front().facing;
  face.of_the_bust = is_the_bust(studio);
  if (face.of_the_bust && head) {
    face.box = face_of_bust(*head);
    return face;
  }
  const Faces found = faces_in(lit_from_the_camera(studio, planes));
  if (!found.boxes.empty()) {
    face.box = found.boxes.front();
    return face;
  }
  if (!head) return std::nullopt;
  face.box = *head;
  return face;
}

FaceBox face_of_drawn_moods() { return kDrawn; }

Alignment aligned(const ExampleGoal& goal, const OurFace& ours) {
  Alignment alignment;
  if (goal.drawn_here) {
    alignment.theirs = kDrawn;
    const bool same = std::abs(ours.box.x - kDrawn.x) < kSamePlace &&
                      std::abs(ours.box.y - kDrawn.y) < kSamePlace &&
                      std::abs(ours.box.side / kDrawn.side - 1) < kSameSize;
    alignment.by = ours.of_the_bust && same ? Alignment::By::own_framing : Alignment::By::face;
    if (alignment.by == Alignment::By::own_framing) return alignment;
  } else {
    const Faces faces = faces_in(core::luminance(shrunk(goal.exemplar, kLooked)));
    if (faces.no_cascades) alignment.words.push_back(kNoCascades);
    find_by_face(faces, alignment);
  }
  const bool face = alignment.by == Alignment::By::face;
  alignment.foreground =
      foreground_of(central_square(goal.exemplar, kLooked),
                    face ? std::optional<FaceBox>(alignment.theirs) : std::nullopt);
  if (!face) find_by_outline(alignment);
  if (alignment.by != Alignment::By::nothing)
    alignment.window = window_for(ours.box, alignment.theirs);
  return alignment;
}

}  // namespace chiaro::design
