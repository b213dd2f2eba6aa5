// SPDX-License-Identifier: Apache-2.0
// A study's findings as files and as text: one CSV a table, one SVG a drawing, and record.json,
// which says how to get them again (command, seed, commit, machine).
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "controller/daemon/study/study.h"

namespace chiaro::daemon::study {

/// What is needed to repeat a run and to compare its times.
struct Record {
  std::string study, command;
  Options options;
  int items = 0;
  double seconds = 0;
  std::string started_utc;
};
std::string commit();   ///< the sources that this program was built from
std::string machine();  ///< processor, cores, memory, system, in one line

/// RFC 4180; numbers with the fewest digits that give them back.
std::string to_csv(const Table& table);
/// For a terminal: columns lined up, numbers with four digits.
std::string to_text(const Table& table);
std::string to_text(const Study& study, const Findings& findings, const Record& record);
std::string to_json(const Study& study, const Findings& findings, const Record& record);
/// The claims of several studies in one table.
Table claims_table(const std::vector<Claim>& claims);

/// Makes the folder and writes everything into it.
core::Result<core::Done> write(const std::filesystem::path& folder, const Findings& findings,
                               const Record& record);
core::Result<core::Done> write_text(const std::filesystem::path& file, const std::string& text);

}  // namespace chiaro::daemon::study
