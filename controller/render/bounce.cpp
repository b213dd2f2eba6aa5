// SPDX-License-Identifier: Apache-2.0
#include "controller/render/bounce.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <mutex>
#include <tbb/parallel_for.h>
#include <tuple>

#include "controller/core/random.h"
#include "controller/render/surface.h"
#include "controller/twin/lights/light_model.h"

namespace chiaro::render {
namespace {

using core::Vec3;

constexpr core::Size kPoints{32, 32};
constexpr std::size_t kRays = 64, kBundle = 16;
constexpr int kBounces = 4;  // between patches; a studio's walls return a third
constexpr std::size_t kMostPatches = 600;
constexpr double kLift = 1e-4;  // metres off the surface, so that a ray does not meet its own
constexpr std::uint16_t kNowhere = 0xFFFF;

using Channels = std::array<float, 3>;

struct Patch {
  Vec3 position, normal;
  Channels albedo;
  float hits = 0;
};

/// Cosine-weighted directions about a normal, stratified, the same for the same `stream`.
std::array<Vec3, kRays> directions(Vec3 normal, std::uint64_t stream) {
  core::Random random(7, stream);
  const Vec3 side =
      core::unit(core::cross(normal, std::abs(normal.z) < 0.9 ? Vec3{0, 0, 1} : Vec3{1, 0, 0}));
  const Vec3 up = core::cross(side, normal);
  std::array<Vec3, kRays> out;
  for (std::size_t k = 0; k < kRays; ++k) {
    const double u = (static_cast<double>(k % 8) + random.uniform()) / 8;
    const double v = (static_cast<double>(k / 8) + random.uniform()) / 8;
    const double r = std::sqrt(u), a = 2 * core::kPi * v;
    out[k] = core::unit(r * std::cos(a) * side + r * std::sin(a) * up +
                        std::sqrt(std::max(1e-6, 1 - u)) * normal);
  }
  return out;
}

struct Hit {
  bool hit = false;
  std::uint32_t mesh = 0;
  Surface surface;
};
using Hits = std::array<Hit, kRays>;

Hits hits_from(const Tracer& tracer, Vec3 position, Vec3 normal, std::uint64_t stream) {
  const auto towards = directions(normal, stream);
  Hits out;
  std::array<Tracer::Hit, kBundle> found;
  for (std::size_t first = 0; first < kRays; first += kBundle) {
    tracer.closest16(position + kLift * normal, &towards[first], kBundle, found.data());
    for (std::size_t k = 0; k < kBundle; ++k)
      if (found[k].hit)
        out[first + k] = {true, found[k].mesh,
                          surface_at(tracer.geometry(), found[k], towards[first + k])};
  }
  return out;
}

/// Surfaces of one mesh that lie near each other and face the same way count as one patch.
using Key = std::tuple<std::uint32_t, int, int, int, int>;

class Cells {
 public:
  explicit Cells(const twin::Geometry& geometry, double scale) {
    for (const twin::Mesh& mesh : geometry.meshes)
      sizes_.push_back(scale * (mesh.subject ? geometry.radius / 4 : 0.5));
  }
  Key key(const Hit& hit) const {
    const double size = sizes_[hit.mesh];
    const Vec3 p = hit.surface.position, n = hit.surface.normal;
    const double x = std::abs(n.x), y = std::abs(n.y), z = std::abs(n.z);
    const int facing = x >= y && x >= z ? (n.x > 0 ? 0 : 1)
                       : y >= z         ? (n.y > 0 ? 2 : 3)
                                        : (n.z > 0 ? 4 : 5);
    const auto cell = [size](double v) {
      return static_cast<int>(std::floor(std::clamp(v / size, -1e6, 1e6)));
    };
    return {hit.mesh, cell(p.x), cell(p.y), cell(p.z), facing};
  }

 private:
  std::vector<double> sizes_;
};

/// Patches by key, each at the hit nearest to its hits' middle.
class Patches {
 public:
  explicit Patches(const Cells& cells) : cells_(cells) {}
  void add(const Hits& hits) {
    for (const Hit& hit : hits) {
      if (!hit.hit) continue;
      Gathered& g = gathered_[cells_.key(hit)];
      g.sum = g.sum + hit.surface.position;
      g.hits.push_back(hit.surface);
    }
  }
  std::size_t size() const { return gathered_.size(); }
  /// Appends those that are not yet known.
  void settle(std::vector<Patch>& patches, std::map<Key, std::uint16_t>& index) const {
    for (const auto& [key, g] : gathered_) {
      if (index.count(key) != 0 || patches.size() >= kNowhere) continue;
      const Vec3 middle = g.sum / static_cast<double>(g.hits.size());
      const Surface& best =
          *std::min_element(g.hits.begin(), g.hits.end(), [&](const Surface& a, const Surface& b) {
            return core::distance(a.position, middle) < core::distance(b.position, middle);
          });
      index[key] = static_cast<std::uint16_t>(patches.size());
      patches.push_back({best.position,
                         best.normal,
                         {static_cast<float>(best.diffuse.r), static_cast<float>(best.diffuse.g),
                          static_cast<float>(best.diffuse.b)},
                         static_cast<float>(g.hits.size())});
    }
  }

 private:
  struct Gathered {
    Vec3 sum;
    std::vector<Surface> hits;
  };
  const Cells& cells_;
  std::map<Key, Gathered> gathered_;
};

using Row = std::array<std::uint16_t, kRays>;

Row row_of(const Hits& hits, const Cells& cells, const std::map<Key, std::uint16_t>& index) {
  Row row;
  for (std::size_t k = 0; k < kRays; ++k) {
    row[k] = kNowhere;
    if (!hits[k].hit) continue;
    if (const auto known = index.find(cells.key(hits[k])); known != index.end())
      row[k] = known->second;
  }
  return row;
}

/// Mean of what the row's rays meet; nothing comes from where they meet nothing.
void gather(const std::vector<Row>& rows, const std::array<std::vector<float>, 3>& radiosity,
            std::array<std::vector<float>, 3>& lux) {
  for (std::size_t c = 0; c < 3; ++c) {
    lux[c].resize(rows.size());
    for (std::size_t i = 0; i < rows.size(); ++i) {
      float sum = 0;
      for (const std::uint16_t patch : rows[i])
        if (patch != kNowhere) sum += radiosity[c][patch];
      lux[c][i] = sum / static_cast<float>(kRays);
    }
  }
}

}  // namespace

struct BounceField::State {
  std::shared_ptr<const Tracer> tracer;
  core::GBuffer buffer;  ///< the points
  std::vector<Patch> patches;
  std::vector<Row> points_see, patches_see;  ///< the latter of the first patches only
};

BounceField::BounceField(std::shared_ptr<const Tracer> tracer, const studio::Camera& camera) {
  auto state = std::make_unique<State>();
  state->tracer = tracer;
  state->buffer = see(tracer, camera, kPoints).buffer;
  const core::GBuffer& b = state->buffer;
  std::vector<Hits> from_points(b.samples());
  tbb::parallel_for(std::size_t{0}, b.samples(), [&](std::size_t i) {
    from_points[i] = hits_from(*tracer, {b.position_x[i], b.position_y[i], b.position_z[i]},
                               {b.normal_x[i], b.normal_y[i], b.normal_z[i]}, i);
  });
  std::map<Key, std::uint16_t> index;
  double scale = 1;
  std::unique_ptr<Cells> cells;
  for (;; scale *= 1.4) {
    cells = std::make_unique<Cells>(tracer->geometry(), scale);
    Patches patches(*cells);
    for (const Hits& hits : from_points) patches.add(hits);
    if (patches.size() > kMostPatches) continue;
    patches.settle(state->patches, index);
    break;
  }
  const std::size_t first = state->patches.size();
  std::vector<Hits> from_patches(first);
  tbb::parallel_for(std::size_t{0}, first, [&](std::size_t i) {
    from_patches[i] =
        hits_from(*tracer, state->patches[i].position, state->patches[i].normal, 100000 + i);
  });
  Patches more(*cells);
  for (const Hits& hits : from_patches) more.add(hits);
  if (first + more.size() < 4 * kMostPatches) more.settle(state->patches, index);
  for (const Hits& hits : from_points) state->points_see.push_back(row_of(hits, *cells, index));
  for (const Hits& hits : from_patches) state->patches_see.push_back(row_of(hits, *cells, index));
  state_ = std::move(state);
}
BounceField::~BounceField() = default;

std::size_t BounceField::patches() const { return state_->patches.size(); }

Bounced BounceField::from(const twin::Light& light) const {
  const twin::LightModel& model = twin::light_model(light.kind);
  const std::vector<Patch>& patches = state_->patches;
  std::vector<float> direct(patches.size());
  for (std::size_t i = 0; i < patches.size(); ++i) {
    const Patch& p = patches[i];
    const double lux = model.irradiance(light, p.position, p.normal);
    const Vec3 from = p.position + kLift * p.normal;
    direct[i] = lux > 0 && !state_->tracer->blocked(from, model.target(light, from, 0.5, 0.5))
                    ? static_cast<float>(lux)
                    : 0.0f;
  }
  std::array<std::vector<float>, 3> radiosity, again;
  for (int bounce = 0; bounce <= kBounces; ++bounce) {
    for (std::size_t c = 0; c < 3; ++c) {
      radiosity[c].resize(patches.size());
      for (std::size_t i = 0; i < patches.size(); ++i)
        radiosity[c][i] =
            patches[i].albedo[c] * (direct[i] + (i < again[c].size() ? again[c][i] : 0.0f));
    }
    if (bounce < kBounces) gather(state_->patches_see, radiosity, again);
  }
  Bounced out;
  gather(state_->points_see, radiosity, out.lux);
  return out;
}

BounceMap::BounceMap(const BounceField& field, const View& view) {
  const core::GBuffer &coarse = field.state_->buffer, &fine = view.buffer;
  core::Grid<std::int32_t> sample_at(coarse.size, -1);
  for (std::size_t i = 0; i < coarse.samples(); ++i)
    sample_at.values[coarse.pixel[i]] = static_cast<std::int32_t>(i);
  // A subject so small or far that the field's own view sees nothing of it: nothing is added.
  if (coarse.samples() == 0) return;
  const std::size_t n = fine.samples();
  pixel_ = fine.pixel;
  point_.resize(n);
  weight_.resize(n);
  albedo_.resize(n);
  const double scale_x = static_cast<double>(coarse.size.width) / fine.size.width,
               scale_y = static_cast<double>(coarse.size.height) / fine.size.height;
  tbb::parallel_for(std::size_t{0}, n, [&](std::size_t i) {
    albedo_[i] = {fine.diffuse_r[i], fine.diffuse_g[i], fine.diffuse_b[i]};
    point_[i].fill(0);
    weight_[i].fill(0);
    const auto width = static_cast<std::uint32_t>(fine.size.width);
    const double x = (fine.pixel[i] % width + 0.5) * scale_x - 0.5,
                 y = (fine.pixel[i] / width + 0.5) * scale_y - 0.5;
    // The points around whose surface is most like this one's; farther away where there is none.
    std::array<std::pair<float, std::uint16_t>, 49> near;
    std::size_t count = 0;
    const int cx = static_cast<int>(std::floor(x)), cy = static_cast<int>(std::floor(y));
    for (int reach = 1; reach <= 3 && count == 0; reach += 2)
      for (int py = cy - reach + 1; py <= cy + reach; ++py)
        for (int px = cx - reach + 1; px <= cx + reach; ++px) {
          if (px < 0 || py < 0 || px >= coarse.size.width || py >= coarse.size.height) continue;
          const std::int32_t k = sample_at.at(px, py);
          if (k < 0) continue;
          const auto j = static_cast<std::size_t>(k);
          const float facing = fine.normal_x[i] * coarse.normal_x[j] +
                               fine.normal_y[i] * coarse.normal_y[j] +
                               fine.normal_z[i] * coarse.normal_z[j];
          const float step = (fine.depth[i] - coarse.depth[j]) / (0.03f * fine.depth[i]);
          const auto beside = static_cast<float>(std::max(0.05, 1 - std::abs(px - x) / reach) *
                                                 std::max(0.05, 1 - std::abs(py - y) / reach));
          const float weight =
              beside * std::pow(std::max(0.0f, facing), 8.0f) * std::exp(-step * step);
          if (weight > 1e-4f && count < near.size())
            near[count++] = {weight, static_cast<std::uint16_t>(j)};
        }
    std::sort(near.begin(), near.begin() + static_cast<std::ptrdiff_t>(count),
              [](const auto& a, const auto& b) {
                return a.first != b.first ? a.first > b.first : a.second < b.second;
              });
    count = std::min(count, kNear);
    float sum = 0;
    for (std::size_t k = 0; k < count; ++k) sum += near[k].first;
    for (std::size_t k = 0; k < count; ++k) {
      point_[i][k] = near[k].second;
      weight_[i][k] = near[k].first / sum;
    }
  });
}

void BounceMap::add_luminance(const Bounced& bounced, const core::Rgb& colour, double gain,
                              core::Plane& out) const {
  // The same weights as core::luminance.
  const core::Rgb weights{core::luminance(core::Rgb{1, 0, 0}), core::luminance(core::Rgb{0, 1, 0}),
                          core::luminance(core::Rgb{0, 0, 1})};
  const float k[3] = {static_cast<float>(gain * weights.r * colour.r),
                      static_cast<float>(gain * weights.g * colour.g),
                      static_cast<float>(gain * weights.b * colour.b)};
  const float *r = bounced.lux[0].data(), *g = bounced.lux[1].data(), *b = bounced.lux[2].data();
  for (std::size_t i = 0; i < pixel_.size(); ++i) {
    const float kr = k[0] * albedo_[i][0], kg = k[1] * albedo_[i][1], kb = k[2] * albedo_[i][2];
    float sum = 0;
    for (std::size_t j = 0; j < kNear; ++j) {
      const std::uint16_t p = point_[i][j];
      sum += weight_[i][j] * (kr * r[p] + kg * g[p] + kb * b[p]);
    }
    out.values[pixel_[i]] += sum;
  }
}

void BounceMap::add_colour(const Bounced& bounced, const core::Rgb& colour, double gain,
                           core::Picture& out) const {
  const float k[3] = {static_cast<float>(gain * colour.r), static_cast<float>(gain * colour.g),
                      static_cast<float>(gain * colour.b)};
  core::Plane* planes[3] = {&out.red, &out.green, &out.blue};
  for (std::size_t c = 0; c < 3; ++c)
    for (std::size_t i = 0; i < pixel_.size(); ++i) {
      float sum = 0;
      for (std::size_t j = 0; j < kNear; ++j) sum += weight_[i][j] * bounced.lux[c][point_[i][j]];
      planes[c]->values[pixel_[i]] += k[c] * albedo_[i][c] * sum;
    }
}

namespace {

constexpr double kAngle = core::radians(15), kRatio = 1.5;

/// Grid coordinates of a place and back.
struct Node {
  int azimuth, elevation, distance;
  auto operator<=>(const Node&) const = default;
};
core::Spherical place_of(const Node& n) {
  return {n.azimuth * kAngle, n.elevation * kAngle, std::pow(kRatio, n.distance)};
}

struct Kept {
  std::once_flag once;
  Bounced bounced;
};

}  // namespace

struct BounceCache::State {
  const BounceField& field;
  const studio::Studio& studio;
  const core::AimFrame aim;
  std::mutex mutex;  ///< guards the map, never held while rays are traced
  std::map<std::pair<std::size_t, Node>, std::shared_ptr<Kept>> kept;

  Bounced traced(std::size_t fixture, const core::FixtureState& state) const {
    return field.from(
        twin::light(studio.fixtures[fixture], state, aim, studio.exposure.white_balance));
  }
  std::shared_ptr<Kept> node(std::size_t fixture, const Node& where,
                             const core::FixtureState& state) {
    std::shared_ptr<Kept> found;
    {
      const std::lock_guard lock(mutex);
      auto& entry = kept[{fixture, where}];
      if (!entry) entry = std::make_shared<Kept>();
      found = entry;
    }
    std::call_once(found->once, [&] {
      const core::Spherical place = place_of(where);
      core::FixtureState there = state;
      there.set(core::Dof::azimuth, place.azimuth);
      there.set(core::Dof::elevation, place.elevation);
      there.set(core::Dof::distance, place.distance);
      found->bounced = traced(fixture, there);
    });
    return found;
  }
};

BounceCache::BounceCache(const BounceField& field, const studio::Studio& studio,
                         const core::AimFrame& aim)
    : state_(new State{field, studio, aim, {}, {}}) {}
BounceCache::~BounceCache() = default;

Bounced BounceCache::at(std::size_t fixture, const core::FixtureState& state) const {
  const studio::Mount& mount = state_->studio.fixtures[fixture].mount;
  const bool moves = std::holds_alternative<studio::StandMount>(mount) ||
                     std::holds_alternative<studio::VirtualMount>(mount);
  const double distance = state.get(core::Dof::distance);
  if (!moves || !(distance > 0)) return state_->traced(fixture, state);
  const double at[3] = {state.get(core::Dof::azimuth) / kAngle,
                        state.get(core::Dof::elevation) / kAngle,
                        std::log(distance) / std::log(kRatio)};
  int low[3];
  double part[3];
  for (int d = 0; d < 3; ++d) {
    low[d] = static_cast<int>(std::floor(at[d]));
    part[d] = at[d] - low[d];
  }
  Bounced out;
  for (int corner = 0; corner < 8; ++corner) {
    const int up[3] = {corner & 1, (corner >> 1) & 1, corner >> 2};
    double weight = 1;
    for (int d = 0; d < 3; ++d) weight *= up[d] != 0 ? part[d] : 1 - part[d];
    if (weight <= 0) continue;
    const Node node{low[0] + up[0], low[1] + up[1], low[2] + up[2]};
    const auto kept = state_->node(fixture, node, state);
    // Near a lamp light falls with the square of its distance; what is left varies slowly.
    const double nearer = place_of(node).distance / distance;
    const auto k = static_cast<float>(weight * nearer * nearer);
    for (std::size_t c = 0; c < 3; ++c) {
      const std::vector<float>& lux = kept->bounced.lux[c];
      out.lux[c].resize(lux.size());
      for (std::size_t i = 0; i < lux.size(); ++i) out.lux[c][i] += k * lux[i];
    }
  }
  return out;
}

}  // namespace chiaro::render
