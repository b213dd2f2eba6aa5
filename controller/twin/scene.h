// SPDX-License-Identifier: Apache-2.0
// The geometric twin: the studio's surfaces as triangles and its lamps as lights. Geometry is built
// once and shared read-only by every thread; a Scene is geometry plus the lights of one rig.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "controller/core/geometry.h"
#include "controller/core/picture.h"
#include "controller/core/result.h"
#include "controller/studio/studio.h"

namespace chiaro::twin {

struct SurfaceMaterial {
  core::Rgb diffuse{0.5, 0.5, 0.5};
  float specular = 0, shininess = 16;
  int texture = -1;  ///< index into Geometry::textures, multiplies diffuse; -1 = none
};

/// Triangles in the studio frame, metres. `normals` are unit shading normals, one per vertex.
struct Mesh {
  std::string name;
  bool subject = false;
  std::vector<float> positions;  ///< x y z per vertex (padded by one float at the end for Embree)
  std::vector<float> normals;    ///< x y z per vertex
  std::vector<float> texture_coordinates;  ///< u v per vertex, or empty
  std::vector<std::uint32_t> indices;      ///< three per triangle
  std::vector<std::uint16_t> material;     ///< one per triangle
  std::size_t triangles() const { return indices.size() / 3; }
};

/// Immutable after building; thread-safe to read.
struct Geometry {
  std::vector<Mesh> meshes;  ///< object id = index + 1
  std::vector<SurfaceMaterial> materials;
  std::vector<core::Picture> textures;  ///< linear albedo; v = 0 is the bottom row, repeating
  core::AimFrame aim;                   ///< frame of azimuth, elevation, distance
  core::Box3 subject_bounds, bounds;
  double radius = 1;        ///< of the subjects about the aim, metres
  core::Problems warnings;  ///< what was left out (a missing texture), for people
};

/// Loads, welds, normalises, scales and places every subject and background plane. Prepared meshes
/// are cached by content hash in `cache` (empty = no cache).
///
/// A subject stands with the middle of its bounding box over `at` and its lowest point at `at.z`,
/// its front turned `facing` from the direction of the main camera. Formats by custom: OBJ, glTF,
/// DAE are Y up with +Z in front; PLY, STL, 3DS, OFF Z up with -Y in front; `up` and `front`
/// override. A stand-in is raised so that its eyes (kEyesOfBust of its height) are at `eye_height`.
/// The default aim is the head's centre: the middle of what stands above the neck, the narrowest
/// place in the upper part with shoulders at least 1.4 times as wide below; without a neck, the
/// middle of the first subject's box.
/// A background plane whose normal is level (a wall) stands on `through`, centred sideways; any
/// other is centred on it, its width along the camera's right. An unbounded one is 60 m wide.
core::Result<std::shared_ptr<const Geometry>> build_geometry(const studio::Studio& studio,
                                                             const std::filesystem::path& cache);

/// Where the eyes of the shipped bust are, as a part of its height from the base.
inline constexpr double kEyesOfBust = 0.8052;

/// The rectangle that stands for a background plane: centre, unit normal, and the vectors from the
/// centre to the middle of its right and upper edge. `right` x `up` points along the normal.
struct PlaneFrame {
  core::Vec3 centre, normal, right, up;
};
PlaneFrame plane_frame(const studio::BackgroundPlane& plane, const core::AimFrame& aim);

/// One lamp at one placement, at full level. Units: candela, metres; `colour` has luminance 1.
struct Light {
  studio::Optic::Kind kind = studio::Optic::Kind::point;
  studio::Optic::Attenuation attenuation = studio::Optic::Attenuation::inverse_square;
  core::Vec3 position;
  core::Vec3 direction{0, 1, 0};  ///< unit, the way the light goes along its axis
  core::Vec3 right{1, 0, 0},
      up{0, 0, 1};     ///< unit, span rectangle and disk; right x up = -direction or +; orthonormal
  double candela = 0;  ///< on axis at full (rectangle, disk: whole face, seen from afar)
  double cos_beam = 1, cos_field = 0;  ///< of half angles, spot only; smoothstep between
  double width = 0, height = 0, radius = 0;
  core::Rgb colour{1, 1, 1};
  std::size_t fixture = 0;  ///< index into Studio::fixtures
};

/// No surface is taken to be nearer to a small source than this, so that light stays finite.
inline constexpr double kNearestLight = 0.01;
/// Length of a shadow ray towards parallel light, metres.
inline constexpr double kFarAway = 1000;

struct Scene {
  std::shared_ptr<const Geometry> geometry;
  std::vector<Light> lights;     ///< one per fixture, at full level, same order
  std::vector<double> levels;    ///< intensity 0..1 per light
  core::Rgb ambient_irradiance;  ///< lux times colour, on every surface alike
  double exposure_gain = 1;      ///< see studio::exposure_gain
};

/// Where a fixture is and points for a state (absent placement DOFs: the mount's own).
struct Pose {
  core::Vec3 position, direction;
};
Pose pose(const studio::Fixture& fixture, const core::FixtureState& state,
          const core::AimFrame& aim);
/// Its light at full level in that state.
Light light(const studio::Fixture& fixture, const core::FixtureState& state,
            const core::AimFrame& aim, core::Kelvin balance);
Scene lit_by(const studio::Studio& studio, std::shared_ptr<const Geometry> geometry,
             const studio::Rig& rig);

/// Why a fixture must not stand there, in a person's words; empty when it may (design section 6:
/// frame, view, room, other lamps, 0.6 m from the sitter). `rig` places the other lamps.
std::string infeasible(const studio::Studio& studio, const Geometry& geometry,
                       const studio::Rig& rig, std::size_t fixture);

}  // namespace chiaro::twin
