// SPDX-License-Identifier: Apache-2.0
// Meshes from files: what is mended, what is refused, what is remembered.
#include <array>
#include <cmath>
#include <cstring>
#include <fstream>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sstream>

#include "controller/core/random.h"
#include "controller/twin/mesh/prepared_mesh.h"
#include "tests/support/meshes.h"

namespace chiaro::twin {
namespace {

using testing::HasSubstr;

class MeshFile : public testing::Test {
 protected:
  std::filesystem::path write(const std::string& name, const std::string& content) const {
    const auto file = folder.path() / name;
    std::ofstream(file, std::ios::binary) << content;
    return file;
  }
  core::Result<PreparedMesh> load(const std::string& name, const std::string& content) const {
    return load_mesh(write(name, content), {});
  }
  std::string refusal(const std::string& name, const std::string& content) const {
    const auto mesh = load(name, content);
    EXPECT_FALSE(mesh) << name << " was taken";
    return mesh ? "" : core::to_string(mesh.problems());
  }
  support::Folder folder;
};

const char* const kPyramid = R"(v 0 0 0
v 1 0 0
v 1 0 1
v 0 0 1
v 0.5 1 0.5
f 1 2 3 4
f 1 5 2
f 2 5 3
f 3 5 4
f 4 5 1
)";

std::string ascii_ply(const std::string& vertices, std::size_t vertex_count,
                      const std::string& faces, std::size_t face_count) {
  std::ostringstream out;
  out << "ply\nformat ascii 1.0\ncomment made by hand\nelement vertex " << vertex_count
      << "\nproperty float x\nproperty float y\nproperty float z\nelement face " << face_count
      << "\nproperty list uchar int vertex_indices\nend_header\n"
      << vertices << faces;
  return out.str();
}

TEST_F(MeshFile, ObjQuadsBecomeTrianglesAndYIsUp) {
  const auto mesh = load("pyramid.obj", kPyramid);
  ASSERT_TRUE(mesh) << core::to_string(mesh.problems());
  EXPECT_EQ(mesh->indices.size(), 3u * 6);
  EXPECT_TRUE(mesh->y_up);
}

TEST_F(MeshFile, SharpEdgesKeepTheirFacesFlat) {
  const auto mesh = load("pyramid.obj", kPyramid);
  ASSERT_TRUE(mesh);
  // Five flat sides meeting at more than 60 degrees: 4 + 4 x 3 corners, none shared.
  EXPECT_EQ(mesh->positions.size() / 3, 16u);
  for (std::size_t t = 0; t < mesh->indices.size(); t += 3)
    for (int k = 1; k < 3; ++k)
      for (std::size_t axis = 0; axis < 3; ++axis)
        EXPECT_NEAR(mesh->normals[3 * mesh->indices[t] + axis],
                    mesh->normals[3 * mesh->indices[t + static_cast<std::size_t>(k)] + axis], 1e-6);
}

TEST_F(MeshFile, EveryCornerMayHaveANormalOfItsOwn) {
  // A crumpled sheet: far more different corners than points. It used to be read for ever.
  constexpr std::size_t kSide = 24;
  std::string points, faces;
  std::size_t triangles = 0;
  for (std::size_t y = 0; y < kSide; ++y)
    for (std::size_t x = 0; x < kSide; ++x) {
      points += std::to_string(x) + " " + std::to_string(y) + " " +
                std::to_string((x * 7 + y * 13) % 11 * 3) + "\n";
      if (x + 1 == kSide || y + 1 == kSide) continue;
      const std::size_t a = y * kSide + x, b = a + 1, c = a + kSide, d = c + 1;
      faces += "3 " + std::to_string(a) + " " + std::to_string(b) + " " + std::to_string(d) +
               "\n3 " + std::to_string(a) + " " + std::to_string(d) + " " + std::to_string(c) +
               "\n";
      triangles += 2;
    }
  const auto mesh = load("sheet.ply", ascii_ply(points, kSide * kSide, faces, triangles));
  ASSERT_TRUE(mesh) << core::to_string(mesh.problems());
  EXPECT_GT(mesh->positions.size() / 3, 2u * kSide * kSide + 16);
}

TEST_F(MeshFile, RoundThingsGetSmoothNormals) {
  support::write_ply(folder.path() / "ball.ply", support::icosphere({}, 2, 3));
  const auto mesh = load_mesh(folder.path() / "ball.ply", {});
  ASSERT_TRUE(mesh);
  EXPECT_EQ(mesh->positions.size() / 3, 642u);  // none split
  for (std::size_t i = 0; i < mesh->positions.size(); ++i)
    EXPECT_NEAR(mesh->normals[i], mesh->positions[i] / 2, 5e-3);
}

TEST_F(MeshFile, DuplicatePointsAreWeldedAndUselessTrianglesDropped) {
  const auto mesh = load("soup.ply", ascii_ply("0 0 0\n1 0 0\n0 1 0\n0 0 0\n1 0 0\n1 1 0\n", 6,
                                               "3 0 1 2\n3 4 5 2\n3 0 1 2\n3 3 0 1\n3 1 1 2\n", 5));
  ASSERT_TRUE(mesh) << core::to_string(mesh.problems());
  EXPECT_EQ(mesh->indices.size(), 6u);
  EXPECT_EQ(mesh->positions.size(), 12u);
}

TEST_F(MeshFile, OfASurfaceStoredOncePerSideOneSideIsKept) {
  // Two-sided already: the copy would lie in its original's shadow.
  const auto mesh = load("sides.ply", ascii_ply("0 0 0\n1 0 0\n0 1 0\n1 1 0\n", 4,
                                                "3 0 1 2\n3 2 1 3\n3 0 2 1\n3 2 3 1\n", 4));
  ASSERT_TRUE(mesh) << core::to_string(mesh.problems());
  EXPECT_EQ(mesh->indices.size(), 6u);
  for (std::size_t i = 2; i < mesh->normals.size(); i += 3) EXPECT_GT(mesh->normals[i], 0.99f);
}

// [I-4]
TEST_F(MeshFile, BigEndianAndAsciiPlyEqualLittleEndian) {
  const std::string header =
      "element vertex 3\nproperty double x\nproperty float y\nproperty short z\n"
      "element face 1\nproperty uchar skipped\nproperty list ushort uint "
      "vertex_index\nend_header\n";
  std::string big, little;
  const auto put = [&](auto value) {
    std::array<char, sizeof value> raw;
    std::memcpy(raw.data(), &value, sizeof value);
    little.append(raw.data(), raw.size());
    big.append(raw.rbegin(), raw.rend());
  };
  for (const auto& [x, y, z] : {std::tuple{0.0, 0.0f, 0}, {2.0, 0.5f, -3}, {0.0, 4.0f, 5}})
    put(x), put(y), put(static_cast<std::int16_t>(z));
  put(std::uint8_t{9}), put(std::uint16_t{3});
  for (std::uint32_t i = 0; i < 3; ++i) put(i);
  const auto a = load("b.ply", "ply\nformat binary_big_endian 1.0\n" + header + big);
  const auto b = load("l.ply", "ply\nformat binary_little_endian 1.0\n" + header + little);
  const auto c =
      load("t.ply", "ply\nformat ascii 1.0\n" + header + "0 0 0\n2 0.5 -3\n0 4 5\n9 3 0 1 2");
  ASSERT_TRUE(a && b && c);
  EXPECT_EQ(a->positions, b->positions);
  EXPECT_EQ(a->positions, c->positions);
}

TEST_F(MeshFile, StlIsReadZUp) {
  const auto mesh = load("one.stl",
                         "solid one\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\n"
                         "vertex 0 1 0\nendloop\nendfacet\nendsolid one\n");
  ASSERT_TRUE(mesh) << core::to_string(mesh.problems());
  EXPECT_FALSE(mesh->y_up);
  EXPECT_EQ(mesh->indices.size(), 3u);
}

TEST_F(MeshFile, GltfWithItsBufferInsideIsRead) {
  // Three points and three 16-bit indices, base64.
  const auto mesh = load("one.gltf", R"({"asset":{"version":"2.0"},"scene":0,
"scenes":[{"nodes":[0]}],"nodes":[{"mesh":0}],
"meshes":[{"primitives":[{"attributes":{"POSITION":1},"indices":0}]}],
"buffers":[{"uri":"data:application/octet-stream;base64,AAABAAIAAAAAAAAAAAAAAAAAAAAAAIA/AAAAAAAAAAAAAAAAAACAPwAAAAA=","byteLength":44}],
"bufferViews":[{"buffer":0,"byteOffset":0,"byteLength":6,"target":34963},{"buffer":0,"byteOffset":8,"byteLength":36,"target":34962}],
"accessors":[{"bufferView":0,"byteOffset":0,"componentType":5123,"count":3,"type":"SCALAR","max":[2],"min":[0]},
{"bufferView":1,"byteOffset":0,"componentType":5126,"count":3,"type":"VEC3","max":[1,1,0],"min":[0,0,0]}]})");
  ASSERT_TRUE(mesh) << core::to_string(mesh.problems());
  EXPECT_TRUE(mesh->y_up);
  EXPECT_EQ(mesh->indices.size(), 3u);
}

TEST_F(MeshFile, MaterialsOfAnObjAreRead) {
  write("m.mtl", "newmtl red\nKd 0.8 0.1 0.05\nKs 0.2 0.2 0.2\nNs 30\n");
  const auto mesh = load("m.obj", std::string("mtllib m.mtl\nusemtl red\n") + kPyramid);
  ASSERT_TRUE(mesh);
  const SurfaceMaterial& red = mesh->materials[mesh->material.front()];
  EXPECT_NEAR(red.diffuse.r, 0.8, 1e-6);
  EXPECT_NEAR(red.specular, 0.2, 1e-6);
  EXPECT_NEAR(red.shininess, 30, 1e-3);
}

TEST_F(MeshFile, MissingTextureIsLeftOutWithAWord) {
  write("t.mtl", "newmtl t\nKd 1 1 1\nmap_Kd C:\\pictures\\gone.png\n");
  const auto mesh = load("t.obj", std::string("mtllib t.mtl\nusemtl t\n") + kPyramid);
  ASSERT_TRUE(mesh);
  ASSERT_EQ(mesh->warnings.size(), 1u);
  EXPECT_THAT(mesh->warnings.front(), HasSubstr("gone.png"));
}

TEST_F(MeshFile, RefusalsSayWhatIsWrong) {
  EXPECT_THAT(core::to_string(load_mesh(folder.path() / "none.ply", {}).problems()),
              HasSubstr("no such mesh"));
  EXPECT_THAT(refusal("empty.ply", ""), HasSubstr("empty (0 bytes)"));
  EXPECT_THAT(refusal("empty.obj", ""), HasSubstr("empty (0 bytes)"));
  EXPECT_THAT(refusal("what.blend", "BLENDER"), HasSubstr(".blend"));
  EXPECT_THAT(refusal("text.ply", "hello\n"), HasSubstr("begin with the word ply"));
  EXPECT_THAT(refusal("cloud.ply", ascii_ply("0 0 0\n", 1, "", 0)), HasSubstr("no triangles"));
  EXPECT_THAT(refusal("cut.ply", ascii_ply("0 0 0\n1.000000 0 0\n0 1", 3, "", 1)),
              HasSubstr("cut short"));
  EXPECT_THAT(refusal("liar.ply", ascii_ply("0 0 0\n", 4000000000u, "", 1)),
              HasSubstr("promises 4000000000"));
  EXPECT_THAT(refusal("index.ply", ascii_ply("0 0 0\n1 0 0\n0 1 0\n", 3, "3 0 1 7\n", 1)),
              HasSubstr("point 7 of 3"));
  EXPECT_THAT(refusal("minus.ply", ascii_ply("0 0 0\n1 0 0\n0 1 0\n", 3, "3 0 1 -1\n", 1)),
              HasSubstr("speaks of point"));
  EXPECT_THAT(refusal("nan.ply", ascii_ply("0 0 0\n1 nan 0\n0 1 0\n", 3, "3 0 1 2\n", 1)),
              HasSubstr("point 1 is not a number"));
  EXPECT_THAT(refusal("huge.ply", ascii_ply("0 0 0\n1 0 0\n0 1e12 0\n", 3, "3 0 1 2\n", 1)),
              HasSubstr("further away"));
  EXPECT_THAT(refusal("flat.ply", ascii_ply("0 0 0\n1 0 0\n2 0 0\n", 3, "3 0 1 2\n", 1)),
              HasSubstr("without area"));
  EXPECT_THAT(refusal("points.obj", "v 0 0 0\nv 1 0 0\n"), HasSubstr("points.obj"));
  EXPECT_THAT(refusal("bad.gltf", "{"), HasSubstr("cannot be read"));
  EXPECT_THAT(refusal("bad.3ds", "MM"), HasSubstr("cannot be read"));
}

TEST_F(MeshFile, DamagedPlyNeverCrashes) {
  support::write_ply(folder.path() / "ball.ply", support::icosphere({}, 1, 1));
  std::ifstream in(folder.path() / "ball.ply", std::ios::binary);
  const std::string good{std::istreambuf_iterator<char>(in), {}};
  core::Random random(1);
  for (int trial = 0; trial < 300; ++trial) {
    std::string bad = good.substr(
        0, random.below(4) ? good.size() : random.below(static_cast<std::uint32_t>(good.size())));
    for (std::uint32_t n = random.below(6); n > 0 && !bad.empty(); --n)
      bad[random.below(static_cast<std::uint32_t>(bad.size()))] = static_cast<char>(random.next());
    const auto mesh = load("damaged.ply", bad);
    if (!mesh) {
      EXPECT_FALSE(core::to_string(mesh.problems()).empty());
    }
  }
}

TEST_F(MeshFile, CacheGivesBackTheSameMesh) {
  const auto file = write("pyramid.obj", kPyramid);
  const auto cache = folder.path() / "cache";
  const auto first = load_mesh(file, cache), second = load_mesh(file, cache);
  ASSERT_TRUE(first && second);
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(cache), {}), 1);
  EXPECT_EQ(first->positions, second->positions);
  EXPECT_EQ(first->normals, second->normals);
  EXPECT_EQ(first->indices, second->indices);
  EXPECT_EQ(second->y_up, true);
}

TEST_F(MeshFile, CacheThatIsDamagedAnywhereIsMadeAnew) {
  const auto file = write("pyramid.obj", kPyramid);
  const auto cache = folder.path() / "cache";
  const auto first = load_mesh(file, cache);
  const auto entry = std::filesystem::directory_iterator(cache)->path();
  std::ifstream in(entry, std::ios::binary);
  const std::string good{std::istreambuf_iterator<char>(in), {}};
  in.close();
  for (std::size_t at = 0; at <= good.size(); at += 13) {
    std::string bad = good;
    if (at % 2 == 0)
      bad.resize(at);
    else
      bad[at] = static_cast<char>(bad[at] ^ 0x55);
    std::ofstream(entry, std::ios::binary | std::ios::trunc) << bad;
    const auto again = load_mesh(file, cache);
    ASSERT_TRUE(again);
    EXPECT_EQ(again->positions, first->positions);
  }
}

TEST_F(MeshFile, CacheNoticesThatAMaterialChanged) {
  write("m.mtl", "newmtl a\nKd 0.8 0.1 0.05\n");
  const auto file = write("m.obj", std::string("mtllib m.mtl\nusemtl a\n") + kPyramid);
  const auto cache = folder.path() / "cache";
  ASSERT_TRUE(load_mesh(file, cache));
  write("m.mtl", "newmtl a\nKd 0.2 0.3 0.4\n");
  const auto mesh = load_mesh(file, cache);
  ASSERT_TRUE(mesh);
  EXPECT_NEAR(mesh->materials[mesh->material.front()].diffuse.b, 0.4, 1e-6);
}

TEST_F(MeshFile, CacheThatCannotBeWrittenIsOnlySlower) {
  const auto file = write("pyramid.obj", kPyramid);
  EXPECT_TRUE(load_mesh(file, file / "not" / "a" / "folder"));
}

}  // namespace
}  // namespace chiaro::twin
