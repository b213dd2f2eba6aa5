// SPDX-License-Identifier: Apache-2.0
// The thesis item by item: where each stands in the sources and which tests hold it.
#include <array>
#include <set>

#include "controller/daemon/study/facts.h"
#include "controller/daemon/study/study.h"
#include "controller/daemon/study/tags.h"

namespace chiaro::daemon::study {
namespace {

constexpr std::array<const char*, kThesisItems> kTitles{
    "free variables of a lamp",
    "lamp types and attenuation",
    "how many lamps at once",
    "mesh formats",
    "key light's quarter sphere",
    "object ids per pixel",
    "which faces are visible",
    "edge, surface and background pixels",
    "shadow mask",
    "starts from clustered normals",
    "the objective's weighted sum",
    "weights: setting 45 of 64",
    "ideal targets",
    "Sobel operator",
    "Laplacian",
    "shading gradient",
    "mean",
    "variance",
    "histogram",
    "contrast of parts",
    "RGB to XYZ",
    "L*a*b* and the working scalar",
    "shadow processing",
    "back light",
    "steepest descent",
    "genetic algorithm",
    "simulated annealing",
    "landscapes of the objective",
    "3D and 2D exemplars",
    "tables 4.1 to 4.3",
    "Haar basis",
    "Haar coefficients",
    "wavelet distance",
    "quadtree",
    "chapter 5's curves and coefficients",
    "3D interactive lighting: a spot per object",
    "2D interactive lighting: hide, show, merge",
    "future work: caching, joint lamps, moods",
    "experiment 1: weights",
    "experiment 2: extended against original",
    "experiment 3: wavelet against perceptual",
};

std::string joined(const std::set<std::string>& words, std::size_t most) {
  std::string out;
  std::size_t k = 0;
  for (const std::string& word : words) {
    if (k == most) return out + ", and " + std::to_string(words.size() - most) + " more";
    out += (k++ > 0 ? ", " : "") + word;
  }
  return out;
}

}  // namespace

core::Result<Findings> run_checklist(const Options&, ports::World&) {
  std::array<std::set<std::string>, kThesisItems> owners, tests;
  Table every{"sites", "Every tag", {"item", "file", "test"}, {}, false};
  for (const TagFact& tag : tag_facts()) {
    const auto item = static_cast<std::size_t>(tag.item - 1);
    const std::string file = tag.file, test = tag.test;
    if (!test.empty()) tests[item].insert(test);
    if (file.rfind("tests/", 0) != 0) owners[item].insert(file);
    every.rows.push_back({"I-" + std::to_string(tag.item), file, test});
  }
  Findings findings;
  Table table{"checklist", "The thesis, item by item", {"item", "what", "where", "test"}, {}};
  std::size_t complete = 0;
  for (std::size_t i = 0; i < kThesisItems; ++i) {
    if (!owners[i].empty() && !tests[i].empty()) ++complete;
    table.rows.push_back({"I-" + std::to_string(i + 1), kTitles[i],
                          owners[i].empty() ? "MISSING" : joined(owners[i], 2),
                          tests[i].empty() ? "MISSING" : joined(tests[i], 1)});
  }
  findings.tables = {std::move(table), std::move(every)};
  findings.items = kThesisItems;
  findings.bars.push_back({"items with an owner and a test", std::to_string(complete),
                           std::to_string(kThesisItems), complete == kThesisItems});
  return findings;
}

}  // namespace chiaro::daemon::study
