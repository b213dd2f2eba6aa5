// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <assimp/DefaultIOSystem.h>
#include <assimp/Importer.hpp>
#include <assimp/material.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>
#include <cctype>
#include <map>

#include "controller/core/picture_file.h"
#include "controller/twin/mesh/raw_mesh.h"

namespace chiaro::twin {
namespace {

bool same_but_for_case(std::string a, std::string b) {
  const auto lower = [](std::string& text) {
    for (char& c : text) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  };
  lower(a);
  lower(b);
  return a == b;
}

/// Where a texture really is: mesh files carry backslashes, absolute paths of other people's
/// machines and names in the wrong case.
std::filesystem::path find_beside(const std::filesystem::path& mesh, std::string name) {
  std::replace(name.begin(), name.end(), '\\', '/');
  std::error_code code;
  const std::filesystem::path asked(name), folder = mesh.parent_path();
  if (asked.is_relative() && std::filesystem::is_regular_file(folder / asked, code))
    return folder / asked;
  for (const auto& entry : std::filesystem::directory_iterator(folder, code))
    if (same_but_for_case(entry.path().filename().string(), asked.filename().string()))
      return entry.path();
  return {};
}

/// Notes every further file that decides what the mesh is: materials, buffers.
class NotingFiles : public Assimp::DefaultIOSystem {
 public:
  explicit NotingFiles(std::vector<std::filesystem::path>& opened) : opened_(opened) {}
  Assimp::IOStream* Open(const char* file, const char* mode) override {
    Assimp::IOStream* stream = Assimp::DefaultIOSystem::Open(file, mode);
    if (stream != nullptr) opened_.emplace_back(file);
    return stream;
  }

 private:
  std::vector<std::filesystem::path>& opened_;
};

class Reader {
 public:
  Reader(const std::filesystem::path& file, const aiScene& scene) : file_(file), scene_(scene) {}

  RawMesh read() {
    const std::size_t materials = std::min<std::size_t>(scene_.mNumMaterials, 65535);
    for (std::size_t i = 0; i < materials; ++i)
      mesh_.materials.push_back(material(*scene_.mMaterials[i]));
    if (mesh_.materials.empty()) mesh_.materials.emplace_back();
    // 3DS is Z up; the importer hides that in a turned root. We want the file's own axes.
    const std::string kind = file_.extension().string();
    const bool undo_root = same_but_for_case(kind, ".3ds");
    for (const bool coordinates : {false, true}) {
      want_coordinates_ = coordinates;
      if (coordinates && !any_coordinates_) break;
      mesh_.positions.clear(), mesh_.normals.clear(), mesh_.indices.clear(), mesh_.material.clear();
      mesh_.texture_coordinates.clear();
      all_normals_ = true;
      if (scene_.mRootNode) walk(*scene_.mRootNode, aiMatrix4x4(), undo_root, 0);
    }
    if (!all_normals_) mesh_.normals.clear();
    return std::move(mesh_);
  }

 private:
  void walk(const aiNode& node, const aiMatrix4x4& parent, bool ignore, int depth) {
    if (depth > 200) return;  // no honest file nests so deep
    const aiMatrix4x4 here = ignore ? parent : parent * node.mTransformation;
    for (unsigned i = 0; i < node.mNumMeshes; ++i)
      if (node.mMeshes[i] < scene_.mNumMeshes) append(*scene_.mMeshes[node.mMeshes[i]], here);
    for (unsigned i = 0; i < node.mNumChildren; ++i)
      walk(*node.mChildren[i], here, false, depth + 1);
  }

  void append(const aiMesh& part, const aiMatrix4x4& matrix) {
    const auto first = static_cast<std::uint32_t>(mesh_.vertices());
    const std::size_t triangles_before = mesh_.triangles();
    for (unsigned f = 0; f < part.mNumFaces; ++f) {
      const aiFace& face = part.mFaces[f];
      if (face.mNumIndices != 3) continue;  // points and lines
      for (unsigned k = 0; k < 3; ++k) mesh_.indices.push_back(first + face.mIndices[k]);
    }
    if (mesh_.triangles() == triangles_before) return;
    append_points(part, matrix);
    const auto material = static_cast<std::uint16_t>(
        std::min<std::size_t>(part.mMaterialIndex, mesh_.materials.size() - 1));
    mesh_.material.resize(mesh_.triangles(), material);
  }

  void append_points(const aiMesh& part, const aiMatrix4x4& matrix) {
    aiMatrix3x3 turn(matrix);
    turn.Inverse().Transpose();
    const bool coordinates = part.HasTextureCoords(0);
    any_coordinates_ = any_coordinates_ || coordinates;
    all_normals_ = all_normals_ && part.HasNormals();
    for (unsigned i = 0; i < part.mNumVertices; ++i) {
      const aiVector3D p = matrix * part.mVertices[i];
      mesh_.positions.insert(mesh_.positions.end(), {p.x, p.y, p.z});
      const aiVector3D n = part.HasNormals() ? turn * part.mNormals[i] : aiVector3D(0, 0, 0);
      mesh_.normals.insert(mesh_.normals.end(), {n.x, n.y, n.z});
      if (!want_coordinates_) continue;
      const aiVector3D t = coordinates ? part.mTextureCoords[0][i] : aiVector3D(0, 0, 0);
      mesh_.texture_coordinates.insert(mesh_.texture_coordinates.end(), {t.x, t.y});
    }
  }

  /// Colours are taken as linear albedo; a black diffuse under a texture means "the texture alone".
  SurfaceMaterial material(const aiMaterial& from) {
    SurfaceMaterial out;
    aiColor4D diffuse(0.5f, 0.5f, 0.5f, 1), specular(0, 0, 0, 1);
    from.Get(AI_MATKEY_COLOR_DIFFUSE, diffuse);
    from.Get(AI_MATKEY_COLOR_SPECULAR, specular);
    float shininess = 0;
    from.Get(AI_MATKEY_SHININESS, shininess);
    const auto albedo = [](float v) { return std::clamp(static_cast<double>(v), 0.0, 0.95); };
    out.diffuse = {albedo(diffuse.r), albedo(diffuse.g), albedo(diffuse.b)};
    // Ks 1 with exponent 0 is what exporters write for "no idea": a mirror-bright matt surface.
    if (shininess >= 2) {
      out.specular = std::clamp((specular.r + specular.g + specular.b) / 3, 0.0f, 0.5f);
      out.shininess = std::min(shininess, 2000.0f);
    }
    aiString texture;
    if (from.GetTexture(aiTextureType_DIFFUSE, 0, &texture) == AI_SUCCESS ||
        from.GetTexture(aiTextureType_BASE_COLOR, 0, &texture) == AI_SUCCESS) {
      out.texture = texture_index(texture.C_Str());
      if (out.texture >= 0 && core::luminance(out.diffuse) < 0.01) out.diffuse = {0.95, 0.95, 0.95};
    }
    return out;
  }

  int texture_index(const std::string& name) {
    if (const auto known = textures_.find(name); known != textures_.end()) return known->second;
    auto picture = load(name);
    int index = -1;
    if (picture && !picture->empty()) {
      index = static_cast<int>(mesh_.textures.size());
      mesh_.textures.push_back(std::move(*picture));
    } else {
      mesh_.warnings.push_back("the texture \"" + name + "\" is left out: " +
                               (picture ? "it is empty" : picture.problems().front().what));
    }
    return textures_[name] = index;
  }

  core::Result<core::EncodedPicture> load(const std::string& name) {
    if (const aiTexture* inside = scene_.GetEmbeddedTexture(name.c_str())) {
      if (inside->mHeight != 0)
        return core::Problem{{file_.string(), 0, 0}, "an uncompressed embedded texture", ""};
      return core::decode_picture(
          {reinterpret_cast<const std::uint8_t*>(inside->pcData), inside->mWidth}, name);
    }
    const std::filesystem::path path = find_beside(file_, name);
    if (path.empty())
      return core::Problem{{file_.string(), 0, 0}, "there is no such picture beside the mesh", ""};
    mesh_.depends.push_back(path);
    return core::read_picture(path);
  }

  const std::filesystem::path& file_;
  const aiScene& scene_;
  RawMesh mesh_;
  std::map<std::string, int> textures_;
  bool want_coordinates_ = false, any_coordinates_ = false, all_normals_ = true;
};

}  // namespace

core::Result<RawMesh> read_with_assimp(const std::filesystem::path& file) try {
  std::vector<std::filesystem::path> opened;
  Assimp::Importer importer;
  importer.SetIOHandler(new NotingFiles(opened));  // the importer owns it
  const aiScene* scene =
      importer.ReadFile(file.string(), aiProcess_Triangulate | aiProcess_ValidateDataStructure |
                                           aiProcess_SortByPType);
  if (scene == nullptr)
    return core::Problem{{file.string(), 0, 0},
                         std::string("this mesh cannot be read: ") + importer.GetErrorString(),
                         "export it again, or as binary .ply"};
  RawMesh mesh = Reader(file, *scene).read();
  mesh.depends.insert(mesh.depends.end(), opened.begin(), opened.end());
  return mesh;
} catch (const std::exception& error) {
  return core::Problem{{file.string(), 0, 0},
                       std::string("this mesh cannot be read: ") + error.what(),
                       "export it again, or as binary .ply"};
}

}  // namespace chiaro::twin
