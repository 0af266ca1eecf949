#pragma once

#include <algorithm>
#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

#include "core/base/hash.h"

namespace arris {

/// A fixed-size array of small values whose copies share everything until one of them is written:
/// copying costs one pointer, an edit costs the chunks it touches and one pointer a chunk.
/// Snapshots of a document keep their per-face and per-edge values in it.
template <class T>
class ChunkedArray {
 public:
  static constexpr std::size_t chunk_size = 512;

  ChunkedArray() = default;
  /// `size` elements, all `value`; the full chunks are one and the same until written.
  explicit ChunkedArray(std::size_t size, const T& value = T()) : size_(size) {
    if (size == 0) return;
    auto chunk = std::make_shared<Chunk>();
    chunk->values.fill(value);
    spine_ = std::make_shared<Spine>((size + chunk_size - 1) / chunk_size, chunk);
    // A chunk remembers the hash of as many values as count in it: what counts less is another one.
    if (size % chunk_size != 0) spine_->back() = std::make_shared<Chunk>(chunk->values);
  }
  /// Takes the values of `values`; chunks equal to those of `previous` are shared with it.
  ChunkedArray(const std::vector<T>& values, const ChunkedArray& previous) : size_(values.size()) {
    if (values.empty()) return;
    spine_ = std::make_shared<Spine>();
    spine_->reserve((size_ + chunk_size - 1) / chunk_size);
    bool same = previous.size_ == size_;
    for (std::size_t begin = 0; begin < size_; begin += chunk_size) {
      const std::size_t count = std::min(chunk_size, size_ - begin);
      const auto first = values.begin() + static_cast<std::ptrdiff_t>(begin);
      const auto last = first + static_cast<std::ptrdiff_t>(count);
      // One that other many values count in has another hash.
      if (previous.size_ >= begin + count &&
          std::min(chunk_size, previous.size_ - begin) == count) {
        const std::shared_ptr<Chunk>& theirs = (*previous.spine_)[begin / chunk_size];
        if (std::equal(first, last, theirs->values.begin())) {
          spine_->push_back(theirs);
          continue;
        }
      }
      same = false;
      auto chunk = std::make_shared<Chunk>();
      std::fill(std::copy(first, last, chunk->values.begin()), chunk->values.end(), T());
      spine_->push_back(std::move(chunk));
    }
    if (same) spine_ = previous.spine_;
  }

  std::size_t size() const { return size_; }
  bool empty() const { return size_ == 0; }
  const T& operator[](std::size_t i) const {
    return (*spine_)[i / chunk_size]->values[i % chunk_size];
  }

  /// Writes one element; copies what another array shares first.
  void set(std::size_t i, const T& value) {
    if ((*this)[i] == value) return;
    if (spine_.use_count() > 1) spine_ = std::make_shared<Spine>(*spine_);
    std::shared_ptr<Chunk>& chunk = (*spine_)[i / chunk_size];
    if (chunk.use_count() > 1) chunk = std::make_shared<Chunk>(chunk->values);
    chunk->values[i % chunk_size] = value;
    chunk->hash.store(0, std::memory_order_relaxed);
  }

  /// Content hash. Chunks remember theirs, so that after an edit it costs the chunks touched.
  std::uint64_t hash() const {
    std::vector<std::uint64_t> parts{size_};
    for (std::size_t k = 0; spine_ && k < spine_->size(); ++k) {
      Chunk& chunk = *(*spine_)[k];
      std::uint64_t part = chunk.hash.load(std::memory_order_relaxed);
      if (part == 0) {
        const std::size_t count = std::min(chunk_size, size_ - k * chunk_size);
        part = hash_bytes(chunk.values.data(), count * sizeof(T)) | 1;  // 0: not known
        chunk.hash.store(part, std::memory_order_relaxed);
      }
      parts.push_back(part);
    }
    return hash_bytes(parts.data(), parts.size() * sizeof parts[0]);
  }

  /// Bytes held by this array and not by `other`.
  std::size_t bytes_beyond(const ChunkedArray& other) const {
    if (!spine_ || spine_ == other.spine_) return 0;
    std::size_t own = spine_->size() * sizeof((*spine_)[0]);
    const Chunk* last = nullptr;
    for (std::size_t k = 0; k < spine_->size(); ++k) {
      const Chunk* chunk = (*spine_)[k].get();
      const bool shared =
          other.spine_ && k < other.spine_->size() && (*other.spine_)[k].get() == chunk;
      if (!shared && chunk != last) own += sizeof(Chunk);
      last = chunk;
    }
    return own;
  }

  friend bool operator==(const ChunkedArray& a, const ChunkedArray& b) {
    if (a.size_ != b.size_) return false;
    if (a.spine_ == b.spine_) return true;
    for (std::size_t k = 0; k < a.spine_->size(); ++k) {
      const auto &mine = (*a.spine_)[k], &theirs = (*b.spine_)[k];
      if (mine == theirs) continue;
      const std::size_t count = std::min(chunk_size, a.size_ - k * chunk_size);
      if (!std::equal(mine->values.begin(),
                      mine->values.begin() + static_cast<std::ptrdiff_t>(count),
                      theirs->values.begin()))
        return false;
    }
    return true;
  }

 private:
  struct Chunk {
    Chunk() = default;
    explicit Chunk(const std::array<T, chunk_size>& from) : values(from) {}
    std::array<T, chunk_size> values;
    std::atomic<std::uint64_t> hash{0};  // of the values; 0: not known
  };
  using Spine = std::vector<std::shared_ptr<Chunk>>;
  std::shared_ptr<Spine> spine_;
  std::size_t size_ = 0;
};

}  // namespace arris
