// SPDX-License-Identifier: Apache-2.0
#include "controller/render/shadow.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <embree3/rtcore.h>

#include "controller/render/work.h"
#include "controller/twin/lights/light_model.h"

namespace chiaro::render {
namespace {

/// Shadow rays start this far off the surface, metres: beyond float's grain at studio distances,
/// below what a camera resolves.
constexpr float kLiftOff = 2e-4f;
/// Least sine of a shadow ray's elevation over the surface.
constexpr float kGrazing = 0.02f;
constexpr std::size_t kPacket = 16;

using Lanes = std::array<float, kPacket>;

struct Triple {
  float x = 0, y = 0, z = 0;
};
Triple triple(core::Vec3 v) {
  return {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)};
}

/// Sixteen samples, copied so that the loops below run over plain arrays.
struct Packet {
  alignas(64) Lanes px, py, pz, nx, ny, nz, fx, fy, fz;
  std::size_t count = 0;

  void load(const core::GBuffer& b, std::size_t first, std::size_t n) {
    count = n;
    const auto copy = [&](Lanes& to, const std::vector<float>& from) {
      for (std::size_t k = 0; k < kPacket; ++k) to[k] = from[first + std::min(k, n - 1)];
    };
    copy(px, b.position_x), copy(py, b.position_y), copy(pz, b.position_z);
    copy(nx, b.normal_x), copy(ny, b.normal_y), copy(nz, b.normal_z);
    copy(fx, b.face_x), copy(fy, b.face_y), copy(fz, b.face_z);
  }
};

class Shadow {
 public:
  Shadow(const View& view, const twin::Light& light)
      : tracer_(*view.tracer),
        light_(light),
        model_(twin::light_model(light.kind)),
        axis_(triple(light.direction)) {}

  void fractions(const Packet& p, Strata strata, float* out) {
    std::array<int, kPacket> wanted{};
    std::fill_n(wanted.begin(), p.count, -1);
    if (!model_.has_area || strata.many == 1) {
      single(p, wanted, out);
      return;
    }
    Sums sums;
    sum(p, strata.few, wanted, sums);
    std::array<int, kPacket> mixed{}, below{};
    bool any_mixed = false, any_below = false;
    for (std::size_t k = 0; k < p.count; ++k) {
      below[k] = sums.all[k] > 0 ? 0 : -1;
      const bool agree = sums.open[k] == 0 || sums.open[k] == sums.traced[k];
      mixed[k] = !below[k] && !agree && strata.many > strata.few ? -1 : 0;
      any_mixed = any_mixed || mixed[k];
      any_below = any_below || below[k];
      out[k] = below[k] ? 0 : sums.visible[k] / sums.all[k];
    }
    // The face is turned away or wholly below the horizon: its centre stands for it.
    if (any_below) single(p, below, out);
    if (!any_mixed) return;
    Sums full;
    sum(p, strata.many, mixed, full);
    for (std::size_t k = 0; k < p.count; ++k)
      if (mixed[k]) out[k] = full.visible[k] / full.all[k];
  }

  std::uint64_t rays = 0;

 private:
  struct Sums {
    Lanes visible{}, all{};
    std::array<int, kPacket> open{}, traced{};
  };

  void single(const Packet& p, const std::array<int, kPacket>& wanted, float* out) {
    alignas(64) std::array<int, kPacket> valid = wanted;
    aim(p, triple(model_.target(light_, {}, 0.5, 0.5)));
    trace(valid);
    for (std::size_t k = 0; k < p.count; ++k)
      if (wanted[k]) out[k] = ray_.tfar[k] < 0 ? 0.0f : 1.0f;
  }

  void sum(const Packet& p, int across, const std::array<int, kPacket>& wanted, Sums& sums) {
    for (int s = 0; s < across * across; ++s) {
      const Triple target = triple(
          model_.target(light_, {}, (s % across + 0.5) / across, (s / across + 0.5) / across));
      Lanes weight;
      alignas(64) std::array<int, kPacket> valid{};
      for (std::size_t k = 0; k < kPacket; ++k) {
        const float x = target.x - p.px[k], y = target.y - p.py[k], z = target.z - p.pz[k];
        const float dd = std::max(x * x + y * y + z * z, 1e-6f);
        const float in = std::max(0.0f, x * p.nx[k] + y * p.ny[k] + z * p.nz[k]);
        const float out = std::max(0.0f, -(x * axis_.x + y * axis_.y + z * axis_.z));
        weight[k] = in * out / (dd * dd);
        valid[k] = weight[k] > 0 ? wanted[k] : 0;
      }
      aim(p, target);
      trace(valid);
      for (std::size_t k = 0; k < kPacket; ++k) {
        if (!valid[k]) continue;
        const bool open = !(ray_.tfar[k] < 0);
        sums.all[k] += weight[k];
        sums.visible[k] += open ? weight[k] : 0;
        sums.traced[k] += 1;
        sums.open[k] += open;
      }
    }
  }

  void aim(const Packet& p, Triple target) {
    for (std::size_t k = 0; k < kPacket; ++k) {
      const float ox = p.px[k] + kLiftOff * p.fx[k], oy = p.py[k] + kLiftOff * p.fy[k],
                  oz = p.pz[k] + kLiftOff * p.fz[k];
      float x = model_.parallel ? target.x : target.x - ox;
      float y = model_.parallel ? target.y : target.y - oy;
      float z = model_.parallel ? target.z : target.z - oz;
      const float least = kGrazing * std::sqrt(x * x + y * y + z * z);
      const float lift = std::max(0.0f, least - (x * p.fx[k] + y * p.fy[k] + z * p.fz[k]));
      x += lift * p.fx[k], y += lift * p.fy[k], z += lift * p.fz[k];
      ray_.org_x[k] = ox, ray_.org_y[k] = oy, ray_.org_z[k] = oz;
      ray_.dir_x[k] = x, ray_.dir_y[k] = y, ray_.dir_z[k] = z;
      ray_.tnear[k] = 0, ray_.tfar[k] = 1, ray_.time[k] = 0;
      ray_.mask[k] = 0xffffffffu, ray_.id[k] = 0, ray_.flags[k] = 0;
    }
  }

  void trace(const std::array<int, kPacket>& valid) {
    const auto wanted = std::count(valid.begin(), valid.end(), -1);
    if (wanted == 0) return;
    tracer_.blocked16(valid.data(), ray_);
    rays += static_cast<std::uint64_t>(wanted);
  }

  const Tracer& tracer_;
  const twin::Light& light_;
  const twin::LightModel& model_;
  Triple axis_;
  alignas(64) RTCRay16 ray_;
};

}  // namespace

void trace_fraction(const View& view, const twin::Light& light, Strata strata, std::size_t first,
                    std::span<float> out) {
  Shadow shadow(view, light);
  Packet packet;
  for (std::size_t k = 0; k < out.size(); k += kPacket) {
    packet.load(view.buffer, first + k, std::min(kPacket, out.size() - k));
    shadow.fractions(packet, strata, &out[k]);
  }
  work().shadow_rays += shadow.rays;
}

}  // namespace chiaro::render
