// SPDX-License-Identifier: Apache-2.0
#include "controller/design/wishes.h"

#include <algorithm>

#include "controller/design/words.h"
#include "controller/measure/picture_terms/picture_term.h"

namespace chiaro::design {
namespace {

Wish wish(Wish::Kind kind, Region::Kind where, double wanted, double weight) {
  Wish wish;
  wish.kind = kind;
  wish.region.kind = where;
  wish.region.words = where == Region::Kind::subject ? "the subject" : "the background";
  wish.wanted = wanted;
  wish.weight = weight;
  return wish;
}

/// `evenness` as in impressions.def.
void add_impression(Wishes& wishes, double weight, double subject, double spread, double background,
                    double evenness, double mired) {
  using enum Wish::Kind;
  wishes.wishes.push_back(wish(lightness, Region::Kind::subject, subject, weight));
  wishes.wishes.push_back(wish(spread_at_most, Region::Kind::subject, spread, weight));
  wishes.wishes.push_back(wish(lightness, Region::Kind::background, background, weight));
  wishes.wishes.push_back(wish(evenness < 0 ? spread_at_least : spread_at_most,
                               Region::Kind::background, std::abs(evenness), weight));
  wishes.warmth_mired += mired;
}

core::Problem unknown_lamp(const std::string& name, const studio::Studio& studio) {
  std::vector<std::string> known;
  std::string list;
  for (const auto& fixture : studio.fixtures) {
    known.push_back(fixture.name);
    list += (list.empty() ? "" : ", ") + fixture.name;
  }
  const std::string near = core::nearest_name(name, known);
  return {{},
          "the studio has no lamp \"" + name + "\"",
          (near.empty() ? "" : "did you mean \"" + near + "\"? ") + "there are: " + list};
}

std::optional<core::Problem> problem_of(const TermShare& share) {
  const measure::terms::PictureTerm* term = measure::terms::picture_term(share.name);
  if (term == nullptr) {
    std::vector<std::string> known;
    std::string list;
    for (const auto& each : measure::terms::picture_terms()) {
      known.emplace_back(each.name);
      list += (list.empty() ? "" : ", ") + known.back();
    }
    const std::string near = core::nearest_name(share.name, known);
    return core::Problem{
        {},
        "no term is called \"" + share.name + "\"",
        (near.empty() ? "" : "did you mean \"" + near + "\"? ") + "there are: " + list};
  }
  if (!share.wanted || term->wanted.contains(*share.wanted)) return std::nullopt;
  return core::Problem{
      {},
      "the term " + share.name + " cannot be wanted at " + number(*share.wanted, 2),
      "give " + number(term->wanted.least, 2) + " to " + number(term->wanted.most, 2) + ": " +
          std::string(term->summary)};
}

double sum_of(const core::Plane& plane) {
  double sum = 0;
  for (const float v : plane.values) sum += double{v};
  return sum;
}

}  // namespace

std::span<const Impression> impressions() {
  static constexpr Impression kImpressions[] = {
#define IMPRESSION(name, summary, subject, spread, background, evenness, mired)    \
  {#name, summary, [](Wishes& wishes, double weight) {                             \
     add_impression(wishes, weight, subject, spread, background, evenness, mired); \
   }},
#include "controller/design/impressions.def"
#undef IMPRESSION
  };
  return kImpressions;
}

bool wants(const Wishes& wishes, std::string_view term) {
  return std::any_of(wishes.terms.begin(), wishes.terms.end(),
                     [&](const TermShare& share) { return share.name == term; });
}

std::string in_words(const Wish& wish) {
  const std::string of = wish.lamp.empty() ? "" : " of " + wish.lamp;
  switch (wish.kind) {
    case Wish::Kind::lightness:
      return "lightness of " + wish.region.words;
    case Wish::Kind::spread_at_most:
    case Wish::Kind::spread_at_least:
      return "spread of lightness over " + wish.region.words;
    case Wish::Kind::no_shadow:
    case Wish::Kind::shadow:
      return "shadow" + of + " on " + wish.region.words;
    case Wish::Kind::highlight:
      return "highlight" + of + " at " + wish.region.words;
  }
  return "";
}

std::string in_words(const Bound& bound) {
  switch (bound.kind) {
    case Bound::Kind::lux_at_least:
      return "at least " + number(bound.limit, 0) + " lx on the face";
    case Bound::Kind::lux_at_most:
      return "at most " + number(bound.limit, 0) + " lx on the face";
    case Bound::Kind::power_at_most:
      return "at most " + number(100 * bound.limit, 0) + " % power";
    case Bound::Kind::level_at_most:
      return bound.lamp + " at most " + number(100 * bound.limit, 0) + " %";
    case Bound::Kind::level_at_least:
      return bound.lamp + " at least " + number(100 * bound.limit, 0) + " %";
  }
  return "";
}

core::Problems problems_of(const Wishes& wishes, const studio::Studio& studio,
                           const Layers& layers) {
  core::Problems problems;
  for (const Bound& bound : wishes.bounds)
    if (!bound.lamp.empty() && !studio.fixture_index(bound.lamp))
      problems.push_back(unknown_lamp(bound.lamp, studio));
  for (const TermShare& share : wishes.terms)
    if (auto problem = problem_of(share)) problems.push_back(*std::move(problem));
  for (const Wish& wish : wishes.wishes) {
    if (!wish.lamp.empty() && !studio.fixture_index(wish.lamp))
      problems.push_back(unknown_lamp(wish.lamp, studio));
    const bool geometric = wish.kind == Wish::Kind::highlight;
    if (geometric && layers.geometry() == nullptr)
      problems.push_back({{},
                          "a highlight needs the subject's shape, and this studio has none",
                          "give the studio file a mesh or a stand-in"});
    else if (sum_of(mask_of(wish.region, studio, layers.geometry(), layers.size())) <= 0)
      problems.push_back({{},
                          in_words(wish) + ": no pixel of it is in the middle square of the main "
                                           "camera's picture, which designs look at",
                          "draw it within that square; 0, 0 is the frame's upper left corner and "
                          "1, 1 its lower right"});
  }
  return problems;
}

}  // namespace chiaro::design
