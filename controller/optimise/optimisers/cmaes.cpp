// SPDX-License-Identifier: Apache-2.0
#include "controller/optimise/optimisers/cmaes.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <numeric>

#include "controller/core/random.h"
#include "controller/optimise/search.h"

namespace chiaro::optimise {
namespace {

using Vector = Eigen::VectorXd;
using Matrix = Eigen::MatrixXd;

constexpr double kFirstSigma = 0.25, kSmallestSigma = 1e-7;

double mirrored(double x) {
  x = std::fmod(std::abs(x), 2.0);
  return x > 1 ? 2 - x : x;
}

/// One descent of the strategy; names and constants as in Hansen's tutorial.
class Strategy {
 public:
  Strategy(Vector mean, std::size_t lambda, double sigma)
      : n_(mean.size()),
        lambda_(lambda),
        mu_(lambda / 2),
        mean_(std::move(mean)),
        weights_(static_cast<Eigen::Index>(mu_)),
        sigma_(sigma) {
    for (Eigen::Index i = 0; i < weights_.size(); ++i)
      weights_[i] =
          std::log(static_cast<double>(lambda_) / 2 + 0.5) - std::log(static_cast<double>(i) + 1);
    weights_ /= weights_.sum();
    const auto n = static_cast<double>(n_);
    mu_eff_ = 1 / weights_.squaredNorm();
    c_sigma_ = (mu_eff_ + 2) / (n + mu_eff_ + 5);
    d_sigma_ = 1 + 2 * std::max(0.0, std::sqrt((mu_eff_ - 1) / (n + 1)) - 1) + c_sigma_;
    c_c_ = (4 + mu_eff_ / n) / (n + 4 + 2 * mu_eff_ / n);
    c_1_ = 2 / ((n + 1.3) * (n + 1.3) + mu_eff_);
    c_mu_ = std::min(1 - c_1_, 2 * (mu_eff_ - 2 + 1 / mu_eff_) / ((n + 2) * (n + 2) + mu_eff_));
    length_ = std::sqrt(n) * (1 - 1 / (4 * n) + 1 / (21 * n * n));
    path_sigma_ = path_c_ = Vector::Zero(n_);
    covariance_ = axes_ = Matrix::Identity(n_, n_);
    scales_ = Vector::Ones(n_);
  }

  std::vector<Point> sample(core::Random& random) const {
    std::vector<Point> out;
    for (std::size_t k = 0; k < lambda_; ++k) {
      Vector z(n_);
      for (double& x : z) x = random.normal();
      const Vector y = axes_ * scales_.cwiseProduct(z);
      Point point(static_cast<std::size_t>(n_));
      for (Eigen::Index i = 0; i < n_; ++i)
        point[static_cast<std::size_t>(i)] = mirrored(mean_[i] + sigma_ * y[i]);
      out.push_back(std::move(point));
    }
    return out;
  }

  void learn(const std::vector<Point>& points, const std::vector<double>& values) {
    std::vector<std::size_t> order(points.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::stable_sort(order.begin(), order.end(),
                     [&](std::size_t a, std::size_t b) { return values[a] < values[b]; });
    Matrix steps(n_, static_cast<Eigen::Index>(mu_));
    for (std::size_t k = 0; k < mu_; ++k)
      steps.col(static_cast<Eigen::Index>(k)) =
          (Eigen::Map<const Vector>(points[order[k]].data(), n_) - mean_) / sigma_;
    const Vector step = steps * weights_;
    mean_ += sigma_ * step;
    adapt(steps, step);
  }

  bool converged() const { return sigma_ * scales_.maxCoeff() < kSmallestSigma; }

 private:
  void adapt(const Matrix& steps, const Vector& step) {
    const Vector whitened = axes_ * scales_.cwiseInverse().asDiagonal() * axes_.transpose() * step;
    path_sigma_ =
        (1 - c_sigma_) * path_sigma_ + std::sqrt(c_sigma_ * (2 - c_sigma_) * mu_eff_) * whitened;
    ++generation_;
    const double unbiased = std::sqrt(1 - std::pow(1 - c_sigma_, 2 * generation_));
    const bool moving =
        path_sigma_.norm() / unbiased / length_ < 1.4 + 2 / (static_cast<double>(n_) + 1);
    path_c_ *= 1 - c_c_;
    if (moving) path_c_ += std::sqrt(c_c_ * (2 - c_c_) * mu_eff_) * step;
    const double kept = 1 - c_1_ - c_mu_ + (moving ? 0 : c_1_ * c_c_ * (2 - c_c_));
    covariance_ = kept * covariance_ + c_1_ * path_c_ * path_c_.transpose() +
                  c_mu_ * steps * weights_.asDiagonal() * steps.transpose();
    sigma_ *= std::exp(c_sigma_ / d_sigma_ * (path_sigma_.norm() / length_ - 1));
    sigma_ = std::min(sigma_, 1.0);
    const Eigen::SelfAdjointEigenSolver<Matrix> solver(covariance_);
    axes_ = solver.eigenvectors();
    scales_ = solver.eigenvalues().cwiseMax(1e-20).cwiseSqrt();
  }

  Eigen::Index n_;
  std::size_t lambda_, mu_;
  Vector mean_, weights_;
  double sigma_;
  Vector path_sigma_, path_c_, scales_;
  Matrix covariance_, axes_;
  double mu_eff_ = 1, c_sigma_ = 0, d_sigma_ = 1, c_c_ = 0, c_1_ = 0, c_mu_ = 0, length_ = 1;
  int generation_ = 0;
};

/// One of BIPOP's restarts: how many members, how wide a first step, at most how many trials.
struct Restart {
  std::size_t lambda;
  double sigma;
  std::uint64_t trials;
};

/// Hansen 2009: whichever regime has used less goes next. Large populations double each time; small
/// ones draw a size between the first and half the last large one, and a step of 1 to 1/100 of the
/// first, with half the trials of the last large run.
class Bipop {
 public:
  explicit Bipop(std::size_t dimension)
      : first_(
            static_cast<std::size_t>(4 + std::floor(3 * std::log(static_cast<double>(dimension))))),
        large_(first_) {}

  Restart next(core::Random& random) {
    small_turn_ = runs_ > 1 && used_[0] < used_[1];
    if (!small_turn_) {
      if (runs_ > 0) large_ *= 2;
      return {large_, kFirstSigma, std::numeric_limits<std::uint64_t>::max()};
    }
    const double u = random.uniform();
    const double most = 0.5 * static_cast<double>(large_) / static_cast<double>(first_);
    const double size = static_cast<double>(first_) * std::pow(std::max(1.0, most), u * u);
    const double sigma = kFirstSigma * std::pow(10, -2 * random.uniform());
    return {static_cast<std::size_t>(size), sigma, std::max<std::uint64_t>(1, last_large_ / 2)};
  }
  void used(std::uint64_t trials) {
    if (runs_++ > 0) used_[small_turn_ ? 0 : 1] += trials;
    if (!small_turn_) last_large_ = trials;
  }

 private:
  std::size_t first_, large_;
  std::uint64_t used_[2] = {0, 0}, last_large_ = 0;
  int runs_ = 0;
  bool small_turn_ = false;
};

class CmaEs final : public Optimiser {
 public:
  Outcome minimise(const Task& task) const override {
    const Problem problem(task);
    Ledger ledger(task);
    Record record(problem);
    if (problem.dimension() == 0) return only_point(problem, ledger, record);
    Point from = best_start(problem, ledger, record);
    core::Random random(task.seed, 4);
    Bipop restarts(problem.dimension());
    while (record.left() > 0 && !record.stopped()) {
      const std::uint64_t before = record.trials();
      descend(problem, ledger, record, std::move(from), restarts.next(random), random);
      restarts.used(record.trials() - before);
      from.assign(problem.dimension(), 0);
      for (double& x : from) x = random.uniform();
    }
    return record.finish();
  }

 private:
  /// Ends where the distribution has shrunk to a point or the values no longer differ.
  static void descend(const Problem& problem, Ledger& ledger, Record& record, Point from,
                      const Restart& restart, core::Random& random) {
    const std::size_t lambda = restart.lambda;
    Strategy strategy(Eigen::Map<const Vector>(from.data(), static_cast<Eigen::Index>(from.size())),
                      lambda, restart.sigma);
    const std::uint64_t before = record.trials();
    double best = std::numeric_limits<double>::infinity();
    Point at;
    int still = 0;
    const int patience = 20 + static_cast<int>(30 * problem.dimension() / lambda);
    while (record.left() > 0 && !record.stopped() && !strategy.converged() && still < patience &&
           record.trials() - before < restart.trials) {
      const std::vector<Point> points = strategy.sample(random);
      const std::vector<double> values = evaluate_all(problem, ledger, record, points);
      const auto least = std::min_element(values.begin(), values.end());
      const bool gain =
          std::isfinite(*least) && (!std::isfinite(best) || *least < best - 1e-9 * std::abs(best));
      still = gain ? 0 : still + 1;
      if (*least < best) {
        best = *least;
        at = points[static_cast<std::size_t>(least - values.begin())];
      }
      strategy.learn(points, values);
    }
    if (!at.empty()) record.basin(at, best);
  }
};

}  // namespace

std::unique_ptr<Optimiser> make_cmaes() { return std::make_unique<CmaEs>(); }

}  // namespace chiaro::optimise
