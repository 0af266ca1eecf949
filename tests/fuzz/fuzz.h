#pragma once

#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <string>
#include <string_view>

#include <unistd.h>

/// What the fuzz targets share. Each is a program of libFuzzer of its own (CMake option ARRIS_FUZZ;
/// tests/fuzz/run).
namespace arris::fuzz {

/// Stops the program, and so keeps the input, where `fault` says what does not hold.
inline void require_none(const std::string& fault) {
  if (fault.empty()) return;
  std::fprintf(stderr, "FAULT: %s\n", fault.c_str());
  std::abort();
}

inline void require_sentence(const std::string& message) {
  if (message.size() < 4 || !message.ends_with('.') || message.find('\n') != std::string::npos)
    require_none("\"" + message + "\" is no sentence");
}

/// A file of this process's own, in memory where the system has such a folder.
inline std::string file_with(std::string_view name, std::string_view bytes) {
  static const std::string folder = ::access("/dev/shm", W_OK) == 0 ? "/dev/shm" : "/tmp";
  const std::string path =
      folder + "/arris-fuzz-" + std::to_string(::getpid()) + "-" + std::string(name);
  std::ofstream(path, std::ios::binary).write(bytes.data(), static_cast<long>(bytes.size()));
  return path;
}

inline std::string_view text_of(const std::uint8_t* data, std::size_t size) {
  return {reinterpret_cast<const char*>(data), size};
}

}  // namespace arris::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);
