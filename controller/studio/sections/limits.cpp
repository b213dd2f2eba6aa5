// SPDX-License-Identifier: Apache-2.0
// limits: {most: 80 %, dark_to_full: 2 s, safe_level: 10 %, house_light: yes, end_to_end: 10 s}
#include "controller/studio/reading/scalars.h"
#include "controller/studio/sections/sections.h"

namespace chiaro::studio::sections {

using namespace reading;

Limits read_limits(const Tree* tree, Context& context) {
  Limits limits;
  if (tree == nullptr) return limits;
  Report& report = context.report;
  Section section(*tree, "limits", report);
  into(limits.most, fraction(section.find("most"), report));
  // People think in the time a fade takes; the hand limits the rate.
  if (const auto s =
          quantity(section.find("dark_to_full"), Measure::duration, {0.001, 600}, report))
    limits.slew_per_s = 1 / *s;
  into(limits.end_to_end_s,
       quantity(section.find("end_to_end"), Measure::duration, {0.5, 600}, report));
  const Tree* safe = section.find("safe_level");
  into(limits.safe_level, fraction(safe, report));
  into(limits.ignores_blackout, yes_or_no(section.find("house_light"), report));
  if (limits.safe_level > limits.most)
    report.error(*safe, "the safe level lies above the most this lamp may give",
                 "lower safe_level or raise most");
  section.refuse_unknown();
  return limits;
}

}  // namespace chiaro::studio::sections
