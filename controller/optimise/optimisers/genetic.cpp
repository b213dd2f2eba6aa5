// SPDX-License-Identifier: Apache-2.0
#include "controller/optimise/optimisers/genetic.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "controller/core/random.h"
#include "controller/optimise/search.h"

namespace chiaro::optimise {
namespace {

constexpr std::size_t kPopulation = 30, kElite = 3;
constexpr double kCrossover = 0.8, kMutation = 0.2;
constexpr double kBlend = 0.5, kMutationWidth = 0.15;

struct Population {
  std::vector<Point> members;
  std::vector<double> values;
};

const Point& selected(const Population& from, core::Random& random) {
  const auto n = static_cast<std::uint32_t>(from.members.size());
  const std::size_t a = random.below(n), b = random.below(n);
  return from.members[from.values[b] < from.values[a] ? b : a];
}

Point child_of(const Population& parents, core::Random& random) {
  Point child = selected(parents, random);
  if (random.uniform() < kCrossover) {
    const Point& other = selected(parents, random);
    for (std::size_t i = 0; i < child.size(); ++i) {
      const double share = random.uniform(-kBlend, 1 + kBlend);
      child[i] = std::clamp(child[i] + share * (other[i] - child[i]), 0.0, 1.0);
    }
  }
  if (random.uniform() < kMutation) {
    double& gene = child[random.below(static_cast<std::uint32_t>(child.size()))];
    gene = std::clamp(gene + kMutationWidth * random.normal(), 0.0, 1.0);
  }
  return child;
}

/// The elite first, then children; the elite keeps its values, so it costs no trials.
Population next_of(const Population& now, core::Random& random) {
  std::vector<std::size_t> order(now.members.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return now.values[a] < now.values[b]; });
  Population next;
  for (std::size_t k = 0; k < std::min(kElite, order.size()); ++k) {
    next.members.push_back(now.members[order[k]]);
    next.values.push_back(now.values[order[k]]);
  }
  while (next.members.size() < kPopulation) next.members.push_back(child_of(now, random));
  return next;
}

class Genetic final : public Optimiser {
 public:
  Outcome minimise(const Task& task) const override {
    const Problem problem(task);
    Ledger ledger(task);
    Record record(problem);
    core::Random random(task.seed, 3);
    Population now;
    for (const Point& start : task.starts) now.members.push_back(problem.unit_of(start));
    while (now.members.size() < kPopulation) {
      Point member(problem.dimension());
      for (double& x : member) x = random.uniform();
      now.members.push_back(std::move(member));
    }
    evaluate_rest(problem, ledger, record, now);
    while (record.left() > 0 && !record.stopped() && problem.dimension() > 0) {
      now = next_of(now, random);
      evaluate_rest(problem, ledger, record, now);
    }
    return record.finish();
  }

 private:
  static void evaluate_rest(const Problem& problem, Ledger& ledger, Record& record,
                            Population& population) {
    const std::size_t known = population.values.size();
    const std::vector<double> values =
        evaluate_all(problem, ledger, record, std::span(population.members).subspan(known));
    population.values.insert(population.values.end(), values.begin(), values.end());
  }
};

}  // namespace

std::unique_ptr<Optimiser> make_genetic() { return std::make_unique<Genetic>(); }

}  // namespace chiaro::optimise
