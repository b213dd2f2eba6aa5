// SPDX-License-Identifier: Apache-2.0
// What people ask for at control surfaces that the hand cannot do alone: looks, moods, nudges. The
// hand counts the presses; what has been counted since the last report is carried out as if it had
// come from the panel.
#include <algorithm>
#include <fmt/format.h>
#include <string>
#include <utility>
#include <vector>

#include "controller/daemon/brain/brain.h"
#include "controller/panel/gestures.h"

namespace chiaro::daemon {

void Brain::hear_surfaces() {
  if (!sent_ || sent_->studio_fingerprint != studio_.fingerprint) return;
  // A hand that has started anew counts anew, and what was pressed before we came is past.
  if (asks_id_ != sent_->asks_id || asked_.size() != sent_->asks.size()) {
    asks_id_ = sent_->asks_id;
    asked_ = sent_->asks;
    asks_ = studio::asked_of_brain(studio_);
    return;
  }
  const std::vector<double> before = std::exchange(asked_, sent_->asks);
  for (std::size_t i = 0; i < before.size() && i < asks_.size(); ++i)
    if (const double times = asked_[i] - before[i]; times != 0) obey_surface(asks_[i], times);
}

void Brain::obey_surface(const studio::Deed& deed, double times) {
  using Kind = studio::Deed::Kind;
  panel::Request request;
  request.method = "POST";
  std::vector<std::string> words;
  if (deed.kind == Kind::look) {
    std::int64_t id = 0;
    for (const auto& look : looks())
      if (look.name == deed.name) id = std::max(id, look.id);
    words = {"looks", std::to_string(id), "apply"};
    request.body = "{}";
  } else if (deed.kind == Kind::mood) {
    words = {"design"};
    request.body = fmt::format(R"({{"mood": "{}", "apply": 1.5}})", deed.name);
  } else {
    words = {"nudge"};
    const double stops = std::clamp(deed.amount * times, -2.0, 2.0);
    request.body = fmt::format(R"({{"{}": {}}})", deed.name, stops);
  }
  const auto refused = [this, words = in_words(deed)](const panel::Refusal& refusal) {
    notes_.push_back("a surface asked for " + words + ": " + refusal.what);
    changed();
  };
  const auto gesture = panel::gesture_of(request, words, state_);
  if (const auto* refusal = std::get_if<panel::Refusal>(&gesture)) return refused(*refusal);
  perform(std::get<panel::Gesture>(gesture), [refused](const panel::Outcome& outcome) {
    if (outcome.refused) refused(*outcome.refused);
  });
}

}  // namespace chiaro::daemon
