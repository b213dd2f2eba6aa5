// SPDX-License-Identifier: Apache-2.0
#include "controller/daemon/study/study.h"

namespace chiaro::daemon::study {

std::span<const Study> studies() {
  static constexpr Study kStudies[] = {
#define STUDY(name, sentence) {#name, sentence, run_##name},
#include "controller/daemon/study/studies.def"
#undef STUDY
  };
  return kStudies;
}

Drawing drawing(std::string name, const core::Plot& plot) {
  return {std::move(name), core::to_svg(plot)};
}
Drawing drawing(std::string name, const core::Landscape& landscape) {
  return {std::move(name), core::to_svg(landscape)};
}

}  // namespace chiaro::daemon::study
