#include "core/mesh/gunzip.h"

#include <algorithm>
#include <limits>
#include <memory>

#include <zlib.h>

namespace arris {

bool is_gzip(std::string_view bytes) { return bytes.starts_with("\x1F\x8B\x08"); }

Result<std::string> gunzip(const std::string& path, std::string_view bytes,
                           const Context& context) {
  z_stream stream{};
  constexpr int gzip_header = 16;
  if (inflateInit2(&stream, gzip_header + MAX_WBITS) != Z_OK)
    return fail(path + " cannot be unpacked: there is too little memory.");
  struct End {
    void operator()(z_stream* s) const { inflateEnd(s); }
  };
  const std::unique_ptr<z_stream, End> end(&stream);

  constexpr std::size_t block = std::size_t{1} << 20;
  const auto buffer = std::make_unique_for_overwrite<char[]>(block);
  const std::size_t most = most_growth(bytes.size());
  std::string content;
  std::size_t taken = 0;  // bytes handed to zlib
  while (true) {
    if (context.cancelled()) return cancelled();
    if (stream.avail_in == 0 && taken < bytes.size()) {
      const std::size_t size = std::min<std::size_t>(bytes.size() - taken, block);
      // zlib only reads from it.
      stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(bytes.data() + taken));
      stream.avail_in = static_cast<uInt>(size);
      taken += size;
    }
    stream.next_out = reinterpret_cast<Bytef*>(buffer.get());
    stream.avail_out = static_cast<uInt>(block);
    const int code = inflate(&stream, Z_NO_FLUSH);
    const std::size_t made = block - stream.avail_out;
    if (made > most - content.size())
      return fail(path + " unpacks to more than 200 times its size; it is no mesh file.");
    content.append(buffer.get(), made);
    if (code == Z_STREAM_END) {
      const std::size_t rest = bytes.size() - taken + stream.avail_in;
      if (!is_gzip(bytes.substr(bytes.size() - rest))) return content;  // padding, if anything
      inflateReset(&stream);
    } else if (code == Z_BUF_ERROR && stream.avail_in == 0 && taken == bytes.size()) {
      return fail(path + " is truncated: its compressed content (gzip) ends too early.");
    } else if (code == Z_MEM_ERROR) {
      return fail(path + " cannot be unpacked: there is too little memory.");
    } else if (code != Z_OK && code != Z_BUF_ERROR) {
      return fail(path + " is damaged: its compressed content (gzip) cannot be unpacked.");
    }
  }
}

}  // namespace arris
