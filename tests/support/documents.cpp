#include "tests/support/documents.h"

#include <unordered_map>

namespace arris::testing {

namespace {

/// Each face in four, by the middles of its edges.
Triangles in_four(const Triangles& coarse) {
  Triangles fine;
  fine.points = coarse.points;
  std::unordered_map<std::uint64_t, VertexId> middles;
  middles.reserve(2 * coarse.triangles.size());
  const auto middle = [&](VertexId a, VertexId b) {
    const std::uint64_t key = (std::uint64_t{std::min(a, b)} << 32) | std::max(a, b);
    const auto [at, fresh] = middles.try_emplace(key, static_cast<VertexId>(fine.points.size()));
    if (fresh) fine.points.push_back(0.5 * (coarse.points[a] + coarse.points[b]));
    return at->second;
  };
  for (const auto& [a, b, c] : coarse.triangles) {
    const VertexId ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
    for (const Triangle& t : {Triangle{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}})
      fine.triangles.push_back(t);
  }
  return fine;
}

}  // namespace

Triangles mould_of(double faces) {
  const double edge = MouldOptions().edge_length * std::sqrt(24416.0 / faces);
  constexpr double finest = 0.13;  // a million; finer takes long to make
  return edge < finest ? in_four(mould_of(faces / 4.0)) : sample_mould(edge);
}

}  // namespace arris::testing
