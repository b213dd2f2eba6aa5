// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <numeric>
#include <span>

#include "controller/twin/mesh/prepared_mesh.h"

namespace chiaro::twin {
namespace {

using core::Vec3;

/// Gives equal keys of N floats equal numbers, in order of first appearance. Open addressing: a
/// node-based map takes ten times as long for a million points.
template <std::size_t N>
class Welder {
 public:
  explicit Welder(std::size_t expected)
      : slots_(std::bit_ceil(2 * expected + 16), 0xffffffffu), mask_(slots_.size() - 1) {
    keys_.reserve(expected);
  }
  std::uint32_t number(std::array<float, N> key) {
    for (float& v : key) v += 0.0f;  // minus zero becomes zero
    std::uint64_t hash = 0x9e3779b97f4a7c15ULL;
    for (const float v : key) {
      hash = (hash ^ std::bit_cast<std::uint32_t>(v)) * 0xff51afd7ed558ccdULL;
      hash ^= hash >> 32u;
    }
    for (std::size_t at = hash & mask_;; at = (at + 1) & mask_) {
      if (slots_[at] == 0xffffffffu) {
        slots_[at] = static_cast<std::uint32_t>(keys_.size());
        keys_.push_back(key);
        return slots_[at];
      }
      if (keys_[slots_[at]] == key) return slots_[at];
    }
  }
  const std::vector<std::array<float, N>>& keys() const { return keys_; }

 private:
  std::vector<std::uint32_t> slots_;
  std::size_t mask_;
  std::vector<std::array<float, N>> keys_;
};

Vec3 vec(const float* v) { return {v[0], v[1], v[2]}; }

/// Shape alone: points without duplicates and, per corner, which of them.
struct Shape {
  std::vector<std::array<float, 3>> points;
  std::vector<std::uint32_t> corners;  ///< three per triangle
  std::vector<Vec3> faces;             ///< unit normals
};

Shape welded_by_position(const RawMesh& raw) {
  Welder<3> welder(raw.vertices());
  std::vector<std::uint32_t> number(raw.vertices());
  for (std::size_t i = 0; i < number.size(); ++i) {
    const float* p = &raw.positions[3 * i];
    number[i] = welder.number({p[0], p[1], p[2]});
  }
  Shape shape;
  shape.corners.resize(raw.indices.size());
  for (std::size_t i = 0; i < raw.indices.size(); ++i) shape.corners[i] = number[raw.indices[i]];
  shape.points = welder.keys();
  return shape;
}

Vec3 area_vector(const Shape& shape, std::size_t t) {
  const Vec3 a = vec(shape.points[shape.corners[3 * t]].data());
  const Vec3 b = vec(shape.points[shape.corners[3 * t + 1]].data());
  const Vec3 c = vec(shape.points[shape.corners[3 * t + 2]].data());
  return cross(b - a, c - a);
}

/// Removes triangles without area and later copies of a triangle: same points, in the same turn or
/// the other. Surfaces have two sides here; a file that stores each of them would have its subject
/// stand in its own shadow, triangle by triangle.
void drop_useless(RawMesh& raw, Shape& shape) {
  const std::size_t triangles = raw.triangles();
  Welder<3> seen(triangles);
  std::size_t kept = 0, known = 0;
  for (std::size_t t = 0; t < triangles; ++t) {
    const Vec3 area = area_vector(shape, t);
    const double size = length(area);
    if (!(size > 1e-30)) continue;
    std::array<std::uint32_t, 3> c{shape.corners[3 * t], shape.corners[3 * t + 1],
                                   shape.corners[3 * t + 2]};
    std::sort(c.begin(), c.end());
    // Point numbers as floats keep their order and identity below 2^24; above, as their bits.
    const auto key = [](std::uint32_t i) { return std::bit_cast<float>(i | 0x01000000u); };
    if (shape.points.size() < (1u << 24u)) {
      const std::uint32_t number = seen.number({key(c[0]), key(c[1]), key(c[2])});
      if (number < known) continue;
      known = number + 1;
    }
    for (std::size_t k = 0; k < 3; ++k) {
      raw.indices[3 * kept + k] = raw.indices[3 * t + k];
      shape.corners[3 * kept + k] = shape.corners[3 * t + k];
    }
    raw.material[kept] = raw.material[t];
    shape.faces.push_back(area / size);
    ++kept;
  }
  raw.indices.resize(3 * kept);
  shape.corners.resize(3 * kept);
  raw.material.resize(kept);
}

double corner_angle(const Shape& shape, std::size_t corner) {
  const std::size_t t = corner / 3 * 3, k = corner % 3;
  const Vec3 a = vec(shape.points[shape.corners[t + k]].data());
  const Vec3 b = vec(shape.points[shape.corners[t + (k + 1) % 3]].data());
  const Vec3 c = vec(shape.points[shape.corners[t + (k + 2) % 3]].data());
  return angle_between(b - a, c - a);
}

/// The corners that touch each point, as one flat list.
struct Touching {
  std::vector<std::uint32_t> first, corner;
};
Touching touching(const Shape& shape) {
  Touching out;
  out.first.assign(shape.points.size() + 1, 0);
  for (const std::uint32_t p : shape.corners) ++out.first[p + 1];
  std::partial_sum(out.first.begin(), out.first.end(), out.first.begin());
  out.corner.resize(shape.corners.size());
  std::vector<std::uint32_t> next(out.first.begin(), out.first.end() - 1);
  for (std::size_t c = 0; c < shape.corners.size(); ++c)
    out.corner[next[shape.corners[c]]++] = static_cast<std::uint32_t>(c);
  return out;
}

/// One normal per corner. Faces round a point are averaged, weighted by their angle there (which
/// does not depend on how a polygon was cut), each corner over the faces within the crease of its
/// own.
std::vector<Vec3> smooth_normals(const Shape& shape) {
  const double within = std::cos(core::radians(kCreaseDegrees));
  const double surely_within = std::cos(core::radians(kCreaseDegrees / 2));
  const Touching around = touching(shape);
  std::vector<Vec3> normals(shape.corners.size());
  std::vector<Vec3> weighted;
  for (std::size_t p = 0; p < shape.points.size(); ++p) {
    const auto corners =
        std::span(around.corner).subspan(around.first[p], around.first[p + 1] - around.first[p]);
    weighted.clear();
    Vec3 sum;
    for (const std::uint32_t c : corners) {
      weighted.push_back(corner_angle(shape, c) * shape.faces[c / 3]);
      sum = sum + weighted.back();
    }
    const Vec3 mean = unit(sum);
    // Within half a crease of the mean all lie within a crease of each other: one normal for all.
    const bool smooth = std::all_of(corners.begin(), corners.end(), [&](std::uint32_t c) {
      return dot(shape.faces[c / 3], mean) > surely_within;
    });
    for (const std::uint32_t c : corners) {
      normals[c] = mean;
      if (smooth) continue;
      Vec3 own;
      for (std::size_t k = 0; k < corners.size(); ++k)
        if (dot(shape.faces[corners[k] / 3], shape.faces[c / 3]) > within) own = own + weighted[k];
      normals[c] = unit(own);
    }
  }
  return normals;
}

/// The file's own normals where they are usable, else the face's.
std::vector<Vec3> given_normals(const RawMesh& raw, const Shape& shape) {
  std::vector<Vec3> normals(raw.indices.size());
  for (std::size_t c = 0; c < raw.indices.size(); ++c) {
    const Vec3 n = vec(&raw.normals[3 * raw.indices[c]]);
    normals[c] = length(n) > 1e-6 ? unit(n) : shape.faces[c / 3];
  }
  return normals;
}

}  // namespace

PreparedMesh prepared(RawMesh raw) {
  Shape shape = welded_by_position(raw);
  drop_useless(raw, shape);
  const std::vector<Vec3> normals = raw.normals.size() == raw.positions.size()
                                        ? given_normals(raw, shape)
                                        : smooth_normals(shape);
  const bool textured = raw.texture_coordinates.size() / 2 == raw.vertices();
  PreparedMesh out;
  // Each corner may have a normal of its own: where every edge is sharp all of them differ.
  Welder<8> welder(raw.indices.size());
  out.indices.reserve(raw.indices.size());
  for (std::size_t c = 0; c < raw.indices.size(); ++c) {
    const auto& p = shape.points[shape.corners[c]];
    const Vec3 n = normals[c];
    const float* t = textured ? &raw.texture_coordinates[2 * raw.indices[c]] : nullptr;
    out.indices.push_back(
        welder.number({p[0], p[1], p[2], static_cast<float>(n.x), static_cast<float>(n.y),
                       static_cast<float>(n.z), t ? t[0] : 0, t ? t[1] : 0}));
  }
  for (const auto& key : welder.keys()) {
    out.positions.insert(out.positions.end(), {key[0], key[1], key[2]});
    out.normals.insert(out.normals.end(), {key[3], key[4], key[5]});
    if (textured) out.texture_coordinates.insert(out.texture_coordinates.end(), {key[6], key[7]});
  }
  out.material = std::move(raw.material);
  out.materials = std::move(raw.materials);
  out.textures = std::move(raw.textures);
  out.y_up = raw.y_up;
  out.warnings = std::move(raw.warnings);
  return out;
}

}  // namespace chiaro::twin
