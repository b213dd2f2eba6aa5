// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>

#include "controller/twin/head.h"
#include "controller/twin/mesh/prepared_mesh.h"
#include "controller/twin/scene.h"

namespace chiaro::twin {
namespace {

using core::Vec3;

constexpr double kUnbounded = 60;        // metres
constexpr double kMostSubjectSize = 50;  // metres

/// Three model axes and where they go in the studio.
struct Turn {
  Vec3 model_side, model_front, model_up;
  Vec3 side, front, up{0, 0, 1};
  Vec3 operator()(Vec3 p) const {
    return dot(p, model_side) * side + dot(p, model_front) * front + dot(p, model_up) * up;
  }
};

SurfaceMaterial surface(const studio::Material& from) {
  return {from.diffuse, static_cast<float>(from.specular), static_cast<float>(from.shininess), -1};
}

class Builder {
 public:
  explicit Builder(const studio::Studio& studio) : studio_(studio) {}

  core::Result<std::shared_ptr<const Geometry>> build(const std::filesystem::path& cache) {
    for (const studio::Subject& subject : studio_.subjects) {
      auto mesh = load_mesh(subject.mesh, cache);
      if (mesh)
        add(subject, *std::move(mesh));
      else
        for (core::Problem problem : mesh.problems()) {
          problem.what = "subject \"" + subject.name + "\": " + problem.what;
          problems_.push_back(std::move(problem));
        }
    }
    if (core::any_error(problems_)) return problems_;
    set_aim();
    for (const studio::BackgroundPlane& plane : studio_.background) add(plane);
    if (out_->meshes.empty()) {
      return core::Problem{
          {studio_.file.string(), 0, 0},
          "the studio has neither subject nor background: there is nothing to light",
          "add a subject: with a mesh, or {stand_in: person}"};
    }
    return std::shared_ptr<const Geometry>(out_);
  }

 private:
  void refuse(const studio::Subject& subject, std::string what, std::string remedy) {
    problems_.push_back(
        {subject.place, "subject \"" + subject.name + "\": " + std::move(what), std::move(remedy)});
  }

  core::AimFrame camera_frame(Vec3 at) const {
    return core::aim_frame(
        at, studio_.cameras.empty() ? at + Vec3{0, -1, 0} : studio_.main_camera().at);
  }

  std::optional<Turn> turn(const studio::Subject& subject, bool y_up_by_format) {
    const bool y_up =
        subject.up == studio::UpAxis::by_format ? y_up_by_format : subject.up == studio::UpAxis::y;
    Turn out;
    out.model_up = y_up ? Vec3{0, 1, 0} : Vec3{0, 0, 1};
    Vec3 front = subject.front.value_or(y_up ? Vec3{0, 0, 1} : Vec3{0, -1, 0});
    front = front - dot(front, out.model_up) * out.model_up;
    if (length(front) < 1e-6) {
      refuse(subject, "its front points along its up axis", "give another front, or up: y or z");
      return std::nullopt;
    }
    out.model_front = unit(front);
    out.model_side = cross(out.model_up, out.model_front);
    const core::AimFrame frame = camera_frame(subject.at);
    out.front = std::cos(subject.facing) * frame.towards_camera +
                std::sin(subject.facing) * frame.camera_right;
    out.side = cross(out.up, out.front);
    return out;
  }

  void add(const studio::Subject& subject, PreparedMesh from) {
    for (const std::string& warning : from.warnings)
      out_->warnings.push_back({{subject.mesh.string(), 0, 0}, warning, "", true});
    const auto turned = turn(subject, from.y_up);
    if (!turned) return;
    Mesh mesh;
    mesh.name = subject.name;
    mesh.subject = true;
    mesh.texture_coordinates = std::move(from.texture_coordinates);
    mesh.indices = std::move(from.indices);
    mesh.material = std::move(from.material);
    if (!place(subject, *turned, from, mesh)) return;
    add_materials(subject, from, mesh);
    finish(std::move(mesh));
    sides_.push_back(turned->side);
  }

  /// Turns, scales and stands the points; false when the size makes no sense.
  bool place(const studio::Subject& subject, const Turn& turned, const PreparedMesh& from,
             Mesh& mesh) {
    const std::size_t vertices = from.positions.size() / 3;
    core::Box3 box;
    std::vector<Vec3> points(vertices);
    for (std::size_t i = 0; i < vertices; ++i) {
      points[i] =
          turned({from.positions[3 * i], from.positions[3 * i + 1], from.positions[3 * i + 2]});
      box.include(points[i]);
    }
    if (subject.height && box.extent().z < 1e-9) {
      refuse(subject, "the mesh is flat: it has no height to scale", "is its up axis right?");
      return false;
    }
    const double scale = subject.height ? *subject.height / box.extent().z : 1;
    const double size = scale * length(box.extent());
    if (!(size < kMostSubjectSize) || !(size > 1e-3)) {
      refuse(subject,
             "the mesh is " + std::to_string(size) + " m large" +
                 (subject.height ? "" : " as its file has it, taken as metres"),
             "give its height, such as height: 1.7 m");
      return false;
    }
    const double base = subject.stand_in && subject.eye_height > 0
                            ? subject.eye_height - kEyesOfBust * scale * box.extent().z
                            : subject.at.z;
    const Vec3 stand{subject.at.x - scale * box.centre().x, subject.at.y - scale * box.centre().y,
                     base - scale * box.least.z};
    mesh.positions.resize(3 * vertices);
    mesh.normals.resize(3 * vertices);
    for (std::size_t i = 0; i < vertices; ++i) {
      const Vec3 p = stand + scale * points[i];
      const Vec3 n =
          unit(turned({from.normals[3 * i], from.normals[3 * i + 1], from.normals[3 * i + 2]}));
      put(mesh.positions, i, p);
      put(mesh.normals, i, n);
    }
    return true;
  }

  static void put(std::vector<float>& list, std::size_t i, Vec3 v) {
    list[3 * i] = static_cast<float>(v.x);
    list[3 * i + 1] = static_cast<float>(v.y);
    list[3 * i + 2] = static_cast<float>(v.z);
  }

  void add_materials(const studio::Subject& subject, const PreparedMesh& from, Mesh& mesh) {
    const auto first = static_cast<std::uint16_t>(out_->materials.size());
    if (subject.material) {
      out_->materials.push_back(surface(*subject.material));
      std::fill(mesh.material.begin(), mesh.material.end(), first);
      return;
    }
    const auto first_texture = static_cast<int>(out_->textures.size());
    for (const auto& picture : from.textures) out_->textures.push_back(core::linear(picture));
    for (SurfaceMaterial material : from.materials) {
      if (material.texture >= 0) material.texture += first_texture;
      out_->materials.push_back(material);
    }
    for (std::uint16_t& material : mesh.material)
      material = static_cast<std::uint16_t>(material + first);
  }

  void set_aim() {
    Vec3 aim = studio_.cameras.empty() ? Vec3{} : studio_.main_camera().look_at;
    if (!out_->meshes.empty()) {
      const studio::Subject& first = studio_.subjects.front();
      aim = first.aim ? *first.aim : head_centre(out_->meshes.front(), sides_.front());
    }
    out_->aim = camera_frame(aim);
    double farthest = 0;
    for (const Mesh& mesh : out_->meshes)
      for (std::size_t i = 0; i + 2 < mesh.positions.size(); i += 3)
        farthest = std::max(farthest, distance(aim, {mesh.positions[i], mesh.positions[i + 1],
                                                     mesh.positions[i + 2]}));
    if (farthest > 0) out_->radius = farthest;
    out_->subject_bounds = out_->bounds;
  }

  void add(const studio::BackgroundPlane& plane) {
    const PlaneFrame frame = plane_frame(plane, out_->aim);
    Mesh mesh;
    mesh.name = plane.name;
    const Vec3 corners[] = {
        frame.centre - frame.right - frame.up, frame.centre + frame.right - frame.up,
        frame.centre + frame.right + frame.up, frame.centre - frame.right + frame.up};
    mesh.positions.resize(12);
    mesh.normals.resize(12);
    for (std::size_t i = 0; i < 4; ++i) {
      put(mesh.positions, i, corners[i]);
      put(mesh.normals, i, frame.normal);
    }
    mesh.indices = {0, 1, 2, 0, 2, 3};
    mesh.material.assign(2, static_cast<std::uint16_t>(out_->materials.size()));
    out_->materials.push_back(surface(plane.material));
    finish(std::move(mesh));
  }

  void finish(Mesh mesh) {
    const core::Box3 box = bounds_of(mesh);
    out_->bounds.include(box.least);
    out_->bounds.include(box.most);
    mesh.positions.push_back(0);  // Embree reads 16 bytes at the last point
    out_->meshes.push_back(std::move(mesh));
  }

  const studio::Studio& studio_;
  std::shared_ptr<Geometry> out_ = std::make_shared<Geometry>();
  std::vector<Vec3> sides_;
  core::Problems problems_;
};

}  // namespace

PlaneFrame plane_frame(const studio::BackgroundPlane& plane, const core::AimFrame& aim) {
  PlaneFrame out;
  out.normal = length(plane.normal) > 0 ? unit(plane.normal) : Vec3{0, 0, 1};
  const bool wall = std::abs(out.normal.z) < 0.7;
  const Vec3 right = unit(wall ? cross(Vec3{0, 0, 1}, out.normal)
                               : aim.camera_right - dot(aim.camera_right, out.normal) * out.normal);
  const Vec3 up = cross(out.normal, right);
  const double width = plane.width > 0 ? plane.width : kUnbounded;
  const double height = plane.height > 0 ? plane.height : kUnbounded;
  out.right = 0.5 * width * right;
  out.up = 0.5 * height * up;
  out.centre = plane.through;
  if (wall && plane.height > 0) out.centre = out.centre + out.up;
  return out;
}

core::Result<std::shared_ptr<const Geometry>> build_geometry(const studio::Studio& studio,
                                                             const std::filesystem::path& cache) {
  return Builder(studio).build(cache);
}

}  // namespace chiaro::twin
