// SPDX-License-Identifier: Apache-2.0
#include "controller/daemon/study/write.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sys/utsname.h>
#include <thread>

namespace chiaro::daemon::study {
namespace {

using nlohmann::json;

std::string number(double value, const char* format) {
  if (!std::isfinite(value)) return "";
  char text[40];
  std::snprintf(text, sizeof text, format, value);
  return text;
}

/// The shortest text that reads back as the same number.
std::string exact(double value) {
  for (const char* format : {"%.6g", "%.9g", "%.17g"}) {
    const std::string text = number(value, format);
    if (text.empty() || std::stod(text) == value) return text;
  }
  return number(value, "%.17g");
}

std::string quoted(const std::string& text) {
  if (text.find_first_of(",\"\n\r") == std::string::npos) return text;
  std::string out = "\"";
  for (const char c : text) out += c == '"' ? "\"\"" : std::string(1, c);
  return out + "\"";
}

/// Columns on a terminal, not bytes: continuation bytes of UTF-8 take no room.
std::size_t width_of(const std::string& text) {
  return static_cast<std::size_t>(std::count_if(text.begin(), text.end(), [](char c) {
    return (static_cast<unsigned char>(c) & 0xC0) != 0x80;
  }));
}

std::string shown(const Cell& cell) {
  if (const auto* text = std::get_if<std::string>(&cell)) return *text;
  const double value = std::get<double>(cell);
  return std::isfinite(value) ? number(value, "%.4g") : "-";
}

json to_json(const Cell& cell) {
  if (const auto* text = std::get_if<std::string>(&cell)) return *text;
  const double value = std::get<double>(cell);
  return std::isfinite(value) ? json(value) : json();
}

std::string line_of(const std::string& file, const std::string& key) {
  std::ifstream in(file);
  for (std::string line; std::getline(in, line);)
    if (line.rfind(key, 0) == 0) {
      const std::size_t at = line.find_first_not_of(": \t", key.size());
      return at == std::string::npos ? "" : line.substr(at);
    }
  return "";
}

json record_json(const Findings& findings, const Record& record) {
  json files = json::array();
  for (const Table& table : findings.tables) files.push_back(table.name + ".csv");
  for (const Drawing& each : findings.drawings) files.push_back(each.name + ".svg");
  for (const Page& each : findings.pages) files.push_back(each.file);
  return {{"study", record.study},
          {"command", record.command},
          {"seed", record.options.seed},
          {"quick", record.options.quick},
          {"items", record.items},
          {"threads", record.options.threads},
          {"started_utc", record.started_utc},
          {"seconds", record.seconds},
          {"commit", commit()},
          {"machine", machine()},
          {"files", files}};
}

std::string met_in_words(const std::optional<bool>& met) {
  return !met ? "" : *met ? "met" : "MISSED";
}

}  // namespace

std::string machine() {
  std::string cpu = line_of("/proc/cpuinfo", "model name");
  if (cpu.empty()) cpu = "unknown processor";
  const std::string memory = line_of("/proc/meminfo", "MemTotal");
  utsname system{};
  uname(&system);
  const double gigabytes = memory.empty() ? 0 : std::stod(memory) / (1024 * 1024);
  return cpu + ", " + std::to_string(std::thread::hardware_concurrency()) + " cores, " +
         number(gigabytes, "%.1f") + " GB, " + system.sysname + " " + system.release;
}

std::string to_csv(const Table& table) {
  std::string out;
  const auto add_row = [&out](const auto& row, const auto& text_of) {
    for (std::size_t k = 0; k < row.size(); ++k)
      out += (k > 0 ? "," : "") + quoted(text_of(row[k]));
    out += "\r\n";
  };
  add_row(table.columns, [](const std::string& name) { return name; });
  for (const auto& row : table.rows)
    add_row(row, [](const Cell& cell) {
      const auto* text = std::get_if<std::string>(&cell);
      return text != nullptr ? *text : exact(std::get<double>(cell));
    });
  return out;
}

std::string to_text(const Table& table) {
  std::vector<std::size_t> widths;
  for (const std::string& name : table.columns) widths.push_back(width_of(name));
  for (const auto& row : table.rows)
    for (std::size_t k = 0; k < row.size() && k < widths.size(); ++k)
      widths[k] = std::max(widths[k], width_of(shown(row[k])));
  std::string out = table.title + "\n";
  const auto add = [&](const std::string& text, std::size_t k, bool last, bool right) {
    const std::string room(widths[k] - std::min(widths[k], width_of(text)), ' ');
    out += "  " + (right ? room + text : last ? text : text + room);
  };
  for (std::size_t k = 0; k < table.columns.size(); ++k) {
    const bool numeric =
        !table.rows.empty() && k < table.rows[0].size() && table.rows[0][k].index() == 1;
    add(table.columns[k], k, k + 1 == table.columns.size(), numeric);
  }
  out += "\n";
  for (const auto& row : table.rows) {
    for (std::size_t k = 0; k < row.size() && k < widths.size(); ++k)
      add(shown(row[k]), k, k + 1 == row.size(), row[k].index() == 1);
    out += "\n";
  }
  return out;
}

Table claims_table(const std::vector<Claim>& claims) {
  Table table{"claims",
              "The thesis beside what was found here",
              {"claim", "thesis", "printed form", "corrected form", "agrees"},
              {}};
  for (const Claim& c : claims)
    table.rows.push_back({c.claim, c.thesis, c.printed, c.corrected,
                          std::string(!c.agrees   ? "cannot tell"
                                      : *c.agrees ? "yes"
                                                  : "NO")});
  return table;
}

std::string to_text(const Study& study, const Findings& findings, const Record& record) {
  std::string out = std::string(study.name) + ": " + std::string(study.sentence) + "\n\n";
  for (const Table& table : findings.tables)
    if (table.shown) out += to_text(table) + "\n";
  if (!findings.bars.empty()) {
    Table bars{"", "Bars", {"what", "found", "wanted", ""}, {}};
    for (const Bar& bar : findings.bars)
      bars.rows.push_back({bar.what, bar.found, bar.wanted, met_in_words(bar.met)});
    out += to_text(bars) + "\n";
  }
  if (!findings.claims.empty()) out += to_text(claims_table(findings.claims)) + "\n";
  for (const std::string& note : findings.notes) out += note + "\n";
  return out + std::to_string(findings.items) + " items in " + number(record.seconds, "%.1f") +
         " s, seed " + std::to_string(record.options.seed) + "\n";
}

std::string to_json(const Study& study, const Findings& findings, const Record& record) {
  json bars = json::array(), claims = json::array(), tables = json::object();
  for (const Bar& bar : findings.bars)
    bars.push_back({{"what", bar.what},
                    {"found", bar.found},
                    {"wanted", bar.wanted},
                    {"met", bar.met ? json(*bar.met) : json()}});
  for (const Claim& c : findings.claims)
    claims.push_back({{"claim", c.claim},
                      {"thesis", c.thesis},
                      {"printed", c.printed},
                      {"corrected", c.corrected},
                      {"agrees", c.agrees ? json(*c.agrees) : json()}});
  for (const Table& table : findings.tables) {
    json rows = json::array();
    for (const auto& row : table.rows) {
      json one = json::array();
      for (const Cell& cell : row) one.push_back(to_json(cell));
      rows.push_back(std::move(one));
    }
    tables[table.name] = {{"columns", table.columns}, {"rows", std::move(rows)}};
  }
  const json out{{"ok", true},
                 {"study", study.name},
                 {"record", record_json(findings, record)},
                 {"bars", bars},
                 {"claims", claims},
                 {"tables", tables},
                 {"notes", findings.notes}};
  return out.dump(2, ' ', false, json::error_handler_t::replace);
}

core::Result<core::Done> write_text(const std::filesystem::path& file, const std::string& text) {
  std::ofstream out(file, std::ios::binary | std::ios::trunc);
  out << text;
  if (!out.flush())
    return core::Problem{{file.string()},
                         "this file cannot be written",
                         "give a folder that you may write in with --out"};
  return core::Done{};
}

core::Result<core::Done> write(const std::filesystem::path& folder, const Findings& findings,
                               const Record& record) {
  std::error_code failed;
  std::filesystem::create_directories(folder, failed);
  core::Problems problems;
  const auto put = [&](const std::string& name, const std::string& text) {
    const auto done = write_text(folder / name, text);
    problems.insert(problems.end(), done.problems().begin(), done.problems().end());
  };
  for (const Table& table : findings.tables) put(table.name + ".csv", to_csv(table));
  for (const Drawing& each : findings.drawings) put(each.name + ".svg", each.svg);
  for (const Page& each : findings.pages) put(each.file, each.text);
  put("record.json", record_json(findings, record).dump(2) + "\n");
  if (!problems.empty()) return problems;
  return core::Done{};
}

}  // namespace chiaro::daemon::study
