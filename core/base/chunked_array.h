#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <memory>
#include <utility>
#include <vector>

namespace arris {

/// A fixed-size array of small values whose copies share their chunks until one of them is written:
/// copying costs one pointer per 4,096 elements, an edit costs the chunks it touches. Snapshots of
/// a document keep their per-face and per-edge values in it.
template <class T>
class ChunkedArray {
 public:
  static constexpr std::size_t chunk_size = 4096;

  ChunkedArray() = default;
  /// `size` elements, all `value`; the chunks are one and the same until written.
  explicit ChunkedArray(std::size_t size, const T& value = T()) : size_(size) {
    if (size == 0) return;
    auto chunk = std::make_shared<Chunk>();
    chunk->fill(value);
    chunks_.assign((size + chunk_size - 1) / chunk_size, std::move(chunk));
  }
  /// Takes the values of `values`; chunks equal to those of `previous` are shared with it.
  ChunkedArray(const std::vector<T>& values, const ChunkedArray& previous) : size_(values.size()) {
    chunks_.reserve((size_ + chunk_size - 1) / chunk_size);
    for (std::size_t begin = 0; begin < size_; begin += chunk_size) {
      const std::size_t count = std::min(chunk_size, size_ - begin);
      const std::size_t k = begin / chunk_size;
      if (k < previous.chunks_.size() && previous.size_ >= begin + count &&
          std::equal(values.begin() + begin, values.begin() + begin + count,
                     previous.chunks_[k]->begin())) {
        chunks_.push_back(previous.chunks_[k]);
        continue;
      }
      auto chunk = std::make_shared<Chunk>();
      std::copy_n(values.begin() + begin, count, chunk->begin());
      std::fill(chunk->begin() + count, chunk->end(), T());
      chunks_.push_back(std::move(chunk));
    }
  }

  std::size_t size() const { return size_; }
  bool empty() const { return size_ == 0; }
  const T& operator[](std::size_t i) const { return (*chunks_[i / chunk_size])[i % chunk_size]; }

  /// Writes one element; copies its chunk first when another array shares it.
  void set(std::size_t i, const T& value) {
    std::shared_ptr<Chunk>& chunk = chunks_[i / chunk_size];
    if ((*chunk)[i % chunk_size] == value) return;
    if (chunk.use_count() > 1) chunk = std::make_shared<Chunk>(*chunk);
    (*chunk)[i % chunk_size] = value;
  }

  /// Bytes held by this array and not by `other`.
  std::size_t bytes_beyond(const ChunkedArray& other) const {
    std::size_t own = chunks_.size() * sizeof(chunks_[0]);
    const Chunk* last = nullptr;
    for (std::size_t k = 0; k < chunks_.size(); ++k) {
      const Chunk* chunk = chunks_[k].get();
      const bool shared = k < other.chunks_.size() && other.chunks_[k].get() == chunk;
      if (!shared && chunk != last) own += sizeof(Chunk);
      last = chunk;
    }
    return own;
  }

  friend bool operator==(const ChunkedArray& a, const ChunkedArray& b) {
    if (a.size_ != b.size_) return false;
    for (std::size_t k = 0; k < a.chunks_.size(); ++k) {
      if (a.chunks_[k] == b.chunks_[k]) continue;
      const std::size_t count = std::min(chunk_size, a.size_ - k * chunk_size);
      if (!std::equal(a.chunks_[k]->begin(), a.chunks_[k]->begin() + count, b.chunks_[k]->begin()))
        return false;
    }
    return true;
  }

 private:
  using Chunk = std::array<T, chunk_size>;
  std::vector<std::shared_ptr<Chunk>> chunks_;
  std::size_t size_ = 0;
};

}  // namespace arris
