// SPDX-License-Identifier: Apache-2.0
// Looks and moods: kept, renamed, taken from files, recalled, removed.
#include <algorithm>
#include <cctype>
#include <cstdint>

#include "controller/panel/made.h"

namespace chiaro::panel {
namespace {

constexpr std::size_t kLongestName = 200;

std::optional<std::int64_t> look_of(const std::string& word) {
  const auto id = number_of(word);
  if (!id || *id > INT64_MAX) return std::nullopt;
  return static_cast<std::int64_t>(*id);
}

void check_length(Fields& fields, const std::string& name) {
  if (name.size() > kLongestName)
    fields.fail(422, "the name is too long", "name", "use at most 200 letters");
}

bool usable_name(const std::string& name) {
  return !name.empty() && name.size() <= 60 &&
         std::all_of(name.begin(), name.end(),
                     [](unsigned char c) { return std::isalnum(c) || c == '-' || c == '_'; });
}

/// "Anna at the window.jpg" becomes "anna-at-the-window-jpg"; of letters beyond ASCII nothing
/// stays.
std::string name_from(const std::string& title) {
  std::string name;
  for (const char c : title) {
    const auto byte = static_cast<unsigned char>(c);
    if (byte < 128 && std::isalnum(byte))
      name += static_cast<char>(std::tolower(byte));
    else if (!name.empty() && name.back() != '-')
      name += '-';
  }
  while (name.ends_with('-')) name.pop_back();
  return name.empty() ? "picture" : name.substr(0, 50);
}

std::string not_taken(std::string name, const State& state) {
  const auto names = mood_names(state);
  const std::string stem = name;
  for (int number = 2; std::count(names.begin(), names.end(), name) > 0; ++number)
    name = stem + "-" + std::to_string(number);
  return name;
}

}  // namespace

Made save_look(const Request& request, const Words&, const State&) {
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
  check_length(fields, gesture.name);
  return checked(fields, gesture);
}

Made rename_look(const Request& request, const Words& words, const State&) {
  const auto id = look_of(words[1]);
  if (!id) return no_such("look", words[1]);
  Fields fields(request.body);
  fields.required("name");
  RenameLook gesture{*id, fields.text("name").value_or("")};
  if (gesture.name.empty()) fields.fail(422, "a look needs a name", "name", "give it a name");
  check_length(fields, gesture.name);
  return checked(fields, gesture);
}

Made delete_look(const Request&, const Words& words, const State&) {
  const auto id = look_of(words[1]);
  if (!id) return no_such("look", words[1]);
  return Gesture(DeleteLook{*id});
}

Made apply_look(const Request& request, const Words& words, const State&) {
  const auto id = look_of(words[1]);
  if (!id) return no_such("look", words[1]);
  Fields fields(request.body);
  return checked(fields, ApplyLook{*id, fields.number("fade_s", kFade).value_or(1.5)});
}

Made undo(const Request& request, const Words&, const State&) {
  Fields fields(request.body);
  return checked(fields, Undo{fields.number("fade_s", kFade).value_or(1.5)});
}

Made add_mood(const Request& request, const Words&, const State& state) {
  const auto parts = parse_multipart(request.header("content-type"), request.body);
  if (!parts)
    return Refusal{400, "the body is not multipart/form-data", "body",
                   "send the fields 'picture' and, if you like, 'title' and 'name' as a form"};
  AddMood mood;
  bool any = false;
  for (const Part& part : *parts) {
    if (part.name == "name") mood.name = part.body;
    if (part.name == "title") mood.title = part.body;
    if (part.name == "picture") mood.picture = part.body, any = true;
  }
  if (!any)
    return Refusal{400, "the form has no 'picture'", "picture",
                   "send the photograph as the form's field 'picture'"};
  mood.replace = !mood.name.empty();
  if (!mood.replace) mood.name = not_taken(name_from(mood.title), state);
  if (!usable_name(mood.name))
    return Refusal{422, "'" + mood.name + "' cannot be a mood's name", "name",
                   "use letters, digits, '-' and '_', at most 60"};
  if (mood.title.empty()) mood.title = mood.name;
  if (auto refusal = not_a_picture(mood.picture, "picture")) return *refusal;
  return Gesture(mood);
}

Made remove_mood(const Request&, const Words& words, const State& state) {
  const std::string& name = words[1];
  for (const MoodView& mood : state.moods)
    if (mood.name == name && mood.own) return Gesture(RemoveMood{name});
  if (const auto names = mood_names(state); std::count(names.begin(), names.end(), name) > 0)
    return Refusal{422, "'" + name + "' is a shipped mood and stays", name,
                   "only your own pictures can be removed"};
  return unknown_name("mood", name, mood_names(state));
}

}  // namespace chiaro::panel
