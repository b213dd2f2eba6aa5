// SPDX-License-Identifier: Apache-2.0
// The state as the panel shows it, made anew from what the brain knows.
#include <algorithm>
#include <cmath>
#include <fmt/format.h>

#include "controller/core/hash.h"
#include "controller/core/light_units.h"
#include "controller/daemon/brain/asked.h"
#include "controller/daemon/brain/brain.h"
#include "controller/daemon/brain/words.h"
#include "controller/design/design.h"
#include "controller/design/words.h"
#include "controller/ports/output.h"

namespace chiaro::daemon {
namespace {

core::FixtureState placement_of(const core::FixtureState& state) {
  core::FixtureState place;
  for (const core::DofInfo& dof : core::dofs())
    if (core::is_placement(dof.dof) && state.has(dof.dof)) place.set(dof.dof, state.get(dof.dof));
  return place;
}

core::FixtureState light_of(const core::FixtureState& state) {
  core::FixtureState light;
  for (const core::DofInfo& dof : core::dofs())
    if (!core::is_placement(dof.dof) && state.has(dof.dof)) light.set(dof.dof, state.get(dof.dof));
  return light;
}

/// What lamps are being told: by the hand's report, else what they start with.
core::FixtureState sent_of(const std::optional<rig::Sent>& sent, const studio::Fixture& fixture,
                           std::size_t index) {
  if (sent && index < sent->fixtures.size()) return sent->fixtures[index];
  return fixture.initial;
}

std::string health_of(const camera::Report& report) {
  switch (report.health) {
    case camera::Health::waiting:
      return "waiting";
    case camera::Health::good:
      return "good";
    case camera::Health::lost:
      return "lost";
  }
  return "";
}

panel::OutputView view_of_port(const rig::Sent::Port& port) {
  static constexpr const char* kHealth[] = {"closed", "good", "lost"};
  return {port.universe,       kHealth[std::min<std::size_t>(port.health, 2)],
          port.rate_hz,        port.frames,
          port.late,           port.failed,
          port.jitter_us_p50,  port.jitter_us_p99,
          port.jitter_us_p999, port.missed,
          port.slots};
}

bool is_flash(const studio::Fixture& fixture) {
  return std::any_of(fixture.by_hand.begin(), fixture.by_hand.end(), [](const auto& binding) {
    return binding.kind == studio::HandKind::flash_power;
  });
}

std::vector<std::pair<std::string, double>> nudges_in_words(const panel::Nudges& nudges) {
  std::vector<std::pair<std::string, double>> given;
  for (const auto& [name, stops] :
       {std::pair{"brighter", nudges.brighter}, std::pair{"softer", nudges.softer},
        std::pair{"warmer", nudges.warmer}, std::pair{"contrast", nudges.contrast}})
    if (stops != 0) given.emplace_back(name, stops);
  return given;
}

/// What a meter with its dome towards the camera reads at the face: each lamp's light by how far
/// it comes from the front.
double lux_on_dome(const studio::Studio& studio, const studio::Rig& rig,
                   const Placements& placements) {
  double lux = 0;
  for (std::size_t i = 0; i < studio.fixtures.size(); ++i) {
    const studio::Fixture& fixture = studio.fixtures[i];
    if (fixture.role == studio::Role::background) continue;
    const core::Spherical from = place_of(studio, fixture, placements.at(i));
    const double front = std::cos(from.azimuth) * std::cos(from.elevation);
    lux += design::lux_at_face(studio, rig, i) * (1 + front) / 2;
  }
  return lux;
}

/// Less than moonlight gives: nothing that a meter on a set would show.
constexpr double kDarkLux = 0.05;
/// A lamp that gives nothing need not be moved.
constexpr double kWorthMoving = 0.002;

}  // namespace

const studio::Studio& Brain::standing() const {
  if (!standing_) standing_ = placements_->placed_studio(studio_);
  return *standing_;
}

studio::Rig Brain::sent_rig() const {
  studio::Rig rig = studio::placed_rig(standing());
  for (std::size_t i = 0; i < rig.states.size(); ++i) {
    const studio::Fixture& fixture = studio_.fixtures[i];
    rig.states[i].overlay(light_of(sent_of(sent_, fixture, i)));
    // What a hand sets goes over no wire.
    for (const studio::HandBinding& binding : fixture.by_hand)
      if (placements_->at(i).has(binding.dof) && !core::is_placement(binding.dof))
        rig.states[i].set(binding.dof, placements_->at(i).get(binding.dof));
  }
  return rig;
}

std::optional<panel::Instruction> Brain::instruction_for(std::size_t index) const {
  if (!live_ || index >= live_->look.wanted.states.size() || placements_->locked(index))
    return std::nullopt;
  const studio::Fixture& fixture = studio_.fixtures[index];
  const core::FixtureState& aim = live_->look.wanted.states[index];
  const core::FixtureState& level = live_->look.placed.states[index];
  const core::FixtureState& now = placements_->at(index);
  panel::Instruction instruction{fixture.name, "", {}};
  const bool stand = std::holds_alternative<studio::StandMount>(fixture.mount);
  if (stand && aim.get(core::Dof::intensity, 1) >= kWorthMoving && !stands_there(aim, now)) {
    instruction.to = placement_of(aim);
    instruction.words =
        fmt::format("move {} to {}", fixture.name,
                    design::place_in_words(place_of(studio_, fixture, instruction.to)));
  }
  for (const studio::HandBinding& binding : fixture.by_hand) {
    if (binding.kind == studio::HandKind::stand || is_set(binding, level, now)) continue;
    const double value = level.get(binding.dof);
    instruction.to.set(binding.dof, value);
    instruction.words +=
        (instruction.words.empty() ? "" : "; ") + hand_in_words(fixture, binding, value);
  }
  if (instruction.words.empty()) return std::nullopt;
  return instruction;
}

panel::FixtureView Brain::view_of(std::size_t index, const studio::Rig& rig) const {
  const studio::Fixture& fixture = studio_.fixtures[index];
  panel::FixtureView view;
  view.name = fixture.name;
  view.role = studio::name_of(fixture.role);
  view.mount = mount_name(fixture.mount);
  view.placed = placements_->at(index);
  view.sent = light_of(rig.states[index]);
  view.words = design::place_in_words(place_of(studio_, fixture, view.placed));
  const double level = view.sent.get(core::Dof::intensity);
  view.level = is_flash(fixture) ? core::flash_power_in_words(level) : level_in_words(level);
  view.lux = design::lux_at_face(standing(), rig, index);
  view.light = view.lux >= kDarkLux ? core::illuminance_in_words(core::Lux{view.lux}) : "";
  view.output_cd = standing().fixtures[index].output.value;
  view.measured = placements_->measured(index).has_value();
  if (const auto* patch = std::get_if<studio::DmxPatch>(&fixture.patch))
    view.patch = {patch->universe, patch->address, fixture.footprint()};
  if (level >= kOff) view.colour = colour_in_words(fixture, view.sent);
  view.manual = console_->held(index);
  constexpr auto kOwn = static_cast<std::size_t>(rig::Source::own);
  if (sent_ && index < sent_->sources[kOwn].fixtures.size())
    view.manual.overlay(sent_->sources[kOwn].fixtures[index]);
  view.limits = fixture.ranges();
  view.locked = placements_->locked(index);
  view.controlled = fixture.controlled;
  for (const core::DofInfo& dof : core::dofs())
    if (set_by_hand(fixture, dof.dof)) view.by_hand.push_back(dof.dof);
  if (!live_ || index >= live_->look.wanted.states.size()) return view;
  const core::FixtureState& aim = live_->look.wanted.states[index];
  view.wanted = light_of(live_->look.placed.states[index]);
  view.wanted.overlay(placement_of(aim));
  view.instruction = instruction_for(index);
  return view;
}

std::optional<panel::LookView> Brain::live_view(const studio::Rig& rig) const {
  if (!live_) return std::nullopt;
  const design::Look& look = live_->look;
  panel::LookView view;
  view.id = live_->record.id;
  view.name = live_->record.name;
  view.mood = live_->record.mood;
  view.verdict = design::name_of(look.judgement.verdict);
  view.verdict_when_placed = design::name_of(look.placed_judgement.verdict);
  view.remedy = look.placed_judgement.remedy;
  if (const auto ratio = design::key_fill_ratio(standing(), look.placed))
    view.ratio = core::ratio_in_words(*ratio) + (*ratio < 0.9 ? ", the fill is brighter" : "");
  if (const double lux = lux_on_dome(standing(), rig, *placements_); lux >= kDarkLux)
    view.light = core::illuminance_in_words(core::Lux{lux});
  const panel::StartDesign ask = asked_from_json(live_->record.request, live_->record.reference);
  view.nudges = nudges_in_words(ask.nudges);
  view.can_nudge = true;
  view.advice = live_->advice;
  view.kept = live_->record.kept;
  view.edition = edition_;
  // Until the hand has seen this fade, what it reports is the end of the last one.
  constexpr auto kLook = static_cast<std::size_t>(rig::Source::look);
  const bool seen = sent_ && sent_->fade_id[kLook] >= console_->wanted().sources[kLook].fade_id;
  if (sent_) view.fade = seen ? sent_->fade_progress[kLook] : 0;
  if (!live_->record.reference.empty())
    view.reference = fmt::format("/api/v1/looks/{}/reference", view.id);
  else if (!view.mood.empty())
    view.reference = "/api/v1/moods/" + view.mood + "/picture";
  view.trials = look.trials;
  view.seconds = look.seconds;
  return view;
}

void Brain::renew_state() {
  panel::State& s = state_;
  s.studio = studio_.name;
  s.file = studio_.file;
  s.fingerprint = core::hex(studio_.fingerprint);
  s.ready = ready_;
  s.stage = ready_ ? "" : "preparing the preview of the subject";
  s.hand_connected = hand_alive_;
  s.hand_refused = sent_ && sent_->refused;
  s.real_time = sent_ && sent_->real_time;
  s.caution = sent_ ? rig::name_of(sent_->caution) : "normal";
  s.blackout = hand_alive_ && sent_ ? sent_->blackout : console_->wanted().blackout;
  s.motion_stopped = sent_ && sent_->motion_stop.on;
  s.motion_armed = sent_ && sent_->motion_armed.on;
  s.axes_waiting = sent_ ? sent_->axes_waiting : 0;
  // A fader at the hand may have moved a master since it was set here.
  const bool newest = hand_alive_ && sent_ && sent_->master_id == console_->wanted().master_id;
  s.masters = newest ? sent_->masters : console_->wanted().masters;
  const studio::Rig rig = sent_rig();
  s.look = live_view(rig);
  s.design = job_ ? std::optional(job_->view) : std::nullopt;
  s.fixtures.clear();
  for (std::size_t i = 0; i < studio_.fixtures.size(); ++i) s.fixtures.push_back(view_of(i, rig));
  s.outputs.clear();
  if (hand_alive_ && sent_)
    for (const rig::Sent::Port& port : sent_->ports) s.outputs.push_back(view_of_port(port));
  const bool trying = !tried_.levels.empty() && world_.clock.now() < tried_until_;
  s.tried = trying ? panel::TriedView{tried_.universe, tried_.levels} : panel::TriedView{};
  s.problems = warnings_;
  s.problems.insert(s.problems.end(), moods_.problems.begin(), moods_.problems.end());
  s.problems.insert(s.problems.end(), twin_problems_.begin(), twin_problems_.end());
  for (const std::string& note : notes_) s.problems.push_back({{}, note, "", false});
  s.cameras.clear();
  for (const studio::Camera& camera : studio_.cameras) {
    const auto eye = eyes_.find(camera.name);
    if (eye == eyes_.end() || !eye->second->watch) {
      s.cameras.push_back({camera.name, "none", 0, 0});
      continue;
    }
    const camera::Report report = eye->second->watch->report();
    s.cameras.push_back({camera.name, health_of(report), report.frames, report.reconnects});
    s.problems.insert(s.problems.end(), report.trouble.begin(), report.trouble.end());
  }
  if (!hand_alive_ && spoken_)
    s.problems.push_back({{},
                          "the output process does not answer" +
                              (link_->silence().empty() ? "" : ": " + link_->silence()),
                          "start chiaro-output with the same studio file",
                          false});
  s.moods.clear();
  for (const design::Mood& mood : moods_.moods)
    s.moods.push_back({mood.name, mood.title, mood.sentence, mood.tags.words(), mood.attainable,
                       false, mood.words, design::turn_in_words(mood.sitter_turn)});
  for (const store::MoodRecord& mood : store_->moods())
    s.moods.push_back({mood.name, mood.title, "Your own picture", {}, true, true, {}, ""});
  s.can_undo = !history_.empty() || (running() && live_);
}

}  // namespace chiaro::daemon
