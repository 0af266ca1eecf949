#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "core/mesh/chains.h"
#include "core/mesh/mesh.h"
#include "core/sharp_lines/face_table.h"

namespace arris {

/// Lengths in mean edges, angles in degrees.
struct BorderTestOptions {
  float near = 0.9F;    // across the border, the strip about it that the rounding spoils
  float far = 3.2F;     // across the border, where the sides end
  float along = 1.5F;   // spread of a place along the border; less where the border bends
  int pooled = 5;       // places on either side that count in, ever less
  float narrow = 0.8F;  // share of its mean turn that a side too narrow for a slope is taken for
  float least_ratio = 0.5F;     // of the jump to the turn between the means: below, it is a fillet
  float most_of_fillet = 8.0F;  // and its jump counts for this at most
};

/// What the two sides of a border say at one place of it.
struct BorderPlace {
  float jump = 0.0F;   ///< Degrees: both sides extrapolated to the border, convex positive.
  float turn = 0.0F;   ///< Degrees: between the means of the sides, convex positive.
  float value = 0.0F;  ///< Degrees, 0 to 180: what the place counts for.
};

/// Tests whole borders between regions of faces: a border is followed as a smoothed chain, the turn
/// of the normals is summed up on each side of it, pooled along it, and the straight lines through
/// both sides are extrapolated to it.
///
/// Chains may be joined and regions may be joined; then what changed is measured again by the
/// caller's order (measure()).
class BorderTest {
 public:
  /// One chain of the border; the same two regions lie on its left and right all along.
  struct BorderChain {
    std::vector<HalfEdgeId> path;
    bool closed = false;
    bool alive = true;
  };

  /// `labels`: per face, a label whose root() is its region; `parent`: the forest over labels, each
  /// its own root when anything is first measured. Both must outlive the test.
  BorderTest(const Mesh& mesh, const FaceTable& table, const std::vector<Eigen::Vector3f>& normals,
             const std::vector<std::uint32_t>& labels, std::vector<std::uint32_t>& parent,
             const BorderTestOptions& options);

  const std::vector<BorderChain>& chains() const { return chains_; }
  std::uint32_t region(FaceId f) const { return root(labels_[f]); }
  std::uint32_t root(std::uint32_t label) const {
    while (parent_[label] != label) label = parent_[label] = parent_[parent_[label]];
    return label;
  }
  /// Regions left and right of a chain.
  std::array<std::uint32_t, 2> sides(std::uint32_t chain) const {
    const HalfEdgeId h = chains_[chain].path.front();
    return {region(mesh_.face(h)), region(mesh_.face(Mesh::opposite(h)))};
  }
  /// The living chain through an edge, no_id: none.
  std::uint32_t chain_of(EdgeId e) const {
    return slot_of_edge_[e] == no_id ? no_id : chain_of_[slot_of_edge_[e]];
  }
  /// Where on it.
  std::uint32_t index_of(EdgeId e) const { return index_of_[slot_of_edge_[e]]; }
  const BorderPlace& place(EdgeId e) const { return place_[slot_of_edge_[e]]; }

  /// Sums up the sides at the places [from, to) of a chain. Places are independent.
  void sum_sides(std::uint32_t chain, std::size_t from, std::size_t to, FaceWindow& window);
  /// Works out the places [from, to) of a chain from the sums round them.
  void pool(std::uint32_t chain, std::size_t from, std::size_t to);
  /// Both for a whole chain.
  void measure(std::uint32_t chain, FaceWindow& window);

  /// A chain between regions that became one.
  void remove(std::uint32_t chain);
  /// Joins the two living chains that end at v into one, or closes one. Nothing happens unless
  /// exactly two living border edges meet at v, inside the mesh.
  void join_at(VertexId v);

 private:
  struct Sums {
    std::array<std::array<float, 5>, 2> side{};  // weight, t, t^2, turn, t * turn
    std::array<float, 2> own_far{}, all_far{};
  };

  VertexId vertex(const BorderChain& chain, std::ptrdiff_t i) const;

  const Mesh& mesh_;
  const FaceTable& table_;
  const std::vector<Eigen::Vector3f>& normals_;
  const std::vector<std::uint32_t>& labels_;
  std::vector<std::uint32_t>& parent_;
  const BorderTestOptions options_;
  std::vector<BorderChain> chains_;
  std::vector<std::uint32_t> slot_of_edge_;  // per mesh edge
  std::vector<std::uint32_t> chain_of_;      // per slot; no_id: no longer a border
  std::vector<std::uint32_t> index_of_;      // per slot: its place on the chain
  std::vector<Sums> sums_;                   // per slot
  std::vector<BorderPlace> place_;           // per slot
  std::vector<std::uint32_t> nearest_;       // per face: slot of the nearest border edge
};

}  // namespace arris
