// SPDX-License-Identifier: Apache-2.0
#include "controller/render/visibility_cache.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <list>
#include <mutex>
#include <optional>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>
#include <unordered_map>

#include "controller/render/kernels.h"
#include "controller/render/samples.h"
#include "controller/render/work.h"
#include "controller/twin/lights/light_model.h"

// Relighting at interactive rates by remembering what each place of a lamp can see [I-38].
namespace chiaro::render {
namespace {

using core::Dof;

/// Evenly spaced places from least to most; one when they are the same.
struct Axis {
  double least = 0, step = 0;
  int places = 1;
  double at(int i) const { return least + step * i; }
  /// The place below `x` and how far towards the next, 0..1.
  std::pair<int, double> find(double x) const {
    if (places == 1) return {0, 0};
    const double t = std::clamp((x - least) / step, 0.0, static_cast<double>(places - 1));
    const int i = std::min(static_cast<int>(t), places - 2);
    return {i, t - i};
  }
};
Axis axis(core::Range range, double step) {
  const double width = std::max(0.0, range.width());
  const int parts =
      width > 1e-9 ? std::max(1, static_cast<int>(std::ceil(width / step - 1e-9))) : 0;
  return {range.least, parts > 0 ? width / parts : 0, parts + 1};
}

/// The grid of one fixture. Distance is kept as its logarithm.
struct Grid {
  bool moves = false;
  core::Spherical placed;
  studio::Region region;
  Axis elevation, distance;
  std::vector<Axis> azimuth;  ///< one per elevation; alone, along an arc or a track
  std::optional<Dof> along;   ///< of a motor: the only way that the lamp moves
};

/// Metres of a track are as far apart as the grid's angle at the usual distance of a lamp.
Grid motor_grid(Dof along, core::Range range, double step) {
  Grid out;
  out.moves = true;
  out.along = along;
  out.elevation = out.distance = Axis{0, 0, 1};
  out.azimuth = {axis(range, step)};
  return out;
}

Grid grid(const studio::Fixture& fixture, GridSpacing spacing) {
  constexpr double kUsualDistance = 1.8;
  Grid out;
  if (const auto* arc = std::get_if<studio::ArcMount>(&fixture.mount))
    return motor_grid(Dof::arc, arc->angle, spacing.angle);
  if (const auto* track = std::get_if<studio::TrackMount>(&fixture.mount))
    return motor_grid(Dof::track, {0, 1},
                      spacing.angle * kUsualDistance / core::distance(track->from, track->to));
  if (const auto* stand = std::get_if<studio::StandMount>(&fixture.mount)) {
    out = {true, stand->at, stand->region, {}, {}, {}, {}};
  } else if (const auto* free = std::get_if<studio::VirtualMount>(&fixture.mount)) {
    out = {true, free->at, free->region, {}, {}, {}, {}};
  } else {
    return out;
  }
  const core::Range d{std::log(std::max(out.region.distance.least, 0.05)),
                      std::log(std::max(out.region.distance.most, 0.05))};
  const bool parallel = fixture.fitted_optic().kind == studio::Optic::Kind::directional;
  out.distance = parallel ? Axis{d.least, 0, 1} : axis(d, std::log(spacing.ratio));
  out.elevation = axis(out.region.elevation, spacing.angle);
  for (int e = 0; e < out.elevation.places; ++e)
    out.azimuth.push_back(
        axis(out.region.azimuth, spacing.angle / std::max(0.2, std::cos(out.elevation.at(e)))));
  return out;
}

/// One place of one fixture: a bit or a byte per sample. Its tiles are filled by whoever needs the
/// place, each by one thread: nobody who waits for it is idle, and the answer is the same.
struct Place {
  explicit Place(std::size_t bytes) : data(bytes, 0) {}
  std::atomic<std::size_t> next{0}, done{0};  ///< tiles begun, tiles filled
  std::vector<std::uint8_t> data;
};
using PlacePointer = std::shared_ptr<Place>;

struct Corner {
  int elevation, azimuth, distance;
  double weight;
};

/// The up to eight places around a point. Weights sum to 1.
std::vector<Corner> corners(const Grid& g, const core::Spherical& place) {
  std::vector<Corner> out;
  const auto [e0, fe] = g.elevation.find(place.elevation);
  const auto [d0, fd] = g.distance.find(std::log(std::max(place.distance, 0.05)));
  for (int e = 0; e < (fe > 0 ? 2 : 1); ++e) {
    const double we = e == 0 ? 1 - fe : fe;
    const auto [a0, fa] = g.azimuth[static_cast<std::size_t>(e0 + e)].find(place.azimuth);
    for (int a = 0; a < (fa > 0 ? 2 : 1); ++a)
      for (int d = 0; d < (fd > 0 ? 2 : 1); ++d)
        out.push_back(
            {e0 + e, a0 + a, d0 + d, we * (a == 0 ? 1 - fa : fa) * (d == 0 ? 1 - fd : fd)});
  }
  return out;
}

class Blend : public Visible {
 public:
  Blend(std::vector<PlacePointer> places, std::vector<float> weights, bool bits)
      : places_(std::move(places)), weights_(std::move(weights)), bits_(bits) {}

  void tile(std::size_t tile, float* out) const override {
    if (bits_) {
      std::array<kernels::Bits, 8> all;
      for (std::size_t k = 0; k < places_.size(); ++k)
        all[k] = {places_[k]->data.data() + tile * kTile / 8, weights_[k]};
      kernels::blend_bits({all.data(), places_.size()}, out, kTile);
    } else {
      std::array<kernels::Bytes, 8> all;
      for (std::size_t k = 0; k < places_.size(); ++k)
        all[k] = {places_[k]->data.data() + tile * kTile, weights_[k]};
      kernels::blend_bytes({all.data(), places_.size()}, out, kTile);
    }
  }

 private:
  std::vector<PlacePointer> places_;
  std::vector<float> weights_;
  bool bits_;
};

}  // namespace

struct VisibilityCache::State {
  const View& view;
  const studio::Studio& studio;
  std::size_t budget;
  std::vector<Grid> grids;

  struct Entry {
    PlacePointer place;
    std::list<std::uint64_t>::iterator age;
    std::size_t bytes;
  };
  std::mutex mutex;  ///< guards the three below, never held while rays are traced
  std::unordered_map<std::uint64_t, Entry> entries;
  std::list<std::uint64_t> by_age;  ///< newest first
  std::size_t bytes = 0;

  bool soft(std::size_t fixture) const {
    return twin::light_model(studio.fixtures[fixture].fitted_optic().kind).has_area;
  }
  std::size_t bytes_of(std::size_t fixture) const {
    const std::size_t samples = view.samples->tiles() * kTile;
    // Mask loads read eight bytes at a time.
    return (soft(fixture) ? samples : samples / 8) + 8;
  }

  std::size_t tiles() const { return view.samples->tiles(); }

  PlacePointer find(std::size_t fixture, const Corner& c) {
    const std::uint64_t key = (static_cast<std::uint64_t>(fixture) << 48u) |
                              (static_cast<std::uint64_t>(c.elevation) << 32u) |
                              (static_cast<std::uint64_t>(c.azimuth) << 16u) |
                              static_cast<std::uint64_t>(c.distance);
    const std::lock_guard lock(mutex);
    if (const auto known = entries.find(key); known != entries.end()) {
      by_age.splice(by_age.begin(), by_age, known->second.age);
      return known->second.place;
    }
    by_age.push_front(key);
    const std::size_t size = bytes_of(fixture);
    const auto place = std::make_shared<Place>(size);
    entries.emplace(key, Entry{place, by_age.begin(), size});
    bytes += size;
    while (bytes > budget && by_age.size() > 1) {
      const auto oldest = entries.find(by_age.back());
      bytes -= oldest->second.bytes;  // whoever still blends it keeps it alive
      entries.erase(oldest);
      by_age.pop_back();
    }
    return place;
  }

  /// A place that is not filled yet, and the lamp there.
  struct Gap {
    Place& place;
    twin::Light light;
  };

  void fill_tile(const Gap& gap, bool bytes_each, Strata strata) const {
    const std::size_t tile = gap.place.next.fetch_add(1, std::memory_order_relaxed);
    if (tile >= tiles()) return;
    std::array<float, kTile> values;
    const std::size_t first = tile * kTile, n = view.samples->in_tile(tile);
    trace_fraction(view, gap.light, strata, first, {values.data(), n});
    std::uint8_t* to = gap.place.data.data();
    for (std::size_t k = 0; k < n; ++k)
      if (bytes_each)
        to[first + k] = static_cast<std::uint8_t>(std::lround(255 * values[k]));
      else if (values[k] > 0.5f)
        to[(first + k) / 8] |= static_cast<std::uint8_t>(1u << (k % 8));
    if (gap.place.done.fetch_add(1, std::memory_order_acq_rel) + 1 < tiles()) return;
    work().nodes += 1;
    gap.place.done.notify_all();
  }

  /// Isolated: while this thread waits for others' tiles it must not take up another trial, which
  /// may hold what the caller is in the middle of.
  void fill(const std::vector<Gap>& gaps, bool bytes_each, Strata strata) const {
    tbb::this_task_arena::isolate([&] {
      tbb::parallel_for(std::size_t{0}, gaps.size() * tiles(),
                        [&](std::size_t k) { fill_tile(gaps[k / tiles()], bytes_each, strata); });
    });
    // What other callers have begun they will end: they hold no lock and wait for nothing.
    for (const Gap& gap : gaps)
      for (std::size_t done = gap.place.done.load(std::memory_order_acquire); done < tiles();
           done = gap.place.done.load(std::memory_order_acquire))
        gap.place.done.wait(done, std::memory_order_acquire);
  }

  twin::Light light_at(std::size_t fixture, const Corner& c) const;

  core::FixtureState state_at(const Grid& g, const Corner& c) const {
    core::FixtureState state;
    if (!g.moves) return state;
    if (g.along) {
      state.set(*g.along, g.azimuth[0].at(c.azimuth));
      return state;
    }
    state.set(Dof::elevation, g.elevation.at(c.elevation));
    state.set(Dof::azimuth, g.azimuth[static_cast<std::size_t>(c.elevation)].at(c.azimuth));
    state.set(Dof::distance, std::exp(g.distance.at(c.distance)));
    return state;
  }
};

twin::Light VisibilityCache::State::light_at(std::size_t fixture, const Corner& c) const {
  return twin::light(studio.fixtures[fixture], state_at(grids[fixture], c),
                     view.tracer->geometry().aim, studio.exposure.white_balance);
}

VisibilityCache::VisibilityCache(const View& view, const studio::Studio& studio,
                                 std::size_t budget_bytes, GridSpacing spacing)
    : state_(new State{view, studio, budget_bytes, {}, {}, {}, {}, 0}) {
  for (const studio::Fixture& fixture : studio.fixtures)
    state_->grids.push_back(grid(fixture, spacing));
}
VisibilityCache::~VisibilityCache() = default;

std::unique_ptr<const Visible> VisibilityCache::at(std::size_t fixture,
                                                   const core::FixtureState& state) const {
  const Grid& g = state_->grids[fixture];
  std::vector<Corner> around{{0, 0, 0, 1}};
  if (g.along) {
    around = corners(g, {state.get(*g.along, g.azimuth[0].least), 0, 1});
  } else if (g.moves) {
    around = corners(g, {state.get(Dof::azimuth, g.placed.azimuth),
                         state.get(Dof::elevation, g.placed.elevation),
                         state.get(Dof::distance, g.placed.distance)});
  }
  std::vector<PlacePointer> places;
  std::vector<float> weights;
  std::vector<State::Gap> gaps;
  for (const Corner& corner : around) {
    places.push_back(state_->find(fixture, corner));
    weights.push_back(static_cast<float>(corner.weight));
    if (places.back()->done.load(std::memory_order_acquire) < state_->tiles())
      gaps.push_back({*places.back(), state_->light_at(fixture, corner)});
  }
  if (!gaps.empty()) state_->fill(gaps, state_->soft(fixture), g.moves ? kCached : kExact);
  return std::make_unique<Blend>(std::move(places), std::move(weights), !state_->soft(fixture));
}

std::size_t VisibilityCache::bytes() const {
  const std::lock_guard lock(state_->mutex);
  return state_->bytes;
}

}  // namespace chiaro::render
