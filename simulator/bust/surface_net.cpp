// SPDX-License-Identifier: Apache-2.0
#include "simulator/bust/surface_net.h"

#include <algorithm>
#include <cmath>
#include <tbb/parallel_for.h>

namespace chiaro::simulator {
namespace {

using core::Vec3;

constexpr std::uint32_t kNone = ~0u;

/// Values at the grid's corners, and the numbering of corners and cells (both by corner).
class Field {
 public:
  Field(const Distance& distance, const GridLines& grid)
      : grid_(grid), nx_(grid.x.size()), ny_(grid.y.size()), nz_(grid.z.size()) {
    values_.resize(nx_ * ny_ * nz_);
    tbb::parallel_for(std::size_t{0}, nz_, [&](std::size_t k) {
      for (std::size_t j = 0; j < ny_; ++j)
        for (std::size_t i = 0; i < nx_; ++i)
          values_[index(i, j, k)] = distance({grid_.x[i], grid_.y[j], grid_.z[k]});
    });
    while (settle_faces()) {
    }
  }
  std::size_t index(std::size_t i, std::size_t j, std::size_t k) const {
    return (k * ny_ + j) * nx_ + i;
  }
  double at(std::size_t i, std::size_t j, std::size_t k) const { return values_[index(i, j, k)]; }
  Vec3 corner(std::size_t i, std::size_t j, std::size_t k) const {
    return {grid_.x[i], grid_.y[j], grid_.z[k]};
  }
  std::size_t nx() const { return nx_; }
  std::size_t ny() const { return ny_; }
  std::size_t nz() const { return nz_; }

 private:
  /// A grid face whose corners alternate in sign would belong to two sheets, and its edge to four
  /// triangles: the outer corner nearer the surface is filled in. True when any was.
  bool settle_faces() {
    bool changed = false;
    const std::array<std::size_t, 3> step{1, nx_, nx_ * ny_};
    for (std::size_t k = 0; k + 1 < nz_; ++k)
      for (std::size_t j = 0; j + 1 < ny_; ++j)
        for (std::size_t i = 0; i + 1 < nx_; ++i)
          for (std::size_t axis = 0; axis < 3; ++axis)
            changed |= settle(index(i, j, k), step[axis], step[(axis + 1) % 3]);
    return changed;
  }
  bool settle(std::size_t at, std::size_t u, std::size_t v) {
    const std::array<std::size_t, 4> corners{at, at + u, at + u + v, at + v};
    const auto in = [&](std::size_t c) { return values_[corners[c]] < 0; };
    if (in(0) != in(2) || in(1) != in(3) || in(0) == in(1)) return false;
    const std::size_t first = in(0) ? 1 : 0, second = first + 2;
    double& a = values_[corners[first]];
    double& b = values_[corners[second]];
    (a < b ? a : b) = -1e-9;
    return true;
  }

  const GridLines& grid_;
  std::size_t nx_, ny_, nz_;
  std::vector<double> values_;
};

/// The mean of the points where the surface cuts the cell's edges; nothing when it does not.
bool cell_point(const Field& field, std::size_t i, std::size_t j, std::size_t k, Vec3& point) {
  Vec3 sum;
  int cuts = 0;
  const auto edge = [&](std::array<std::size_t, 3> a, std::array<std::size_t, 3> b) {
    const double va = field.at(i + a[0], j + a[1], k + a[2]);
    const double vb = field.at(i + b[0], j + b[1], k + b[2]);
    if ((va < 0) == (vb < 0)) return;
    const Vec3 pa = field.corner(i + a[0], j + a[1], k + a[2]);
    const Vec3 pb = field.corner(i + b[0], j + b[1], k + b[2]);
    sum = sum + pa + (va / (va - vb)) * (pb - pa);
    ++cuts;
  };
  for (std::size_t u = 0; u < 2; ++u)
    for (std::size_t v = 0; v < 2; ++v) {
      edge({0, u, v}, {1, u, v});
      edge({u, 0, v}, {u, 1, v});
      edge({u, v, 0}, {u, v, 1});
    }
  if (cuts == 0) return false;
  point = sum / cuts;
  return true;
}

Vec3 gradient(const Distance& distance, Vec3 p, double h) {
  const auto slope = [&](Vec3 d) { return (distance(p + d) - distance(p - d)) / (2 * h); };
  return {slope({h, 0, 0}), slope({0, h, 0}), slope({0, 0, h})};
}

/// Along the slope to the surface, never farther than `most` in all: neighbours must not cross.
Vec3 pulled(const Distance& distance, Vec3 p, double most) {
  const Vec3 start = p;
  for (int step = 0; step < 4; ++step) {
    const Vec3 g = gradient(distance, p, 0.02 * most);
    const double steep = core::dot(g, g);
    if (steep < 1e-6) return p;
    const Vec3 next = p - (distance(p) / std::max(steep, 0.25)) * g;
    if (core::distance(next, start) > most) return p;
    p = next;
  }
  return p;
}

/// Two triangles over the four cells round a cut edge, split along the shorter diagonal.
void add_quad(TriangleMesh& mesh, std::array<std::uint32_t, 4> q, bool flipped) {
  if (flipped) std::swap(q[1], q[3]);
  const auto& p = mesh.positions;
  if (core::distance(p[q[0]], p[q[2]]) <= core::distance(p[q[1]], p[q[3]])) {
    mesh.triangles.push_back({q[0], q[1], q[2]});
    mesh.triangles.push_back({q[0], q[2], q[3]});
  } else {
    mesh.triangles.push_back({q[1], q[2], q[3]});
    mesh.triangles.push_back({q[1], q[3], q[0]});
  }
}

std::vector<std::uint32_t> place_vertices(const Field& field, TriangleMesh& mesh,
                                          std::vector<double>& reach) {
  std::vector<std::uint32_t> vertex(field.nx() * field.ny() * field.nz(), kNone);
  for (std::size_t k = 0; k + 1 < field.nz(); ++k)
    for (std::size_t j = 0; j + 1 < field.ny(); ++j)
      for (std::size_t i = 0; i + 1 < field.nx(); ++i) {
        Vec3 point;
        if (!cell_point(field, i, j, k, point)) continue;
        vertex[field.index(i, j, k)] = static_cast<std::uint32_t>(mesh.positions.size());
        mesh.positions.push_back(point);
        const Vec3 cell = field.corner(i + 1, j + 1, k + 1) - field.corner(i, j, k);
        reach.push_back(0.5 * std::min({cell.x, cell.y, cell.z}));
      }
  return vertex;
}

void join_vertices(const Field& field, const std::vector<std::uint32_t>& vertex,
                   TriangleMesh& mesh) {
  const auto v = [&](std::size_t i, std::size_t j, std::size_t k) {
    return vertex[field.index(i, j, k)];
  };
  for (std::size_t k = 1; k + 1 < field.nz(); ++k)
    for (std::size_t j = 1; j + 1 < field.ny(); ++j)
      for (std::size_t i = 1; i + 1 < field.nx(); ++i) {
        const bool in = field.at(i, j, k) < 0;
        if (in != (field.at(i + 1, j, k) < 0))
          add_quad(mesh, {v(i, j - 1, k - 1), v(i, j, k - 1), v(i, j, k), v(i, j - 1, k)}, !in);
        if (in != (field.at(i, j + 1, k) < 0))
          add_quad(mesh, {v(i - 1, j, k - 1), v(i - 1, j, k), v(i, j, k), v(i, j, k - 1)}, !in);
        if (in != (field.at(i, j, k + 1) < 0))
          add_quad(mesh, {v(i - 1, j - 1, k), v(i, j - 1, k), v(i, j, k), v(i - 1, j, k)}, !in);
      }
}

}  // namespace

TriangleMesh surface_net(const Distance& distance, const GridLines& grid) {
  const Field field(distance, grid);
  TriangleMesh mesh;
  std::vector<double> reach;
  const std::vector<std::uint32_t> vertex = place_vertices(field, mesh, reach);
  mesh.normals.resize(mesh.positions.size());
  tbb::parallel_for(std::size_t{0}, mesh.positions.size(), [&](std::size_t i) {
    mesh.positions[i] = pulled(distance, mesh.positions[i], reach[i]);
    mesh.normals[i] = core::unit(gradient(distance, mesh.positions[i], 0.2 * reach[i]));
  });
  join_vertices(field, vertex, mesh);
  return mesh;
}

}  // namespace chiaro::simulator
