// SPDX-License-Identifier: Apache-2.0
// Readers of single values. Each takes a node that may be absent (null: already reported, or
// optional) and gives the value, or reports what was expected and gives nothing.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "controller/core/colour.h"
#include "controller/core/geometry.h"
#include "controller/core/picture.h"
#include "controller/core/units.h"
#include "controller/studio/reading/quantity.h"
#include "controller/studio/reading/report.h"
#include "controller/studio/reading/tree.h"

namespace chiaro::studio::reading {

/// Nothing in a studio is further away or longer than this, in metres.
inline constexpr double kFar = 1000;

std::optional<double> quantity(const Tree* tree, Measure measure, core::Range bounds,
                               Report& report);
/// A pair [least, most] of quantities, least <= most.
std::optional<core::Range> span(const Tree* tree, Measure measure, core::Range bounds,
                                Report& report);
/// A bare number (a ratio, an f-number, an ISO speed).
std::optional<double> number(const Tree* tree, core::Range bounds, Report& report);
/// A pair [least, most] of bare numbers.
std::optional<core::Range> number_span(const Tree* tree, core::Range bounds, Report& report);
/// 0..1, or per cent: `0.8` or `80 %`.
std::optional<double> fraction(const Tree* tree, Report& report);
std::optional<std::int64_t> whole(const Tree* tree, std::int64_t least, std::int64_t most,
                                  Report& report);
std::optional<bool> yes_or_no(const Tree* tree, Report& report);
/// Any text that is not empty.
std::optional<std::string> text(const Tree* tree, Report& report);
/// [x, y, z] in metres.
std::optional<core::Vec3> point(const Tree* tree, Report& report);
/// A direction: not the zero vector; comes back with length 1.
std::optional<core::Vec3> direction(const Tree* tree, Report& report);
/// [r, g, b] of 0..1, or one number for a grey.
std::optional<core::Rgb> albedo(const Tree* tree, Report& report);
/// `count` bare numbers within bounds.
std::optional<std::vector<double>> numbers(const Tree* tree, std::size_t count, core::Range bounds,
                                           const std::string& expected, Report& report);

/// Index into `words` of the word that stands there.
std::optional<std::size_t> word_among(const Tree* tree, const std::vector<std::string>& words,
                                      Report& report);
template <class T>
std::optional<T> choice(const Tree* tree, const std::vector<std::pair<std::string, T>>& choices,
                        Report& report) {
  std::vector<std::string> words;
  for (const auto& [word, value] : choices) words.push_back(word);
  const auto index = word_among(tree, words, report);
  return index ? std::optional<T>(choices[*index].second) : std::nullopt;
}

/// target = value where there is one; else target keeps its default.
template <class T, class U>
void into(T& target, std::optional<U> value) {
  if (value) target = T(std::move(*value));
}

}  // namespace chiaro::studio::reading
