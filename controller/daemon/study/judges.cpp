// SPDX-License-Identifier: Apache-2.0
#include "controller/daemon/study/judges.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>
#include <numeric>

#include "controller/core/units.h"
#include "controller/measure/filters.h"

namespace chiaro::daemon::study {
namespace {

constexpr std::size_t kTerms = 9;
using Terms = std::array<double, kTerms>;

Terms harmonics(double x, double y, double z) {
  return {1, x, y, z, x * y, y * z, x * z, x * x - y * y, 3 * z * z - 1};
}

/// Solves a symmetric positive system by Gauss; `a` and `b` are used up.
Terms solved(std::array<Terms, kTerms> a, Terms b) {
  for (std::size_t i = 0; i < kTerms; ++i)
    for (std::size_t r = i + 1; r < kTerms; ++r) {
      const double factor = a[r][i] / a[i][i];
      for (std::size_t c = i; c < kTerms; ++c) a[r][c] -= factor * a[i][c];
      b[r] -= factor * b[i];
    }
  Terms x{};
  for (std::size_t i = kTerms; i-- > 0;) {
    double sum = b[i];
    for (std::size_t c = i + 1; c < kTerms; ++c) sum -= a[i][c] * x[c];
    x[i] = sum / a[i][i];
  }
  return x;
}

Terms normal_terms(const core::GeometryPlanes& p, std::size_t i) {
  return harmonics(static_cast<double>(p.normal_x.values[i]),
                   static_cast<double>(p.normal_y.values[i]),
                   static_cast<double>(p.normal_z.values[i]));
}

/// Fit of nine harmonics to the picture, the light clipped as the eye's camera clips it.
struct Fit {
  std::array<Terms, kTerms> normal{};
  Terms coefficients{};
};
Fit fit(const Subject& subject, const core::Plane& light) {
  Fit out;
  Terms right{};
  for (std::size_t i = 0; i < light.values.size(); ++i) {
    if (!subject.planes.subject.values[i]) continue;
    const Terms h = normal_terms(subject.planes, i);
    const double value = std::min(1.0, static_cast<double>(light.values[i]));
    for (std::size_t r = 0; r < kTerms; ++r) {
      right[r] += h[r] * value;
      for (std::size_t c = 0; c < kTerms; ++c) out.normal[r][c] += h[r] * h[c];
    }
  }
  // A little towards zero: a subject may not show every direction.
  for (std::size_t r = 0; r < kTerms; ++r) out.normal[r][r] += 1e-3 * (out.normal[0][0] + 1);
  out.coefficients = solved(out.normal, right);
  return out;
}

/// Root mean square over the subject's normals of what the terms give.
double energy(const Fit& fit, const Terms& t) {
  double sum = 0;
  for (std::size_t r = 0; r < kTerms; ++r)
    for (std::size_t c = 0; c < kTerms; ++c) sum += t[r] * fit.normal[r][c] * t[c];
  return std::sqrt(std::max(0.0, sum));
}

using Complex = std::complex<float>;

/// A Gabor filter's response: wavelength in pixels, direction in radians.
core::Grid<Complex> gabor(const core::Plane& values, double wavelength, double direction) {
  const double sigma = 0.5 * wavelength;
  const int reach = static_cast<int>(std::ceil(2.2 * sigma));
  const int w = values.size.width, h = values.size.height;
  std::vector<Complex> kernel;
  Complex sum{};
  float weight = 0;
  for (int y = -reach; y <= reach; ++y)
    for (int x = -reach; x <= reach; ++x) {
      const double along = x * std::cos(direction) + y * std::sin(direction);
      const double g = std::exp(-(x * x + y * y) / (2 * sigma * sigma));
      kernel.push_back(Complex(std::polar(g, 2 * core::kPi * along / wavelength)));
      sum += kernel.back();
      weight += static_cast<float>(g);
    }
  std::size_t k = 0;  // no answer to a flat picture
  for (int y = -reach; y <= reach; ++y)
    for (int x = -reach; x <= reach; ++x, ++k)
      kernel[k] -=
          sum / weight * static_cast<float>(std::exp(-(x * x + y * y) / (2 * sigma * sigma)));
  core::Grid<Complex> out(values.size);
  for (int y = 0; y < h; ++y)
    for (int x = 0; x < w; ++x) {
      Complex total{};
      k = 0;
      for (int dy = -reach; dy <= reach; ++dy) {
        const float* row = values.row(std::clamp(y + dy, 0, h - 1));
        for (int dx = -reach; dx <= reach; ++dx, ++k)
          total += kernel[k] * row[std::clamp(x + dx, 0, w - 1)];
      }
      out.at(x, y) = total;
    }
  return out;
}

/// Mean over windows on the subject of one band's complex similarity.
double similarity(const Subject& subject, const core::Grid<Complex>& a,
                  const core::Grid<Complex>& b) {
  constexpr int kReach = 3, kStep = 2;
  constexpr float kSmall = 1;  // of grey levels squared: noise is no structure
  double sum = 0, count = 0;
  for (int y = kReach; y + kReach < a.size.height; y += kStep)
    for (int x = kReach; x + kReach < a.size.width; x += kStep) {
      if (!subject.planes.subject.at(x, y)) continue;
      Complex cross{};
      float energy = 0;
      for (int dy = -kReach; dy <= kReach; ++dy)
        for (int dx = -kReach; dx <= kReach; ++dx) {
          const Complex p = a.at(x + dx, y + dy), q = b.at(x + dx, y + dy);
          cross += p * std::conj(q);
          energy += std::norm(p) + std::norm(q);
        }
      sum += static_cast<double>((2 * std::abs(cross) + kSmall) / (energy + kSmall));
      ++count;
    }
  return count > 0 ? sum / count : 1;
}

/// A smaller picture, so that a filter's size does not depend on the camera's.
core::Plane small_lightness(const core::Plane& light) { return measure::working_scalar(light); }

constexpr int kRegions = 5;

/// Light of each region of the subject's box: its mean luminance times its share of the subject.
std::vector<double> region_light(const Subject& subject, const core::Plane& light) {
  int left = light.size.width, right = -1, top = light.size.height, bottom = -1;
  for (int y = 0; y < light.size.height; ++y)
    for (int x = 0; x < light.size.width; ++x)
      if (subject.planes.subject.at(x, y)) {
        left = std::min(left, x), right = std::max(right, x);
        top = std::min(top, y), bottom = std::max(bottom, y);
      }
  std::vector<double> sums(kRegions * kRegions, 0);
  double count = 0;
  for (int y = top; y <= bottom; ++y)
    for (int x = left; x <= right; ++x) {
      if (!subject.planes.subject.at(x, y)) continue;
      const int column = (x - left) * kRegions / (right - left + 1),
                row = (y - top) * kRegions / (bottom - top + 1);
      sums[static_cast<std::size_t>(row * kRegions + column)] +=
          std::min(1.0, static_cast<double>(light.at(x, y)));
      ++count;
    }
  for (double& s : sums) s /= std::max(1.0, count);
  return sums;
}

std::vector<double> ranks(const std::vector<double>& values) {
  std::vector<std::size_t> order(values.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(),
            [&](std::size_t a, std::size_t b) { return values[a] < values[b]; });
  std::vector<double> out(values.size());
  for (std::size_t i = 0; i < order.size();) {
    std::size_t j = i;
    while (j < order.size() && values[order[j]] == values[order[i]]) ++j;
    for (std::size_t k = i; k < j; ++k) out[order[k]] = static_cast<double>(i + j - 1) / 2;
    i = j;
  }
  return out;
}

double correlation(const std::vector<double>& a, const std::vector<double>& b) {
  const double n = static_cast<double>(a.size());
  if (a.size() < 3) return 0;
  double ma = 0, mb = 0, aa = 0, bb = 0, ab = 0;
  for (std::size_t i = 0; i < a.size(); ++i) ma += a[i] / n, mb += b[i] / n;
  for (std::size_t i = 0; i < a.size(); ++i) {
    aa += (a[i] - ma) * (a[i] - ma);
    bb += (b[i] - mb) * (b[i] - mb);
    ab += (a[i] - ma) * (b[i] - mb);
  }
  return aa > 0 && bb > 0 ? ab / std::sqrt(aa * bb) : 0;
}

/// How fast the normal turns at each pixel: what shading should show.
core::Plane bend(const core::GeometryPlanes& p) {
  const core::Plane x = measure::sobel_magnitude(p.normal_x),
                    y = measure::sobel_magnitude(p.normal_y),
                    z = measure::sobel_magnitude(p.normal_z);
  core::Plane out(x.size);
  for (std::size_t i = 0; i < out.values.size(); ++i)
    out.values[i] = std::sqrt(x.values[i] * x.values[i] + y.values[i] * y.values[i] +
                              z.values[i] * z.values[i]);
  return out;
}

bool near_one(const core::Grid<std::uint8_t>& marks, int x, int y) {
  for (int dy = -1; dy <= 1; ++dy)
    for (int dx = -1; dx <= 1; ++dx) {
      const int px = x + dx, py = y + dy;
      if (px >= 0 && py >= 0 && px < marks.size.width && py < marks.size.height && marks.at(px, py))
        return true;
    }
  return false;
}

/// F1 of strong picture gradients against the geometry's edge pixels, a pixel's tolerance.
double edge_f1(const Subject& subject, const core::Plane& gradient) {
  constexpr float kStrong = 12;  // grey levels per pixel
  core::Grid<std::uint8_t> drawn(gradient.size, 0), true_edge(gradient.size, 0);
  for (std::size_t i = 0; i < drawn.values.size(); ++i) {
    const auto type = subject.map.type.values[i];
    true_edge.values[i] = type == measure::PixelType::edge;
    drawn.values[i] = type != measure::PixelType::background && gradient.values[i] > kStrong;
  }
  double found = 0, edges = 0, right = 0, all = 0;
  for (int y = 0; y < drawn.size.height; ++y)
    for (int x = 0; x < drawn.size.width; ++x) {
      if (true_edge.at(x, y)) ++edges, found += near_one(drawn, x, y);
      if (drawn.at(x, y)) ++all, right += near_one(true_edge, x, y);
    }
  const double recall = edges > 0 ? found / edges : 0, precision = all > 0 ? right / all : 0;
  return recall + precision > 0 ? 2 * recall * precision / (recall + precision) : 0;
}

}  // namespace

double illumination_distance(const Subject& subject, const core::Plane& a, const core::Plane& b) {
  const Fit fa = fit(subject, a), fb = fit(subject, b);
  Terms difference{};
  for (std::size_t i = 0; i < kTerms; ++i) difference[i] = fa.coefficients[i] - fb.coefficients[i];
  return energy(fa, difference) / std::max(1e-9, energy(fa, fa.coefficients));
}

double structure_distance(const Subject& subject, const core::Plane& a, const core::Plane& b) {
  const core::Plane la = small_lightness(a), lb = small_lightness(b);
  double sum = 0;
  int bands = 0;
  for (const double wavelength : {4.0, 8.0, 16.0})
    for (int k = 0; k < 4; ++k, ++bands) {
      const double direction = core::kPi * k / 4;
      sum +=
          similarity(subject, gabor(la, wavelength, direction), gabor(lb, wavelength, direction));
    }
  return 1 - sum / bands;
}

double transport_cost(std::vector<double> from, std::vector<double> to,
                      const std::vector<double>& cost) {
  const std::size_t n = from.size(), m = to.size();
  std::vector<double> carried(n * m, 0);
  constexpr double kNone = 1e-12;
  double total = 0;
  for (std::size_t source = 0; source < n; ++source)
    while (from[source] > kNone) {
      // Bellman and Ford from this source over ways that may be used, back ways included.
      std::vector<double> here(n, 1e300), there(m, 1e300);
      std::vector<std::size_t> from_of(m, n), to_of(n, m);
      here[source] = 0;
      for (bool changed = true; changed;) {
        changed = false;
        for (std::size_t i = 0; i < n; ++i)
          for (std::size_t j = 0; j < m; ++j) {
            if (here[i] < 1e299 && here[i] + cost[i * m + j] < there[j] - kNone)
              there[j] = here[i] + cost[i * m + j], from_of[j] = i, changed = true;
            if (carried[i * m + j] > kNone && there[j] < 1e299 &&
                there[j] - cost[i * m + j] < here[i] - kNone)
              here[i] = there[j] - cost[i * m + j], to_of[i] = j, changed = true;
          }
      }
      std::size_t sink = m;
      for (std::size_t j = 0; j < m; ++j)
        if (to[j] > kNone && (sink == m || there[j] < there[sink])) sink = j;
      if (sink == m || there[sink] > 1e299) return total;
      double amount = std::min(from[source], to[sink]);
      for (std::size_t j = sink, i = from_of[j]; i != source; j = to_of[i], i = from_of[j])
        amount = std::min(amount, carried[i * m + to_of[i]]);
      for (std::size_t j = sink;;) {
        const std::size_t i = from_of[j];
        carried[i * m + j] += amount;
        if (i == source) break;
        carried[i * m + to_of[i]] -= amount;
        j = to_of[i];
      }
      from[source] -= amount, to[sink] -= amount;
      total += amount * there[sink];
    }
  return total;
}

double region_distance(const Subject& subject, const core::Plane& a, const core::Plane& b) {
  std::vector<double> la = region_light(subject, a), lb = region_light(subject, b);
  const double sum_a = std::accumulate(la.begin(), la.end(), 0.0),
               sum_b = std::accumulate(lb.begin(), lb.end(), 0.0);
  const double farthest = std::sqrt(2.0) * (kRegions - 1) / kRegions;
  std::vector<double> cost;
  const auto place = [](std::size_t k) {
    return std::pair(static_cast<double>(k % kRegions), static_cast<double>(k / kRegions));
  };
  // The one with less light gets the rest from far away.
  std::vector<double>& poor = sum_a < sum_b ? la : lb;
  poor.push_back(std::abs(sum_a - sum_b));
  (sum_a < sum_b ? lb : la).push_back(0);
  for (std::size_t i = 0; i < la.size(); ++i)
    for (std::size_t j = 0; j < lb.size(); ++j) {
      if (i + 1 == la.size() || j + 1 == lb.size()) {
        cost.push_back(farthest);
        continue;
      }
      const auto [xa, ya] = place(i);
      const auto [xb, yb] = place(j);
      cost.push_back(std::hypot(xa - xb, ya - yb) / kRegions);
    }
  return transport_cost(std::move(la), std::move(lb), cost) /
         std::max(1e-9, std::max(sum_a, sum_b));
}

Shown shown(const Subject& subject, const core::Plane& luminance) {
  Shown out;
  const core::Plane values = measure::working_scalar(luminance);
  const core::Plane gradient = measure::sobel_magnitude(values);
  const core::Plane bends = bend(subject.planes);
  std::vector<double> shading, turning;
  std::array<double, 256> counts{};
  double all = 0, clipped = 0;
  for (std::size_t i = 0; i < values.values.size(); ++i) {
    if (!subject.planes.subject.values[i]) continue;
    ++all;
    ++counts[static_cast<std::size_t>(std::clamp(values.values[i] + 0.5f, 0.0f, 255.0f))];
    clipped += values.values[i] < 0.5f || values.values[i] > 254.5f;
    if (subject.map.type.values[i] != measure::PixelType::surface) continue;
    shading.push_back(static_cast<double>(gradient.values[i]));
    turning.push_back(static_cast<double>(bends.values[i]));
  }
  out.shape = correlation(ranks(shading), ranks(turning));
  out.edges = edge_f1(subject, gradient);
  for (const double count : counts)
    if (count > 0) out.entropy -= count / all * std::log2(count / all);
  out.clipped = all > 0 ? clipped / all : 0;
  return out;
}

double overall(const Shown& s) { return (s.shape + s.edges + s.entropy / 8) / 3 - s.clipped; }

}  // namespace chiaro::daemon::study
