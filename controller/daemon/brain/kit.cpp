// SPDX-License-Identifier: Apache-2.0
// A lamp without a profile: its slots are raised while a person looks, and what the person saw
// becomes a profile file and an entry of the studio file.
#include <algorithm>
#include <filesystem>
#include <fmt/format.h>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>

#include "controller/daemon/brain/brain.h"
#include "controller/daemon/brain/refusals.h"
#include "controller/daemon/interview/answers.h"
#include "controller/daemon/interview/learnt.h"
#include "controller/design/starts.h"
#include "controller/studio/words.h"

namespace chiaro::daemon {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

/// The page repeats its word every few seconds; silence lets the slots fall.
constexpr ports::Duration kTry = std::chrono::seconds(10);

std::string read(const fs::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
}

/// Beside the file and then into its place: nothing is ever half written.
core::Result<core::Done> write(const fs::path& file, const std::string& text) {
  std::error_code code;
  fs::create_directories(file.parent_path(), code);
  fs::path draft = file;
  draft += ".new";
  std::ofstream out(draft, std::ios::binary | std::ios::trunc);
  out << text;
  out.close();
  if (out) fs::rename(draft, file, code);
  if (out && !code) return core::Done{};
  fs::remove(draft, code);
  return core::Problem{{file, 0, 0},
                       "this file cannot be written",
                       "copy the lines into it by hand, or give this user the right to write it"};
}

interview::LearntLamp learnt(const panel::LearnLamp& seen) {
  interview::LearntLamp lamp;
  lamp.profile = interview::profile_name(seen.name);
  lamp.maker = seen.maker;
  lamp.model = seen.model.empty() ? seen.name : seen.model;
  lamp.output_cd = seen.output_cd;
  lamp.cct = seen.cct;
  for (const auto& slot : seen.slots) lamp.slots.push_back({slot.sees, slot.level});
  return lamp;
}

struct Named {
  interview::LearntLamp lamp;
  std::string profile;
};
/// With its profile, under a name that no other lamp's profile has: "Panel" and "panel!" are two.
core::Result<Named> with_free_name(interview::LearntLamp lamp, const fs::path& folder) {
  const std::string stem = lamp.profile;
  std::error_code ignored;
  for (int number = 2;; ++number) {
    auto profile = interview::profile_yaml(lamp);
    if (!profile) return profile.problems();
    const fs::path file = folder / (lamp.profile + ".yaml");
    if (!fs::exists(file, ignored) || read(file) == *profile)
      return Named{std::move(lamp), std::move(*profile)};
    lamp.profile = stem + "-" + std::to_string(number);
  }
}

/// The lamp's entry in the studio file: patch, and what holds it.
core::Result<interview::Lamp> entry_of(const panel::LearnLamp& seen, const std::string& profile) {
  const auto place = studio::place_from_words(seen.place);
  if (!place) return place.problems();
  const auto far_end = studio::place_from_words(seen.far_end);
  if (!far_end) return far_end.problems();
  const auto held = std::find(std::begin(panel::kHeldBy), std::end(panel::kHeldBy), seen.held);
  interview::Lamp lamp;
  lamp.name = seen.name;
  lamp.role = seen.role;
  lamp.profile = profile;
  lamp.mode = interview::kLearntMode;
  lamp.universe = seen.universe;
  lamp.address = seen.address;
  lamp.slots = static_cast<int>(seen.slots.size());
  lamp.place = *place;
  lamp.held = static_cast<interview::Held>(held - std::begin(panel::kHeldBy));
  lamp.motor = {std::max<int>(seen.motor_slot, lamp.slots + 1),
                seen.motor_bits / 8,
                seen.over,
                core::radians(seen.travel_deg),
                *far_end,
                seen.along};
  return lamp;
}

}  // namespace

void Brain::carry_out(const panel::TrySlots& slots, const panel::Answer& answer) {
  tried_ = slots;
  tried_until_ = world_.clock.now() + kTry;
  std::vector<rig::TriedSlot> raised;
  for (const auto& [slot, level] : slots.levels) raised.push_back({slots.universe, slot, level});
  console_->try_slots(raised, raised.empty() ? ports::TimePoint{} : tried_until_);
  changed();
  answer({});
}

void Brain::carry_out(const panel::LearnLamp& seen, const panel::Answer& answer) {
  const fs::path folder = studio_.file.parent_path() / "fixtures";
  const auto named = with_free_name(learnt(seen), folder);
  if (!named) return answer({refusal_of(named.problems())});
  const auto& [lamp, profile] = *named;
  const auto entry = entry_of(seen, lamp.profile);
  if (!entry) return answer({refusal_of(entry.problems())});
  const std::string lines =
      interview::lamp_yaml(*entry, design::estimated_aim(studio_), std::nullopt);
  const fs::path file = folder / (lamp.profile + ".yaml");
  const Json json = {{"profile", lamp.profile}, {"profile_file", file.string()},
                     {"profile_yaml", profile}, {"studio_file", studio_.file.string()},
                     {"studio_lines", lines},   {"added", seen.add}};
  const std::string text = json.dump(-1, ' ', false, Json::error_handler_t::replace);
  if (!seen.add) return answer({{}, 200, text});
  const auto changed_file = interview::with_fixture(read(studio_.file), lines);
  if (!changed_file) return answer({refusal_of(changed_file.problems())});
  std::error_code ignored;
  const bool was_there = fs::exists(file, ignored);  // the same lamp, learned before
  if (auto written = write(file, profile); !written)
    return answer({refusal_of(written.problems(), 409)});
  // The whole studio is read with it before a byte of its file changes.
  const auto loaded =
      studio::parse_studio(*changed_file, studio_.file.parent_path(), {world_.config_folder});
  if (!loaded) {
    if (!was_there) fs::remove(file, ignored);
    return answer({refusal_of(loaded.problems())});
  }
  if (auto written = write(studio_.file, *changed_file); !written)
    return answer({refusal_of(written.problems(), 409)});
  store_->note("learned " + seen.name + ", " + lamp.profile);
  carry_out(panel::TrySlots{}, [](const panel::Outcome&) {});
  carry_out(panel::Reload{}, [answer, text](const panel::Outcome& reloaded) {
    answer(reloaded.refused ? reloaded : panel::Outcome{{}, 201, text});
  });
}

}  // namespace chiaro::daemon
