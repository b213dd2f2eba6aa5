// SPDX-License-Identifier: Apache-2.0
// keep_out: {desk: {at: [1, -2, 1], radius: 0.8 m}} - where people are: no motor brings a lamp
// there.
#include "controller/studio/reading/scalars.h"
#include "controller/studio/sections/sections.h"

namespace chiaro::studio::sections {

using namespace reading;

void read_keep_out(Section& top, Context& context, Studio& studio) {
  const Tree* tree = top.find("keep_out");
  if (tree == nullptr) return;
  Report& report = context.report;
  Section section(*tree, "keep_out", report);
  for (std::size_t i = 0; section.valid() && i < tree->keys.size(); ++i) {
    section.find(tree->keys[i].text);
    check_name(tree->keys[i], context);
    Section body(tree->items[i], "a place to keep out of", report);
    KeepOut zone{tree->keys[i].text, {}, 1, report.place(tree->keys[i])};
    into(zone.at, point(body.need("at", "[1, -2, 1]"), report));
    into(zone.radius, quantity(body.need("radius", "0.8 m"), Measure::length, {0.05, 20}, report));
    body.refuse_unknown();
    studio.keep_out.push_back(std::move(zone));
  }
}

}  // namespace chiaro::studio::sections
