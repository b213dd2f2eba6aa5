// SPDX-License-Identifier: Apache-2.0
// The inner loops, in vectors chosen for the processor at run time. Each is the float twin of a
// formula in twin/lights, tested against it. All work on one tile.
#pragma once

#include <cstdint>
#include <span>

#include "controller/render/samples.h"
#include "controller/twin/scene.h"

namespace chiaro::render::kernels {

/// Unshadowed: `irradiance` in lux, `glossy` = specular weight x highlight in lux, for the kTile
/// samples of a tile. `glossy` may be null when the tile has no gloss. Light kinds without a vector
/// kernel go through their scalar formulas. `shading` matters to rectangles and disks only:
/// quickly, what is `visible` (the tile's; null: everything) nowhere in a vector may be left at 0.
void shade(const Samples& samples, const twin::Light& light, std::size_t tile, float* irradiance,
           float* glossy, Shading shading = Shading::exact, const float* visible = nullptr);
/// Points, spots, parallel light.
void shade_small(const Samples& samples, const twin::Light& light, std::size_t tile,
                 float* irradiance, float* glossy);
/// Rectangles and disks by their closed forms, highlights by four or nine points of the face.
void shade_face(const Samples& samples, const twin::Light& light, std::size_t tile,
                float* irradiance, float* glossy);
/// The same by an expansion about the face's middle; see Shading::quick. False, and nothing to be
/// read, where a sample of the tile is too near or too sharp for it.
bool shade_face_quickly(const Samples& samples, const twin::Light& light, std::size_t tile,
                        const float* visible, float* irradiance, float* glossy);

/// out[i] = visible[i] * (k * albedo[i] * irradiance[i] + g * glossy[i]); `visible` or `glossy` may
/// be null (1 and 0). n is a multiple of 64.
void combine(const float* albedo, const float* irradiance, const float* glossy,
             const float* visible, float k, float g, float* out, std::size_t n);
/// out[i] = visible[i] * k * irradiance[i] * (r * red[i] + g * green[i] + b * blue[i])
void combine_rgb(const Samples& samples, std::size_t tile, const float* irradiance,
                 const float* glossy, const float* visible, const float rgb[3], float glossy_gain,
                 float* out);

/// Blended visibility of a tile from up to 8 places: sum of weight x bit, or of weight x byte /
/// 255.
struct Bits {
  const std::uint8_t* bits;  ///< 8 samples a byte, lowest bit first
  float weight;
};
void blend_bits(std::span<const Bits> places, float* out, std::size_t n);
struct Bytes {
  const std::uint8_t* bytes;
  float weight;
};
void blend_bytes(std::span<const Bytes> places, float* out, std::size_t n);

/// out = ambient + sum level x plane, over any length.
void mix(std::span<const float* const> planes, std::span<const float> levels, const float* ambient,
         float* out, std::size_t n);

/// For tests, one thread: runs `f` once for every instruction set that this processor has and this
/// program was compiled for, the kernels held to it.
void for_each_target(void (*f)(void* context), void* context);

}  // namespace chiaro::render::kernels
