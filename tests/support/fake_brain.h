// SPDX-License-Identifier: Apache-2.0
// A brain that remembers what it was asked and answers at once, over a small studio of three lamps.
#pragma once

#include <vector>

#include "controller/panel/api.h"

namespace chiaro::support {

class FakeBrain final : public panel::Brain {
 public:
  FakeBrain();
  const panel::State& state() const override { return state_; }
  const panel::Counters& counters() const override { return counters_; }
  std::vector<panel::LookEntry> looks() const override;
  std::variant<panel::PictureFile, panel::Refusal> picture(const panel::PictureOf& which) override;
  void perform(const panel::Gesture& gesture, panel::Answer answer) override;

  panel::State state_;
  panel::Counters counters_;
  std::vector<panel::Gesture> gestures;
  panel::Outcome outcome;
  bool answers = true;  ///< false: keeps the answer in `waiting`
  std::vector<panel::Answer> waiting;
};

/// The bytes of a small PNG.
std::string small_png();
std::string base64(const std::string& bytes);

}  // namespace chiaro::support
