// SPDX-License-Identifier: Apache-2.0
// circuits: {socket left: {limit: 2300 W, lamps: {key: 650 W, fill: 300 W}, tungsten: yes}} - lamps
// behind one fuse. Who asks for more than it bears gets all of them dimmed in proportion.
#include <algorithm>

#include "controller/studio/reading/scalars.h"
#include "controller/studio/reading/text.h"
#include "controller/studio/sections/sections.h"

namespace chiaro::studio::sections {

using namespace reading;

namespace {

constexpr core::Range kWatts{0.1, 1e6};

/// A fixture is on one circuit at most.
bool is_wired(const Studio& studio, const Circuit& here, std::size_t fixture) {
  const auto has = [&](const Circuit& circuit) {
    return std::any_of(circuit.loads.begin(), circuit.loads.end(),
                       [&](const Circuit::Load& load) { return load.fixture == fixture; });
  };
  return has(here) || std::any_of(studio.circuits.begin(), studio.circuits.end(), has);
}

void read_load(const Tree::Key& key, const Tree& watts, Circuit& circuit, const Studio& studio,
               Report& report) {
  std::vector<std::string> names;
  for (const Fixture& fixture : studio.fixtures) names.push_back(fixture.name);
  const auto fixture = studio.fixture_index(key.text);
  const auto power = quantity(&watts, Measure::power, kWatts, report);
  if (!fixture) {
    report.error(key, "there is no fixture " + in_quotes(key.text), suggestion(key.text, names));
  } else if (is_wired(studio, circuit, *fixture)) {
    report.error(key, "fixture " + in_quotes(key.text) + " is on another circuit already",
                 "each lamp has one plug: name it once");
  } else if (power) {
    circuit.loads.push_back({*fixture, *power});
  }
}

}  // namespace

void read_circuits(Section& top, Context& context, Studio& studio) {
  const Tree* tree = top.find("circuits");
  if (tree == nullptr) return;
  Report& report = context.report;
  Section section(*tree, "circuits", report);
  for (std::size_t i = 0; section.valid() && i < tree->keys.size(); ++i) {
    section.find(tree->keys[i].text);
    check_name(tree->keys[i], context);
    Section body(tree->items[i], "a circuit", report);
    Circuit circuit{tree->keys[i].text, 0, {}, false, report.place(tree->keys[i])};
    into(circuit.limit_w, quantity(body.need("limit", "2300 W"), Measure::power, kWatts, report));
    into(circuit.tungsten, yes_or_no(body.find("tungsten"), report));
    if (const Tree* lamps = body.need("lamps", "{key: 650 W}")) {
      Section loads(*lamps, "a circuit's lamps", report);
      for (std::size_t j = 0; loads.valid() && j < lamps->keys.size(); ++j)
        read_load(lamps->keys[j], lamps->items[j], circuit, studio, report);
    }
    body.refuse_unknown();
    studio.circuits.push_back(std::move(circuit));
  }
}

}  // namespace chiaro::studio::sections
