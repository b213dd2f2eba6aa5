// SPDX-License-Identifier: Apache-2.0
// safety: - what the lamps do when nobody tells them anything, and when power returns.
#include "controller/studio/reading/scalars.h"
#include "controller/studio/sections/sections.h"

namespace chiaro::studio::sections {

using namespace reading;

namespace {

void read_silence(const Tree* tree, Safety& safety, Report& report) {
  const auto kind = variant(tree, "a way to go on", {"hold", "fade_to_safe"}, report);
  if (!kind) return;
  if (kind->index == 0) {
    if (kind->body != nullptr) report.error(*tree, "'hold' has no settings", "write just: hold");
    return;
  }
  if (kind->body == nullptr) {
    report.error(*tree, "'fade_to_safe' needs to know when",
                 "fade_to_safe: {after: 60 s, over: 5 s}");
    return;
  }
  Section fade(*kind->body, "fade_to_safe", report);
  into(safety.fade_to_safe_after_s,
       quantity(fade.need("after", "60 s"), Measure::duration, {0.5, 86400}, report));
  into(safety.fade_to_safe_s, quantity(fade.find("over"), Measure::duration, {0, 3600}, report));
  fade.refuse_unknown();
}

}  // namespace

void read_safety(Section& top, Context& context, Studio& studio) {
  const Tree* tree = top.find("safety");
  if (tree == nullptr) return;
  Section section(*tree, "safety", context.report);
  read_silence(section.find("when_silent"), studio.safety, context.report);
  using PowerUp = Safety::PowerUp;
  into(studio.safety.power_up,
       choice<PowerUp>(section.find("power_up"), {{"last", PowerUp::last}, {"dark", PowerUp::dark}},
                       context.report));
  section.refuse_unknown();
}

}  // namespace chiaro::studio::sections
