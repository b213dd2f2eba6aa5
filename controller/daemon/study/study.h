// SPDX-License-Identifier: Apache-2.0
// What every study of `chiaro study` is: a name, one sentence, and a function from options to
// findings. Writing them down (CSV, SVG, record) is done once, for all of them, in write.h.
// studies.def lists the studies, one file each in studies/; contract tests run over every line.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "controller/core/plot.h"
#include "controller/core/result.h"
#include "controller/ports/world.h"

namespace chiaro::daemon::study {

struct Options {
  std::uint64_t seed = 1;
  bool quick = false;  ///< a look, not a record: small pictures, few items
  int items = 0;       ///< how many of whatever the study counts; 0 = its own number
  int threads = 2;
  std::string assets;  ///< folder of meshes and photographs from packages; empty: none

  int items_or(int whole, int few) const { return items > 0 ? items : quick ? few : whole; }
};

/// A table as it is written to NAME.csv and, where `shown`, printed for people.
using Cell = std::variant<std::string, double>;
struct Table {
  std::string name, title;
  std::vector<std::string> columns;  ///< with their units: "angle_deg"
  std::vector<std::vector<Cell>> rows{};
  bool shown = true;
};

/// A picture of numbers, written to NAME.svg.
struct Drawing {
  std::string name, svg;
};
/// A page for a browser, pictures within, written as it is.
struct Page {
  std::string file, text;
};
Drawing drawing(std::string name, const core::Plot& plot);
Drawing drawing(std::string name, const core::Landscape& landscape);

/// Something that was asked for and whether it was found. `met` is empty where nothing is asked.
struct Bar {
  std::string what, found, wanted;
  std::optional<bool> met{};
};

/// One row of the table that sets the thesis beside what was found here.
struct Claim {
  std::string claim, thesis;       ///< what it says and its number, "-" where it gives none
  std::string printed, corrected;  ///< what its form as printed and the corrected one give here
  std::optional<bool> agrees{};    ///< empty: cannot be told from this run
};

struct Findings {
  std::vector<Bar> bars;
  std::vector<Table> tables;
  std::vector<Drawing> drawings;
  std::vector<Page> pages;
  std::vector<Claim> claims;
  std::vector<std::string> notes;
  int items = 0;  ///< how many were looked at
};

/// Long ones look at world.stop and then give what they have; progress goes to world.err.
using Run = core::Result<Findings> (*)(const Options& options, ports::World& world);

struct Study {
  std::string_view name, sentence;
  Run run;
};
std::span<const Study> studies();

#define STUDY(name, sentence) \
  core::Result<Findings> run_##name(const Options& options, ports::World& world);
#include "controller/daemon/study/studies.def"
#undef STUDY

}  // namespace chiaro::daemon::study
