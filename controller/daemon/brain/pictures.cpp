// SPDX-License-Identifier: Apache-2.0
#include "controller/daemon/brain/pictures.h"

#include "controller/core/picture_file.h"

namespace chiaro::daemon {
namespace {

constexpr int kJpegQuality = 92;
/// A photograph of two megapixels is smaller than this; a larger one is worth the work.
constexpr std::size_t kSmall = 1u << 20;

struct Read {
  core::Picture light;
  std::string kept;
};

core::Result<Read> read(std::string bytes, const std::string& name) {
  const auto picture = core::decode_picture(
      {reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size()}, name);
  if (!picture) return picture.problems();
  core::Picture light = core::linear_at_most(*picture);
  if (bytes.size() > kSmall || light.red.size.pixels() < picture->size.pixels()) {
    const auto smaller = core::encode_jpeg(core::encoded(light), kJpegQuality);
    bytes.assign(smaller.begin(), smaller.end());
  }
  return Read{std::move(light), std::move(bytes)};
}

}  // namespace

core::Result<std::string> kept_picture(std::string bytes, const std::string& name) {
  auto picture = read(std::move(bytes), name);
  if (!picture) return picture.problems();
  return std::move(picture->kept);
}

GoalReader goal_like(std::string bytes, std::string name, design::Objective objective) {
  return [bytes = std::move(bytes), name = std::move(name),
          objective]() mutable -> core::Result<ReadGoal> {
    auto picture = read(std::move(bytes), name);
    if (!picture) return picture.problems();
    design::ExampleGoal goal;
    goal.name = name;
    goal.exemplar = std::move(picture->light);
    goal.objective = objective;
    return ReadGoal{std::move(goal), std::move(picture->kept)};
  };
}

}  // namespace chiaro::daemon
