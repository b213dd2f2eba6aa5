// SPDX-License-Identifier: Apache-2.0
// The few statistics that a study needs to say how sure it is.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace chiaro::core {

struct Interval {
  double least = 0, most = 1;
};

/// Where a share lies with 95 % confidence when `successes` of `trials` were seen (Wilson 1927):
/// sound for few trials and for shares near 0 and 1. Without trials nothing is known: 0..1.
Interval wilson_interval(std::size_t successes, std::size_t trials);

/// Two-sided exact sign test: the probability of a split at least as uneven as wins : losses when
/// either is as likely. Ties are left out beforehand. On the discordant pairs of a yes/no question
/// it is McNemar's exact test. 1 without pairs.
double sign_test(std::size_t wins, std::size_t losses);

/// Of the differences of pairs: their mean and where it lies with 95 % confidence by Student's t.
/// With fewer than two pairs the interval is the mean itself.
struct PairedDifference {
  double mean = 0;
  Interval interval;
  double p = 1;  ///< two-sided, of a difference at least as large when there is none
};
PairedDifference paired_difference(std::span<const double> differences);

double mean(std::span<const double> values);
/// Of the sample (divided by n - 1); 0 for fewer than two.
double standard_deviation(std::span<const double> values);
/// `share` 0..1 of the sorted values, interpolated between neighbours; 0 without values.
double quantile(std::vector<double> values, double share);
inline double median(std::vector<double> values) { return quantile(std::move(values), 0.5); }

}  // namespace chiaro::core
