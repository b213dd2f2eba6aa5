// SPDX-License-Identifier: Apache-2.0
#include "controller/design/pattern.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "controller/optimise/least_squares.h"

namespace chiaro::design {
namespace {

constexpr std::size_t kFace = kFaceCells * kFaceCells, kBody = kBodyCells * kBodyCells;
constexpr std::size_t kFields = 6;  // of background: three across, two down
constexpr std::size_t kCells = kFace + kBody + kFields;

// The face inside its box: an ellipse without the hair line, in shares of the box's side.
constexpr double kHalfWidth = 0.39, kHalfHeight = 0.5, kMiddle = 0.03, kBrow = -0.36;
// A cell counts where our subject fills this share of it; the exemplar must fill as much.
constexpr double kFilled = 0.5;
// How much the parts weigh: the half of the face's differences that is not symmetrical, the half
// that is (on skin alone), the rest of the person, the background. Found by trial on items 0 to 23
// of `chiaro study transfer --seed 7`; that study's own seed is another, its heads are the same.
constexpr double kLopsided = 1, kAlike = 1, kBodyWeight = 0.02, kFieldWeight = 0.02;
// Differences in hair and clothes say little once they are large, working scalar.
constexpr double kOdd = 30;
constexpr double kScale = 2.55;
constexpr int kQuickSteps = 3, kThoroughSteps = 12, kHalvings = 3;
constexpr double kEnough = 1e-4;

double scalar_of(double y) { return kScale * core::lightness(std::clamp(y, 0.0, 1.0)); }
double slope_at(double y) {
  if (y >= 1) return 0;
  const double f = (core::lightness(std::max(y, 0.0)) + 16) / 116;
  return std::min(kScale * 116 / (3 * f * f), kScale * 903.3);
}

/// How much of what is alike on both halves a cell may say: skin alone, not eyes, brows, mouth or
/// hair. `u` to the right, `v` down, from the middle of the box, in shares of its side.
double skin_there(double u, double v) {
  const double side = std::abs(u);
  const auto inside = [&](double u0, double u1, double v0, double v1) {
    return side >= u0 && side < u1 && v >= v0 && v < v1;
  };
  if (inside(0.06, 0.34, -0.02, 0.2) || inside(0, 0.08, -0.12, 0.14)) return 1;  // cheeks, nose
  if (inside(0.16, 0.3, 0.2, 0.36) || inside(0, 0.16, 0.36, 0.47)) return 0.7;   // jaw, chin
  if (inside(0, 0.24, -0.34, -0.22)) return 0.5;                                 // forehead
  return 0.1;
}

bool in_face(double u, double v) {
  const double y = v - kMiddle;
  return v > kBrow && u * u / (kHalfWidth * kHalfWidth) + y * y / (kHalfHeight * kHalfHeight) < 1;
}

std::uint16_t cell_at(const FaceBox& face, double x, double y, bool subject) {
  const double u = (x - face.x) / face.side, v = (y - face.y) / face.side;
  if (subject && in_face(u, v)) {
    const auto step = [](double at) {
      return std::clamp(static_cast<int>(std::floor((at + 0.5) * kFaceCells)), 0, kFaceCells - 1);
    };
    return static_cast<std::uint16_t>(step(v) * kFaceCells + step(u));
  }
  const auto share = [](double at, int n) {
    return std::clamp(static_cast<int>(at * n), 0, n - 1);
  };
  if (subject)
    return static_cast<std::uint16_t>(kFace +
                                      static_cast<std::size_t>(share(y, kBodyCells)) * kBodyCells +
                                      static_cast<std::size_t>(share(x, kBodyCells)));
  return static_cast<std::uint16_t>(kFace + kBody + static_cast<std::size_t>(share(y, 2)) * 3 +
                                    static_cast<std::size_t>(share(x, 3)));
}

/// Sums over cells of an exemplar's pixels that may count.
struct Sums {
  std::vector<double> light = std::vector<double>(kCells, 0);
  std::vector<double> weight = light, clipped = light, pixels = light;
  void add(std::size_t cell, float y, float most, double share) {
    light[cell] += share * double{y};
    clipped[cell] += share * (most >= 0.985f ? 1 : 0);
    weight[cell] += share;
    pixels[cell] += 1;
  }
};

float most_of(const core::Picture& picture, std::size_t i) {
  return std::max({picture.red.values[i], picture.green.values[i], picture.blue.values[i]});
}

Sums sums_of(const Matched& matched, const Pattern& pattern) {
  Sums sums;
  const core::Size size = pattern.size;
  const core::Picture on_subject = core::resized(matched.aligned, size),
                      as_framed = core::resized(matched.own_frame, size);
  const core::Plane here = core::luminance(on_subject), there = core::luminance(as_framed);
  const core::Plane person =
      matched.foreground.empty() ? core::Plane{} : core::resized(matched.foreground, size);
  const core::Plane behind =
      matched.behind.empty() ? core::Plane{} : core::resized(matched.behind, size);
  for (std::size_t i = 0; i < pattern.cell.size(); ++i) {
    const std::size_t cell = pattern.cell[i];
    if (cell == kNoCell || cell >= kFace + kBody) continue;
    const bool face = cell < kFace;
    const double share = face || person.empty() ? 1 : double{person.values[i]};
    sums.add(cell, here.values[i], most_of(on_subject, i), share);
  }
  // The exemplar's fields are its own, whatever of ours stands before them.
  for (int y = 0; y < size.height; ++y)
    for (int x = 0; x < size.width; ++x) {
      const std::size_t cell = kFace + kBody + static_cast<std::size_t>(2 * y / size.height) * 3 +
                               static_cast<std::size_t>(3 * x / size.width);
      if (behind.empty()) continue;
      sums.add(cell, there.at(x, y), 0, double{behind.at(x, y)});
    }
  return sums;
}

// ---- the face's differences ---------------------------------------------------------------------

constexpr int kLevels = 4;  // of a 16 x 16 pyramid
constexpr std::size_t kDetails = 2 * (1 + 4 + 16 + 64);
constexpr std::size_t kResiduals = 2 * (1 + kDetails) + kBody + kFields;

/// Mean and details of a 16 x 16 square, each times the root of its weight; appends to `out`.
void pyramid(std::vector<double> square, double weight, double* out) {
  const double level_share = weight / (kLevels + 1);
  int side = kFaceCells;
  for (int level = kLevels - 1; level >= 0; --level) {
    const int half = side / 2;
    const double w = std::sqrt(level_share / (2.0 * half * half));
    std::vector<double> next(static_cast<std::size_t>(half) * static_cast<std::size_t>(half));
    for (int y = 0; y < half; ++y)
      for (int x = 0; x < half; ++x) {
        const auto at = [&](int dx, int dy) {
          return square[static_cast<std::size_t>((2 * y + dy) * side + 2 * x + dx)];
        };
        const double a = at(0, 0), b = at(1, 0), c = at(0, 1), d = at(1, 1);
        *out++ = w * (a + c - b - d) / 2;
        *out++ = w * (a + b - c - d) / 2;
        next[static_cast<std::size_t>(y * half + x)] = (a + b + c + d) / 4;
      }
    square = std::move(next);
    side = half;
  }
  *out = std::sqrt(level_share) * square.front();
}

std::array<double, kFace> skin_weights() {
  std::array<double, kFace> weights{};
  for (int y = 0; y < kFaceCells; ++y)
    for (int x = 0; x < kFaceCells; ++x)
      weights[static_cast<std::size_t>(y * kFaceCells + x)] =
          skin_there((x + 0.5) / kFaceCells - 0.5, (y + 0.5) / kFaceCells - 0.5);
  return weights;
}

/// Residuals whose squares sum to the cost's square, of differences per cell.
std::vector<double> residuals(const std::vector<double>& cells, const std::vector<double>& odd) {
  static const std::array<double, kFace> kSkin = skin_weights();
  std::vector<double> lopsided(kFace), alike(kFace), out(kResiduals);
  for (int y = 0; y < kFaceCells; ++y)
    for (int x = 0; x < kFaceCells; ++x) {
      const auto i = static_cast<std::size_t>(y * kFaceCells + x),
                 m = static_cast<std::size_t>(y * kFaceCells + kFaceCells - 1 - x);
      lopsided[i] = (cells[i] - cells[m]) / 2;
      alike[i] = kSkin[i] * (cells[i] + cells[m]) / 2;
    }
  pyramid(std::move(lopsided), kLopsided, out.data());
  pyramid(std::move(alike), kAlike, out.data() + 1 + kDetails);
  double* rest = out.data() + 2 * (1 + kDetails);
  for (std::size_t i = kFace; i < kCells; ++i) *rest++ = odd[i - kFace] * cells[i];
  return out;
}

}  // namespace

Pattern pattern_of(const Matched& matched, const core::GeometryPlanes* planes, core::Size size) {
  Pattern pattern;
  pattern.size = size;
  pattern.cell.resize(size.pixels());
  std::vector<double> ours(kCells, 0);
  for (int y = 0; y < size.height; ++y)
    for (int x = 0; x < size.width; ++x) {
      const bool subject = planes == nullptr || planes->subject.at(x, y) != 0;
      const std::uint16_t cell =
          cell_at(matched.ours, (x + 0.5) / size.width, (y + 0.5) / size.height, subject);
      pattern.cell[static_cast<std::size_t>(y * size.width + x)] = cell;
      ours[cell] += 1;
    }
  const Sums theirs = sums_of(matched, pattern);
  pattern.wanted.resize(kCells);
  pattern.pixels.resize(kCells);
  pattern.clipped.resize(kCells);
  const double face_cell = matched.ours.side * size.width / kFaceCells;
  for (std::size_t i = 0; i < kCells; ++i) {
    const bool face = i < kFace;
    const bool ours_there = face ? ours[i] >= kFilled * face_cell * face_cell : ours[i] >= 4;
    const bool theirs_there =
        theirs.weight[i] > 0 && theirs.weight[i] >= kFilled * theirs.pixels[i];
    if (!ours_there || !theirs_there) continue;
    pattern.pixels[i] = static_cast<float>(ours[i]);
    pattern.wanted[i] = static_cast<float>(scalar_of(theirs.light[i] / theirs.weight[i]));
    pattern.clipped[i] = theirs.clipped[i] > 0.5 * theirs.weight[i];
  }
  for (std::uint16_t& cell : pattern.cell)
    if (pattern.pixels[cell] == 0) cell = kNoCell;
  pattern.by_face = matched.by_face;
  return pattern;
}

double background_off(const Pattern& pattern, const core::Plane& values) {
  double sum = 0, count = 0;
  for (std::size_t i = 0; i < pattern.cell.size(); ++i) {
    const std::size_t cell = pattern.cell[i];
    if (cell == kNoCell || cell < kFace + kBody) continue;
    sum += double{values.values[i]} - double{pattern.wanted[cell]};
    ++count;
  }
  return count > 0 ? sum / count : 0;
}

PatternLevels::PatternLevels(const Pattern& pattern)
    : pattern_(pattern), difference_(kCells, 0), slope_(kCells, 0) {}

PatternLevels::Means PatternLevels::mean_of(const core::Plane& plane) const {
  Means means(kCells + 1, 0);
  const float* value = plane.values.data();
  for (const std::uint16_t cell : pattern_.cell)
    means[cell == kNoCell ? kCells : cell] += double{*value++};
  means.resize(kCells);
  for (std::size_t i = 0; i < kCells; ++i)
    if (pattern_.pixels[i] > 0) means[i] /= double{pattern_.pixels[i]};
  return means;
}

void PatternLevels::reduce(const Columns& columns) {
  offset_ = mean_of(*columns.offset);
  columns_.clear();
  for (const core::Plane* plane : columns.planes) columns_.push_back(mean_of(*plane));
}

void PatternLevels::compare(std::span<const double> levels) {
  for (std::size_t i = 0; i < kCells; ++i) {
    difference_[i] = slope_[i] = 0;
    if (pattern_.pixels[i] == 0) continue;
    double y = offset_[i];
    for (std::size_t k = 0; k < columns_.size(); ++k) y += levels[k] * columns_[k][i];
    const double off = scalar_of(y) - double{pattern_.wanted[i]};
    if (pattern_.clipped[i] && off >= 0) continue;
    difference_[i] = off;
    slope_[i] = slope_at(y);
  }
}

namespace {

/// Weights of body and background cells: what is far off is another coat, or another wall.
std::vector<double> odd_weights(const std::vector<double>& difference, const Pattern& pattern,
                                bool of_cost) {
  std::vector<double> weights(kBody + kFields);
  double body = 0, fields = 0;
  for (std::size_t i = kFace; i < kCells; ++i)
    (i < kFace + kBody ? body : fields) += pattern.pixels[i] > 0;
  for (std::size_t i = kFace; i < kCells; ++i) {
    if (pattern.pixels[i] == 0) continue;
    const double share = i < kFace + kBody ? kBodyWeight / body : kFieldWeight / fields;
    const double r = difference[i] / kOdd, square = r * r;
    // Cauchy's loss as a weight on the square, or as iteratively reweighted least squares want it.
    const double loss =
        of_cost ? (square > 1e-9 ? std::log1p(square) / square : 1) : 1 / (1 + square);
    weights[i - kFace] = std::sqrt(share * loss);
  }
  return weights;
}

}  // namespace

double PatternLevels::cost_of(std::span<const double> levels) {
  compare(levels);
  double sum = 0;
  for (const double r : residuals(difference_, odd_weights(difference_, pattern_, true)))
    sum += r * r;
  return std::sqrt(sum);
}

double PatternLevels::cost(const Columns& columns, std::span<const double> levels) {
  reduce(columns);
  return cost_of(levels);
}

std::vector<double> PatternLevels::start(const Columns& columns) {
  // Linear light, each cell weighed by how much a change at the wanted light would show.
  const std::size_t n = columns_.size();
  std::vector<double> matrix(n * n, 0), vector(n, 0);
  for (std::size_t i = 0; i < kCells; ++i) {
    if (pattern_.pixels[i] == 0) continue;
    const double y = core::luminance_of_lightness(double{pattern_.wanted[i]} / kScale);
    const double slope = slope_at(std::min(y, 0.95));
    const double w = slope * slope * (i < kFace ? 1 : 0.1);
    for (std::size_t a = 0; a < n; ++a) {
      vector[a] += w * columns_[a][i] * (y - offset_[i]);
      for (std::size_t b = 0; b < n; ++b) matrix[a * n + b] += w * columns_[a][i] * columns_[b][i];
    }
  }
  return optimise::bounded_least_squares(matrix, vector, columns.bounds);
}

Levels PatternLevels::solve(const Columns& columns, Effort effort) {
  reduce(columns);
  Levels now;
  now.values = start(columns);
  now.cost = cost_of(now.values);
  const int steps = effort == Effort::quick ? kQuickSteps : kThoroughSteps;
  for (int i = 0; i < steps; ++i) {
    const double before = now.cost;
    if (!step(columns, now) || before - now.cost < kEnough * before) break;
  }
  return now;
}

bool PatternLevels::step(const Columns& columns, Levels& now) {
  compare(now.values);
  const auto odd = odd_weights(difference_, pattern_, false);
  const std::vector<double> rest = residuals(difference_, odd);
  const std::size_t n = columns_.size();
  std::vector<std::vector<double>> slopes;
  std::vector<double> cells(kCells);
  for (const Means& column : columns_) {
    for (std::size_t i = 0; i < kCells; ++i) cells[i] = slope_[i] * column[i];
    slopes.push_back(residuals(cells, odd));
  }
  // Minimise |rest + J (x - now)|^2.
  std::vector<double> matrix(n * n, 0), vector(n, 0);
  for (std::size_t r = 0; r < rest.size(); ++r) {
    double wanted = -rest[r];
    for (std::size_t k = 0; k < n; ++k) wanted += slopes[k][r] * now.values[k];
    for (std::size_t a = 0; a < n; ++a) {
      vector[a] += slopes[a][r] * wanted;
      for (std::size_t b = 0; b < n; ++b) matrix[a * n + b] += slopes[a][r] * slopes[b][r];
    }
  }
  const auto wanted = optimise::bounded_least_squares(matrix, vector, columns.bounds, now.values);
  Levels next;
  next.values.resize(n);
  double share = 1;
  for (int halving = 0; halving <= kHalvings; ++halving, share /= 2) {
    for (std::size_t k = 0; k < n; ++k)
      next.values[k] = now.values[k] + share * (wanted[k] - now.values[k]);
    next.cost = cost_of(next.values);
    if (next.cost < now.cost) {
      now = next;
      return true;
    }
  }
  return false;
}

}  // namespace chiaro::design
