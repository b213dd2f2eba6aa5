// SPDX-License-Identifier: Apache-2.0
// Looks and moods as an operator keeps, recalls and removes them, and their pictures.
#include <fmt/format.h>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>

#include "controller/daemon/brain/asked.h"
#include "controller/daemon/brain/brain.h"
#include "controller/daemon/brain/pictures.h"
#include "controller/daemon/brain/refusals.h"

namespace chiaro::daemon {
namespace {

std::string bytes_of(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
}

std::string type_of(const std::string& bytes) {
  if (bytes.starts_with("\x89PNG")) return "image/png";
  if (bytes.starts_with("\xff\xd8")) return "image/jpeg";
  if (bytes.starts_with("RIFF")) return "image/webp";
  return "application/octet-stream";
}

std::variant<panel::PictureFile, panel::Refusal> file_or(std::string bytes, panel::Refusal none) {
  if (bytes.empty()) return none;
  std::string type = type_of(bytes);
  return panel::PictureFile{std::move(type), std::move(bytes)};
}

}  // namespace

std::vector<panel::LookEntry> Brain::looks() const {
  std::vector<panel::LookEntry> list;
  for (const store::LookRecord& look : store_->looks())
    list.push_back({look.id, look.name, look.mood, look.verdict, look.created,
                    live_ && live_->record.id == look.id, look.kept});
  return list;
}

std::variant<panel::PictureFile, panel::Refusal> Brain::picture(const panel::PictureOf& which) {
  using Kind = panel::PictureOf::Kind;
  if (which.kind == Kind::mood) {
    for (const design::Mood& mood : moods_.moods)
      if (mood.name == which.name)
        return file_or(
            bytes_of(mood.picture),
            {500, "the mood's picture cannot be read", mood.picture, "install Chiaro again", {}});
    const auto own = store_->mood(which.name);
    return file_or(own ? own->picture : "",
                   panel::unknown_name("mood", which.name, panel::mood_names(state_)));
  }
  if (which.kind == Kind::camera) {
    const auto eye = eyes_.find(which.name);
    if (eye == eyes_.end())
      return panel::unknown_name("camera", which.name, panel::camera_names(state_));
    return file_or(eye->second->jpeg ? *eye->second->jpeg : "",
                   {503,
                    "no picture has come from '" + which.name + "' yet",
                    which.name,
                    "see whether the camera is on and its source in the studio file is right",
                    {}});
  }
  const auto look = store_->look(which.id);
  const panel::Refusal none{
      404, "there is no such picture", which.name, "see GET /api/v1/looks", {}};
  if (!look) return none;
  return file_or(which.kind == Kind::look_wanted   ? look->picture
                 : which.kind == Kind::look_placed ? look->placed_picture
                                                   : look->reference,
                 none);
}

void Brain::carry_out(const panel::SaveLook& save, const panel::Answer& answer) {
  std::int64_t id = live_ ? live_->record.id : 0;
  if (!save.look_json.empty()) {
    auto look = design::look_from_json(studio_, save.look_json, "look");
    if (!look) return answer({refusal_of(look.problems(), 422)});
    store::LookRecord record;
    record.name = save.name.empty() ? look->name : save.name;
    record.verdict = design::name_of(look->judgement.verdict);
    record.kept = true;
    record.request = request_of(save.look_json);
    record.json = save.look_json;
    const auto saved = store_->save_look(record);
    if (!saved) return answer({refusal_of(saved.problems(), 500)});
    id = *saved;
  } else if (!live_) {
    return answer({panel::Refusal{409, "no look is live", "look", "choose a mood first", {}}});
  } else {
    if (auto kept = store_->keep_look(id, save.name); !kept)
      return answer({refusal_of(kept.problems(), 500)});
    live_->record.name = save.name;
    live_->record.kept = true;
  }
  changed();
  answer({{}, 201, fmt::format(R"({{"id":{}}})", id)});
}

void Brain::carry_out(const panel::RenameLook& rename, const panel::Answer& answer) {
  if (!store_->look(rename.id))
    return answer({panel::Refusal{
        404, fmt::format("there is no look {}", rename.id), "look", "see GET /api/v1/looks", {}}});
  if (auto kept = store_->keep_look(rename.id, rename.name); !kept)
    return answer({refusal_of(kept.problems(), 500)});
  if (live_ && live_->record.id == rename.id) {
    live_->record.name = rename.name;
    live_->record.kept = true;
  }
  changed();
  answer({{}, 200, fmt::format(R"({{"id":{}}})", rename.id)});
}

void Brain::carry_out(const panel::ApplyLook& apply, const panel::Answer& answer) {
  panel::Refusal refusal;
  auto live = load(apply.id, refusal);
  if (!live) return answer({refusal});
  cancel_running(false);  // the newest click wins
  go_live(std::move(*live), apply.fade_s, true);
  answer({{}, 200, fmt::format(R"({{"id":{}}})", apply.id)});
}

void Brain::carry_out(const panel::DeleteLook& remove, const panel::Answer& answer) {
  if (live_ && live_->record.id == remove.id)
    return answer({panel::Refusal{409, "this look is live", "look", "apply another first", {}}});
  if (!store_->remove_look(remove.id))
    return answer({panel::Refusal{
        404, fmt::format("there is no look {}", remove.id), "look", "see GET /api/v1/looks", {}}});
  std::erase(history_, remove.id);
  remember_live();
  changed();
  answer({});
}

void Brain::carry_out(const panel::Undo& undo, const panel::Answer& answer) {
  panel::Refusal refusal{409, "there is nothing to go back to", "", "choose a mood", {}};
  if (running() && live_) {  // what is being looked for was the last click
    cancel_running();
    return answer({{}, 200, fmt::format(R"({{"id":{}}})", live_->record.id)});
  }
  while (!history_.empty()) {
    const std::int64_t id = history_.back();
    history_.pop_back();
    auto live = load(id, refusal);
    if (!live) continue;  // removed, or of another studio
    go_live(std::move(*live), undo.fade_s, false);
    return answer({{}, 200, fmt::format(R"({{"id":{}}})", id)});
  }
  changed();
  answer({refusal});
}

/// A look.json says what it was to be like in words; a mood that is installed here can be solved
/// for again when a stand is moved.
std::string Brain::request_of(const std::string& look_json) const {
  const auto json = nlohmann::json::parse(look_json, nullptr, false);
  if (!json.is_object()) return "{}";
  const auto text = [&](const char* key) {
    return json.contains(key) && json[key].is_string() ? json[key].get<std::string>() : "";
  };
  const std::string goal = text("goal"), name = text("name");
  panel::StartDesign ask;
  ask.wavelet = goal.find("perceptual") == std::string::npos;
  ask.ideal = goal.starts_with("ideal");
  for (const panel::MoodView& mood : state_.moods)
    if (mood.name == name || mood.title == name) ask.mood = mood.name;
  ask.title = name;
  if (json.contains("seed") && json["seed"].is_number_unsigned())
    ask.seed = json["seed"].get<std::uint64_t>();
  return can_be_solved(ask) ? asked_to_json(ask) : "{}";
}

void Brain::carry_out(const panel::AddMood& mood, const panel::Answer& answer) {
  for (const design::Mood& shipped : moods_.moods)
    if (shipped.name == mood.name)
      return answer({panel::Refusal{
          409, "'" + mood.name + "' is a shipped mood", "name", "choose another name", {}}});
  // Fifty megapixels take a second to read: the loop has blackouts to hear of meanwhile.
  reader_.add([this, here = here_, mood = std::make_shared<panel::AddMood>(mood), answer] {
    auto kept = kept_picture(std::move(mood->picture), mood->title);
    if (kept) mood->picture = std::move(*kept);
    post_([this, here, mood, answer, problems = kept.problems()] {
      if (!*here) return;
      if (!problems.empty()) return answer({refusal_of(problems, 422)});
      keep_mood(std::move(*mood), answer);
    });
  });
}

void Brain::keep_mood(panel::AddMood mood, const panel::Answer& answer) {
  const std::string stem = mood.name;
  for (int number = 2; !mood.replace && store_->mood(mood.name); ++number)
    mood.name = stem + "-" + std::to_string(number);
  if (auto kept = store_->save_mood({mood.name, mood.title, std::move(mood.picture)}); !kept)
    return answer({refusal_of(kept.problems(), 500)});
  changed();
  answer({{}, 201, fmt::format(R"({{"name":"{}"}})", mood.name)});
}

void Brain::carry_out(const panel::RemoveMood& mood, const panel::Answer& answer) {
  store_->remove_mood(mood.name);
  changed();
  answer({});
}

}  // namespace chiaro::daemon
