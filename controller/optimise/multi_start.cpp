// SPDX-License-Identifier: Apache-2.0
#include "controller/optimise/multi_start.h"

#include <algorithm>
#include <cmath>

namespace chiaro::optimise {
namespace {

constexpr double kSampleShare = 0.2, kSearchShare = 0.6;
constexpr std::uint64_t kMostSamples = 100;  // per variable and round
constexpr double kSeedsApart = 0.1;          // root mean square per variable, unit cube
constexpr std::uint64_t kLocalTrials = 14;   // per variable and local search of the first stage
constexpr std::size_t kMostSearches = 12;
constexpr double kWideStep = 0.12, kFineStep = 0.02;

/// Searches from each seed with an equal share of `budget`, in parallel; the ends in seed order.
std::vector<Run> search_from(const Problem& problem, Ledger& ledger, Record& record,
                             const LocalSearch& local, const std::vector<Point>& seeds,
                             std::uint64_t budget, double step) {
  std::vector<Run> runs(seeds.size(), Run(problem, ledger, 0));
  const std::uint64_t share = std::min(budget, record.left()) / seeds.size();
  for_each_task(problem.task().threads, seeds.size(),
                [&](std::size_t i) { runs[i] = local(problem, ledger, share, seeds[i], step); });
  for (const Run& run : runs) record.absorb(run, true);
  return runs;
}

/// The caller's first start is always among them: it is where the lamps stand, or the last look.
std::vector<Point> chosen(const std::vector<Point>& samples, const std::vector<double>& values,
                          bool keep_first, std::size_t most, const Record& record) {
  std::vector<Point> seeds;
  if (keep_first && std::isfinite(values.front())) seeds.push_back(samples.front());
  for (const std::size_t k : distinct(samples, values, kSeedsApart, most))
    if (seeds.size() < most && (seeds.empty() || samples[k] != seeds.front()))
      seeds.push_back(samples[k]);
  if (seeds.empty()) seeds.push_back(record.best());
  return seeds;
}

void refine(const Problem& problem, Ledger& ledger, Record& record, const LocalSearch& local,
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
  search_from(problem, ledger, record, local, seeds,
              std::max<std::uint64_t>(record.left(), seeds.size()), kFineStep);
}

void round(const Problem& problem, Ledger& ledger, Record& record, const LocalSearch& local,
           bool first, std::uint64_t& sampled) {
  const std::uint64_t budget = record.left(), n = problem.dimension();
  std::vector<Point> samples;
  if (first)
    for (const Point& start : problem.task().starts) samples.push_back(problem.unit_of(start));
  const std::size_t given = samples.size();
  const auto wanted = std::min<std::uint64_t>(
      kMostSamples * n, static_cast<std::uint64_t>(kSampleShare * static_cast<double>(budget)) + 1);
  while (samples.size() < wanted)
    samples.push_back(spread_point(sampled++, n, problem.task().seed));
  const std::vector<double> values = evaluate_all(problem, ledger, record, samples);
  if (record.left() == 0 || record.stopped() || !std::isfinite(record.value())) return;

  const auto share = static_cast<std::uint64_t>(kSearchShare * static_cast<double>(budget));
  const auto searches = std::clamp<std::size_t>(share / (kLocalTrials * n), 1, kMostSearches);
  const std::vector<Point> seeds = chosen(samples, values, given > 0, searches, record);
  const std::vector<Run> runs = search_from(problem, ledger, record, local, seeds,
                                            std::max<std::uint64_t>(share, 1), kWideStep);
  if (record.left() == 0 || record.stopped()) return;
  refine(problem, ledger, record, local, runs);
}

}  // namespace

Outcome multi_start(const Task& task, const LocalSearch& local) {
  const Problem problem(task);
  Ledger ledger(task);
  Record record(problem);
  if (problem.dimension() == 0) return only_point(problem, ledger, record);
  std::uint64_t sampled = 0;
  for (bool first = true; record.left() > 0 && !record.stopped(); first = false)
    round(problem, ledger, record, local, first, sampled);
  return record.finish();
}

}  // namespace chiaro::optimise
