#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <set>
#include <utility>
#include <vector>

#include "core/document/document.h"
#include "core/mesh/geometry.h"
#include "core/partitions/interactive_treatments.h"

/// What tests of treatments by hand ask of the documents they leave.
namespace arris::testing {

/// The edges that are lines, ascending.
inline std::vector<EdgeId> sharp_set(const Document& document) {
  std::vector<EdgeId> edges;
  for (EdgeId e = 0; e < document.lines.edges.size(); ++e)
    if (document.lines.is_sharp(e)) edges.push_back(e);
  return edges;
}

inline std::vector<std::vector<VertexId>> sorted_paths(const std::vector<LinePtr>& lines) {
  std::vector<std::vector<VertexId>> paths;
  for (const LinePtr& line : lines) paths.push_back(line->vertices);
  std::sort(paths.begin(), paths.end());
  return paths;
}

/// What must hold of every document (method.md 5 and 6).
inline void expect_invariants(const Document& document) {
  const Mesh& mesh = *document.mesh;
  // Lines are the chains of the sharp edges, each once.
  std::vector<Origin> edges(mesh.edge_count(), Origin::none);
  for (EdgeId e = 0; e < document.lines.edges.size(); ++e) edges[e] = document.lines.edges[e];
  std::vector<std::vector<VertexId>> derived;
  for (const Line& line : derive_lines(mesh, *document.curvatures, edges, document.lines.cuts))
    derived.push_back(line.vertices);
  std::sort(derived.begin(), derived.end());
  ASSERT_EQ(sorted_paths(document.lines.lines), derived);
  std::set<std::uint32_t> ids;
  for (const LinePtr& line : document.lines.lines) {
    ASSERT_TRUE(ids.insert(line->id).second);
    ASSERT_LT(line->id, document.next_id);
  }
  // Boundaries carried on by edits are those derived from scratch.
  const Boundaries fresh =
      derive_boundaries(mesh, *document.curvatures, document.lines, document.partitions);
  ASSERT_EQ(document.boundaries->size(), fresh.size());
  for (std::size_t k = 0; k < fresh.size(); ++k)
    ASSERT_TRUE(*(*document.boundaries)[k] == *fresh[k])
        << "boundary " << k << " " << name_of(fresh[k]->type) << " line " << fresh[k]->line << " "
        << (*document.boundaries)[k]->line;
  // Partitions are edge-connected and disjoint, and know their faces, area and anchor.
  if (document.partitions.labels.empty()) return;
  std::map<std::uint32_t, std::pair<std::uint32_t, double>> counted;
  for (FaceId f = 0; f < mesh.face_count(); ++f)
    if (const std::uint32_t id = document.partitions.labels[f]; id != 0) {
      ++counted[id].first;
      counted[id].second += face_area(mesh, f);
    }
  ASSERT_EQ(counted.size(), document.partitions.partitions.size());
  for (const PartitionPtr& partition : document.partitions.partitions) {
    ASSERT_TRUE(ids.insert(partition->id).second);
    ASSERT_LT(partition->id, document.next_id);
    ASSERT_EQ(partition->faces, counted[partition->id].first);
    ASSERT_NEAR(partition->area, counted[partition->id].second, 1e-6 * partition->area + 1e-9);
    const auto anchor = mesh.find_face(partition->anchor);
    ASSERT_TRUE(anchor.has_value());
    ASSERT_EQ(document.partitions.labels[*anchor], partition->id);
    ASSERT_EQ(faces_of(mesh, document.partitions, *partition).size(), partition->faces);
  }
}

}  // namespace arris::testing
