// SPDX-License-Identifier: Apache-2.0
#include "controller/panel/gestures.h"

#include <algorithm>
#include <charconv>
#include <fmt/format.h>

#include "controller/core/picture_file.h"
#include "controller/panel/fields.h"

namespace chiaro::panel {
namespace {

using Made = std::variant<Gesture, Refusal>;
constexpr core::Range kFade{0, 600};

/// `gesture`, unless a field was wrong.
Made checked(Fields& fields, Gesture gesture) {
  if (auto fault = fields.fault()) return *fault;
  return gesture;
}

std::optional<std::uint64_t> number_of(const std::string& word) {
  std::uint64_t value = 0;
  const auto [end, code] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (code != std::errc() || end != word.data() + word.size() || word.empty()) return std::nullopt;
  return value;
}

Refusal no_such(const std::string& kind, const std::string& word) {
  return {404, fmt::format("there is no {} '{}'", kind, word), word,
          "ask for the list and take a number from it"};
}

/// Refuses bytes that are no picture before any job starts on them.
std::optional<Refusal> not_a_picture(const std::string& bytes, const std::string& where) {
  const std::span<const std::uint8_t> span(reinterpret_cast<const std::uint8_t*>(bytes.data()),
                                           bytes.size());
  const auto picture = core::decode_picture(span, "the picture");
  if (picture) return std::nullopt;
  const core::Problem& problem = picture.problems().front();
  return Refusal{422, problem.what, where, problem.remedy};
}

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

Made start_design(const Request& request, const State& state) {
  Fields fields(request.body);
  StartDesign design;
  read_source(fields, state, design);
  if (const auto title = fields.text("title")) design.title = *title;
  if (design.title.empty()) design.title = design.ideal ? "Shape shown best" : "Own picture";
  const std::string goal = fields.text("goal").value_or("wavelet");
  design.wavelet = goal == "wavelet";
  if (goal != "wavelet" && goal != "perceptual")
    fields.fail(422, "goal '" + goal + "' is not known", "goal", "send 'wavelet' or 'perceptual'");
  design.seed = fields.whole("seed").value_or(1);
  design.trials = std::min<std::uint64_t>(fields.whole("trials").value_or(0), 10'000'000);
  design.budget_s = fields.number("budget_s", {0.01, 600});
  design.move_stands = fields.flag("move_stands").value_or(true);
  design.apply_fade_s = fields.number("apply", kFade);
  for (const std::string& name : fields.texts("lock")) {
    if (!state.fixture(name)) {
      const Refusal refusal = unknown_name("fixture", name, fixture_names(state));
      fields.fail(refusal.status, refusal.what, "lock", refusal.remedy);
    }
    design.lock.push_back(name);
  }
  return checked(fields, design);
}

/// One degree of freedom of a body: null releases, a number sets within the fixture's limits.
void read_dof(Fields& fields, const FixtureView& fixture, const core::DofInfo& dof,
              SetFixture& gesture) {
  const std::string name(dof.file_name);
  const auto limit =
      std::find_if(fixture.limits.begin(), fixture.limits.end(),
                   [&](const auto& candidate) { return candidate.first == dof.dof; });
  if (limit == fixture.limits.end()) return;
  const bool by_hand = std::count(fixture.by_hand.begin(), fixture.by_hand.end(), dof.dof) > 0;
  if (!fields.has(name.c_str())) return;
  if (by_hand)
    return fields.fail(422, fmt::format("{} of '{}' is set by hand", name, fixture.name), name,
                       fmt::format("move it, then POST /api/v1/fixtures/{}/placed", fixture.name));
  if (fields.json().at(name).is_null()) return gesture.release.push_back(dof.dof);
  const core::Range range{core::file_value(dof.dof, limit->second.least),
                          core::file_value(dof.dof, limit->second.most)};
  if (const auto value = fields.number(name.c_str(), range))
    gesture.set.set(dof.dof, core::inside_value(dof.dof, *value));
}

Made set_fixture(const Request& request, const FixtureView& fixture) {
  Fields fields(request.body);
  SetFixture gesture{fixture.name, {}, {}, {}};
  gesture.lock = fields.flag("lock");
  if (fields.flag("release").value_or(false))
    for (const core::DofInfo& dof : core::dofs()) gesture.release.push_back(dof.dof);
  for (const core::DofInfo& dof : core::dofs()) read_dof(fields, fixture, dof, gesture);
  if (!fixture.controlled)
    fields.fail(422, "'" + fixture.name + "' is not controlled from here", fixture.name,
                "give it a patch in the studio file");
  return checked(fields, gesture);
}

Made placed(const Request& request, const FixtureView& fixture) {
  Fields fields(request.body);
  Placed gesture{fixture.name, {}};
  const bool stand =
      std::any_of(fixture.by_hand.begin(), fixture.by_hand.end(), core::is_placement);
  if (!stand)
    fields.fail(422, "'" + fixture.name + "' is not moved by hand", fixture.name,
                "only lamps on stands can be placed");
  for (const core::Dof dof : fixture.by_hand) {
    if (!core::is_placement(dof)) continue;
    const std::string name(core::info(dof).file_name);
    // Where a stand really is may lie outside its region; only the impossible is refused.
    const core::Range range = dof == core::Dof::azimuth     ? core::Range{-180, 180}
                              : dof == core::Dof::elevation ? core::Range{-90, 90}
                                                            : core::Range{0.1, 100};
    if (const auto value = fields.number(name.c_str(), range))
      gesture.at.set(dof, core::inside_value(dof, *value));
  }
  return checked(fields, gesture);
}

Made set_master(const Request& request, const std::string& word) {
  const std::vector<std::string> names(std::begin(kMasterNames), std::end(kMasterNames));
  const auto found = std::find(names.begin(), names.end(), word);
  if (found == names.end()) return unknown_name("master", word, names);
  Fields fields(request.body);
  fields.required("level");
  const double level = fields.number("level", {0, 1}).value_or(1);
  return checked(fields, SetMaster{static_cast<std::size_t>(found - names.begin()), level});
}

bool usable_name(const std::string& name) {
  return !name.empty() && name.size() <= 60 &&
         std::all_of(name.begin(), name.end(),
                     [](unsigned char c) { return std::isalnum(c) || c == '-' || c == '_'; });
}

Made add_mood(const Request& request) {
  const auto parts = parse_multipart(request.header("content-type"), request.body);
  if (!parts)
    return Refusal{400, "the body is not multipart/form-data", "body",
                   "send the fields 'name' and 'picture' as a form"};
  AddMood mood;
  for (const Part& part : *parts) {
    if (part.name == "name") mood.name = part.body;
    if (part.name == "title") mood.title = part.body;
    if (part.name == "picture") mood.picture = part.body;
  }
  if (!usable_name(mood.name))
    return Refusal{422, "'" + mood.name + "' cannot be a mood's name", "name",
                   "use letters, digits, '-' and '_', at most 60"};
  if (mood.title.empty()) mood.title = mood.name;
  if (auto refusal = not_a_picture(mood.picture, "picture")) return *refusal;
  return Gesture(mood);
}

Made save_look(const Request& request) {
  Fields fields(request.body);
  SaveLook gesture;
  gesture.name = fields.text("name").value_or("");
  const Json look = fields.any("look");
  if (!look.is_null() && !look.is_object())
    fields.fail(400, "'look' must be the object that look.json holds", "look",
                "send the content of a look.json");
  if (look.is_object())
    gesture.look_json = look.dump(-1, ' ', false, Json::error_handler_t::replace);
  if (look.is_null() && gesture.name.empty())
    fields.fail(400, "'name' is missing", "name", "add \"name\"");
  if (gesture.name.size() > 200)
    fields.fail(422, "the name is too long", "name", "use at most 200 letters");
  return checked(fields, gesture);
}

template <class Switch>
Made switched(const Request& request) {
  Fields fields(request.body);
  fields.required("on");
  return checked(fields, Switch{fields.flag("on").value_or(true)});
}

Made look_gesture(const Request& request, const std::vector<std::string>& words) {
  const auto id = number_of(words[1]);
  if (!id || *id > INT64_MAX) return no_such("look", words[1]);
  const auto look = static_cast<std::int64_t>(*id);
  if (words.size() == 2) return Gesture(DeleteLook{look});
  Fields fields(request.body);
  return checked(fields, ApplyLook{look, fields.number("fade_s", kFade).value_or(1.5)});
}

Made fixture_gesture(const Request& request, const std::vector<std::string>& words,
                     const State& state) {
  const FixtureView* fixture = state.fixture(words[1]);
  if (!fixture) return unknown_name("fixture", words[1], fixture_names(state));
  return words.size() == 2 ? set_fixture(request, *fixture) : placed(request, *fixture);
}

Made cancel_design(const std::string& word) {
  const auto job = number_of(word);
  if (!job) return no_such("job", word);
  return Gesture(CancelDesign{*job});
}

Made remove_mood(const std::string& name, const State& state) {
  for (const MoodView& mood : state.moods)
    if (mood.name == name && mood.own) return Gesture(RemoveMood{name});
  if (const auto names = mood_names(state); std::count(names.begin(), names.end(), name) > 0)
    return Refusal{422, "'" + name + "' is a shipped mood and stays", name,
                   "only your own pictures can be removed"};
  return unknown_name("mood", name, mood_names(state));
}

Made undo(const Request& request) {
  Fields fields(request.body);
  return checked(fields, Undo{fields.number("fade_s", kFade).value_or(1.5)});
}

Made reload(const Request& request) {
  Fields fields(request.body);
  return checked(fields, Reload{});
}

using Words = std::vector<std::string>;
/// A route: its method, its words ("*" = any one), and what it means.
struct Route {
  const char* method;
  Words words;
  Made (*make)(const Request&, const Words&, const State&);
};

const std::vector<Route>& routes() {
  static const std::vector<Route> kRoutes = {
      {"POST", {"design"}, [](auto& r, auto&, auto& s) { return start_design(r, s); }},
      {"DELETE", {"design", "*"}, [](auto&, auto& w, auto&) { return cancel_design(w[1]); }},
      {"POST", {"moods"}, [](auto& r, auto&, auto&) { return add_mood(r); }},
      {"DELETE", {"moods", "*"}, [](auto&, auto& w, auto& s) { return remove_mood(w[1], s); }},
      {"POST", {"looks"}, [](auto& r, auto&, auto&) { return save_look(r); }},
      {"POST", {"looks", "*", "apply"}, [](auto& r, auto& w, auto&) { return look_gesture(r, w); }},
      {"DELETE", {"looks", "*"}, [](auto& r, auto& w, auto&) { return look_gesture(r, w); }},
      {"POST", {"undo"}, [](auto& r, auto&, auto&) { return undo(r); }},
      {"PUT",
       {"fixtures", "*"},
       [](auto& r, auto& w, auto& s) { return fixture_gesture(r, w, s); }},
      {"POST",
       {"fixtures", "*", "placed"},
       [](auto& r, auto& w, auto& s) { return fixture_gesture(r, w, s); }},
      {"PUT", {"masters", "*"}, [](auto& r, auto& w, auto&) { return set_master(r, w[1]); }},
      {"POST", {"studio", "reload"}, [](auto& r, auto&, auto&) { return reload(r); }},
      {"POST", {"motion-stop"}, [](auto& r, auto&, auto&) { return switched<MotionStop>(r); }},
      {"POST", {"blackout"}, [](auto& r, auto&, auto&) { return switched<Blackout>(r); }},
  };
  return kRoutes;
}

bool matches(const Words& pattern, const Words& words) {
  return std::equal(pattern.begin(), pattern.end(), words.begin(), words.end(),
                    [](const std::string& a, const std::string& b) { return a == "*" || a == b; });
}

std::vector<std::string> names(const auto& items) {
  std::vector<std::string> list;
  for (const auto& item : items) list.push_back(item.name);
  return list;
}

}  // namespace

Refusal unknown_name(const std::string& kind, const std::string& name,
                     const std::vector<std::string>& known) {
  const std::string nearest = core::nearest_name(name, known);
  std::string list;
  for (const std::string& word : known) list += (list.empty() ? "" : ", ") + word;
  return {404, fmt::format("no {} is called '{}'", kind, name), name,
          !nearest.empty() ? "did you mean '" + nearest + "'?"
          : list.empty()   ? "there is none at all"
                           : "known are: " + list};
}

std::vector<std::string> mood_names(const State& state) { return names(state.moods); }
std::vector<std::string> fixture_names(const State& state) { return names(state.fixtures); }
std::vector<std::string> camera_names(const State& state) { return names(state.cameras); }

Made gesture_of(const Request& request, const Words& words, const State& state) {
  std::string allowed;
  for (const Route& route : routes()) {
    if (!matches(route.words, words)) continue;
    if (route.method == request.method) return route.make(request, words, state);
    allowed += (allowed.empty() ? "" : ", ") + std::string(route.method);
  }
  if (allowed.empty())
    return Refusal{404, "there is nothing at " + request.path, request.path,
                   "see the list of addresses in controller/README.md"};
  return Refusal{405, request.path + " does not take " + request.method, request.path,
                 "use " + allowed};
}

}  // namespace chiaro::panel
