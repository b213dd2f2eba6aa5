// SPDX-License-Identifier: Apache-2.0
// What these lamps can do, at a glance: a small set of attainable looks as different from each
// other as can be (Marks and others 1997, Design Galleries, with a perceptual distance). Many rigs
// are tried at random, unusable pictures left out, the widest spread set of them chosen, and every
// other one counted to the look it resembles most.
#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <vector>

#include "controller/design/design.h"

namespace chiaro::design {

struct GalleryOptions {
  std::size_t looks = 9;
  std::size_t samples = 600;  ///< rigs tried
  std::uint64_t seed = 1;
  std::vector<std::string> locked;
  bool move_stands = true;
  core::Size sample_size{64, 64}, picture_size{256, 256};
  int threads = 2;
  const std::atomic<bool>* stop = nullptr;
  std::function<void(std::size_t tried)> progress;  ///< one thread at a time
};

struct GalleryLook {
  Look look;         ///< rig (wanted and placed alike), picture at picture_size, instructions
  double apart = 0;  ///< distance from the nearest other look of the gallery, in L*
  double share = 0;  ///< of all usable samples: those it stands for
};
struct Gallery {
  std::vector<GalleryLook> looks;  ///< neighbours resemble each other
  std::size_t tried = 0, usable = 0;
  double least_apart = 0, mean_apart = 0;  ///< over pairs of looks
  double mean_random = 0;                  ///< over pairs of samples as they came, to compare
};

/// What a look is compared by: L* in 16 x 16 cells, so that what is finer does not count.
std::vector<float> signature_of(const core::Plane& luminance);
/// Root mean square difference, L*.
double apart(const std::vector<float>& a, const std::vector<float>& b);

/// Indices of `count` signatures whose least distance is as large as exchanges make it: greedy
/// farthest first, then swaps until none helps.
std::vector<std::size_t> most_dispersed(const std::vector<std::vector<float>>& signatures,
                                        std::size_t count);

/// Same seed and samples, same gallery, whatever `threads`. Problems: an unknown lock, every lamp
/// locked, no usable picture.
core::Result<Gallery> gallery(const studio::Studio& studio, const LayersSource& twin,
                              const GalleryOptions& options);

/// The looks' pictures in rows, three or more a row, on grey.
core::Picture contact_sheet(const Gallery& gallery);

}  // namespace chiaro::design
