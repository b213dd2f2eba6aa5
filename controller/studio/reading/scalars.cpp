// SPDX-License-Identifier: Apache-2.0
#include "controller/studio/reading/scalars.h"

#include <cmath>

#include "controller/studio/reading/text.h"

namespace chiaro::studio::reading {
namespace {

std::string name_of(const Tree& tree) {
  return tree.label.empty() ? "this" : in_quotes(tree.label);
}

/// What stands there, for "… is X, expected Y".
std::string seen(const Tree& tree) {
  switch (tree.kind) {
    case Tree::Kind::nothing:
      return "empty";
    case Tree::Kind::scalar:
      return in_quotes(tree.text);
    case Tree::Kind::sequence:
      return "a list of " + std::to_string(tree.items.size());
    case Tree::Kind::mapping:
      return "a section";
  }
  return {};
}

void unexpected(const Tree& tree, const std::string& expected, const std::string& remedy,
                Report& report) {
  report.error(tree, name_of(tree) + " is " + seen(tree) + ", expected " + expected, remedy);
}

std::string unit_remedy(const Tree& tree, const Parsed& parsed, Measure measure) {
  const std::string example(words(measure).example);
  const std::string unit = example.substr(example.find(' ') + 1);
  switch (parsed.why) {
    case Misread::no_unit:
      return "write the unit too: " + std::string(trimmed(tree.text)) + " " + unit;
    case Misread::unknown_unit:
      if (parsed.unit.front() == ',') return "write a point, not a comma, in numbers";
      return "the unit " + in_quotes(parsed.unit) + " is not known, write " + unit;
    case Misread::wrong_unit:
      return in_quotes(parsed.unit) + " is the unit of something else";
    case Misread::not_a_number:
      break;
  }
  return "write a number and its unit";
}

bool within(const Tree& tree, double value, core::Range bounds, const std::string& expected,
            Report& report) {
  if (bounds.contains(value)) return true;
  unexpected(tree, expected, "correct the value", report);
  return false;
}

std::string range_words(core::Range bounds) {
  return digits(bounds.least) + " to " + digits(bounds.most);
}

/// The two items of a list, or null after a report.
const Tree* pair(const Tree* tree, const std::string& expected, Report& report) {
  if (tree == nullptr) return nullptr;
  if (tree->kind == Tree::Kind::sequence && tree->items.size() == 2) return tree->items.data();
  unexpected(*tree, expected, "write two values in brackets, the smaller first", report);
  return nullptr;
}

std::optional<core::Range> ordered(const Tree& tree, std::optional<double> least,
                                   std::optional<double> most, Report& report) {
  if (!least || !most) return std::nullopt;
  if (*least <= *most) return core::Range{*least, *most};
  report.error(tree, "the range of " + name_of(tree) + " runs backwards",
               "write the smaller value first");
  return std::nullopt;
}

}  // namespace

std::optional<double> quantity(const Tree* tree, Measure measure, core::Range bounds,
                               Report& report) {
  if (tree == nullptr) return std::nullopt;
  const auto [noun, example] = words(measure);
  if (tree->kind != Tree::Kind::scalar) {
    unexpected(*tree, std::string(noun), "for example " + std::string(example), report);
    return std::nullopt;
  }
  const Parsed parsed = parse_quantity(tree->text, measure);
  if (!parsed.value) {
    unexpected(*tree, std::string(noun) + " such as " + std::string(example),
               unit_remedy(*tree, parsed, measure), report);
    return std::nullopt;
  }
  const std::string expected =
      written(measure, bounds.least) + " to " + written(measure, bounds.most);
  if (!within(*tree, *parsed.value, bounds, expected, report)) return std::nullopt;
  return parsed.value;
}

std::optional<core::Range> span(const Tree* tree, Measure measure, core::Range bounds,
                                Report& report) {
  const std::string example(words(measure).example);
  const Tree* items = pair(tree, "a range such as [" + example + ", …]", report);
  if (items == nullptr) return std::nullopt;
  const auto least = quantity(items, measure, bounds, report);
  return ordered(*tree, least, quantity(items + 1, measure, bounds, report), report);
}

std::optional<double> number(const Tree* tree, core::Range bounds, Report& report) {
  if (tree == nullptr) return std::nullopt;
  const auto value =
      tree->kind == Tree::Kind::scalar && !tree->quoted ? parse_number(tree->text) : std::nullopt;
  const std::string expected = "a number, " + range_words(bounds);
  if (!value) {
    unexpected(*tree, expected, "write a plain number here", report);
    return std::nullopt;
  }
  return within(*tree, *value, bounds, expected, report) ? value : std::nullopt;
}

std::optional<core::Range> number_span(const Tree* tree, core::Range bounds, Report& report) {
  const Tree* items = pair(tree, "a range of two numbers", report);
  if (items == nullptr) return std::nullopt;
  const auto least = number(items, bounds, report);
  return ordered(*tree, least, number(items + 1, bounds, report), report);
}

std::optional<double> fraction(const Tree* tree, Report& report) {
  if (tree == nullptr) return std::nullopt;
  std::optional<double> value;
  if (tree->kind == Tree::Kind::scalar) {
    const std::string_view written = trimmed(tree->text);
    if (!written.empty() && written.back() == '%') {
      value = parse_number(trimmed(written.substr(0, written.size() - 1)));
      if (value) *value /= 100;
    } else {
      value = parse_number(written);
    }
  }
  const std::string expected = "a share of full, 0 to 1 or 0 % to 100 %";
  if (!value) {
    unexpected(*tree, expected, "for example 0.8 or 80 %", report);
    return std::nullopt;
  }
  return within(*tree, *value, {0, 1}, expected, report) ? value : std::nullopt;
}

std::optional<std::int64_t> whole(const Tree* tree, std::int64_t least, std::int64_t most,
                                  Report& report) {
  if (tree == nullptr) return std::nullopt;
  const auto value =
      tree->kind == Tree::Kind::scalar && !tree->quoted ? parse_number(tree->text) : std::nullopt;
  const std::string expected =
      "a whole number, " + std::to_string(least) + " to " + std::to_string(most);
  if (!value || *value != std::floor(*value)) {
    unexpected(*tree, expected, "write a whole number without a unit", report);
    return std::nullopt;
  }
  const core::Range bounds{static_cast<double>(least), static_cast<double>(most)};
  if (!within(*tree, *value, bounds, expected, report)) return std::nullopt;
  return static_cast<std::int64_t>(*value);
}

std::optional<bool> yes_or_no(const Tree* tree, Report& report) {
  return choice<bool>(tree, {{"yes", true}, {"no", false}, {"true", true}, {"false", false}},
                      report);
}

std::optional<std::string> text(const Tree* tree, Report& report) {
  if (tree == nullptr) return std::nullopt;
  if (tree->kind == Tree::Kind::scalar && !trimmed(tree->text).empty())
    return std::string(trimmed(tree->text));
  unexpected(*tree, "a word or a line of text", "write it after the colon", report);
  return std::nullopt;
}

std::optional<std::vector<double>> numbers(const Tree* tree, std::size_t count, core::Range bounds,
                                           const std::string& expected, Report& report) {
  if (tree == nullptr) return std::nullopt;
  if (tree->kind != Tree::Kind::sequence || tree->items.size() != count) {
    unexpected(*tree, expected, "write " + std::to_string(count) + " numbers in brackets", report);
    return std::nullopt;
  }
  std::vector<double> values;
  for (const Tree& item : tree->items)
    if (const auto value = number(&item, bounds, report)) values.push_back(*value);
  return values.size() == count ? std::optional(values) : std::nullopt;
}

std::optional<core::Vec3> point(const Tree* tree, Report& report) {
  const auto v = numbers(tree, 3, {-kFar, kFar}, "a place [x, y, z] in metres", report);
  return v ? std::optional(core::Vec3{(*v)[0], (*v)[1], (*v)[2]}) : std::nullopt;
}

std::optional<core::Vec3> direction(const Tree* tree, Report& report) {
  const auto v = numbers(tree, 3, {-kFar, kFar}, "a direction [x, y, z]", report);
  if (!v) return std::nullopt;
  const core::Vec3 towards{(*v)[0], (*v)[1], (*v)[2]};
  if (length(towards) > 1e-9) return unit(towards);
  report.error(*tree, name_of(*tree) + " is [0, 0, 0], which points nowhere",
               "for example [0, 0, 1] for straight up");
  return std::nullopt;
}

std::optional<core::Rgb> albedo(const Tree* tree, Report& report) {
  if (tree != nullptr && tree->kind == Tree::Kind::scalar) {
    const auto grey = number(tree, {0, 1}, report);
    return grey ? std::optional(core::Rgb{*grey, *grey, *grey}) : std::nullopt;
  }
  const auto v = numbers(tree, 3, {0, 1}, "a colour [red, green, blue] of 0 to 1", report);
  return v ? std::optional(core::Rgb{(*v)[0], (*v)[1], (*v)[2]}) : std::nullopt;
}

std::optional<std::size_t> word_among(const Tree* tree, const std::vector<std::string>& words,
                                      Report& report) {
  if (tree == nullptr) return std::nullopt;
  if (tree->kind == Tree::Kind::scalar)
    for (std::size_t i = 0; i < words.size(); ++i)
      if (words[i] == trimmed(tree->text)) return i;
  const std::string word = tree->kind == Tree::Kind::scalar ? tree->text : "";
  const std::string nearest = core::nearest_name(word.substr(0, 100), words);
  unexpected(*tree, any_of(words),
             nearest.empty() ? "choose one of these" : "did you mean " + in_quotes(nearest) + "?",
             report);
  return std::nullopt;
}

}  // namespace chiaro::studio::reading
