// SPDX-License-Identifier: Apache-2.0
#include "simulator/moods/mood_file.h"

#include <iomanip>
#include <sstream>

namespace chiaro::simulator {
namespace {

std::string quoted(const std::string& text) {
  std::string out = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') out += '\\';
    out += c;
  }
  return out + '"';
}

void put(std::ostream& out, const char* name, const std::optional<double>& value) {
  if (value) out << "  " << name << ": " << *value << '\n';
}

}  // namespace

std::string mood_yaml(const Recipe& recipe, const measure::Targets& targets) {
  std::ostringstream out;
  out.imbue(std::locale::classic());
  out << "# Written by chiaro-draw from recipe.yaml: edit that, and draw again.\n"
      << "title: " << quoted(recipe.title) << "\nsentence: " << quoted(recipe.sentence)
      << "\ntags: [";
  for (std::size_t i = 0; i < recipe.tags.size(); ++i)
    out << (i > 0 ? ", " : "") << quoted(recipe.tags[i]);
  out << "]\nattainable: " << (recipe.attainable ? "true" : "false") << "\ntargets:\n"
      << std::setprecision(5);
  put(out, "edge", targets.edge);
  put(out, "mean", targets.mean);
  put(out, "gradient", targets.gradient);
  put(out, "variance", targets.variance);
  put(out, "contrast", targets.contrast);
  if (!targets.histogram) return out.str();
  out << "  histogram:\n    [" << std::setprecision(4);
  for (std::size_t i = 0; i < targets.histogram->size(); ++i)
    out << (i == 0 ? "" : i % 16 == 0 ? ",\n     " : ", ") << (*targets.histogram)[i];
  out << "]\n";
  return out.str();
}

}  // namespace chiaro::simulator
