// SPDX-License-Identifier: Apache-2.0
// The shipped sitter: a closed mesh, of a head's size, true to its model and to its landmarks.
#include "simulator/bust/bust.h"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <iterator>
#include <map>
#include <yaml-cpp/yaml.h>

#include "controller/core/geometry.h"
#include "simulator/bust/bust_mesh.h"

namespace chiaro::simulator {
namespace {

using core::Vec3;

const std::filesystem::path kSubjects = std::filesystem::path(CHIARO_SOURCE) / "config/subjects";

const TriangleMesh& shipped_model() {
  static const TriangleMesh mesh = bust_mesh();
  return mesh;
}

std::size_t edges_not_shared_by_two(const TriangleMesh& mesh) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> uses;
  for (const auto& t : mesh.triangles)
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t a = t[k], b = t[(k + 1) % 3];
      ++uses[{std::min(a, b), std::max(a, b)}];
    }
  return static_cast<std::size_t>(
      std::count_if(uses.begin(), uses.end(), [](const auto& use) { return use.second != 2; }));
}

double volume(const TriangleMesh& mesh) {
  double sum = 0;
  for (const auto& t : mesh.triangles)
    sum +=
        core::dot(mesh.positions[t[0]], core::cross(mesh.positions[t[1]], mesh.positions[t[2]])) /
        6;
  return sum;
}

TEST(SurfaceNet, GivesASphereItsVolumeClosedAndOutward) {
  GridLines grid;
  for (double t = -1.3; t < 1.31; t += 0.1) grid.x.push_back(t);
  grid.y = grid.z = grid.x;
  const TriangleMesh mesh = surface_net([](Vec3 p) { return core::length(p) - 1; }, grid);
  EXPECT_EQ(edges_not_shared_by_two(mesh), 0u);
  EXPECT_NEAR(volume(mesh), 4.0 / 3.0 * 3.14159, 0.05);
  for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
    EXPECT_NEAR(core::length(mesh.positions[i]), 1, 1e-3);
    EXPECT_GT(core::dot(mesh.normals[i], mesh.positions[i]), 0.99);
  }
}

TEST(SurfaceNet, StaysClosedWhereTwoBodiesTouchAcrossACell) {
  GridLines grid;
  for (double t = -2.05; t < 2.1; t += 0.25) grid.x.push_back(t);
  grid.y = grid.z = grid.x;
  const TriangleMesh mesh = surface_net(
      [](Vec3 p) {
        return std::min(core::length(p - Vec3{0.62, 0.62, 0}),
                        core::length(p + Vec3{0.62, 0.62, 0})) -
               0.86;
      },
      grid);
  EXPECT_EQ(edges_not_shared_by_two(mesh), 0u);
}

TEST(Bust, IsClosedAndWithinItsTriangleBudget) {
  const TriangleMesh& mesh = shipped_model();
  EXPECT_GE(mesh.triangles.size(), 60'000u);
  EXPECT_LE(mesh.triangles.size(), 100'000u);
  EXPECT_EQ(edges_not_shared_by_two(mesh), 0u);
  EXPECT_GT(volume(mesh), 0.015);  // cubic metres; inside out it would be negative
}

TEST(Bust, HasAHumanHeadsSizeAndStandsOnItsBase) {
  core::Box3 box;
  for (const Vec3& p : shipped_model().positions) box.include(p);
  EXPECT_NEAR(box.least.z, 0, 1e-3);
  EXPECT_NEAR(box.most.z, kBustHeight, 2e-3);
  EXPECT_NEAR(box.least.x + box.most.x, 0, 1e-3);
  double widest = 0;  // of the cranium, above the ears
  for (const Vec3& p : shipped_model().positions)
    if (p.z > kEyeHeight + 0.05) widest = std::max(widest, 2 * p.x);
  EXPECT_GT(widest, 0.14);
  EXPECT_LT(widest, 0.18);
}

TEST(Bust, NormalsPointOutOfTheModel) {
  const TriangleMesh& mesh = shipped_model();
  for (std::size_t i = 0; i < mesh.positions.size(); i += 97)
    EXPECT_GT(bust_distance(mesh.positions[i] + 0.001 * mesh.normals[i]),
              bust_distance(mesh.positions[i] - 0.001 * mesh.normals[i]));
}

TEST(Bust, LandmarksLieOnTheFace) {
  const YAML::Node sheet = YAML::LoadFile(kSubjects / "bust.yaml");
  ASSERT_GE(sheet["landmarks"].size(), 6u);
  for (const auto& mark : sheet["landmarks"]) {
    const auto p = mark.second.as<std::vector<double>>();
    EXPECT_LT(std::abs(bust_distance({p[0], p[1], p[2]})), 0.001) << mark.first.as<std::string>();
  }
  EXPECT_NEAR(sheet["eye_fraction"].as<double>(), kEyeHeight / kBustHeight, 1e-3);
}

TEST(Bust, ShippedFileHoldsTheModel) {
  const auto file = std::filesystem::temp_directory_path() / "chiaro_bust_test.ply";
  ASSERT_TRUE(write_ply(file, shipped_model()));
  // Compilers round differently in the last bit: the size is the same, the surface too.
  EXPECT_EQ(std::filesystem::file_size(file), std::filesystem::file_size(kSubjects / "bust.ply"));
  std::filesystem::remove(file);
  std::ifstream in(kSubjects / "bust.ply", std::ios::binary);
  const std::string bytes{std::istreambuf_iterator<char>(in), {}};
  const std::size_t start = bytes.find("end_header\n") + 11;
  for (std::size_t i = 0; i < shipped_model().positions.size(); i += 53) {
    std::array<float, 3> p{};
    std::copy_n(bytes.data() + start + 24 * i, sizeof p, reinterpret_cast<char*>(p.data()));
    EXPECT_LT(core::distance({p[0], p[1], p[2]}, shipped_model().positions[i]), 1e-5);
  }
}

TEST(Bust, RefusesAFolderThatIsNotThere) {
  const auto result = write_ply("/no/such/folder/bust.ply", bust_mesh(0.2));
  ASSERT_FALSE(result);
  EXPECT_EQ(result.problems()[0].where.file, "/no/such/folder/bust.ply");
}

}  // namespace
}  // namespace chiaro::simulator
