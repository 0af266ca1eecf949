#include "tests/support/fake_disk.h"

#include <algorithm>
#include <cerrno>
#include <cstdarg>
#include <fstream>
#include <map>
#include <mutex>
#include <stdexcept>

#include <dlfcn.h>
#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

namespace arris::testing {

namespace {

constexpr std::uint64_t sector = 512;

struct Event {
  enum class Kind { create, write, truncate, sync, rename, unlink, sync_folder, acknowledge };
  Kind kind;
  std::uint64_t inode = 0;
  std::uint64_t offset = 0;  // of a write; size after a truncation; what was acknowledged
  std::string bytes, name, other;
};

struct Disk {
  std::string folder;
  std::vector<Event> events;
  std::map<int, std::uint64_t> open;  // descriptor to inode; 0: the folder itself
  std::map<std::string, std::uint64_t> names;
  std::map<std::uint64_t, std::uint64_t> sizes;
  std::uint64_t next_inode = 1;
  std::uint64_t room = FakeDisk::endless;
  bool read_only = false;
};

std::recursive_mutex mutex;
Disk* disk = nullptr;  // while a FakeDisk is there

/// The name of a file in the folder; empty: it is none.
std::string name_in(const char* path) {
  if (!disk || !path) return {};
  const std::string text = path;
  if (!text.starts_with(disk->folder + "/")) return {};
  return text.substr(disk->folder.size() + 1);
}

template <class Function>
Function* real(const char* name) {
  return reinterpret_cast<Function*>(::dlsym(RTLD_NEXT, name));
}

int refuse(int error) {
  errno = error;
  return -1;
}

int open_file(const char* function, const char* path, int flags, mode_t mode) {
  static auto* const open_there = real<int(const char*, int, ...)>("open64");
  static_cast<void>(function);
  const std::lock_guard lock(mutex);
  const std::string name = name_in(path);
  const bool is_folder = disk && path && disk->folder == path;
  if (name.empty() && !is_folder) return open_there(path, flags, mode);
  const bool changes = (flags & O_ACCMODE) != O_RDONLY || (flags & (O_CREAT | O_TRUNC)) != 0;
  if (changes && disk->read_only) return refuse(EROFS);
  struct stat before {};
  const bool is_new = ::stat(path, &before) != 0;
  const int descriptor = open_there(path, flags, mode);
  if (descriptor < 0) return descriptor;
  if (is_folder) {
    disk->open[descriptor] = 0;
    return descriptor;
  }
  if (is_new) {
    disk->names[name] = disk->next_inode++;
    disk->events.push_back({Event::Kind::create, disk->names[name], 0, {}, name, {}});
  }
  if (disk->names.contains(name)) disk->open[descriptor] = disk->names[name];
  if (!is_new && (flags & O_TRUNC)) {
    disk->events.push_back({Event::Kind::truncate, disk->names[name], 0, {}, {}, {}});
    disk->sizes[disk->names[name]] = 0;
  }
  return descriptor;
}

std::uint64_t* inode_of(int descriptor) {
  if (!disk) return nullptr;
  const auto found = disk->open.find(descriptor);
  return found == disk->open.end() ? nullptr : &found->second;
}

/// How much of a write there is room for.
std::size_t taken(std::uint64_t inode, std::uint64_t offset, std::size_t count) {
  const std::uint64_t size = disk->sizes[inode], end = offset + count;
  if (end <= size) return count;
  const std::uint64_t more = end - size;
  if (more <= disk->room) return count;
  return more - disk->room >= count ? 0 : static_cast<std::size_t>(count - (more - disk->room));
}

void note_write(std::uint64_t inode, std::uint64_t offset, const void* bytes, std::size_t count) {
  std::uint64_t& size = disk->sizes[inode];
  if (offset + count > size) {
    if (disk->room != FakeDisk::endless) disk->room -= offset + count - size;
    size = offset + count;
  }
  disk->events.push_back({Event::Kind::write,
                          inode,
                          offset,
                          std::string(static_cast<const char*>(bytes), count),
                          {},
                          {}});
}

ssize_t write_at(int descriptor, const void* bytes, std::size_t count, std::uint64_t offset) {
  static auto* const write_there = real<ssize_t(int, const void*, size_t, off64_t)>("pwrite64");
  const std::lock_guard lock(mutex);
  const std::uint64_t* inode = inode_of(descriptor);
  if (!inode) return write_there(descriptor, bytes, count, static_cast<off64_t>(offset));
  if (disk->read_only) return refuse(EROFS);
  const std::size_t fits = taken(*inode, offset, count);
  if (fits == 0 && count > 0) return refuse(ENOSPC);
  const ssize_t written = write_there(descriptor, bytes, fits, static_cast<off64_t>(offset));
  if (written > 0) note_write(*inode, offset, bytes, static_cast<std::size_t>(written));
  return written;
}

int cut(int descriptor, std::uint64_t size) {
  static auto* const cut_there = real<int(int, off64_t)>("ftruncate64");
  const std::lock_guard lock(mutex);
  const std::uint64_t* inode = inode_of(descriptor);
  if (inode && disk->read_only) return refuse(EROFS);
  const int done = cut_there(descriptor, static_cast<off64_t>(size));
  if (inode && done == 0) {
    disk->sizes[*inode] = size;
    disk->events.push_back({Event::Kind::truncate, *inode, size, {}, {}, {}});
  }
  return done;
}

/// Nothing waits for a real disk: what is durable is what was noted to be.
int synchronise(const char* function, int descriptor) {
  const std::lock_guard lock(mutex);
  const std::uint64_t* inode = inode_of(descriptor);
  if (!inode) return real<int(int)>(function)(descriptor);
  disk->events.push_back(*inode == 0 ? Event{Event::Kind::sync_folder, 0, 0, {}, {}, {}}
                                     : Event{Event::Kind::sync, *inode, 0, {}, {}, {}});
  return 0;
}

void put(std::string& content, std::uint64_t offset, std::string_view bytes) {
  if (content.size() < offset + bytes.size()) content.resize(offset + bytes.size(), '\0');
  std::copy(bytes.begin(), bytes.end(), content.begin() + static_cast<std::ptrdiff_t>(offset));
}

void apply(std::string& content, const Event& event) {
  if (event.kind == Event::Kind::write)
    put(content, event.offset, event.bytes);
  else
    content.resize(event.offset, '\0');
}

/// Sector by sector, some of them.
void apply_partly(std::string& content, const Event& event, double share, Random& random) {
  if (event.kind != Event::Kind::write) {
    if (random.uniform(0.0, 1.0) < share) apply(content, event);
    return;
  }
  const std::string_view bytes = event.bytes;
  for (std::uint64_t begin = 0; begin < bytes.size();) {
    const std::uint64_t end = std::min<std::uint64_t>(
        bytes.size(), (event.offset + begin) / sector * sector + sector - event.offset);
    if (random.uniform(0.0, 1.0) < share)
      put(content, event.offset + begin, bytes.substr(begin, end - begin));
    begin = end;
  }
}

}  // namespace

FakeDisk::FakeDisk(const std::filesystem::path& folder) {
  const std::lock_guard lock(mutex);
  if (disk) throw std::logic_error("there is a fake disk already");
  disk = new Disk;
  disk->folder = folder.string();
}

FakeDisk::~FakeDisk() {
  const std::lock_guard lock(mutex);
  delete disk;
  disk = nullptr;
}

void FakeDisk::set_room(std::uint64_t bytes) {
  const std::lock_guard lock(mutex);
  disk->room = bytes;
}

void FakeDisk::set_read_only(bool read_only) {
  const std::lock_guard lock(mutex);
  disk->read_only = read_only;
}

void FakeDisk::acknowledge(std::uint32_t what) {
  const std::lock_guard lock(mutex);
  disk->events.push_back({Event::Kind::acknowledge, 0, what, {}, {}, {}});
}

std::size_t FakeDisk::events() const { return disk->events.size(); }

std::size_t FakeDisk::writes() const {
  return static_cast<std::size_t>(
      std::ranges::count(disk->events, Event::Kind::write, &Event::kind));
}

std::size_t FakeDisk::syncs() const {
  return static_cast<std::size_t>(
      std::ranges::count(disk->events, Event::Kind::sync, &Event::kind));
}

std::uint32_t FakeDisk::after_power_cut(std::size_t events, Random& random,
                                        const std::filesystem::path& to) const {
  using Kind = Event::Kind;
  std::map<std::string, std::uint64_t> names;     // as the folder was synchronised last
  std::map<std::uint64_t, std::string> contents;  // as each file was
  std::map<std::uint64_t, std::vector<const Event*>> written;  // since then
  std::vector<const Event*> moved;                             // names, since then
  std::uint32_t acknowledged = 0;
  const auto move = [&names](const Event& event) {
    if (event.kind == Kind::create) {
      names[event.name] = event.inode;
    } else if (event.kind == Kind::unlink) {
      names.erase(event.name);
    } else {
      names[event.other] = names[event.name];
      names.erase(event.name);
    }
  };
  for (std::size_t k = 0; k < events; ++k) {
    const Event& event = disk->events[k];
    switch (event.kind) {
      case Kind::create:
      case Kind::rename:
      case Kind::unlink:
        moved.push_back(&event);
        break;
      case Kind::write:
      case Kind::truncate:
        written[event.inode].push_back(&event);
        break;
      case Kind::sync:
        for (const Event* change : written[event.inode]) apply(contents[event.inode], *change);
        written[event.inode].clear();
        break;
      case Kind::sync_folder:
        for (const Event* change : moved) move(*change);
        moved.clear();
        break;
      case Kind::acknowledge:
        acknowledged = static_cast<std::uint32_t>(event.offset);
        break;
    }
  }
  // Names come to the disk in their order, as the journals of file systems keep it.
  moved.resize(static_cast<std::size_t>(random.bits() % (moved.size() + 1)));
  for (const Event* change : moved) move(*change);
  for (const auto& [inode, changes] : written) {
    const double shares[]{0.0, 0.15, 0.5, 0.85, 1.0};
    const double share = shares[random.bits() % std::size(shares)];
    for (const Event* change : changes) apply_partly(contents[inode], *change, share, random);
  }
  std::filesystem::remove_all(to);
  std::filesystem::create_directory(to);
  for (const auto& [name, inode] : names)
    std::ofstream(to / name, std::ios::binary) << contents[inode];
  return acknowledged;
}

}  // namespace arris::testing

// What the rest of the program, and the libraries that it is linked with, find first.

using namespace arris::testing;

extern "C" {

int open(const char* path, int flags, ...) {
  mode_t mode = 0;
  if (flags & (O_CREAT | O_TMPFILE)) {
    va_list more;
    va_start(more, flags);
    mode = va_arg(more, mode_t);
    va_end(more);
  }
  return open_file("open", path, flags, mode);
}

int open64(const char* path, int flags, ...) {
  mode_t mode = 0;
  if (flags & (O_CREAT | O_TMPFILE)) {
    va_list more;
    va_start(more, flags);
    mode = va_arg(more, mode_t);
    va_end(more);
  }
  return open_file("open64", path, flags, mode);
}

int close(int descriptor) {
  static auto* const close_there = real<int(int)>("close");
  const std::lock_guard lock(mutex);
  if (disk) disk->open.erase(descriptor);
  return close_there(descriptor);
}

ssize_t write(int descriptor, const void* bytes, size_t count) {
  static auto* const write_there = real<ssize_t(int, const void*, size_t)>("write");
  {
    const std::lock_guard lock(mutex);
    if (inode_of(descriptor)) {
      const off64_t at = ::lseek64(descriptor, 0, SEEK_CUR);
      const ssize_t written = write_at(descriptor, bytes, count, static_cast<std::uint64_t>(at));
      if (written > 0) ::lseek64(descriptor, written, SEEK_CUR);
      return written;
    }
  }
  return write_there(descriptor, bytes, count);
}

ssize_t pwrite(int descriptor, const void* bytes, size_t count, off_t offset) {
  return write_at(descriptor, bytes, count, static_cast<std::uint64_t>(offset));
}

ssize_t pwrite64(int descriptor, const void* bytes, size_t count, off64_t offset) {
  return write_at(descriptor, bytes, count, static_cast<std::uint64_t>(offset));
}

int ftruncate(int descriptor, off_t size) noexcept {
  return cut(descriptor, static_cast<std::uint64_t>(size));
}

int ftruncate64(int descriptor, off64_t size) noexcept {
  return cut(descriptor, static_cast<std::uint64_t>(size));
}

int fsync(int descriptor) { return synchronise("fsync", descriptor); }

int fdatasync(int descriptor) { return synchronise("fdatasync", descriptor); }

int rename(const char* from, const char* to) noexcept {
  static auto* const rename_there = real<int(const char*, const char*)>("rename");
  const std::lock_guard lock(mutex);
  const std::string before = name_in(from), after = name_in(to);
  if (!before.empty() && disk->read_only) return refuse(EROFS);
  const int done = rename_there(from, to);
  if (done == 0 && !before.empty() && !after.empty()) {
    disk->events.push_back({Event::Kind::rename, 0, 0, {}, before, after});
    disk->names[after] = disk->names[before];
    disk->names.erase(before);
  }
  return done;
}

int unlink(const char* path) noexcept {
  static auto* const unlink_there = real<int(const char*)>("unlink");
  const std::lock_guard lock(mutex);
  const std::string name = name_in(path);
  if (!name.empty() && disk->read_only) return refuse(EROFS);
  const int done = unlink_there(path);
  if (done == 0 && !name.empty()) {
    disk->events.push_back({Event::Kind::unlink, 0, 0, {}, name, {}});
    disk->names.erase(name);
  }
  return done;
}

}  // extern "C"
