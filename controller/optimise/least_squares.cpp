// SPDX-License-Identifier: Apache-2.0
#include "controller/optimise/least_squares.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <cstdint>

namespace chiaro::optimise {
namespace {

/// Up to this many variables nothing but the answer is allocated.
constexpr std::size_t kSmall = 32;
/// Relative to each diagonal: keeps equal columns from making the system singular.
constexpr double kRidge = 1e-12;
constexpr int kSweeps = 4;

template <class T>
class Scratch {
 public:
  explicit Scratch(std::size_t n) {
    if (n > kStack) heap_.resize(n), data_ = heap_.data();
  }
  Scratch(const Scratch&) = delete;
  Scratch& operator=(const Scratch&) = delete;
  T& operator[](std::size_t i) { return data_[i]; }

 private:
  static constexpr std::size_t kStack = kSmall * kSmall;
  T stack_[kStack];
  std::vector<T> heap_;
  T* data_ = stack_;
};

/// x'Qx - 2q'x in a box: coordinate descent finds nearly all active bounds, then an active-set
/// method with Cholesky ends exactly. The gradient (halved) is kept up to date throughout.
class BoxProblem {
 public:
  BoxProblem(std::span<const double> q_matrix, std::span<const double> q_vector,
             std::span<const core::Range> bounds, std::span<double> x)
      : n_(x.size()),
        q_(q_matrix),
        linear_(q_vector),
        bounds_(bounds),
        x_(x),
        gradient_(n_),
        step_(n_),
        factor_(n_ * n_),
        free_(n_),
        held_(n_) {
    for (std::size_t i = 0; i < n_; ++i) refresh(i);
  }

  void solve() {
    for (int k = 0; k < kSweeps; ++k) sweep();
    for (std::size_t i = 0; i < n_; ++i) held_[i] = at_bound(i);
    // Each round fixes one variable more, or ends on the optimum of a face, which never returns.
    const std::size_t most = 20 * n_ + 50;
    for (std::size_t round = 0; round < most; ++round) {
      const bool whole = step_on_face();
      for (std::size_t i = 0; i < n_; ++i) refresh(i);
      if (whole && !release()) return;
    }
  }

 private:
  double diagonal(std::size_t i) const { return q_[i * n_ + i] * (1 + kRidge); }
  bool idle(std::size_t i) const { return !(q_[i * n_ + i] > 0) || bounds_[i].width() <= 0; }
  bool at_bound(std::size_t i) const {
    return idle(i) || x_[i] <= bounds_[i].least || x_[i] >= bounds_[i].most;
  }

  void refresh(std::size_t i) {
    double g = -linear_[i];
    for (std::size_t k = 0; k < n_; ++k) g += q_[i * n_ + k] * x_[k];
    gradient_[i] = g;
  }

  void sweep() {
    for (std::size_t i = 0; i < n_; ++i) {
      if (idle(i)) continue;
      const double to = bounds_[i].clamp(x_[i] - gradient_[i] / diagonal(i));
      const double moved = to - x_[i];
      if (moved == 0) continue;
      x_[i] = to;
      for (std::size_t k = 0; k < n_; ++k) gradient_[k] += q_[k * n_ + i] * moved;
    }
  }

  /// Newton step over the variables that are not held, cut where it meets the box. True when it was
  /// taken whole.
  bool step_on_face() {
    std::size_t m = 0;
    for (std::size_t i = 0; i < n_; ++i)
      if (!held_[i]) free_[m++] = i;
    if (m == 0) return true;
    factorise(m);
    solve_step(m);
    double share = 1;
    std::size_t blocking = n_;
    for (std::size_t a = 0; a < m; ++a) {
      const std::size_t i = free_[a];
      const double room = (step_[a] > 0 ? bounds_[i].most : bounds_[i].least) - x_[i];
      if (std::abs(step_[a]) * share > std::abs(room)) {
        share = room / step_[a];
        blocking = i;
      }
    }
    for (std::size_t a = 0; a < m; ++a)
      x_[free_[a]] = bounds_[free_[a]].clamp(x_[free_[a]] + share * step_[a]);
    if (blocking == n_) return true;
    const core::Range& b = bounds_[blocking];
    x_[blocking] = x_[blocking] - b.least < b.most - x_[blocking] ? b.least : b.most;
    held_[blocking] = 1;
    return false;
  }

  void factorise(std::size_t m) {
    for (std::size_t a = 0; a < m; ++a) {
      for (std::size_t b = 0; b <= a; ++b) {
        double sum = a == b ? diagonal(free_[a]) : q_[free_[a] * n_ + free_[b]];
        for (std::size_t k = 0; k < b; ++k) sum -= factor_[a * n_ + k] * factor_[b * n_ + k];
        if (a == b)
          factor_[a * n_ + a] = std::sqrt(std::max(sum, kRidge * diagonal(free_[a])));
        else
          factor_[a * n_ + b] = sum / factor_[b * n_ + b];
      }
    }
  }

  void solve_step(std::size_t m) {
    for (std::size_t a = 0; a < m; ++a) {
      double sum = -gradient_[free_[a]];
      for (std::size_t k = 0; k < a; ++k) sum -= factor_[a * n_ + k] * step_[k];
      step_[a] = sum / factor_[a * n_ + a];
    }
    for (std::size_t a = m; a-- > 0;) {
      double sum = step_[a];
      for (std::size_t k = a + 1; k < m; ++k) sum -= factor_[k * n_ + a] * step_[k];
      step_[a] = sum / factor_[a * n_ + a];
    }
  }

  /// Lets go of the held variable that gains most by leaving its bound. False: the optimum.
  bool release() {
    std::size_t best = n_;
    double most = 0;
    for (std::size_t i = 0; i < n_; ++i) {
      if (!held_[i] || idle(i)) continue;
      const bool inwards = x_[i] <= bounds_[i].least ? gradient_[i] < 0 : gradient_[i] > 0;
      const double gain = inwards ? gradient_[i] * gradient_[i] / diagonal(i) : 0;
      // Rounding of the gradient must not make a variable bounce for ever.
      const double noise = 1e-13 * (std::abs(linear_[i]) + diagonal(i) * bounds_[i].width());
      if (gain > most && std::abs(gradient_[i]) > noise) most = gain, best = i;
    }
    if (best == n_) return false;
    held_[best] = 0;
    return true;
  }

  std::size_t n_;
  std::span<const double> q_, linear_;
  std::span<const core::Range> bounds_;
  std::span<double> x_;
  Scratch<double> gradient_, step_, factor_;
  Scratch<std::size_t> free_;
  Scratch<std::uint8_t> held_;
};

}  // namespace

std::vector<double> bounded_least_squares(std::span<const double> q_matrix,
                                          std::span<const double> q_vector,
                                          std::span<const core::Range> bounds,
                                          std::span<const double> start) {
  const std::size_t n = q_vector.size();
  assert(q_matrix.size() == n * n && bounds.size() == n && (start.empty() || start.size() == n));
  std::vector<double> x(n);
  for (std::size_t i = 0; i < n; ++i)
    x[i] = start.empty() ? bounds[i].least : bounds[i].clamp(start[i]);
  BoxProblem(q_matrix, q_vector, bounds, x).solve();
  return x;
}

}  // namespace chiaro::optimise
