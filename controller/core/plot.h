// SPDX-License-Identifier: Apache-2.0
// Plots that people can read, as SVG: axes with round numbers and units, a legend, colours that
// colour-blind readers can tell apart. No fonts or scripts from elsewhere.
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace chiaro::core {

struct Axis {
  std::string label;                      ///< with its unit: "elevation (deg)"
  bool log = false;                       ///< decades; values <= 0 are left out
  std::optional<double> least{}, most{};  ///< from the data where absent
};

/// One curve, cloud of points or set of bars, with its own name in the legend.
struct Series {
  enum class Kind { line, steps, points, bars };
  std::string name;
  std::vector<double> x{}, y{};         ///< equal sizes; points that are not finite are left out
  std::vector<double> least{}, most{};  ///< error bars beside y, or empty
  Kind kind = Kind::line;
  bool dashed = false;
};

struct Plot {
  std::string title;
  Axis x, y;
  std::vector<Series> series{};
  /// Names along x at 0, 1, 2 …: for bars. Empty = numbers.
  std::vector<std::string> categories{};
  std::vector<double> levels{};  ///< thin horizontal lines at these values: bars that must be met
  int width = 760, height = 460;
};
std::string to_svg(const Plot& plot);

/// A function of two variables as colours, with a scale beside it.
struct Landscape {
  std::string title;
  Axis x, y;
  std::string value_label;
  std::size_t columns = 0, rows = 0;
  std::vector<double> values{};  ///< row-major, the first row at y.least; not finite = left white
  struct Mark {
    double x, y;
    std::string name;
  };
  std::vector<Mark> marks{};
};
/// Precondition: both axes have least and most.
std::string to_svg(const Landscape& landscape);

}  // namespace chiaro::core
