// SPDX-License-Identifier: Apache-2.0
// background: - planes behind and below the subject; ceiling: - what no lamp may pass.
#include "controller/studio/reading/scalars.h"
#include "controller/studio/reading/text.h"
#include "controller/studio/sections/sections.h"

namespace chiaro::studio::sections {

using namespace reading;

namespace {

BackgroundPlane read_plane(const Tree& tree, Context& context) {
  Report& report = context.report;
  Section section(tree, "a background plane", report);
  BackgroundPlane plane;
  plane.place = report.place(tree);
  into(plane.name, text(section.need("plane", "wall"), report));
  into(plane.through, point(section.need("through", "[0, 2.0, 0]"), report));
  into(plane.normal, direction(section.need("normal", "[0, -1, 0]"), report));
  const auto size =
      numbers(section.find("size"), 2, {0.01, kFar}, "[width, height] in metres", report);
  if (size) {
    plane.width = (*size)[0];
    plane.height = (*size)[1];
  }
  plane.material = read_material(section, {{0.35, 0.35, 0.35}, 0, 16}, context);
  section.refuse_unknown();
  return plane;
}

}  // namespace

void read_background(Section& top, Context& context, Studio& studio) {
  if (const auto height =
          quantity(top.find("ceiling"), Measure::length, {0.5, 100}, context.report))
    studio.ceiling = *height;
  const Tree* tree = top.find("background");
  if (tree == nullptr) return;
  if (tree->kind != Tree::Kind::sequence) {
    context.report.error(*tree, "'background' needs a list of planes",
                         "- {plane: wall, through: [0, 2, 0], normal: [0, -1, 0]}");
    return;
  }
  for (const Tree& item : tree->items) {
    BackgroundPlane plane = read_plane(item, context);
    for (const BackgroundPlane& other : studio.background)
      if (!plane.name.empty() && other.name == plane.name)
        context.report.error(item, "two background planes are called " + in_quotes(plane.name),
                             "give one of them another name");
    studio.background.push_back(std::move(plane));
  }
}

}  // namespace chiaro::studio::sections
