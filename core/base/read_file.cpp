#include "core/base/read_file.h"

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>

#include "core/base/hash.h"
#include "core/base/machine_memory.h"

namespace arris {

Result<FileContent> read_file(const std::string& path, const Context& context) {
  std::error_code error;
  const std::filesystem::file_status status = std::filesystem::status(path, error);
  if (status.type() == std::filesystem::file_type::not_found)
    return fail(path + ": there is no such file.");
  if (error) return fail(path + " cannot be read: " + error.message() + ".");
  if (std::filesystem::is_directory(status)) return fail(path + " is a directory, not a file.");
  if (!std::filesystem::is_regular_file(status)) return fail(path + " is not an ordinary file.");
  const std::uintmax_t size = std::filesystem::file_size(path, error);
  if (error) return fail(path + " cannot be read: " + error.message() + ".");
  if (size == 0) return fail(path + " is empty.");

  if (const auto fits = check_memory(path, size); !fits) return tl::unexpected<Error>(fits.error());

  struct Close {
    void operator()(std::FILE* file) const { std::fclose(file); }
  };
  const std::unique_ptr<std::FILE, Close> file(std::fopen(path.c_str(), "rb"));
  if (!file) return fail(path + " cannot be opened: " + std::strerror(errno) + ".");
  FileContent content{std::make_unique_for_overwrite<char[]>(size), size};
  constexpr std::size_t block = std::size_t{1} << 24;
  for (std::size_t done = 0; done < size;) {
    if (context.cancelled()) return cancelled();
    const std::size_t wanted = std::min(block, size - done);
    if (std::fread(content.bytes.get() + done, 1, wanted, file.get()) != wanted)
      return fail(path + " could not be read to its end.");
    done += wanted;
    context.report(static_cast<double>(done) / static_cast<double>(size), "reading");
  }
  return content;
}

std::string hash_of_content(std::string_view bytes) {
  Hasher hasher;
  hasher.bytes(bytes.data(), bytes.size());
  return hasher.hex();
}

}  // namespace arris
