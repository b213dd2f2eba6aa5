// SPDX-License-Identifier: Apache-2.0
#include "controller/daemon/box.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cerrno>
#include <cstring>
#include <fcntl.h>
#include <string>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include "controller/core/dof.h"
#include "controller/core/hash.h"
#include "controller/rig/wanted.h"

namespace chiaro::daemon {
namespace {

constexpr std::uint64_t kMagic = 0x584f424f52414843;  // "CHAROBOX"
/// The layout's own number, and what else shapes the words: a build with one DOF more is another
/// layout.
constexpr std::uint64_t kLayout = 3u << 16u | core::kDofs << 8u | rig::kSources;

std::uint64_t load(const std::uint64_t& word) {
  // atomic_ref of a const type came after C++20; a load does not write.
  return std::atomic_ref(const_cast<std::uint64_t&>(word)).load(std::memory_order_acquire);
}

core::Problem trouble(const std::filesystem::path& file, const std::string& doing) {
  return {{file.string()},
          "cannot " + doing + ": " + std::strerror(errno),
          "is its folder there, and yours to write?",
          false};
}

/// A descriptor that closes itself.
struct Descriptor {
  int number;
  ~Descriptor() {
    if (number >= 0) ::close(number);
  }
};

core::Result<std::unique_ptr<Mapping>> map(const std::filesystem::path& file, int descriptor,
                                           std::size_t bytes, int protection) {
  void* address = ::mmap(nullptr, bytes, protection, MAP_SHARED, descriptor, 0);
  if (address == MAP_FAILED) return trouble(file, "map the box into memory");
  return std::make_unique<Mapping>(address, bytes);
}

std::uint64_t identity_of(const struct stat& about) {
  return static_cast<std::uint64_t>(about.st_ino) ^
         (static_cast<std::uint64_t>(about.st_ctim.tv_sec) << 32u) ^
         static_cast<std::uint64_t>(about.st_ctim.tv_nsec);
}

}  // namespace

std::uint64_t slot_checksum(std::uint64_t sequence, std::span<const std::uint64_t> value) {
  std::uint64_t sum = sequence * 0x9e3779b97f4a7c15ULL;
  for (const std::uint64_t word : value) sum = std::rotl((sum ^ word) * 0x100000001b3ULL, 23);
  return sum;
}

std::uint64_t take_out(std::span<const std::uint64_t> box, std::uint64_t seen,
                       std::span<std::uint64_t> into) {
  const std::size_t slot_words = kSlotHeader + into.size();
  // Newest first; a slot that turns out torn is passed over for the next older one.
  std::array<std::uint64_t, kBoxSlots> sequences{};
  for (std::size_t i = 0; i < kBoxSlots; ++i) sequences[i] = load(box[kBoxHeader + i * slot_words]);
  std::sort(sequences.rbegin(), sequences.rend());
  for (const std::uint64_t sequence : sequences) {
    if (sequence <= seen) return 0;
    const std::size_t at = kBoxHeader + sequence % kBoxSlots * slot_words;
    for (std::size_t i = 0; i < into.size(); ++i) into[i] = load(box[at + kSlotHeader + i]);
    const std::uint64_t sum = load(box[at + 1]);
    if (load(box[at]) == sequence && sum == slot_checksum(sequence, into)) return sequence;
  }
  return 0;
}

void write_header(std::span<std::uint64_t> box, const BoxFormat& format) {
  const std::array<std::uint64_t, kBoxHeader> header{
      kMagic, kLayout, format.words, static_cast<std::uint64_t>(format.kind), format.fingerprint};
  for (std::size_t i = 0; i < kBoxHeader; ++i) ReleaseStore{}(box[i], header[i]);
}

core::Result<core::Done> check_header(std::span<const std::uint64_t> box, const BoxFormat& format) {
  const std::string remedy = "restart chiarod and chiaro-output from the same installation";
  if (box.size() < kBoxHeader || load(box[0]) != kMagic)
    return core::Problem{{}, "this file is not one of Chiaro's boxes", remedy};
  if (load(box[1]) != kLayout)
    return core::Problem{{},
                         "the box has another layout: the two programs are of different "
                         "versions",
                         remedy};
  if (load(box[3]) != static_cast<std::uint64_t>(format.kind))
    return core::Problem{{}, "the box is of the other direction", remedy};
  if (load(box[4]) != format.fingerprint)
    return core::Problem{{},
                         "the box belongs to another studio file or another version of it (" +
                             core::hex(load(box[4])) + ", here " + core::hex(format.fingerprint) +
                             ")",
                         "let both programs read the same file again"};
  if (load(box[2]) != format.words || box.size() < box_words(format.words))
    return core::Problem{{}, "the box has another size than the studio needs", remedy};
  return core::Done{};
}

Mapping::~Mapping() { ::munmap(address_, bytes_); }

core::Result<std::unique_ptr<BoxWriter>> BoxWriter::create(const std::filesystem::path& file,
                                                           const BoxFormat& format) {
  const std::filesystem::path fresh = file.string() + ".new";
  ::unlink(fresh.c_str());
  const Descriptor descriptor{::open(fresh.c_str(), O_RDWR | O_CREAT | O_EXCL | O_CLOEXEC, 0640)};
  if (descriptor.number < 0) return trouble(fresh, "create the box");
  const std::size_t bytes = box_words(format.words) * sizeof(std::uint64_t);
  if (::ftruncate(descriptor.number, static_cast<off_t>(bytes)) != 0)
    return trouble(fresh, "make room for the box");
  auto memory = map(fresh, descriptor.number, bytes, PROT_READ | PROT_WRITE);
  if (!memory) return memory.problems();
  write_header((*memory)->words(), format);
  if (::rename(fresh.c_str(), file.c_str()) != 0) return trouble(file, "put the box in place");
  return std::unique_ptr<BoxWriter>(new BoxWriter(std::move(*memory)));
}

void BoxWriter::post(std::span<const std::uint64_t> value) {
  lay_in(memory_->words(), ++sequence_, value, ReleaseStore{});
}

core::Result<std::unique_ptr<BoxReader>> BoxReader::open(const std::filesystem::path& file,
                                                         const BoxFormat& format) {
  const Descriptor descriptor{::open(file.c_str(), O_RDONLY | O_CLOEXEC)};
  if (descriptor.number < 0) return trouble(file, "open the box");
  struct stat about {};
  if (::fstat(descriptor.number, &about) != 0) return trouble(file, "look at the box");
  const auto bytes = static_cast<std::size_t>(about.st_size);
  if (bytes < kBoxHeader * sizeof(std::uint64_t))
    return core::Problem{{file.string()}, "this file is too short to be a box", "remove it"};
  auto memory = map(file, descriptor.number, bytes, PROT_READ);
  if (!memory) return memory.problems();
  if (const auto fits = check_header((*memory)->words(), format); !fits) {
    auto problems = fits.problems();
    for (auto& problem : problems) problem.where.file = file.string();
    return problems;
  }
  return std::unique_ptr<BoxReader>(new BoxReader(std::move(*memory), file, identity_of(about)));
}

bool BoxReader::read(std::span<std::uint64_t> into) {
  const std::uint64_t sequence = take_out(memory_->words(), seen_, into);
  if (sequence == 0) return false;
  seen_ = sequence;
  return true;
}

bool BoxReader::replaced() const { return box_identity(file_) != identity_; }

std::uint64_t box_identity(const std::filesystem::path& file) {
  struct stat about {};
  return ::stat(file.c_str(), &about) == 0 ? identity_of(about) : 0;
}

}  // namespace chiaro::daemon
