// SPDX-License-Identifier: Apache-2.0
// Another person's photograph made comparable with our studio: laid on our subject, mirrored where
// that fits better, and our subject given the skin that the exemplar's sitter seems to have, so
// that what is left to compare is light.
#pragma once

#include <map>
#include <mutex>

#include "controller/design/pattern.h"
#include "controller/design/search.h"

namespace chiaro::design {

struct Match {
  Goal goal;                      ///< as asked, or with its exemplar matched
  std::optional<core::Rgb> skin;  ///< what our subject wears while pictures are compared
  bool mirrored = false;
  std::vector<std::string> words;  ///< for people: what was followed and what could not be found
};

/// By options.align and options.normalise; both off gives the goal as it is.
Match matched(const studio::Studio& studio, const LayersSource& twin, const Goal& goal,
              const Options& options, const Variables& all, Watch& watch);

/// The twin's layers with a skin for the subject, where one is wanted and the twin can.
/// Thread-safe.
class Compared : public LayersSource {
 public:
  Compared(const LayersSource& twin, std::optional<core::Rgb> skin) : twin_(twin), skin_(skin) {}
  const Layers& at(core::Size size) const override;

 private:
  const LayersSource& twin_;
  const std::optional<core::Rgb> skin_;
  mutable std::mutex mutex_;
  mutable std::map<std::pair<int, int>, std::unique_ptr<Layers>> sizes_;
};

/// The diffuse reflectance (luminance) that the sitter of an exemplar seems to have: brightness of
/// skin in a picture is light times skin, and each is more likely usual than unusual. `lit`: the
/// luminance of the well lit part of the face, display-linear.
double likely_skin(double lit);

}  // namespace chiaro::design
