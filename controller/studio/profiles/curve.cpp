// SPDX-License-Identifier: Apache-2.0
// curve: linear, square, s_curve, {gamma: 2.2} or {table: [0, 0.1, …, 1]}.
#include "controller/studio/profiles/profiles.h"
#include "controller/studio/reading/scalars.h"
#include "controller/studio/reading/section.h"

namespace chiaro::studio::profiles {

using namespace reading;

namespace {

void read_table(const Tree& body, DimmerCurve& curve, Report& report) {
  constexpr std::size_t kMost = 4096;
  if (body.kind != Tree::Kind::sequence || body.items.size() < 2 || body.items.size() > kMost) {
    report.error(body, "a table needs 2 to 4096 levels of light",
                 "from drive 0 to drive 1, evenly spaced: [0, 0.04, 0.2, 0.5, 1]");
    return;
  }
  const auto light = numbers(&body, body.items.size(), {0, 1}, "levels of light, 0 to 1", report);
  if (!light) return;
  for (std::size_t i = 1; i < light->size(); ++i)
    if ((*light)[i] < (*light)[i - 1]) {
      report.error(body.items[i], "the table falls here", "more drive must not give less light");
      return;
    }
  if (light->front() != 0 || light->back() != 1)
    report.error(body, "the table must run from 0 to 1", "divide each level by the last");
  curve.table = *light;
}

}  // namespace

DimmerCurve read_curve(const Tree* tree, Report& report) {
  using Law = DimmerCurve::Law;
  DimmerCurve curve;
  const std::vector<std::string> names{"linear", "square", "gamma", "s_curve", "table"};
  const auto kind = variant(tree, "a dimmer curve", names, report);
  if (!kind) return curve;
  curve.law = static_cast<Law>(kind->index);
  const bool has_settings = curve.law == Law::gamma || curve.law == Law::table;
  if (has_settings != (kind->body != nullptr)) {
    report.error(*tree,
                 has_settings ? "this curve needs its numbers" : "this curve has no settings",
                 has_settings ? "for example {gamma: 2.2} or {table: [0, 0.2, 1]}"
                              : "write just its name: curve: " + names[kind->index]);
  } else if (curve.law == Law::gamma) {
    into(curve.gamma, number(kind->body, {0.2, 5}, report));
  } else if (curve.law == Law::table) {
    read_table(*kind->body, curve, report);
  }
  return curve;
}

}  // namespace chiaro::studio::profiles
