// SPDX-License-Identifier: Apache-2.0
#include "controller/core/statistics.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace chiaro::core {
namespace {

constexpr double kNormal95 = 1.959963984540054;

/// The regularised incomplete beta function by its continued fraction (Lentz's method).
double incomplete_beta(double a, double b, double x) {
  if (x <= 0) return 0;
  if (x >= 1) return 1;
  if (x > (a + 1) / (a + b + 2)) return 1 - incomplete_beta(b, a, 1 - x);
  const double front = std::exp(std::lgamma(a + b) - std::lgamma(a) - std::lgamma(b) +
                                a * std::log(x) + b * std::log(1 - x)) /
                       a;
  constexpr double kTiny = 1e-300;
  double c = 1, d = 1 - (a + b) * x / (a + 1);
  d = 1 / (std::abs(d) < kTiny ? kTiny : d);
  double fraction = d;
  for (int m = 1; m < 500; ++m) {
    const auto step = [&](double numerator) {
      d = 1 + numerator * d;
      c = 1 + numerator / c;
      d = 1 / (std::abs(d) < kTiny ? kTiny : d);
      c = std::abs(c) < kTiny ? kTiny : c;
      fraction *= d * c;
      return std::abs(d * c - 1) < 1e-14;
    };
    step(m * (b - m) * x / ((a + 2 * m - 1) * (a + 2 * m)));
    if (step(-(a + m) * (a + b + m) * x / ((a + 2 * m) * (a + 2 * m + 1)))) break;
  }
  return front * fraction;
}

/// Two-sided probability of |t| under Student's distribution.
double student_p(double t, double freedom) {
  return incomplete_beta(freedom / 2, 0.5, freedom / (freedom + t * t));
}

/// The t whose two-sided probability is 5 %, by bisection.
double student_95(double freedom) {
  double low = 0, high = 1000;
  for (int i = 0; i < 100; ++i) {
    const double middle = (low + high) / 2;
    (student_p(middle, freedom) > 0.05 ? low : high) = middle;
  }
  return low;
}

}  // namespace

Interval wilson_interval(std::size_t successes, std::size_t trials) {
  if (trials == 0) return {0, 1};
  const double n = static_cast<double>(trials), p = static_cast<double>(successes) / n;
  const double z2 = kNormal95 * kNormal95;
  const double centre = (p + z2 / (2 * n)) / (1 + z2 / n);
  const double half = kNormal95 / (1 + z2 / n) * std::sqrt(p * (1 - p) / n + z2 / (4 * n * n));
  return {successes == 0 ? 0 : centre - half, successes == trials ? 1 : centre + half};
}

double sign_test(std::size_t wins, std::size_t losses) {
  const std::size_t n = wins + losses, fewer = std::min(wins, losses);
  double sum = 0;
  for (std::size_t k = 0; k <= fewer; ++k) {
    const double nn = static_cast<double>(n), kk = static_cast<double>(k);
    sum += std::exp(std::lgamma(nn + 1) - std::lgamma(kk + 1) - std::lgamma(nn - kk + 1) -
                    nn * std::log(2.0));
  }
  return std::min(1.0, 2 * sum);
}

PairedDifference paired_difference(std::span<const double> differences) {
  PairedDifference out;
  out.mean = mean(differences);
  out.interval = {out.mean, out.mean};
  const double n = static_cast<double>(differences.size());
  if (differences.size() < 2) return out;
  const double error = standard_deviation(differences) / std::sqrt(n);
  const double reach = student_95(n - 1) * error;
  out.interval = {out.mean - reach, out.mean + reach};
  if (error > 0)
    out.p = student_p(out.mean / error, n - 1);
  else
    out.p = out.mean == 0 ? 1 : 0;
  return out;
}

double mean(std::span<const double> values) {
  double sum = 0;
  for (const double v : values) sum += v;
  return values.empty() ? 0 : sum / static_cast<double>(values.size());
}

double standard_deviation(std::span<const double> values) {
  if (values.size() < 2) return 0;
  const double m = mean(values);
  double sum = 0;
  for (const double v : values) sum += (v - m) * (v - m);
  return std::sqrt(sum / static_cast<double>(values.size() - 1));
}

double quantile(std::vector<double> values, double share) {
  if (values.empty()) return 0;
  std::sort(values.begin(), values.end());
  const double at = std::clamp(share, 0.0, 1.0) * static_cast<double>(values.size() - 1);
  const auto low = static_cast<std::size_t>(at);
  const std::size_t high = std::min(low + 1, values.size() - 1);
  const double part = at - static_cast<double>(low);
  // Infinities stand for "never": they must not become NaN between themselves.
  if (part == 0 || values[low] == values[high]) return values[low];
  return values[low] + part * (values[high] - values[low]);
}

}  // namespace chiaro::core
