// SPDX-License-Identifier: Apache-2.0
#include "simulator/bust/bust_mesh.h"

#include <bit>
#include <cstring>
#include <fstream>

#include "simulator/bust/bust.h"

namespace chiaro::simulator {
namespace {

/// A stretch of an axis and the spacing wanted there, metres.
struct Band {
  double from, to, spacing;
};

/// Lines from the first band's start to the last one's end: at least as fine as every band asks,
/// coarser by 15 % of the way between bands.
std::vector<double> lines(const std::vector<Band>& bands, double detail) {
  const auto wanted = [&](double t) {
    double least = 1;
    for (const Band& band : bands) {
      const double away = t < band.from ? band.from - t : t > band.to ? t - band.to : 0;
      least = std::min(least, band.spacing / detail + 0.15 * away);
    }
    return least;
  };
  std::vector<double> at;
  for (double t = bands.front().from; t < bands.back().to; t += wanted(t)) at.push_back(t);
  at.push_back(bands.back().to);
  return at;
}

/// Odd counts would put a line on x = 0 or not by chance; mirroring keeps the face symmetric.
std::vector<double> mirrored(const std::vector<double>& half) {
  std::vector<double> all;
  for (auto i = half.rbegin(); i != half.rend(); ++i)
    if (*i > 0) all.push_back(-*i);
  all.insert(all.end(), half.begin(), half.end());
  return all;
}

void put(std::vector<char>& bytes, const void* data, std::size_t size) {
  const char* from = static_cast<const char*>(data);
  bytes.insert(bytes.end(), from, from + size);
}
void put(std::vector<char>& bytes, core::Vec3 v) {
  for (const double c : {v.x, v.y, v.z}) {
    const float f = static_cast<float>(c);
    put(bytes, &f, sizeof f);
  }
}

std::string header(const TriangleMesh& mesh) {
  return "ply\nformat binary_little_endian 1.0\n"
         "comment Chiaro's bust: metres, Z up, the face looks along -Y\n"
         "element vertex " +
         std::to_string(mesh.positions.size()) +
         "\nproperty float x\nproperty float y\nproperty float z\n"
         "property float nx\nproperty float ny\nproperty float nz\n"
         "element face " +
         std::to_string(mesh.triangles.size()) +
         "\nproperty list uchar uint vertex_indices\nend_header\n";
}

}  // namespace

TriangleMesh bust_mesh(double detail) {
  GridLines grid;
  grid.x = mirrored(lines(
      {{0, 0.014, 0.0021}, {0.016, 0.047, 0.0016}, {0.05, 0.085, 0.0032}, {0.085, 0.27, 0.018}},
      detail));
  grid.y = lines({{-0.135, -0.06, 0.0021}, {-0.03, 0.03, 0.0045}, {0.03, 0.16, 0.014}}, detail);
  constexpr double eye = kEyeHeight;
  grid.z = lines({{-0.03, eye - 0.25, 0.014},
                  {eye - 0.22, eye - 0.14, 0.007},
                  {eye - 0.118, eye + 0.03, 0.0021},
                  {eye - 0.075, eye - 0.065, 0.0013},  // mouth
                  {eye - 0.010, eye + 0.011, 0.0012},  // eyes
                  {eye + 0.03, eye + 0.083, 0.0032},
                  {eye + 0.09, eye + 0.15, 0.007}},
                 detail);
  return surface_net(bust_distance, grid);
}

core::Result<core::Done> write_ply(const std::filesystem::path& file, const TriangleMesh& mesh) {
  static_assert(std::endian::native == std::endian::little, "PLY is written as memory holds it");
  std::vector<char> bytes;
  for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
    put(bytes, mesh.positions[i]);
    put(bytes, mesh.normals[i]);
  }
  for (const auto& triangle : mesh.triangles) {
    bytes.push_back(3);
    put(bytes, triangle.data(), sizeof triangle);
  }
  std::ofstream out(file, std::ios::binary);
  out << header(mesh);
  out.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  if (!out)
    return core::Problem{{file.string()},
                         "the bust cannot be written there",
                         "check that the folder exists and may be written"};
  return core::Done{};
}

}  // namespace chiaro::simulator
