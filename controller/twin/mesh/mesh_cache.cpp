// SPDX-License-Identifier: Apache-2.0
#include <bit>
#include <cstring>
#include <fstream>
#include <span>
#include <unistd.h>

#include "controller/core/hash.h"
#include "controller/twin/mesh/prepared_mesh.h"

namespace chiaro::twin {
namespace {

constexpr std::uint64_t kMagic = 0x3148534d4f494843ULL;  // "CHIOMSH1"
/// Raise it whenever preparing changes what it makes.
constexpr std::uint64_t kVersion = 2;

std::optional<std::vector<std::uint8_t>> bytes_of(const std::filesystem::path& file) {
  std::error_code code;
  const auto size = std::filesystem::file_size(file, code);
  if (code || size > kMostMeshBytes) return std::nullopt;
  std::vector<std::uint8_t> bytes(size);
  std::ifstream in(file, std::ios::binary);
  in.read(reinterpret_cast<char*>(bytes.data()), static_cast<std::streamsize>(size));
  if (!in && size > 0) return std::nullopt;
  return bytes;
}

class Writer {
 public:
  std::vector<std::uint8_t> bytes;
  void number(std::uint64_t v) { raw(&v, sizeof v); }
  void text(const std::string& t) {
    number(t.size());
    raw(t.data(), t.size());
  }
  template <class T>
  void list(const std::vector<T>& values) {
    static_assert(std::is_trivially_copyable_v<T>);
    number(values.size());
    raw(values.data(), values.size() * sizeof(T));
  }

 private:
  void raw(const void* from, std::size_t size) {
    const auto* p = static_cast<const std::uint8_t*>(from);
    bytes.insert(bytes.end(), p, p + size);
  }
};

/// Reads what Writer wrote; after any shortage `good` is false and every answer empty.
class Checked {
 public:
  explicit Checked(std::span<const std::uint8_t> bytes) : left_(bytes) {}
  bool good = true;
  bool finished() const { return good && left_.empty(); }
  std::uint64_t number() {
    std::uint64_t v = 0;
    raw(&v, sizeof v);
    return v;
  }
  std::string text() {
    std::string t(size_of_next(1), ' ');
    raw(t.data(), t.size());
    return t;
  }
  template <class T>
  void list(std::vector<T>& values) {
    values.resize(size_of_next(sizeof(T)));
    raw(values.data(), values.size() * sizeof(T));
  }
  std::size_t size_of_next(std::size_t each) {
    const std::uint64_t n = number();
    good = good && n <= left_.size() / each;
    return good ? static_cast<std::size_t>(n) : 0;
  }

 private:
  void raw(void* to, std::size_t size) {
    good = good && size <= left_.size();
    if (!good || size == 0) return;
    std::memcpy(to, left_.data(), size);
    left_ = left_.subspan(size);
  }
  std::span<const std::uint8_t> left_;
};

void keep(const std::filesystem::path& entry, const std::vector<std::uint8_t>& bytes) {
  std::error_code code;
  std::filesystem::create_directories(entry.parent_path(), code);
  std::filesystem::path draft = entry;
  draft += "." + std::to_string(::getpid()) + ".part";
  {
    std::ofstream out(draft, std::ios::binary | std::ios::trunc);
    out.write(reinterpret_cast<const char*>(bytes.data()),
              static_cast<std::streamsize>(bytes.size()));
    out.close();
    if (!out) code = std::make_error_code(std::errc::io_error);
  }
  if (!code) std::filesystem::rename(draft, entry, code);
  if (code) std::filesystem::remove(draft, code);
}

core::Problem refusal(const std::filesystem::path& file, const char* what, const char* remedy) {
  return {{file.string(), 0, 0}, what, remedy};
}

}  // namespace

std::uint64_t content_hash(const std::uint8_t* bytes, std::size_t size) {
  std::uint64_t lanes[4] = {1, 2, 3, 4};
  const auto mix = [](std::uint64_t h, std::uint64_t v) {
    h = (h ^ v) * 0x9ddfea08eb382d69ULL;
    return h ^ (h >> 29u);
  };
  std::size_t at = 0;
  for (; at + 32 <= size; at += 32)
    for (std::size_t k = 0; k < 4; ++k) {
      std::uint64_t v;
      std::memcpy(&v, bytes + at + 8 * k, 8);
      lanes[k] = mix(lanes[k], v);
    }
  std::uint64_t hash = mix(size, 0);
  for (const std::uint64_t lane : lanes) hash = mix(hash, lane);
  for (; at < size; ++at) hash = mix(hash, bytes[at]);
  return hash;
}

std::filesystem::path cache_entry(const std::filesystem::path& cache, std::uint64_t content) {
  return cache / (core::hex(content) + ".mesh");
}

std::vector<std::uint8_t> serialised(const PreparedMesh& mesh,
                                     const std::vector<std::filesystem::path>& depends) {
  Writer body;
  body.number(depends.size());
  for (const auto& file : depends) {
    const auto bytes = bytes_of(file);
    body.text(file.string());
    body.number(bytes ? content_hash(bytes->data(), bytes->size()) : 0);
  }
  body.list(mesh.positions);
  body.list(mesh.normals);
  body.list(mesh.texture_coordinates);
  body.list(mesh.indices);
  body.list(mesh.material);
  body.list(mesh.materials);
  body.number(mesh.textures.size());
  for (const auto& picture : mesh.textures) {
    body.number(static_cast<std::uint64_t>(picture.size.width));
    body.number(static_cast<std::uint64_t>(picture.size.height));
    body.list(picture.values);
  }
  body.number(mesh.y_up ? 1 : 0);
  body.number(mesh.warnings.size());
  for (const std::string& warning : mesh.warnings) body.text(warning);
  Writer out;
  out.number(kMagic);
  out.number(kVersion);
  out.number(body.bytes.size());
  out.number(content_hash(body.bytes.data(), body.bytes.size()));
  out.bytes.insert(out.bytes.end(), body.bytes.begin(), body.bytes.end());
  return std::move(out.bytes);
}

std::optional<PreparedMesh> deserialised(const std::vector<std::uint8_t>& bytes) {
  constexpr std::size_t kHead = 32;
  if (bytes.size() < kHead) return std::nullopt;
  Checked head(std::span<const std::uint8_t>(bytes).first(kHead));
  if (head.number() != kMagic || head.number() != kVersion ||
      head.number() != bytes.size() - kHead ||
      head.number() != content_hash(bytes.data() + kHead, bytes.size() - kHead))
    return std::nullopt;
  Checked body(std::span<const std::uint8_t>(bytes).subspan(kHead));
  for (std::size_t left = body.size_of_next(16); left > 0; --left) {
    const std::filesystem::path file = body.text();
    const auto now = bytes_of(file);
    if (body.number() != (now ? content_hash(now->data(), now->size()) : 0)) return std::nullopt;
  }
  PreparedMesh mesh;
  body.list(mesh.positions);
  body.list(mesh.normals);
  body.list(mesh.texture_coordinates);
  body.list(mesh.indices);
  body.list(mesh.material);
  body.list(mesh.materials);
  mesh.textures.resize(body.size_of_next(24));
  for (auto& picture : mesh.textures) {
    picture.size.width = static_cast<int>(body.number());
    picture.size.height = static_cast<int>(body.number());
    body.list(picture.values);
  }
  mesh.y_up = body.number() != 0;
  mesh.warnings.resize(body.size_of_next(8));
  for (std::string& warning : mesh.warnings) warning = body.text();
  if (!body.finished()) return std::nullopt;
  return mesh;
}

core::Result<PreparedMesh> load_mesh(const std::filesystem::path& file,
                                     const std::filesystem::path& cache) try {
  std::error_code code;
  if (!std::filesystem::is_regular_file(file, code))
    return refusal(file, "there is no such mesh", "check the path");
  const auto size = std::filesystem::file_size(file, code);
  if (!code && size > kMostMeshBytes)
    return refusal(file, "the mesh file is larger than 2 GiB",
                   "decimate it: 100,000 triangles light as well");
  const auto bytes = bytes_of(file);
  if (!bytes) return refusal(file, "the mesh cannot be read", "check its permissions");
  // The name's ending chooses the reader, so it belongs to the key; so does the folder, where the
  // materials and textures of this mesh are looked for.
  const std::string where =
      file.extension().string() + std::filesystem::absolute(file, code).parent_path().string();
  const std::uint64_t content =
      content_hash(bytes->data(), bytes->size()) ^
      content_hash(reinterpret_cast<const std::uint8_t*>(where.data()), where.size());
  const std::filesystem::path entry = cache.empty() ? cache : cache_entry(cache, content);
  if (!entry.empty())
    if (const auto kept = bytes_of(entry))
      if (auto mesh = deserialised(*kept)) return std::move(*mesh);
  auto raw = read_mesh(file, *bytes);
  if (!raw) return raw.problems();
  std::vector<std::filesystem::path> depends = std::move(raw->depends);
  PreparedMesh mesh = prepared(std::move(*raw));
  if (mesh.indices.empty())
    return refusal(file, "every triangle of the mesh is without area", "export it again");
  if (!entry.empty()) keep(entry, serialised(mesh, depends));
  return mesh;
} catch (const std::bad_alloc&) {
  return refusal(file, "the mesh is too large for this machine's memory",
                 "decimate it: 100,000 triangles light as well");
}

}  // namespace chiaro::twin
