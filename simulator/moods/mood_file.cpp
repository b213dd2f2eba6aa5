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

/// [a, b]
void put_list(std::ostream& out, const std::vector<std::string>& words) {
  out << '[';
  for (std::size_t i = 0; i < words.size(); ++i) out << (i > 0 ? ", " : "") << quoted(words[i]);
  out << ']';
}

void put_words(std::ostream& out, const Recipe& recipe) {
  out << "title: " << quoted(recipe.title) << "\nsentence: " << quoted(recipe.sentence)
      << "\ntags: {";
  const auto& kinds = core::mood_tag_kinds();
  for (std::size_t k = 0; k < kinds.size(); ++k)
    out << (k > 0 ? ", " : "") << kinds[k].name << ": " << quoted(recipe.tags.at(k));
  out << "}\nwords: ";
  put_list(out, recipe.words);
  out << "\nattainable: " << (recipe.attainable ? "true" : "false") << '\n';
}

}  // namespace

std::string mood_yaml(const Recipe& recipe, const Measured& measured) {
  const measure::Targets& targets = measured.targets;
  std::ostringstream out;
  out.imbue(std::locale::classic());
  out << "# Written by chiaro-draw from recipe.yaml: edit that, and draw again.\n";
  put_words(out, recipe);
  out << "sitter_turn: " << core::degrees(recipe.sitter_turn)
      << " deg\nwhite_balance: " << measured.white_balance.value << " K\n"
      << std::fixed << std::setprecision(2);
  if (measured.exposure_stops) out << "exposure: " << *measured.exposure_stops << " stops\n";
  out << std::defaultfloat << "targets:\n" << std::setprecision(5);
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
