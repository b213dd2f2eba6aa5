// SPDX-License-Identifier: Apache-2.0
#include "controller/daemon/bench/report.h"

#include <cmath>
#include <cstdio>
#include <nlohmann/json.hpp>

namespace chiaro::daemon::bench {
namespace {

std::string number(double value) {
  if (!std::isfinite(value)) return "not reached";
  char text[32];
  const double size = std::abs(value);
  std::snprintf(text, sizeof text, size >= 100 ? "%.0f" : size >= 10 ? "%.1f" : "%.3g", value);
  return text;
}

bool met(const Figure& f) {
  return (!f.bar.most || f.value <= *f.bar.most) && (!f.bar.least || f.value >= *f.bar.least);
}

std::string bar_in_words(const Figure& f) {
  if (!f.bar.most && !f.bar.least) return "";
  return (f.bar.most ? "at most " + number(*f.bar.most) : "at least " + number(*f.bar.least)) +
         (met(f) ? ", met" : ", MISSED");
}

}  // namespace

void Report::add(std::string name, double value, std::string unit, Bar bar, std::string note) {
  figures_.push_back({heading_, std::move(name), value, std::move(unit), bar, std::move(note)});
}

std::string Report::to_text() const {
  std::string text, heading;
  for (const Figure& f : figures_) {
    if (f.heading != heading) text += (heading.empty() ? "" : "\n") + f.heading + "\n";
    heading = f.heading;
    char line[256];
    std::snprintf(line, sizeof line, "  %-44s %11s %-6s %-22s %s", f.name.c_str(),
                  number(f.value).c_str(), f.unit.c_str(), bar_in_words(f).c_str(), f.note.c_str());
    std::string shown = line;
    text += shown.substr(0, shown.find_last_not_of(' ') + 1) + "\n";
  }
  return text;
}

std::string Report::to_json(const std::string& studio, bool quick) const {
  using nlohmann::json;
  json figures = json::array();
  for (const Figure& f : figures_) {
    json entry{{"heading", f.heading},
               {"name", f.name},
               {"value", std::isfinite(f.value) ? json(f.value) : json()},
               {"unit", f.unit},
               {"note", f.note}};
    if (f.bar.most) entry["at_most"] = *f.bar.most;
    if (f.bar.least) entry["at_least"] = *f.bar.least;
    if (f.bar.most || f.bar.least) entry["met"] = met(f);
    figures.push_back(std::move(entry));
  }
  return json{{"ok", true}, {"studio", studio}, {"quick", quick}, {"figures", figures}}.dump(
      2, ' ', false, json::error_handler_t::replace);
}

}  // namespace chiaro::daemon::bench
