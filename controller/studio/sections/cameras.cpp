// SPDX-License-Identifier: Apache-2.0
// cameras: - by name; the one called main, else the first, is the main camera.
#include <algorithm>

#include "controller/studio/reading/scalars.h"
#include "controller/studio/reading/text.h"
#include "controller/studio/sections/sections.h"

namespace chiaro::studio::sections {

using namespace reading;

namespace {

/// f-numbers are written 2.8 or f/2.8.
std::optional<double> aperture(const Tree* tree, Report& report) {
  if (tree == nullptr) return std::nullopt;
  Tree plain = *tree;
  if (plain.text.rfind("f/", 0) == 0) plain.text = plain.text.substr(2);
  return number(&plain, {0.5, 128}, report);
}

void read_settings(Section& section, Camera& camera, Context& context) {
  Report& report = context.report;
  const Tree* shutter = section.find("shutter");
  const Tree* f_number = section.find("aperture");
  const Tree* iso = section.find("iso");
  const int given = (shutter != nullptr) + (f_number != nullptr) + (iso != nullptr);
  if (given != 0 && given != 3)
    report.error(section.tree(), "shutter, aperture and iso belong together",
                 "give all three, or none and use exposure: {grey_card: 800 lx}");
  into(camera.shutter_s, quantity(shutter, Measure::duration, {1e-5, 60}, report));
  into(camera.aperture_f, aperture(f_number, report));
  into(camera.iso, number(iso, {1, 1e7}, report));
}

void read_source(const Tree* tree, Camera& camera, Context& context) {
  Report& report = context.report;
  const auto kind = variant(tree, "a kind of source", {"http", "file", "v4l2"}, report);
  if (!kind) return;
  if (kind->body == nullptr) {
    report.error(*tree, "the source lacks its address", "source: {http: \"http://host/picture\"}");
    return;
  }
  const auto address = text(kind->body, report);
  if (!address) return;
  if (kind->index == 0) {
    camera.source = *address;
    if (address->rfind("http://", 0) != 0 || address->size() < 8)
      report.error(*kind->body, in_quotes(*address) + " is not an http:// address",
                   "for example http://192.168.0.20/picture");
  } else if (kind->index == 1) {
    camera.source = "file:" + existing_file(kind->body, "picture", context).string();
  } else {
    camera.source = "v4l2:" + *address;
    if (address->rfind("/dev/", 0) != 0)
      report.error(*kind->body, in_quotes(*address) + " is not a device",
                   "for example /dev/video0");
  }
}

void read_size(const Tree* tree, Camera& camera, Report& report) {
  if (tree == nullptr) return;
  if (tree->kind != Tree::Kind::sequence || tree->items.size() != 2) {
    report.error(*tree, "'size' needs [width, height] in pixels", "for example [640, 480]");
    return;
  }
  const auto width = whole(tree->items.data(), 16, 8192, report);
  const auto height = whole(&tree->items[1], 16, 8192, report);
  if (width && height) camera.size = {static_cast<int>(*width), static_cast<int>(*height)};
}

Camera read_camera(const Tree::Key& key, const Tree& tree, Context& context) {
  Report& report = context.report;
  Section section(tree, "a camera", report);
  Camera camera;
  camera.name = key.text;
  camera.place = report.place(key);
  const auto at = point(section.need("at", "[0, -2.6, 1.45]"), report);
  const auto look_at = point(section.need("look_at", "[0, 0, 1.35]"), report);
  into(camera.at, at);
  into(camera.look_at, look_at);
  if (at && look_at && core::distance(*at, *look_at) < 1e-3)
    report.error(key, "the camera looks at the point where it stands",
                 "move 'look_at' to the subject");
  into(camera.vertical_fov, quantity(section.need("vertical_fov", "22 deg"), Measure::angle,
                                     {core::radians(0.5), core::radians(170)}, report));
  read_size(section.find("size"), camera, report);
  read_settings(section, camera, context);
  into(camera.lamps_may_show, yes_or_no(section.find("lamps_may_show"), report));
  read_source(section.find("source"), camera, context);
  section.refuse_unknown();
  return camera;
}

}  // namespace

void read_cameras(Section& top, Context& context, Studio& studio) {
  const Tree* tree = top.need(
      "cameras", "{main: {at: [0, -2.6, 1.45], look_at: [0, 0, 1.35], vertical_fov: 22 deg}}");
  if (tree == nullptr) return;
  if (tree->kind != Tree::Kind::mapping || tree->keys.empty()) {
    context.report.error(*tree, "'cameras' needs at least one camera by name",
                         "main: {at: […], look_at: […], vertical_fov: 22 deg}");
    return;
  }
  for (std::size_t i = 0; i < tree->keys.size(); ++i) {
    check_name(tree->keys[i], context);
    studio.cameras.push_back(read_camera(tree->keys[i], tree->items[i], context));
  }
  std::stable_partition(studio.cameras.begin(), studio.cameras.end(),
                        [](const Camera& camera) { return camera.name == "main"; });
}

}  // namespace chiaro::studio::sections
