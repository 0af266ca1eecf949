#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include "tests/bench/accuracy/part.h"

namespace arris::accuracy {

struct TurningOptions {
  std::size_t least_edges = 6;  // of a chain; in a shorter one chance decides
  double least_length = 30.0;   // mean edges, of all these chains; in less chance decides, too
  int rounds = 4;               // of averaging; 4 take off zigzag of up to four edges
};

/// How much chains of points turn, in degrees for each mean edge of their mesh. NaN: too little
/// of them.
struct Turning {
  /// Of the chains as they run along the edges of the mesh. There all of them zigzag, a straight
  /// border on a regular lattice too where it runs across the lattice; so this figure says how
  /// ragged a border is and next to nothing of how it bends.
  double raw = std::numeric_limits<double>::quiet_NaN();
  /// Of the same chains with each point averaged with its two neighbours in the chain (a third
  /// each, ends held, `rounds` times), by their own length: most of the zigzag of the mesh is gone,
  /// what is left are waves and teeth of several edges.
  double smoothed = std::numeric_limits<double>::quiet_NaN();
};

/// The sum of the angles between successive segments over all chains, by their length. A closed
/// chain, which repeats its first point at the end, turns there, too. Chains of fewer than
/// `least_edges` segments count nothing. `mean_edge`: of the mesh, mm.
Turning turning_of(const std::vector<Polyline>& chains, double mean_edge,
                   const TurningOptions& options = {});

/// The edges between two faces of different labels, ascending. `labels`: one for each face; faces
/// labelled `none` have none, and no border.
std::vector<EdgeId> edges_between(const Mesh& mesh, const std::vector<std::uint32_t>& labels,
                                  std::uint32_t none = no_id);

/// Edges linked into chains that end where not exactly two of them meet. `edges`: ascending.
std::vector<Polyline> chains_of(const Mesh& mesh, const std::vector<EdgeId>& edges);

}  // namespace arris::accuracy
