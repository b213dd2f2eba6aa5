// SPDX-License-Identifier: Apache-2.0
#include "controller/measure/terms/term.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "controller/measure/terms/contrast.h"
#include "controller/measure/terms/edge.h"
#include "controller/measure/terms/gradient.h"
#include "controller/measure/terms/histogram.h"
#include "controller/measure/terms/mean.h"
#include "controller/measure/terms/variance.h"

namespace chiaro::measure {
namespace terms {

std::span<const Term> all() {
  static constexpr Term kTerms[] = {
#define TERM(name, summary) {#name, summary, name##_example, name##_ideal, &TermWeights::name},
#include "controller/measure/terms.def"
#undef TERM
  };
  return kTerms;
}

double relative_difference(double now, double wanted) {
  const double larger = std::max(now, wanted);
  return larger > 0 ? std::abs(now - wanted) / larger : 0;
}

double spanned_difference(double now, double wanted, double most) {
  return std::abs(now - wanted) / std::max(wanted, most - wanted);
}

}  // namespace terms

/// The objective of the thesis, all six terms [I-11].
double perceptual_cost(const Components& now, const Targets& wanted, const TermWeights& weights) {
  double sum = 0;
  for (const terms::Term& term : terms::all())
    sum += weights.*term.weight * term.example(now, wanted, weights).value_or(0);
  return sum;
}

double ideal_cost(const Components& now, const IdealTargets& wanted, const TermWeights& weights) {
  double sum = 0;
  for (const terms::Term& term : terms::all())
    sum += weights.*term.weight * term.ideal(now, wanted, weights);
  return sum;
}

}  // namespace chiaro::measure
