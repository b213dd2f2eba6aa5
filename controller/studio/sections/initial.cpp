// SPDX-License-Identifier: Apache-2.0
// initial: {intensity: 30 %, cct: 4300 K} - level and colour before anything has been said. Colour
// that the file leaves open starts at the camera's white balance, or as near as the lamp comes.
#include "controller/studio/reading/scalars.h"
#include "controller/studio/reading/text.h"
#include "controller/studio/sections/sections.h"

namespace chiaro::studio::sections {

using namespace reading;

core::FixtureState read_initial(const Tree* tree, const Fixture& fixture, Context& context) {
  core::FixtureState state = fixture.initial;
  if (tree == nullptr) return state;
  Report& report = context.report;
  Section section(*tree, "initial", report);
  for (const auto& [dof, range] : fixture.ranges()) {
    if (core::is_placement(dof)) continue;
    const Tree* value = section.find(core::info(dof).name);
    std::optional<double> number_read;
    if (dof == core::Dof::cct)
      number_read = quantity(value, Measure::temperature, range, report);
    else if (dof == core::Dof::tint)
      number_read = number(value, range, report);
    else
      number_read = fraction(value, report);
    if (number_read && !range.contains(*number_read))
      report.error(*value, in_quotes(value->label) + " lies above the most this lamp may give",
                   "lower it or raise limits: most");
    else if (number_read)
      state.set(dof, *number_read);
  }
  section.refuse_unknown();
  return state;
}

}  // namespace chiaro::studio::sections
