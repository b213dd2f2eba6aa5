// SPDX-License-Identifier: Apache-2.0
// fixtures: - the lamps by name.
#include <algorithm>

#include "controller/studio/reading/scalars.h"
#include "controller/studio/reading/text.h"
#include "controller/studio/sections/sections.h"

namespace chiaro::studio::sections {

using namespace reading;

namespace {

/// False when the profile cannot be used: then nothing that rests on it is judged.
bool read_profile(const Tree* tree, profiles::Shelf& shelf, Fixture& fixture, Report& report) {
  const auto name = text(tree, report);
  if (!name) return false;
  const core::Result<Profile>& profile = shelf.get(*name);
  if (profile) {
    fixture.profile = *profile;
    return true;
  }
  const core::Problem& first = profile.problems().front();
  if (first.where.file.empty()) {  // there is none: said where it is asked for
    report.error(*tree, first.what, first.remedy);
  } else {
    report.error(*tree, "the fixture profile " + in_quotes(*name) + " has problems of its own",
                 "see " + first.where.file);
    if (shelf.first_mention(*name)) report.add(profile.problems());
  }
  return false;
}

void read_mode(const Tree* tree, const Tree::Key& key, Fixture& fixture, Report& report) {
  std::vector<std::string> names;
  for (const Mode& mode : fixture.profile.modes) names.push_back(mode.name);
  if (tree == nullptr) {
    if (names.size() > 1)
      report.error(
          key,
          in_quotes(key.text) + " has no 'mode', and " + fixture.profile.name + " knows several",
          "add mode: " + any_of(names));
    return;
  }
  if (tree->kind != Tree::Kind::scalar) {
    text(tree, report);
    return;
  }
  const auto found = std::find(names.begin(), names.end(), trimmed(tree->text));
  if (found != names.end())
    fixture.mode = static_cast<std::size_t>(found - names.begin());
  else
    report.error(*tree, fixture.profile.name + " has no mode " + in_quotes(tree->text),
                 suggestion(tree->text, names));
}

/// A mode without the lamp's amber cannot light its amber: what the mode leaves out stays dark.
void keep_what_the_mode_reaches(Fixture& fixture) {
  Emitter& emitter = fixture.profile.emitter;
  if (fixture.mode >= fixture.profile.modes.size() || emitter.primaries.empty()) return;
  const auto& channels = fixture.profile.modes[fixture.mode].channels;
  const auto reached = [&](core::Dof dof) {
    return std::any_of(channels.begin(), channels.end(),
                       [&](const Channel& channel) { return channel.dof == dof; });
  };
  emitter.primaries.erase(
      std::remove_if(emitter.primaries.begin(), emitter.primaries.end(),
                     [&](const Primary& primary) { return !reached(primary.dof); }),
      emitter.primaries.end());
  const bool white = emitter.kind == Emitter::Kind::blend && reached(core::Dof::cct);
  if (emitter.primaries.empty())
    emitter.kind = white ? Emitter::Kind::bicolour : Emitter::Kind::dimmer;
  else if (!white)
    emitter.kind = Emitter::Kind::mixed;
}

/// White balance or as near as the lamp comes; drives full: the profile's white.
core::FixtureState first_colour(const Fixture& fixture, const Studio& studio) {
  core::FixtureState state;
  for (const auto& [dof, range] : fixture.ranges()) {
    if (dof == core::Dof::intensity) state.set(dof, 0);
    if (dof == core::Dof::cct) state.set(dof, range.clamp(studio.exposure.white_balance.value));
    if (dof == core::Dof::tint) state.set(dof, range.clamp(0));
    if (dof > core::Dof::tint && core::is_colour(dof))
      state.set(dof, dof == core::Dof::crossfade ? 0 : 1);
  }
  if (!fixture.controlled) state.set(core::Dof::intensity, 1);
  return state;
}

Role read_role(const Tree* tree, Report& report) {
  std::vector<std::pair<std::string, Role>> roles;
  for (const Role role : {Role::key, Role::fill, Role::back, Role::hair, Role::kicker,
                          Role::background, Role::practical})
    roles.emplace_back(name_of(role), role);
  return choice<Role>(tree, roles, report).value_or(Role::key);
}

bool patch_is_none(const Tree* patch) {
  return patch == nullptr || patch->kind == Tree::Kind::scalar;
}

void check_can_be_set(const Tree::Key& key, const Fixture& fixture, Report& report) {
  if (!fixture.controlled || std::holds_alternative<VirtualMount>(fixture.mount)) return;
  report.error(key, "nothing can set the light of " + in_quotes(key.text),
               "add patch: {universe: 1, address: 1}, or by_hand: {intensity: knob}, or "
               "controlled: no for a lamp that stays as it is");
}

Fixture read_fixture(const Tree::Key& key, const Tree& tree, Context& context,
                     profiles::Shelf& shelf, const Studio& studio) {
  Report& report = context.report;
  Section section(tree, "a fixture", report);
  Fixture fixture;
  fixture.name = key.text;
  fixture.place = report.place(key);
  fixture.role = read_role(section.need("role", "key"), report);
  const bool known =
      read_profile(section.need("profile", "generic/dimmer"), shelf, fixture, report);
  const Tree* mode = section.find("mode");
  if (known) read_mode(mode, key, fixture, report);
  fixture.output = fixture.profile.output;
  if (const auto cd = quantity(section.find("output"), Measure::intensity, {0.1, 1e8}, report))
    fixture.output = {*cd};
  fixture.modifiers = read_modifiers(section.find("modifiers"), context);
  fixture.mount = read_mount(section.need("mount", "{fixed: {at: […], aim_at: […]}}"), context);
  const Tree* patch = section.find("patch");
  fixture.patch = read_patch(patch, studio, context);
  fixture.patch_place = patch != nullptr ? report.place(*patch) : fixture.place;
  if (std::holds_alternative<DmxPatch>(fixture.patch) &&
      !std::holds_alternative<VirtualMount>(fixture.mount))
    keep_what_the_mode_reaches(fixture);
  fixture.limits = read_limits(section.find("limits"), context);
  fixture.curve = fixture.profile.curve;
  if (const Tree* curve = section.find("curve"))
    fixture.curve = profiles::read_curve(curve, report);
  into(fixture.controlled, yes_or_no(section.find("controlled"), report));
  const Tree* by_hand = section.find("by_hand");
  const Tree* initial = section.find("initial");
  if (known) {
    fixture.by_hand = read_by_hand(by_hand, fixture, context);
    fixture.initial = first_colour(fixture, studio);
    fixture.initial = read_initial(initial, fixture, context);
    // A patch or binding that could not be read has been reported as such.
    if (section.valid() && patch_is_none(patch) && by_hand == nullptr)
      check_can_be_set(key, fixture, report);
  }
  section.refuse_unknown();
  return fixture;
}

}  // namespace

void read_fixtures(Section& top, Context& context, profiles::Shelf& shelf, Studio& studio) {
  const Tree* tree = top.need("fixtures", "{key: {role: key, profile: generic/dimmer, …}}");
  if (tree == nullptr) return;
  if (tree->kind != Tree::Kind::mapping || tree->keys.empty()) {
    context.report.error(*tree, "'fixtures' needs at least one lamp by name",
                         "key: {role: key, profile: generic/dimmer, mount: …, patch: …}");
    return;
  }
  for (std::size_t i = 0; i < tree->keys.size(); ++i) {
    check_name(tree->keys[i], context);
    studio.fixtures.push_back(read_fixture(tree->keys[i], tree->items[i], context, shelf, studio));
  }
}

}  // namespace chiaro::studio::sections
