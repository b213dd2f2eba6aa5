// SPDX-License-Identifier: Apache-2.0
// The geometric twin's side of `Layers`: nothing but what tests and benches need beyond layers.h.
#pragma once

#include "controller/design/layers.h"
#include "controller/render/view.h"
#include "controller/twin/scene.h"

namespace chiaro::design {

/// The tracer of a source made by geometric_layers, for a picture at any size or another camera.
/// Null for any other source.
std::shared_ptr<const render::Tracer> tracer_of(const LayersSource& source);

}  // namespace chiaro::design
