// SPDX-License-Identifier: Apache-2.0
// Gestures that end in a look being found: a mood, a picture, a nudge, work light.
#include <algorithm>
#include <fmt/format.h>

#include "controller/panel/made.h"

namespace chiaro::panel {
namespace {

void read_exemplar(Fields& fields, StartDesign& design) {
  const auto encoded = fields.text("exemplar");
  if (!encoded) return;
  const auto bytes = from_base64(*encoded);
  if (!bytes)
    return fields.fail(400, "'exemplar' is not base64", "exemplar",
                       "send the picture's bytes in base64");
  design.picture = *bytes;
  if (const auto refusal = not_a_picture(*bytes, "exemplar"))
    fields.fail(refusal->status, refusal->what, refusal->where, refusal->remedy);
}

void read_source(Fields& fields, const State& state, StartDesign& design) {
  design.ideal = fields.flag("ideal").value_or(false);
  if (const auto mood = fields.text("mood")) {
    design.mood = *mood;
    const auto known = std::find_if(state.moods.begin(), state.moods.end(),
                                    [&](const MoodView& m) { return m.name == *mood; });
    if (known == state.moods.end()) {
      const Refusal refusal = unknown_name("mood", *mood, mood_names(state));
      return fields.fail(refusal.status, refusal.what, "mood", refusal.remedy);
    }
    design.title = known->title;
  }
  read_exemplar(fields, design);
  const int given = !design.mood.empty() + !design.picture.empty() + design.ideal;
  if (given != 1)
    fields.fail(400, "exactly one of 'mood', 'exemplar' and 'ideal' is needed", "mood",
                "send {\"mood\": \"rembrandt\"}, a picture, or {\"ideal\": true}");
}

void read_goal(Fields& fields, StartDesign& design) {
  const std::string goal = fields.text("goal").value_or("wavelet");
  design.wavelet = goal == "wavelet";
  if (goal != "wavelet" && goal != "perceptual")
    fields.fail(422, "goal '" + goal + "' is not known", "goal", "send 'wavelet' or 'perceptual'");
}

void read_locks(Fields& fields, const State& state, StartDesign& design) {
  for (const std::string& name : fields.texts("lock")) {
    if (!state.fixture(name)) {
      const Refusal refusal = unknown_name("fixture", name, fixture_names(state));
      fields.fail(refusal.status, refusal.what, "lock", refusal.remedy);
    }
    design.lock.push_back(name);
  }
}

}  // namespace

Made start_design(const Request& request, const Words&, const State& state) {
  Fields fields(request.body);
  StartDesign design;
  read_source(fields, state, design);
  if (const auto title = fields.text("title")) design.title = *title;
  if (design.title.empty()) design.title = design.ideal ? "Shape shown best" : "Own picture";
  read_goal(fields, design);
  design.seed = fields.whole("seed").value_or(1);
  design.trials = std::min<std::uint64_t>(fields.whole("trials").value_or(0), 10'000'000);
  design.budget_s = fields.number("budget_s", {0.01, 600});
  design.move_stands = fields.flag("move_stands").value_or(true);
  design.apply_fade_s = fields.number("apply", kFade);
  read_locks(fields, state, design);
  return checked(fields, design);
}

Made cancel_design(const Request&, const Words& words, const State&) {
  const auto job = number_of(words[1]);
  if (!job) return no_such("job", words[1]);
  return Gesture(CancelDesign{*job});
}

Made nudge(const Request& request, const Words&, const State&) {
  constexpr core::Range kStops{-4, 4};
  Fields fields(request.body);
  Nudge gesture;
  gesture.by.brighter = fields.number("brighter", kStops).value_or(0);
  gesture.by.softer = fields.number("softer", kStops).value_or(0);
  gesture.by.warmer = fields.number("warmer", kStops).value_or(0);
  gesture.by.contrast = fields.number("contrast", kStops).value_or(0);
  gesture.fade_s = fields.number("fade_s", kFade).value_or(0.5);
  if (gesture.by == Nudges{})
    fields.fail(400, "there is nothing to nudge", "brighter",
                "send stops, such as {\"brighter\": 0.25}; also softer, warmer, contrast");
  return checked(fields, gesture);
}

Made work_light(const Request& request, const Words&, const State&) {
  Fields fields(request.body);
  return checked(fields, WorkLight{fields.number("fade_s", kFade).value_or(1.5)});
}

}  // namespace chiaro::panel
