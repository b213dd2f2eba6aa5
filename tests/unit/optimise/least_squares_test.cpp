// SPDX-License-Identifier: Apache-2.0
#include "controller/optimise/least_squares.h"

#include <cmath>
#include <gtest/gtest.h>

#include "controller/core/random.h"

namespace chiaro::optimise {
namespace {

struct Case {
  std::vector<double> q, linear;
  std::vector<core::Range> bounds;
};

/// Q = A'A, q = A'b of a random tall A; `twins` makes the last column a copy of the first.
Case random_case(std::size_t n, std::uint64_t seed, bool twins = false) {
  core::Random random(seed);
  const std::size_t rows = 3 * n + 2;
  std::vector<double> a(rows * n), b(rows);
  for (double& v : a) v = random.uniform();
  for (double& v : b) v = random.uniform(-1, 4);
  if (twins)
    for (std::size_t r = 0; r < rows; ++r) a[r * n + n - 1] = a[r * n];
  Case out{std::vector<double>(n * n), std::vector<double>(n), {}};
  for (std::size_t r = 0; r < rows; ++r)
    for (std::size_t j = 0; j < n; ++j) {
      out.linear[j] += a[r * n + j] * b[r];
      for (std::size_t k = 0; k < n; ++k) out.q[j * n + k] += a[r * n + j] * a[r * n + k];
    }
  for (std::size_t j = 0; j < n; ++j) out.bounds.push_back({0, random.uniform(0.2, 1.5)});
  return out;
}

double value(const Case& c, const std::vector<double>& x) {
  double sum = 0;
  const std::size_t n = x.size();
  for (std::size_t j = 0; j < n; ++j) {
    sum -= 2 * c.linear[j] * x[j];
    for (std::size_t k = 0; k < n; ++k) sum += c.q[j * n + k] * x[j] * x[k];
  }
  return sum;
}

/// The optimum's own conditions: no slope inside, slopes outwards at the bounds.
void expect_optimal(const Case& c, const std::vector<double>& x, double tolerance = 1e-9) {
  const std::size_t n = x.size();
  for (std::size_t i = 0; i < n; ++i) {
    ASSERT_TRUE(c.bounds[i].contains(x[i])) << i;
    double g = -c.linear[i];
    for (std::size_t k = 0; k < n; ++k) g += c.q[i * n + k] * x[k];
    const double scale = tolerance * (std::abs(c.linear[i]) + c.q[i * n + i]);
    if (x[i] > c.bounds[i].least) {
      EXPECT_LE(g, scale) << i;
    }
    if (x[i] < c.bounds[i].most) {
      EXPECT_GE(g, -scale) << i;
    }
  }
}

TEST(BoundedLeastSquares, SolvesByHand) {
  // x^2 + y^2 + xy - 2 (4x + y) with x, y in 0..3: free optimum (4, -1) is outside; on y = 0: x =
  // 4, cut to 3; there dy = x/2 + y - 1 = 0.5 > 0, so y = 0 holds... and the least is (3, 0).
  const std::vector<double> x =
      bounded_least_squares(std::vector<double>{1, 0.5, 0.5, 1}, std::vector<double>{4, 1},
                            std::vector<core::Range>{{0, 3}, {0, 3}});
  EXPECT_DOUBLE_EQ(x[0], 3);
  EXPECT_DOUBLE_EQ(x[1], 0);
}

TEST(BoundedLeastSquares, MeetsTheConditionsOfTheOptimumOnRandomProblems) {
  for (std::size_t n = 1; n <= 40; n += n < 8 ? 1 : 6)
    for (std::uint64_t seed = 0; seed < 40; ++seed) {
      SCOPED_TRACE(testing::Message() << n << " variables, seed " << seed);
      const Case c = random_case(n, seed);
      expect_optimal(c, bounded_least_squares(c.q, c.linear, c.bounds));
    }
}

TEST(BoundedLeastSquares, NoRandomPointIsBetter) {
  core::Random random(3);
  const Case c = random_case(6, 11);
  const double best = value(c, bounded_least_squares(c.q, c.linear, c.bounds));
  for (int k = 0; k < 2000; ++k) {
    std::vector<double> x(6);
    for (std::size_t i = 0; i < 6; ++i) x[i] = random.uniform(0, c.bounds[i].most);
    EXPECT_GE(value(c, x), best);
  }
}

TEST(BoundedLeastSquares, TheStartDoesNotMatter) {
  for (std::uint64_t seed = 0; seed < 30; ++seed) {
    const Case c = random_case(7, seed);
    core::Random random(seed + 100);
    std::vector<double> start(7);
    for (double& s : start) s = random.uniform(-1, 3);
    const auto a = bounded_least_squares(c.q, c.linear, c.bounds),
               b = bounded_least_squares(c.q, c.linear, c.bounds, start);
    for (std::size_t i = 0; i < 7; ++i) EXPECT_NEAR(a[i], b[i], 1e-9);
  }
}

TEST(BoundedLeastSquares, EqualAndEmptyColumnsDoNoHarm) {
  for (std::uint64_t seed = 0; seed < 30; ++seed) {
    Case c = random_case(5, seed, true);
    expect_optimal(c, bounded_least_squares(c.q, c.linear, c.bounds), 1e-7);
    for (std::size_t k = 0; k < 5; ++k) c.q[2 * 5 + k] = c.q[k * 5 + 2] = 0;
    c.linear[2] = 0;
    const auto x = bounded_least_squares(c.q, c.linear, c.bounds);
    EXPECT_EQ(x[2], 0) << "a lamp that nobody sees stays dark";
    expect_optimal(c, x, 1e-7);
  }
}

TEST(BoundedLeastSquares, VariablesOfVeryDifferentScale) {
  Case c = random_case(4, 5);
  const double scale[] = {1e-6, 1, 1e6, 1e3};
  for (std::size_t j = 0; j < 4; ++j) {
    c.linear[j] *= scale[j];
    c.bounds[j].most /= scale[j];
    for (std::size_t k = 0; k < 4; ++k) c.q[j * 4 + k] *= scale[j] * scale[k];
  }
  const Case plain = random_case(4, 5);
  const auto x = bounded_least_squares(c.q, c.linear, c.bounds),
             y = bounded_least_squares(plain.q, plain.linear, plain.bounds);
  for (std::size_t j = 0; j < 4; ++j) EXPECT_NEAR(x[j] * scale[j], y[j], 1e-9);
}

TEST(BoundedLeastSquares, FixedVariablesKeepTheirValue) {
  Case c = random_case(4, 9);
  c.bounds[1] = {0.4, 0.4};
  const auto x = bounded_least_squares(c.q, c.linear, c.bounds);
  EXPECT_EQ(x[1], 0.4);
}

TEST(BoundedLeastSquares, NothingToSolveIsSolved) {
  EXPECT_TRUE(bounded_least_squares({}, {}, {}).empty());
}

}  // namespace
}  // namespace chiaro::optimise
