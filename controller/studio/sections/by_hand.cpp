// SPDX-License-Identifier: Apache-2.0
// by_hand: {intensity: knob, cct: {gel: [3200 K, 5600 K]}} - what a person sets on the lamp. A
// stand's place is by hand without saying so.
#include <algorithm>

#include "controller/studio/reading/scalars.h"
#include "controller/studio/reading/text.h"
#include "controller/studio/sections/sections.h"

namespace chiaro::studio::sections {

using namespace reading;

namespace {

using core::Dof;

const std::vector<std::string> kKinds{"knob", "gel", "flash_power"};

bool goes_with(Dof dof, HandKind kind) {
  switch (kind) {
    case HandKind::gel:
      return dof == Dof::cct || dof == Dof::tint;
    case HandKind::flash_power:
      return dof == Dof::intensity;
    case HandKind::knob:
      return !core::is_placement(dof) || dof == Dof::zoom;
    case HandKind::stand:
      return core::is_placement(dof);
  }
  return false;
}

std::optional<core::Range> read_range(const Tree& body, Dof dof, Report& report) {
  switch (core::info(dof).unit) {
    case core::Unit::kelvin:
      return span(&body, Measure::temperature, {1000, 25000}, report);
    case core::Unit::degrees:
      return span(&body, Measure::angle, {0, core::kPi}, report);
    default:
      return number_span(&body, {-50, 50}, report);
  }
}

std::optional<HandBinding> read_binding(const Tree::Key& key, const Tree& tree,
                                        const Fixture& fixture, Report& report) {
  const auto dof = core::dof_named(key.text);
  if (!dof || core::info(*dof).name != key.text) {
    std::vector<std::string> names;
    for (const core::DofInfo& each : core::dofs()) names.emplace_back(each.name);
    report.error(key, in_quotes(key.text) + " is nothing that a lamp has",
                 suggestion(key.text, names));
    return std::nullopt;
  }
  const auto kind = variant(&tree, "a way of setting by hand", kKinds, report);
  if (!kind) return std::nullopt;
  HandBinding binding{*dof, static_cast<HandKind>(kind->index), std::nullopt};
  if (!goes_with(*dof, binding.kind)) {
    report.error(tree, in_quotes(kKinds[kind->index]) + " does not set " + in_quotes(key.text),
                 "knob sets light, colour or zoom, gel cct or tint, flash_power intensity");
    return std::nullopt;
  }
  if (kind->body != nullptr) binding.range = read_range(*kind->body, *dof, report);
  if (!binding.range && !profiles::own_range(fixture.profile, *dof))
    report.error(tree, "this lamp has no range of " + in_quotes(key.text) + " of its own",
                 "give one, for example cct: {gel: [3200 K, 5600 K]}");
  return binding;
}

}  // namespace

std::vector<HandBinding> read_by_hand(const Tree* tree, const Fixture& fixture, Context& context) {
  std::vector<HandBinding> bindings;
  if (std::holds_alternative<StandMount>(fixture.mount))
    for (const Dof dof : {Dof::azimuth, Dof::elevation, Dof::distance})
      bindings.push_back({dof, HandKind::stand, std::nullopt});
  if (tree == nullptr) return bindings;
  Section section(*tree, "by_hand", context.report);
  for (std::size_t i = 0; i < tree->keys.size(); ++i)
    if (auto binding = read_binding(tree->keys[i], tree->items[i], fixture, context.report))
      bindings.push_back(*binding);
  return bindings;
}

}  // namespace chiaro::studio::sections
