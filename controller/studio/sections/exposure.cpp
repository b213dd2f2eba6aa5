// SPDX-License-Identifier: Apache-2.0
// exposure: - how much light makes a mid grey, and which white is white.
#include "controller/studio/reading/scalars.h"
#include "controller/studio/sections/sections.h"

namespace chiaro::studio::sections {

using namespace reading;

void read_exposure(Section& top, Context& context, Studio& studio) {
  const Tree* tree = top.find("exposure");
  if (tree == nullptr) return;
  Section section(*tree, "exposure", context.report);
  if (const auto lux =
          quantity(section.find("grey_card"), Measure::illuminance, {0.1, 1e6}, context.report))
    studio.exposure.grey_card = {*lux};
  if (const auto kelvin = quantity(section.find("white_balance"), Measure::temperature,
                                   {1500, 20000}, context.report))
    studio.exposure.white_balance = {*kelvin};
  section.refuse_unknown();
}

}  // namespace chiaro::studio::sections
