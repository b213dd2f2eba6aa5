// SPDX-License-Identifier: Apache-2.0
#include "controller/importers/import_fixture.h"

#include <fstream>
#include <iterator>

#include "controller/importers/gdtf.h"
#include "controller/importers/ofl.h"
#include "controller/importers/qxf.h"
#include "controller/importers/xml.h"

namespace chiaro::importers {
namespace {

core::Problem bad(const std::string& file, std::string what, std::string remedy) {
  return {{file, 0, 0}, std::move(what), std::move(remedy), false};
}

core::Result<LibraryFixture> read(const std::string& bytes, const std::string& ending,
                                  const std::string& maker, const std::string& file) {
  if (ending == ".qxf") return read_qxf(bytes, file);
  if (ending == ".gdtf") return read_gdtf(bytes, file);
  if (ending == ".json") return read_ofl(bytes, maker, file);
  return bad(file, "fixtures are not read from files like this one",
             "give a .qxf (QLC+), .gdtf or .json (Open Fixture Library) file");
}

}  // namespace

core::Result<std::string> bytes_of(const std::filesystem::path& file) {
  constexpr std::uintmax_t kMost = 256u << 20;
  std::error_code code;
  if (!std::filesystem::is_regular_file(file, code))
    return bad(file.string(), "there is no such file", "check the path");
  if (std::filesystem::file_size(file, code) > kMost)
    return bad(file.string(), "this file is larger than 256 MB", "is it the right one?");
  std::ifstream in(file, std::ios::binary);
  std::string bytes{std::istreambuf_iterator<char>(in), {}};
  if (!in.good() && !in.eof())
    return bad(file.string(), "this file cannot be read", "may you read it?");
  return bytes;
}

core::Result<Imported> import_fixture(const std::string& bytes, const std::string& ending,
                                      const std::string& maker, const std::string& file) {
  const auto fixture = read(bytes, lower(ending), maker, file);
  if (!fixture) return fixture.problems();
  return profile_of(*fixture, file);
}

core::Result<Imported> import_fixture(const std::filesystem::path& file) {
  const auto bytes = bytes_of(file);
  if (!bytes) return bytes.problems();
  std::error_code code;
  const auto folder = std::filesystem::absolute(file, code).parent_path().filename().string();
  return import_fixture(*bytes, file.extension().string(), folder, file.string());
}

}  // namespace chiaro::importers
