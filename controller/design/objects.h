// SPDX-License-Identifier: Apache-2.0
// Objects lit one by one (thesis, chapter 6). In space: a spot per object whose cone holds it and
// spares its neighbours, each spot with a goal of its own [I-36]. In the picture: each object drawn
// and lit with the others hidden, then put together by depth [I-37].
#pragma once

#include <string>
#include <vector>

#include "controller/design/design.h"
#include "controller/render/spot_cone.h"
#include "controller/render/view.h"

namespace chiaro::design {

struct ObjectGoal {
  std::size_t subject = 0;  ///< index into Studio::subjects
  std::size_t fixture = 0;  ///< its lamp; not used in the picture
  Goal goal;
};

struct LitObject {
  std::string object, lamp;
  core::Vec3 at, aim_at;  ///< of the lamp, metres
  render::SpotCone cone;  ///< full light within `cone.angle`
  double level = 0;
  double covered = 0;       ///< share of the object's pixels that the lamp's light reaches
  double stray = 0;         ///< share of the lamp's light on subjects that falls on other ones
  double cost = 0;          ///< of its goal, over its own pixels
  std::size_t tries = 0;    ///< places tried
  std::string instruction;  ///< for a person; empty where a motor does it
};

struct LitObjects {
  std::vector<LitObject> objects;
  Look look;  ///< every lamp of the studio, those of no object as placed; heads turned and zoomed
};

/// Any number of objects and lamps. Ideal and perceptual goals; a wavelet goal, which compares
/// place by place, is taken as perceptual. Stands and virtual mounts are tried over their region
/// about the object, others hang where they hang. Problems: an object that no camera pixel shows,
/// two objects with one lamp, a lamp from which no cone holds its object.
core::Result<LitObjects> light_objects(const studio::Studio& studio,
                                       std::shared_ptr<const render::Tracer> tracer,
                                       const std::vector<ObjectGoal>& goals);

struct MergedObjects {
  std::vector<Look> looks;  ///< beside the goals
  core::Picture picture;    ///< of them all, at full size
};
/// Each object with the others hidden, the background kept. Any goal.
core::Result<MergedObjects> merge_objects(const studio::Studio& studio,
                                          const std::vector<ObjectGoal>& goals,
                                          const GeometricOptions& geometric,
                                          const Options& options);

/// {"objects": {"NAME": {"lamp": "spot", "like": "ideal" | {"mood": "split"} | {"exemplar": FILE},
/// "objective": "perceptual"}}}, every problem with its place. `named` makes a goal of a mood's
/// name or a picture's file.
using NamedGoal = std::function<core::Result<Goal>(const std::string& mood,
                                                   const std::string& exemplar, Objective)>;
core::Result<std::vector<ObjectGoal>> objects_from_json(const std::string& text,
                                                        const std::string& file,
                                                        const studio::Studio& studio,
                                                        const std::filesystem::path& folder,
                                                        bool lamps, const NamedGoal& named);

}  // namespace chiaro::design
