// SPDX-License-Identifier: Apache-2.0
// Figures 3.8 and 3.10 [I-28]: the objective over the places of one lamp of constant intensity, for
// a scene of one object and for one of two, and how many valleys a greedy search could end in.
#include <cmath>

#include "controller/daemon/study/lab.h"
#include "controller/daemon/study/study.h"

namespace chiaro::daemon::study {
namespace {

struct Sweep {
  int columns, rows;
  core::Range azimuth, elevation;
  std::vector<double> values;  ///< row-major, lowest elevation first
  double at(int c, int r) const { return values[static_cast<std::size_t>(r * columns + c)]; }
  double azimuth_of(int c) const { return azimuth.least + azimuth.width() * (c + 0.5) / columns; }
  double elevation_of(int r) const {
    return elevation.least + elevation.width() * (r + 0.5) / rows;
  }
};

Sweep sweep(Lab& lab, const studio::Studio& studio, int columns, int rows, ports::World& world) {
  const auto& region = std::get<studio::StandMount>(studio.fixtures[0].mount).region;
  Sweep out{columns, rows, region.azimuth, region.elevation, {}};
  studio::Rig rig = studio::placed_rig(studio);
  rig.states[0].set(core::Dof::distance, 1.8);
  rig.states[0].set(core::Dof::intensity, 1);
  rig.states[0].set(core::Dof::intensity,
                    std::min(1.0, 700 / lux_of(studio.fixtures[0], rig.states[0])));
  for (int r = 0; r < rows; ++r)
    for (int c = 0; c < columns; ++c) {
      if (world.stop) return out;
      rig.states[0].set(core::Dof::azimuth, out.azimuth_of(c));
      rig.states[0].set(core::Dof::elevation, out.elevation_of(r));
      out.values.push_back(lab.cost(lab.point(rig)));
    }
  return out;
}

/// Cells lower than all that touch them.
std::vector<std::pair<int, int>> valleys(const Sweep& s) {
  std::vector<std::pair<int, int>> found;
  for (int r = 0; r < s.rows; ++r)
    for (int c = 0; c < s.columns; ++c) {
      bool lowest = std::isfinite(s.at(c, r));
      for (int dr = -1; dr <= 1; ++dr)
        for (int dc = -1; dc <= 1; ++dc) {
          const int x = c + dc, y = r + dr;
          if ((dc != 0 || dr != 0) && x >= 0 && y >= 0 && x < s.columns && y < s.rows)
            lowest = lowest && s.at(x, y) > s.at(c, r);
        }
      if (lowest) found.emplace_back(c, r);
    }
  return found;
}

core::Landscape drawn(const Sweep& s, const std::string& title) {
  core::Landscape land{
      title,
      {"azimuth (deg), positive to the camera's right", false, core::degrees(s.azimuth.least),
       core::degrees(s.azimuth.most)},
      {"elevation (deg)", false, core::degrees(s.elevation.least), core::degrees(s.elevation.most)},
      "F",
      static_cast<std::size_t>(s.columns),
      static_cast<std::size_t>(s.rows)};
  land.values = s.values;
  int n = 0;
  for (const auto& [c, r] : valleys(s))
    land.marks.push_back(
        {core::degrees(s.azimuth_of(c)), core::degrees(s.elevation_of(r)), std::to_string(++n)});
  return land;
}

}  // namespace

core::Result<Findings> run_landscape(const Options& options, ports::World& world) {
  const int columns = options.items_or(45, 15), rows = std::max(2, columns / 2);
  Findings findings;
  Table summary{"summary",
                "Valleys of F over one lamp's places",
                {"scene", "objects", "places tried", "valleys", "least", "most"}};
  Table values{
      "landscape", "Every place", {"scene", "azimuth_deg", "elevation_deg", "F"}, {}, false};
  std::size_t counts[2] = {0, 0};
  int k = 0;
  for (const std::string_view name : {scene_names()[0], scene_names()[2]}) {
    auto made = stage(name, {1, {}}, options.threads, world);
    if (!made) return made.problems();
    Lab lab(*made, design::IdealGoal{}, {64, 64}, Levels::searched);
    const Sweep s = sweep(lab, made->studio, columns, rows, world);
    if (s.values.size() != static_cast<std::size_t>(columns * rows)) break;
    double least = 1e300, most = -1e300;
    for (int r = 0; r < rows; ++r)
      for (int c = 0; c < columns; ++c) {
        const double f = s.at(c, r);
        if (std::isfinite(f)) least = std::min(least, f), most = std::max(most, f);
        values.rows.push_back({std::string(name), core::degrees(s.azimuth_of(c)),
                               core::degrees(s.elevation_of(r)), f});
      }
    counts[k] = valleys(s).size();
    const char* objects = k == 0 ? "one object" : "two objects";
    summary.rows.push_back({std::string(name), objects, static_cast<double>(s.values.size()),
                            static_cast<double>(counts[k]), least, most});
    findings.drawings.push_back(
        drawing(k == 0 ? "figure-3.8" : "figure-3.10",
                drawn(s, std::string("F(azimuth, elevation), ") + objects)));
    ++k;
  }
  findings.claims.push_back({"figures 3.8 and 3.10: local minima, more with more objects",
                             "\"substantial numbers\"", "-",
                             std::to_string(counts[0]) + " and " + std::to_string(counts[1]),
                             counts[0] > 1 && counts[1] >= counts[0]});
  findings.tables = {std::move(summary), std::move(values)};
  findings.items = columns;
  return findings;
}

}  // namespace chiaro::daemon::study
