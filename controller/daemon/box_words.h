// SPDX-License-Identifier: Apache-2.0
// `Wanted` and `Sent` as the fixed number of words that a box carries. Real-time but for the
// writing of `Wanted`, which is the brain's; the vectors must have been sized before.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "controller/daemon/box.h"
#include "controller/rig/wanted.h"
#include "controller/studio/studio.h"

namespace chiaro::daemon {

BoxFormat wanted_format(const studio::Studio& studio);
BoxFormat sent_format(const studio::Studio& studio);

/// Values whose vectors have the studio's sizes.
rig::Wanted sized_wanted(const studio::Studio& studio);
rig::Sent sized_sent(const studio::Studio& studio);

/// Precondition: the value is sized for the format and `words` is the format's. A source with
/// fewer fixtures has no opinion on the rest.
void to_words(const rig::Wanted& wanted, std::size_t fixtures, std::span<std::uint64_t> words);
void from_words(std::span<const std::uint64_t> words, rig::Wanted& wanted);
void to_words(const rig::Sent& sent, std::span<std::uint64_t> words);
void from_words(std::span<const std::uint64_t> words, rig::Sent& sent);

}  // namespace chiaro::daemon
