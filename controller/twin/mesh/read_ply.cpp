// SPDX-License-Identifier: Apache-2.0
// PLY, by Greg Turk's description of the format: a text header names elements and their typed
// properties, the data follow as text or in either byte order. Written here because the general
// importer takes seconds where this takes tens of milliseconds, and because every count in the
// header is checked against the file's size before anything is allocated.
#include <array>
#include <bit>
#include <charconv>
#include <cstring>
#include <optional>
#include <span>
#include <sstream>
#include <string_view>

#include "controller/twin/mesh/raw_mesh.h"

namespace chiaro::twin {
namespace {

enum class Type : std::uint8_t { int8, uint8, int16, uint16, int32, uint32, float32, float64 };
constexpr std::array<std::size_t, 8> kBytes{1, 1, 2, 2, 4, 4, 4, 8};

std::optional<Type> type_named(std::string_view name) {
  constexpr std::pair<std::string_view, Type> kNames[] = {
      {"char", Type::int8},      {"int8", Type::int8},       {"uchar", Type::uint8},
      {"uint8", Type::uint8},    {"short", Type::int16},     {"int16", Type::int16},
      {"ushort", Type::uint16},  {"uint16", Type::uint16},   {"int", Type::int32},
      {"int32", Type::int32},    {"uint", Type::uint32},     {"uint32", Type::uint32},
      {"float", Type::float32},  {"float32", Type::float32}, {"double", Type::float64},
      {"float64", Type::float64}};
  for (const auto& [known, type] : kNames)
    if (known == name) return type;
  return std::nullopt;
}

struct Property {
  std::string name;
  Type type = Type::float32;
  std::optional<Type> count;  ///< of a list
};
struct Element {
  std::string name;
  std::size_t count = 0;
  std::vector<Property> properties;
};
enum class Coding { ascii, little, big };
struct Header {
  Coding coding = Coding::ascii;
  std::vector<Element> elements;
  std::size_t data = 0;  ///< offset of the first byte after it
};

/// Thrown and caught inside this file: a reader deep in a list has no better way out.
struct Damaged {
  std::string what;
};

Header read_header(std::string_view text) {
  Header header;
  std::size_t at = 0;
  bool first = true;
  for (;;) {
    const std::size_t end = text.find('\n', at);
    if (end == std::string_view::npos || end - at > 4096) throw Damaged{"its header never ends"};
    std::istringstream line{std::string(text.substr(at, end - at))};
    at = end + 1;
    std::string word;
    line >> word;
    if (first && word != "ply") throw Damaged{"it does not begin with the word ply"};
    first = false;
    if (word == "end_header") break;
    if (word == "format") {
      line >> word;
      if (word == "binary_little_endian")
        header.coding = Coding::little;
      else if (word == "binary_big_endian")
        header.coding = Coding::big;
      else if (word != "ascii")
        throw Damaged{"its format \"" + word + "\" is unknown"};
    } else if (word == "element") {
      Element element;
      if (!(line >> element.name >> element.count)) throw Damaged{"an element has no count"};
      header.elements.push_back(std::move(element));
    } else if (word == "property") {
      if (header.elements.empty()) throw Damaged{"a property belongs to no element"};
      Property property;
      line >> word;
      if (word == "list") {
        std::string count;
        line >> count >> word;
        property.count = type_named(count);
        if (!property.count) throw Damaged{"the type \"" + count + "\" is unknown"};
      }
      const auto type = type_named(word);
      if (!type || !(line >> property.name)) throw Damaged{"the type \"" + word + "\" is unknown"};
      property.type = *type;
      header.elements.back().properties.push_back(std::move(property));
    }
  }
  header.data = at;
  return header;
}

/// The data as a stream of numbers, whatever their coding.
class Numbers {
 public:
  Numbers(std::span<const std::uint8_t> data, Coding coding)
      : at_(data.data()), end_(data.data() + data.size()), coding_(coding) {}

  std::size_t left() const { return static_cast<std::size_t>(end_ - at_); }

  double next(Type type) {
    if (coding_ == Coding::ascii) return word();
    const std::size_t bytes = kBytes[static_cast<std::size_t>(type)];
    if (left() < bytes) throw Damaged{"it is cut short"};
    std::array<std::uint8_t, 8> raw{};
    if ((coding_ == Coding::little) == (std::endian::native == std::endian::little))
      std::memcpy(raw.data(), at_, bytes);
    else
      for (std::size_t i = 0; i < bytes; ++i) raw[i] = at_[bytes - 1 - i];
    at_ += bytes;
    switch (type) {
      case Type::int8:
        return as<std::int8_t>(raw);
      case Type::uint8:
        return as<std::uint8_t>(raw);
      case Type::int16:
        return as<std::int16_t>(raw);
      case Type::uint16:
        return as<std::uint16_t>(raw);
      case Type::int32:
        return as<std::int32_t>(raw);
      case Type::uint32:
        return as<std::uint32_t>(raw);
      case Type::float32:
        return as<float>(raw);
      case Type::float64:
        return as<double>(raw);
    }
    return 0;
  }

 private:
  template <class T>
  static double as(const std::array<std::uint8_t, 8>& raw) {
    T value;
    std::memcpy(&value, raw.data(), sizeof(T));
    return static_cast<double>(value);
  }
  double word() {
    while (at_ != end_ && (*at_ == ' ' || *at_ == '\n' || *at_ == '\r' || *at_ == '\t')) ++at_;
    if (at_ == end_) throw Damaged{"it is cut short"};
    double value = 0;
    const char* from = reinterpret_cast<const char*>(at_);
    if (*from == '+') ++from;
    const auto [stop, code] = std::from_chars(from, reinterpret_cast<const char*>(end_), value);
    if (code != std::errc() || stop == from) throw Damaged{"a number in it cannot be read"};
    at_ = reinterpret_cast<const std::uint8_t*>(stop);
    return value;
  }

  const std::uint8_t* at_;
  const std::uint8_t* end_;
  Coding coding_;
};

/// Least bytes that one row of `element` takes: a header that promises more rows than fit is a lie.
std::size_t least_bytes(const Element& element, Coding coding) {
  std::size_t bytes = 0;
  for (const Property& p : element.properties)
    bytes +=
        coding == Coding::ascii ? 2 : kBytes[static_cast<std::size_t>(p.count.value_or(p.type))];
  return bytes;
}

std::optional<std::size_t> property_named(const Element& element,
                                          std::initializer_list<std::string_view> names) {
  for (std::size_t i = 0; i < element.properties.size(); ++i)
    for (const std::string_view name : names)
      if (element.properties[i].name == name) return i;
  return std::nullopt;
}

double skip_or_read(Numbers& numbers, const Property& property) {
  if (!property.count) return numbers.next(property.type);
  const double count = numbers.next(*property.count);
  for (double i = 0; i < count; ++i) numbers.next(property.type);
  return 0;
}

void read_vertices(const Element& element, Numbers& numbers, RawMesh& mesh) {
  const auto x = property_named(element, {"x"}), y = property_named(element, {"y"}),
             z = property_named(element, {"z"});
  if (!x || !y || !z) throw Damaged{"its points have no x, y and z"};
  const auto nx = property_named(element, {"nx"}), ny = property_named(element, {"ny"}),
             nz = property_named(element, {"nz"});
  const auto u = property_named(element, {"u", "s", "texture_u"}),
             v = property_named(element, {"v", "t", "texture_v"});
  const bool normals = nx && ny && nz, coordinates = u && v;
  mesh.positions.reserve(3 * element.count + 1);
  if (normals) mesh.normals.reserve(3 * element.count);
  std::vector<float> row(element.properties.size());
  for (std::size_t i = 0; i < element.count; ++i) {
    for (std::size_t k = 0; k < row.size(); ++k)
      row[k] = static_cast<float>(skip_or_read(numbers, element.properties[k]));
    mesh.positions.insert(mesh.positions.end(), {row[*x], row[*y], row[*z]});
    if (normals) mesh.normals.insert(mesh.normals.end(), {row[*nx], row[*ny], row[*nz]});
    if (coordinates)
      mesh.texture_coordinates.insert(mesh.texture_coordinates.end(), {row[*u], row[*v]});
  }
}

/// Polygons become fans. Indices are checked against the points by the caller.
void read_faces(const Element& element, Numbers& numbers, RawMesh& mesh) {
  const auto corners = property_named(element, {"vertex_indices", "vertex_index"});
  if (!corners || !element.properties[*corners].count)
    throw Damaged{"its faces have no list of points"};
  mesh.indices.reserve(3 * element.count);
  std::vector<std::uint32_t> polygon;
  for (std::size_t i = 0; i < element.count; ++i)
    for (std::size_t k = 0; k < element.properties.size(); ++k) {
      const Property& p = element.properties[k];
      if (k != *corners) {
        skip_or_read(numbers, p);
        continue;
      }
      const double count = numbers.next(*p.count);
      if (count < 0 || count > static_cast<double>(numbers.left()))
        throw Damaged{"a face has more points than the file has bytes"};
      polygon.clear();
      for (double c = 0; c < count; ++c) {
        const double index = numbers.next(p.type);
        // A negative or unreal index becomes one that the caller's check refuses.
        polygon.push_back(index >= 0 && index < 4294967295.0 ? static_cast<std::uint32_t>(index)
                                                             : 0xffffffffu);
      }
      for (std::size_t c = 2; c < polygon.size(); ++c)
        mesh.indices.insert(mesh.indices.end(), {polygon[0], polygon[c - 1], polygon[c]});
    }
}

}  // namespace

core::Result<RawMesh> read_ply(const std::filesystem::path& file,
                               const std::vector<std::uint8_t>& bytes) try {
  const Header header = read_header({reinterpret_cast<const char*>(bytes.data()), bytes.size()});
  RawMesh mesh;
  Numbers numbers(std::span<const std::uint8_t>(bytes).subspan(header.data), header.coding);
  for (const Element& element : header.elements) {
    const std::size_t least = least_bytes(element, header.coding);
    // The last word of a text file may lack its newline, hence + 1.
    if (least == 0 ? element.count > 0 : element.count > (numbers.left() + 1) / least)
      throw Damaged{"its header promises " + std::to_string(element.count) + " of \"" +
                    element.name + "\", more than the file holds"};
    if (element.name == "vertex")
      read_vertices(element, numbers, mesh);
    else if (element.name == "face")
      read_faces(element, numbers, mesh);
    else
      for (std::size_t i = 0; i < element.count; ++i)
        for (const Property& p : element.properties) skip_or_read(numbers, p);
  }
  mesh.material.assign(mesh.triangles(), 0);
  mesh.materials.emplace_back();
  return mesh;
} catch (const Damaged& damage) {
  return core::Problem{
      {file.string(), 0, 0}, "this PLY mesh is damaged: " + damage.what, "export it again"};
}

}  // namespace chiaro::twin
