#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/mesh/mesh.h"
#include "core/sharp_lines/line_regions.h"

namespace arris {

struct LineChoiceOptions {
  float angle = 27.0F;                 // degrees: the threshold
  float max_angle = 180.0F;            // degrees: what is sharper is no line, either
  bool convex = true, concave = true;  // signs of the jump that may be lines
  // Lengths in mean edges. A line inside a region (a step that fades out, a slit) is told by its
  // own jump alone, so it has to be the longer the less it jumps: its length counts by the square
  // of its jump over the threshold.
  float least_slit = 16.0F;
  float beside = 2.5F;       // what runs this near to a line doubles it: its length counts nothing
  float clear_slit = 38.0F;  // degrees that it reaches somewhere
  float gap = 4.0F;          // stretches of border shorter than this are closed between lines
  float spur = 3.0F;         // branches with a free end, and rungs between lines, under this go
  float least_group = 6.0F;  // connected lines shorter than this in all go
};

/// Edges that may be lines at some threshold, linked by their vertices: small arrays, so that a
/// choice of lines costs what the candidates do and not what the mesh does.
class CandidateGraph {
 public:
  CandidateGraph() = default;
  /// `edges`: by increasing number.
  CandidateGraph(const Mesh& mesh, const FaceTable& table, std::vector<BorderEdge> edges);

  const std::vector<BorderEdge>& edges() const { return edges_; }
  /// The candidate of an edge; null: none.
  const BorderEdge* find(EdgeId e) const;

  /// Edges of the lines, by increasing number.
  std::vector<EdgeId> choose(const LineChoiceOptions& options) const;

  std::size_t bytes() const;

 private:
  struct Half {
    std::uint32_t edge, to;
  };
  std::span<const Half> around(std::uint32_t v) const {
    return {halves_.data() + starts_[v], halves_.data() + starts_[v + 1]};
  }
  class Beside;
  std::size_t degree(std::uint32_t v, const std::vector<std::uint8_t>& chosen) const;
  void add_slits(const LineChoiceOptions& options, std::vector<std::uint8_t>& chosen) const;
  void close_gaps(float most, std::vector<std::uint8_t>& chosen) const;
  void cut_spurs(const LineChoiceOptions& options, std::vector<std::uint8_t>& chosen) const;
  void drop_short(float least, std::vector<std::uint8_t>& chosen) const;

  std::vector<BorderEdge> edges_;
  std::vector<float> length_;  // in mean edges, like places
  std::vector<Eigen::Vector3f> middle_, direction_;
  std::vector<std::array<std::uint32_t, 2>> ends_;
  std::vector<std::uint32_t> starts_;
  std::vector<Half> halves_;
};

}  // namespace arris
