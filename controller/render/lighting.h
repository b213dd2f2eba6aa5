// SPDX-License-Identifier: Apache-2.0
// One light over one view, tile by tile: the fast path under `layer`, and what the design engine's
// geometric twin calls for every trial.
#pragma once

#include "controller/render/samples.h"
#include "controller/render/shadow.h"
#include "controller/render/view.h"

namespace chiaro::render {

/// Where the visible fraction of a light comes from. Implementations are thread-safe.
class Visible {
 public:
  virtual ~Visible() = default;
  /// kTile values 0..1; beyond the last sample anything finite.
  virtual void tile(std::size_t tile, float* out) const = 0;
  virtual bool traces() const { return false; }  ///< slow: worth all cores
};

/// Traced anew on every call.
class Traced : public Visible {
 public:
  Traced(const View& view, const twin::Light& light, Strata strata)
      : view_(view), light_(light), strata_(strata) {}
  void tile(std::size_t tile, float* out) const override;
  bool traces() const override { return true; }

 private:
  const View& view_;
  const twin::Light& light_;
  Strata strata_;
};

/// Diffuse + specular luminance of the light at full level, exposure applied. `visible` may be
/// null: no shadows. `out` is resized as needed. `seen`, where given, also gets what `visibility`
/// gives, in the same pass.
void luminance(const View& view, const twin::Light& light, double gain, const Visible* visible,
               core::Plane& out, Shading shading = Shading::exact, core::Plane* seen = nullptr);
/// In colour, diffuse and specular apart; `out` is resized as needed.
void colour(const View& view, const twin::Light& light, double gain, const Visible* visible,
            core::Layer& out, Shading shading = Shading::exact);
/// 1 where nothing is seen.
void visibility(const View& view, const Visible& visible, core::Plane& out);

}  // namespace chiaro::render
