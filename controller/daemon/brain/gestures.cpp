// SPDX-License-Identifier: Apache-2.0
// What an operator may do, but for design (see jobs.cpp).
#include <fmt/format.h>
#include <fstream>
#include <iterator>

#include "controller/daemon/brain/brain.h"
#include "controller/studio/load.h"

namespace chiaro::daemon {
namespace {

/// How long a blackout's answer waits for the hand.
constexpr ports::Duration kDarkPatience = std::chrono::seconds(2);

panel::Refusal refusal_of(const core::Problems& problems, int status) {
  const core::Problem first = problems.empty() ? core::Problem{{}, "it failed", ""} : problems[0];
  return {status, first.what, first.where.file.empty() ? "" : core::to_string(first.where),
          first.remedy, problems};
}

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

void Brain::perform(const panel::Gesture& gesture, panel::Answer answer) {
  std::visit([&](const auto& wish) { carry_out(wish, answer); }, gesture);
}

std::vector<panel::LookEntry> Brain::looks() const {
  std::vector<panel::LookEntry> list;
  for (const store::LookRecord& look : store_->looks())
    list.push_back({look.id, look.name, look.mood, look.verdict, look.created,
                    live_ && live_->record.id == look.id});
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
    record.request = "{}";
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
  }
  changed();
  answer({{}, 201, fmt::format(R"({{"id":{}}})", id)});
}

void Brain::carry_out(const panel::ApplyLook& apply, const panel::Answer& answer) {
  panel::Refusal refusal;
  auto live = load(apply.id, refusal);
  if (!live) return answer({refusal});
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

void Brain::carry_out(const panel::SetFixture& set, const panel::Answer& answer) {
  const auto index = studio_.fixture_index(set.fixture);
  if (!index) return answer({panel::Refusal{404, "no such fixture", set.fixture, "", {}}});
  const ports::TimePoint now = world_.clock.now();
  if (set.lock) {
    placements_->lock(*index, *set.lock);
    if (auto kept = store_->set("placed:" + studio_.name, placements_->to_json(studio_)); !kept)
      return answer({refusal_of(kept.problems(), 500)});
  }
  if (!set.release.empty()) console_->release(*index, set.release, now);
  if (set.set.present() != 0) console_->hold(*index, set.set, now);
  changed();
  answer({});
}

void Brain::carry_out(const panel::SetMaster& set, const panel::Answer& answer) {
  console_->set_master(set.master, set.level);
  changed();
  answer({});
}

void Brain::carry_out(const panel::Reload&, const panel::Answer& answer) {
  auto loaded = studio::load_studio(studio_.file, {world_.config_folder});
  if (!loaded) return answer({refusal_of(loaded.problems(), 422)});
  cancel_running();
  if (again_) again_->stop = true;
  moods_ = design::load_moods(studio::Folders{world_.config_folder}.moods());
  const std::int64_t live = live_ ? live_->record.id : 0;
  if (auto taken = take_studio(std::move(*loaded)); !taken)
    return answer({refusal_of(taken.problems(), 500)});
  panel::Refusal ignored;
  live_ = live != 0 ? load(live, ignored) : std::nullopt;
  adopted_ = true;  // this brain knows what it said
  errands_.add([this, here = here_, folder = world_.runtime_folder] {
    const auto done = hand_reload(folder);
    post_([this, here, problems = done.problems()] {
      if (!*here || problems.empty()) return;
      notes_.push_back("the output process did not take the new file: " + problems.front().what);
      changed();
    });
  });
  store_->note("studio file read again");
  answer({});
}

void Brain::carry_out(const panel::MotionStop&, const panel::Answer& answer) {
  answer({panel::Refusal{422,
                         "no fixture of this studio moves by motor",
                         "motion-stop",
                         "stands are moved by people: there is nothing to stop",
                         {}}});
}

void Brain::carry_out(const panel::Blackout& blackout, const panel::Answer& answer) {
  const ports::TimePoint now = world_.clock.now();
  waiting_.push_back(
      {console_->blackout(blackout.on, now), blackout.on, now + kDarkPatience, answer});
  store_->note(blackout.on ? "blackout" : "blackout released");
  changed();
  adopted_ = true;  // darkness does not wait for adoption
  speak(now);
}

void Brain::carry_out(const panel::AddMood& mood, const panel::Answer& answer) {
  for (const design::Mood& shipped : moods_.moods)
    if (shipped.name == mood.name)
      return answer({panel::Refusal{
          409, "'" + mood.name + "' is a shipped mood", "name", "choose another name", {}}});
  if (auto kept = store_->save_mood({mood.name, mood.title, mood.picture}); !kept)
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
