// SPDX-License-Identifier: Apache-2.0
#include "controller/importers/zip.h"

#include <algorithm>
#include <fmt/format.h>
#include <memory>
#include <zip.h>

namespace chiaro::importers {
namespace {

constexpr zip_int64_t kMostMembers = 20'000;
constexpr std::size_t kMostArchive = 512u << 20;

struct Discard {
  void operator()(zip_t* archive) const { zip_discard(archive); }
};
struct Close {
  void operator()(zip_file_t* file) const { zip_fclose(file); }
};
using Archive = std::unique_ptr<zip_t, Discard>;

core::Problem bad(const std::string& file, std::string what, std::string remedy) {
  return {{file, 0, 0}, std::move(what), std::move(remedy), false};
}

/// Reads where `bytes` stands: they must outlive the archive.
core::Result<Archive> opened(const std::string& bytes, const std::string& file) {
  if (bytes.size() > kMostArchive)
    return bad(file, "this archive is larger than 512 MB", "is it the right file?");
  constexpr std::size_t kLeast = 22;  // an empty archive's end record
  if (bytes.size() < kLeast)
    return bad(file, "this is no whole zip archive: it is empty or cut short", "fetch it again");
  zip_error_t why;
  zip_error_init(&why);
  zip_source_t* source = zip_source_buffer_create(bytes.data(), bytes.size(), 0, &why);
  zip_t* archive =
      source != nullptr ? zip_open_from_source(source, ZIP_RDONLY | ZIP_CHECKCONS, &why) : nullptr;
  if (archive == nullptr) {
    if (source != nullptr) zip_source_free(source);
    const std::string reason = zip_error_strerror(&why);
    zip_error_fini(&why);
    return bad(file, "this is no whole zip archive: " + reason,
               "was the file cut short? fetch it again");
  }
  zip_error_fini(&why);
  Archive out(archive);
  if (zip_get_num_entries(archive, 0) > kMostMembers)
    return bad(file, "this archive has more than 20000 members", "is it the right file?");
  return out;
}

bool leads_outside(const std::string& name) {
  if (name.empty() || name.front() == '/' || name.front() == '\\' ||
      name.find('\0') != std::string::npos || (name.size() > 1 && name[1] == ':'))
    return true;
  std::size_t from = 0;
  while (from <= name.size()) {
    const std::size_t end = std::min(name.find_first_of("/\\", from), name.size());
    if (name.compare(from, end - from, "..") == 0) return true;
    from = end + 1;
  }
  return false;
}

}  // namespace

core::Result<std::string> zip_member(const std::string& bytes, const std::string& member,
                                     std::size_t most, const std::string& file) {
  const auto archive = opened(bytes, file);
  if (!archive) return archive.problems();
  const zip_int64_t index = zip_name_locate(archive->get(), member.c_str(), ZIP_FL_ENC_GUESS);
  if (index < 0)
    return bad(file, "this archive holds no " + member, "is it of the kind that its name says?");
  zip_stat_t about;
  zip_stat_init(&about);
  zip_stat_index(archive->get(), static_cast<zip_uint64_t>(index), 0, &about);
  if ((about.valid & ZIP_STAT_ENCRYPTION_METHOD) != 0 && about.encryption_method != ZIP_EM_NONE)
    return bad(file, member + " is encrypted", "export it without a password");
  const auto too_large = [&] {
    return bad(file, fmt::format("{} would be larger than {} MB", member, most >> 20u),
               "no honest file of this kind is; is it the right one?");
  };
  if ((about.valid & ZIP_STAT_SIZE) != 0 && about.size > most) return too_large();
  const std::unique_ptr<zip_file_t, Close> reader(
      zip_fopen_index(archive->get(), static_cast<zip_uint64_t>(index), 0));
  if (!reader)
    return bad(file, member + " cannot be read: " + zip_strerror(archive->get()),
               "save the archive again with plain compression");
  std::string content;
  // What a header claims is not what comes out: counted again while it does.
  for (char block[1u << 16u];;) {
    const zip_int64_t got = zip_fread(reader.get(), block, sizeof block);
    if (got < 0) return bad(file, member + " is damaged", "was the file cut short? fetch it again");
    if (got == 0) return content;
    if (content.size() + static_cast<std::size_t>(got) > most) return too_large();
    content.append(block, static_cast<std::size_t>(got));
  }
}

core::Result<std::vector<std::string>> zip_names(const std::string& bytes,
                                                 const std::string& file) {
  const auto archive = opened(bytes, file);
  if (!archive) return archive.problems();
  std::vector<std::string> names;
  const zip_int64_t count = zip_get_num_entries(archive->get(), 0);
  for (zip_int64_t i = 0; i < count; ++i) {
    const char* name = zip_get_name(archive->get(), static_cast<zip_uint64_t>(i), ZIP_FL_ENC_GUESS);
    if (name == nullptr) continue;
    names.emplace_back(name);
    if (leads_outside(names.back()))
      return bad(file, "a member of this archive would be written outside its folder",
                 "such archives are made to do harm: do not use it");
  }
  return names;
}

core::Result<std::string> zip_of(const std::vector<std::pair<std::string, std::string>>& members) {
  zip_error_t why;
  zip_error_init(&why);
  zip_source_t* target = zip_source_buffer_create(nullptr, 0, 0, &why);
  if (target == nullptr) return bad("", "no memory for an archive", "");
  zip_source_keep(target);
  zip_t* archive = zip_open_from_source(target, ZIP_TRUNCATE, &why);
  bool good = archive != nullptr;
  for (const auto& [name, content] : members) {
    if (!good) break;
    zip_source_t* source = zip_source_buffer(archive, content.data(), content.size(), 0);
    const zip_int64_t index =
        source != nullptr ? zip_file_add(archive, name.c_str(), source, ZIP_FL_ENC_UTF_8) : -1;
    if (index < 0 && source != nullptr) zip_source_free(source);
    good = index >= 0;
    // The same show gives the same bytes, whenever it is exported.
    if (good) zip_file_set_dostime(archive, static_cast<zip_uint64_t>(index), 0, 0x21, 0);
  }
  if (good) {
    good = zip_close(archive) == 0;
    if (!good) zip_discard(archive);
  } else if (archive != nullptr) {
    zip_discard(archive);
  }
  std::string bytes;
  zip_stat_t about;
  zip_stat_init(&about);
  if (good && zip_source_stat(target, &about) == 0 && zip_source_open(target) == 0) {
    bytes.resize(about.size);
    good =
        zip_source_read(target, bytes.data(), about.size) == static_cast<zip_int64_t>(about.size);
    zip_source_close(target);
  }
  zip_source_free(target);
  zip_error_fini(&why);
  if (!good || bytes.empty()) return bad("", "the archive cannot be made", "is there memory left?");
  return bytes;
}

}  // namespace chiaro::importers
