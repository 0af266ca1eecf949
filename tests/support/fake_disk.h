#pragma once

#include <cstdint>
#include <filesystem>
#include <limits>
#include <string>
#include <vector>

#include "core/base/random.h"

/// Stands between this program (SQLite included) and the files of one folder: the functions of the
/// C library that change files are those of fake_disk.cpp in whatever is linked with it. It notes
/// what is done to them, so that the folder can be made as a power cut would have left it; and it
/// can be full, or not be written to.
namespace arris::testing {

class FakeDisk {
 public:
  /// From now on, until the end of this object; one at a time.
  explicit FakeDisk(const std::filesystem::path& folder);
  ~FakeDisk();
  FakeDisk(const FakeDisk&) = delete;
  FakeDisk& operator=(const FakeDisk&) = delete;

  static constexpr std::uint64_t endless = std::numeric_limits<std::uint64_t>::max();
  /// Files cannot grow by more than so many bytes together: ENOSPC.
  void set_room(std::uint64_t bytes);
  /// Nothing can be made, changed or removed: EROFS.
  void set_read_only(bool read_only);

  /// The user was told so: from here on this is not to be lost.
  void acknowledge(std::uint32_t what);
  /// How many things were done so far.
  std::size_t events() const;
  std::size_t writes() const;
  std::size_t syncs() const;

  /// Makes `to` as the folder could be if the power went after so many events: what was
  /// synchronised is there; of what was written since, any sectors are and any are not; of files
  /// made, renamed and removed since their folder was synchronised the first few. Gives the last
  /// acknowledgement before; 0: none.
  std::uint32_t after_power_cut(std::size_t events, Random& random,
                                const std::filesystem::path& to) const;
};

}  // namespace arris::testing
