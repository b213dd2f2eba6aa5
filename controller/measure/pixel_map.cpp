// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <limits>

#include "controller/measure/filters.h"
#include "controller/measure/measure.h"

namespace chiaro::measure {
namespace {

/// The share of a straight depth step that reaches the Laplacian beside it: three of the eight
/// neighbours lie across.
constexpr double kStepInLaplacian = 3.0 / 8.0;

struct Neighbour {
  int dx, dy;
};
constexpr Neighbour kNeighbours[] = {{1, 0}, {-1, 0}, {0, 1}, {0, -1}};

core::Grid<std::uint8_t> counted_pixels(const core::GeometryPlanes& planes) {
  core::Grid<std::uint8_t> counted = planes.subject;
  if (std::find(counted.values.begin(), counted.values.end(), 1) != counted.values.end())
    return counted;
  for (std::size_t i = 0; i < counted.values.size(); ++i)
    counted.values[i] = planes.object.values[i] != core::kNothing;
  return counted;
}

core::Plane inverse_depth(const core::GeometryPlanes& planes) {
  core::Plane out(planes.depth.size);
  for (std::size_t i = 0; i < out.values.size(); ++i) {
    const float z = planes.depth.values[i];
    out.values[i] = std::isfinite(z) && z > 0 ? 1 / z : 0;
  }
  return out;
}

bool breaks(const core::GeometryPlanes& planes, int x, int y, int nx, int ny, double least_cosine) {
  if (planes.object.at(x, y) != planes.object.at(nx, ny)) return true;
  const double cosine = double{planes.normal_x.at(x, y)} * planes.normal_x.at(nx, ny) +
                        double{planes.normal_y.at(x, y)} * planes.normal_y.at(nx, ny) +
                        double{planes.normal_z.at(x, y)} * planes.normal_z.at(nx, ny);
  return cosine < least_cosine;
}

/// Walks one line of pixels (a row or a column) and reports the maximal runs of non-edge pixels
/// that show one thing, then each meeting of two runs across nothing but edge pixels. Two pieces of
/// wall that meet across a thin part of the subject tell nothing of its shape.
template <class TypeAt, class PartAt, class Run, class Meet>
void scan_line(int n, TypeAt type_at, PartAt part_at, Run run, Meet meet) {
  bool pending = false;  // a run lies directly before the edge pixels that end here
  bool across_edge = false;
  std::uint32_t before = 0;
  PixelType before_type = PixelType::background;
  for (int i = 0; i < n;) {
    if (type_at(i) == PixelType::edge) {
      across_edge = true;
      ++i;
      continue;
    }
    const auto type = type_at(i);
    const auto part = part_at(i);
    int end = i + 1;
    while (end < n && type_at(end) == type && part_at(end) == part) ++end;
    if (part == core::kNothing) {
      pending = false;
    } else {
      const std::uint32_t slot = run(i, end);
      const bool shape = type == PixelType::surface || before_type == PixelType::surface;
      if (pending && across_edge && shape) meet(before, slot);
      before = slot;
      before_type = type;
      pending = true;
    }
    across_edge = false;
    i = end;
  }
}

struct Line {
  std::uint32_t line, begin, end;
};

/// Runs that take part in no meeting would only cost time: they are dropped and the slots closed.
struct RunScan {
  std::vector<Line> rows, columns;  // slot = position, columns after rows
  std::vector<PixelIndex::Crossing> crossings;
};

RunScan scan(const core::Grid<PixelType>& type, const core::Grid<std::uint16_t>& part) {
  RunScan found;
  const auto meet = [&](std::uint32_t a, std::uint32_t b) { found.crossings.push_back({a, b}); };
  const auto keep = [](std::vector<Line>& lines, int line, int begin, int end, std::size_t base) {
    lines.push_back({static_cast<std::uint32_t>(line), static_cast<std::uint32_t>(begin),
                     static_cast<std::uint32_t>(end)});
    return static_cast<std::uint32_t>(base + lines.size() - 1);
  };
  for (int y = 0; y < type.size.height; ++y)
    scan_line(
        type.size.width, [&](int x) { return type.at(x, y); }, [&](int x) { return part.at(x, y); },
        [&](int b, int e) { return keep(found.rows, y, b, e, 0); }, meet);
  for (int x = 0; x < type.size.width; ++x)
    scan_line(
        type.size.height, [&](int y) { return type.at(x, y); },
        [&](int y) { return part.at(x, y); },
        [&](int b, int e) { return keep(found.columns, x, b, e, found.rows.size()); }, meet);
  return found;
}

template <class Item, class LineOf>
std::vector<std::uint32_t> row_starts(const std::vector<Item>& items, int rows, LineOf line_of) {
  std::vector<std::uint32_t> start(static_cast<std::size_t>(rows) + 1, 0);
  for (const Item& item : items) ++start[line_of(item) + 1];
  for (std::size_t y = 1; y < start.size(); ++y) start[y] += start[y - 1];
  return start;
}

void index_contrast(PixelIndex& index, const core::Grid<PixelType>& type,
                    const core::Grid<std::uint16_t>& part) {
  const RunScan found = scan(type, part);
  constexpr auto kUnused = std::numeric_limits<std::uint32_t>::max();
  std::vector<std::uint32_t> slot(found.rows.size() + found.columns.size(), kUnused);
  for (const auto& c : found.crossings) slot[c.first] = slot[c.second] = 0;
  std::uint32_t slots = 0;
  for (auto& s : slot)
    if (s != kUnused) s = slots++;
  for (const auto& c : found.crossings) index.crossings.push_back({slot[c.first], slot[c.second]});
  index.run_length.resize(slots);

  const int height = type.size.height;
  std::vector<Line> rows;
  for (std::size_t k = 0; k < found.rows.size(); ++k) {
    if (slot[k] == kUnused) continue;
    const Line& r = found.rows[k];
    index.row_runs.push_back({r.begin, r.end, slot[k]});
    index.run_length[slot[k]] = static_cast<float>(r.end - r.begin);
    rows.push_back(r);
  }
  index.row_runs_row = row_starts(rows, height, [](const Line& r) { return r.line; });

  struct Event {
    std::uint32_t y, x, slot;
  };
  std::vector<Event> begins, ends;
  for (std::size_t k = 0; k < found.columns.size(); ++k) {
    const std::uint32_t s = slot[found.rows.size() + k];
    if (s == kUnused) continue;
    const Line& c = found.columns[k];
    begins.push_back({c.begin, c.line, s});
    ends.push_back({c.end - 1, c.line, s});
    index.run_length[s] = static_cast<float>(c.end - c.begin);
  }
  const auto by_row = [](const Event& a, const Event& b) {
    return a.y != b.y ? a.y < b.y : a.x < b.x;
  };
  std::sort(begins.begin(), begins.end(), by_row);
  std::sort(ends.begin(), ends.end(), by_row);
  const auto line_of = [](const Event& e) { return e.y; };
  index.column_begins_row = row_starts(begins, height, line_of);
  index.column_ends_row = row_starts(ends, height, line_of);
  for (const Event& e : begins) index.column_begins.push_back(e.x);
  for (const Event& e : ends) index.column_ends.push_back({e.x, e.slot});
}

void index_edges(PixelIndex& index, const core::Grid<PixelType>& type) {
  index.edge_row.assign(1, 0);
  for (int y = 0; y < type.size.height; ++y) {
    for (int x = 0; x < type.size.width; ++x)
      if (type.at(x, y) == PixelType::edge) index.edge_x.push_back(static_cast<std::uint32_t>(x));
    index.edge_row.push_back(static_cast<std::uint32_t>(index.edge_x.size()));
  }
}

void index_spans(PixelIndex& index, const core::Grid<PixelType>& type) {
  const auto shows = [](PixelType t) { return t != PixelType::background; };
  for (int y = 0; y < type.size.height; ++y) {
    const PixelType *row = type.row(y), *end = row + type.size.width;
    const PixelType* first = std::find_if(row, end, shows);
    const PixelType* last = end;
    while (last > first && !shows(last[-1])) --last;
    index.shown.push_back(
        {static_cast<std::uint32_t>(first - row), static_cast<std::uint32_t>(last - row)});
  }
}

}  // namespace

PixelMap pixel_map_of(core::Grid<PixelType> type, core::Grid<std::uint8_t> external,
                      const core::Grid<std::uint16_t>& part) {
  PixelMap map;
  map.type = std::move(type);
  map.external = std::move(external);
  const auto count = [&](PixelType t) {
    return static_cast<std::size_t>(std::count(map.type.values.begin(), map.type.values.end(), t));
  };
  map.edges = count(PixelType::edge);
  map.surfaces = count(PixelType::surface);
  map.externals = static_cast<std::size_t>(
      std::count(map.external.values.begin(), map.external.values.end(), 1));
  index_edges(map.index, map.type);
  index_spans(map.index, map.type);
  index_contrast(map.index, map.type, part);
  return map;
}

PixelMap flat_pixel_map(core::Size size) {
  return pixel_map_of(core::Grid<PixelType>(size, PixelType::surface),
                      core::Grid<std::uint8_t>(size, 0), core::Grid<std::uint16_t>(size, 1));
}

PixelMap pixel_map(const core::GeometryPlanes& planes, const EdgeThresholds& thresholds) {
  const core::Size size = planes.depth.size;
  const core::Grid<std::uint8_t> counted = counted_pixels(planes);
  const core::Plane inverse = inverse_depth(planes);
  const core::Plane bend = laplacian(inverse);
  const double least_cosine = std::cos(thresholds.normal_angle);
  core::Grid<PixelType> type(size, PixelType::background);
  core::Grid<std::uint8_t> external(size, 0);
  for (int y = 0; y < size.height; ++y) {
    for (int x = 0; x < size.width; ++x) {
      if (!counted.at(x, y)) continue;
      bool edge =
          std::abs(bend.at(x, y)) > kStepInLaplacian * thresholds.depth_step * inverse.at(x, y);
      for (const auto [dx, dy] : kNeighbours) {
        const int nx = x + dx, ny = y + dy;
        if (nx < 0 || ny < 0 || nx >= size.width || ny >= size.height) continue;
        const bool outside = !counted.at(nx, ny);
        external.at(x, y) |= static_cast<std::uint8_t>(outside);
        edge = edge || outside || breaks(planes, x, y, nx, ny, least_cosine);
      }
      type.at(x, y) = edge ? PixelType::edge : PixelType::surface;
    }
  }
  return pixel_map_of(std::move(type), std::move(external), planes.object);
}

bool knows_geometry(const PixelMap& map) { return map.edges > 0; }

core::Plane lit_mask(std::span<const core::Plane* const> visibility, ShadowRule rule) {
  if (visibility.empty()) return {};
  core::Plane out = *visibility.front();
  if (rule == ShadowRule::key) return out;
  for (const core::Plane* plane : visibility.subspan(1))
    for (std::size_t i = 0; i < out.values.size(); ++i)
      out.values[i] = rule == ShadowRule::any ? std::min(out.values[i], plane->values[i])
                                              : std::max(out.values[i], plane->values[i]);
  return out;
}

}  // namespace chiaro::measure
