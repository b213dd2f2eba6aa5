// SPDX-License-Identifier: Apache-2.0
#include "controller/optimise/optimisers/sbplx.h"

#include <algorithm>
#include <cmath>
#include <nlopt.h>

#include "controller/optimise/search.h"

namespace chiaro::optimise {
namespace {

/// NLopt's simplex compares and subtracts values: infeasible must be large, not infinite.
constexpr double kInfeasible = 1e30;
constexpr double kSampleShare = 0.2, kSearchShare = 0.6;
constexpr std::uint64_t kMostSamples = 100;  // per variable and round
constexpr double kSeedsApart = 0.1;          // root mean square per variable, unit cube
constexpr std::uint64_t kLocalTrials = 14;   // per variable and local search of the first stage
constexpr std::size_t kMostSearches = 12;
constexpr double kWideStep = 0.12, kFineStep = 0.02;

struct Local {
  Run run;
  nlopt_opt optimiser;
};

double evaluate(unsigned n, const double* x, double*, void* data) {
  auto& local = *static_cast<Local*>(data);
  const double value = local.run.evaluate({x, n});
  if (local.run.over()) nlopt_force_stop(local.optimiser);
  return std::min(value, kInfeasible);
}

Run local_search(const Problem& problem, Ledger& ledger, std::uint64_t budget, Point from,
                 double step) {
  const auto n = static_cast<unsigned>(problem.dimension());
  Local local{Run(problem, ledger, budget), nlopt_create(NLOPT_LN_SBPLX, n)};
  nlopt_set_min_objective(local.optimiser, evaluate, &local);
  nlopt_set_lower_bounds1(local.optimiser, 0);
  nlopt_set_upper_bounds1(local.optimiser, 1);
  nlopt_set_initial_step1(local.optimiser, step);
  nlopt_set_xtol_abs1(local.optimiser, 1e-6);
  nlopt_set_ftol_rel(local.optimiser, 1e-9);
  nlopt_set_maxeval(local.optimiser, static_cast<int>(std::min<std::uint64_t>(budget, 1u << 30)));
  double value = 0;
  nlopt_optimize(local.optimiser, from.data(), &value);
  nlopt_destroy(local.optimiser);
  return std::move(local.run);
}

/// Searches from each seed with an equal share of `budget`, in parallel; the ends in seed order.
std::vector<Run> search_from(const Problem& problem, Ledger& ledger, Record& record,
                             const std::vector<Point>& seeds, std::uint64_t budget, double step) {
  std::vector<Run> runs(seeds.size(), Run(problem, ledger, 0));
  const std::uint64_t share = std::min(budget, record.left()) / seeds.size();
  for_each_task(problem.task().threads, seeds.size(), [&](std::size_t i) {
    runs[i] = local_search(problem, ledger, share, seeds[i], step);
  });
  for (const Run& run : runs) record.absorb(run, true);
  return runs;
}

class Sbplx final : public Optimiser {
 public:
  Outcome minimise(const Task& task) const override {
    const Problem problem(task);
    Ledger ledger(task);
    Record record(problem);
    if (problem.dimension() == 0) {
      evaluate_all(problem, ledger, record, std::vector<Point>{{}});
      return record.finish();
    }
    std::uint64_t sampled = 0;
    for (bool first = true; record.left() > 0 && !record.stopped(); first = false)
      round(problem, ledger, record, first, sampled);
    return record.finish();
  }

 private:
  static void round(const Problem& problem, Ledger& ledger, Record& record, bool first,
                    std::uint64_t& sampled) {
    const std::uint64_t budget = record.left(), n = problem.dimension();
    std::vector<Point> samples;
    if (first)
      for (const Point& start : problem.task().starts) samples.push_back(problem.unit_of(start));
    const std::size_t given = samples.size();
    const auto wanted = std::min<std::uint64_t>(
        kMostSamples * n,
        static_cast<std::uint64_t>(kSampleShare * static_cast<double>(budget)) + 1);
    while (samples.size() < wanted)
      samples.push_back(spread_point(sampled++, n, problem.task().seed));
    const std::vector<double> values = evaluate_all(problem, ledger, record, samples);
    if (record.left() == 0 || record.stopped() || !std::isfinite(record.value())) return;

    const auto share = static_cast<std::uint64_t>(kSearchShare * static_cast<double>(budget));
    const auto searches = std::clamp<std::size_t>(share / (kLocalTrials * n), 1, kMostSearches);
    const std::vector<Point> seeds = chosen(samples, values, given > 0, searches, record);
    const std::vector<Run> runs =
        search_from(problem, ledger, record, seeds, std::max<std::uint64_t>(share, 1), kWideStep);
    if (record.left() == 0 || record.stopped()) return;
    refine(problem, ledger, record, runs);
  }

  /// The caller's first start is always among them: it is where the lamps stand, or the last look.
  static std::vector<Point> chosen(const std::vector<Point>& samples,
                                   const std::vector<double>& values, bool keep_first,
                                   std::size_t most, const Record& record) {
    std::vector<Point> seeds;
    if (keep_first && std::isfinite(values.front())) seeds.push_back(samples.front());
    for (const std::size_t k : distinct(samples, values, kSeedsApart, most))
      if (seeds.size() < most && (seeds.empty() || samples[k] != seeds.front()))
        seeds.push_back(samples[k]);
    if (seeds.empty()) seeds.push_back(record.best());
    return seeds;
  }

  static void refine(const Problem& problem, Ledger& ledger, Record& record,
                     const std::vector<Run>& runs) {
    std::vector<Point> ends;
    std::vector<double> values;
    for (const Run& run : runs) {
      if (run.used() == 0) continue;
      ends.push_back(run.best());
      values.push_back(run.value());
    }
    std::vector<Point> seeds;
    const std::size_t most = std::max<std::size_t>(1, runs.size() / 4);
    for (const std::size_t k : distinct(ends, values, kSeedsApart / 3, most))
      seeds.push_back(ends[k]);
    if (seeds.empty()) seeds.push_back(record.best());
    search_from(problem, ledger, record, seeds,
                std::max<std::uint64_t>(record.left(), seeds.size()), kFineStep);
  }
};

}  // namespace

std::unique_ptr<Optimiser> make_sbplx() { return std::make_unique<Sbplx>(); }

}  // namespace chiaro::optimise
