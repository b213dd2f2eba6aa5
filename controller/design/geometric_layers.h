// SPDX-License-Identifier: Apache-2.0
// The geometric twin's side of `Layers`, beyond what every caller sees in layers.h.
#pragma once

#include "controller/design/layers.h"
#include "controller/render/view.h"
#include "controller/twin/scene.h"

namespace chiaro::design {

/// As geometric_layers, with the light that comes by way of other surfaces: what a camera in a room
/// sees. What designs for real studios are made with.
core::Result<std::unique_ptr<LayersSource>> bounced_layers(const studio::Studio& studio,
                                                           const GeometricOptions& options);

/// As bounced_layers, seen by another camera of the studio: the same lamps, exposed as that one is.
core::Result<std::unique_ptr<LayersSource>> layers_of_camera(const studio::Studio& studio,
                                                             const std::string& camera,
                                                             const GeometricOptions& options);

/// The tracer of a source made by geometric_layers, for a picture at any size or another camera.
/// Null for any other source.
std::shared_ptr<const render::Tracer> tracer_of(const LayersSource& source);

}  // namespace chiaro::design
