#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "core/mesh/distance.h"
#include "core/mesh/mesh.h"

namespace arris {

/// What makes one triangulation of a star better than another (section 4.1, "remeshing schemes").
/// Measured on the sample mould, a block and fandisk against their clean twins (error zone twice
/// the noise): all three leave as many vertices to 3 %. The mean error of the normals is least with
/// the area (4.56, 6.4, 21.2 degrees; largest angle 4.74, 6.6, 22.7; flat 4.73, 7.0, 22.9). But
/// where edges may have any length the area makes big stars: on a plate of a million faces with a
/// zone of five times the noise it takes 27 s to 8 s of the others, and leaves 48 vertices; the
/// largest angle 79, flat 101 (OpenMesh's Decimater 89). So the largest angle is the default, and
/// the area where the edge length is limited.
enum class StarCost : std::uint8_t {
  flat,   ///< Least sum of |beta| over the new and the bordering edges.
  angle,  ///< Smallest largest angle of the new faces.
  area,   ///< Least area.
};

/// The polygon that is left when a vertex is taken out, and what its triangulations must keep to.
/// Corners run counter-clockwise seen from outside; side i joins corner i and i + 1, the last one
/// and the first. On the free border the last side is the new border edge.
struct StarPolygon {
  static constexpr int max_size = 16;

  int size = 0;
  std::array<VertexId, max_size> vertices;
  std::array<Point, max_size> points;
  std::array<const Point*, max_size> outer_normals;  ///< Face beyond side i; null: none.
  /// Bit j of row i: corners i and j are joined outside the star, so no new edge may join them.
  std::array<std::uint16_t, max_size> joined;
  double longest_edge = 0.0;   ///< No new edge may be longer, mm; infinite: no limit.
  double least_cosine = -1.0;  ///< No |beta| may be above the arc cosine of this.
};

/// One new face: corners of the polygon, first < middle < last.
struct StarFace {
  std::int8_t first, middle, last;
  bool operator==(const StarFace&) const = default;
};

/// Finds the best triangulation of a star polygon. Keeps its tables between calls: one per thread.
///
/// Largest angle and area are costs of a face: interval dynamic programme, O(k^3). The sum of
/// |beta| is a cost between faces, for which that programme misses the optimum in a third of the
/// cases; its state is (first, last, middle), O(k^4) (method.md 2).
class StarTriangulator {
 public:
  StarTriangulator();

  /// Takes the polygon, which must outlive the calls of best(). Works out its possible faces.
  void set(const StarPolygon& polygon);
  /// Rules out every face for which `is_bad(face)`.
  template <class IsBad>
  void rule_out(const IsBad& is_bad) {
    for (std::int8_t i = 0; i < polygon_->size; ++i)
      for (std::int8_t m = i + 1; m < polygon_->size; ++m)
        for (std::int8_t j = m + 1; j < polygon_->size; ++j)
          if (State& state = states_[index(i, m, j)]; state.possible)
            state.possible = !is_bad(StarFace{i, m, j});
  }
  /// The best triangulation, size - 2 faces, or none that keeps to the rules. Ties go to the lowest
  /// middle corner. `faces` comes back empty where there is no triangulation at all for any cost.
  bool best(StarCost cost, std::vector<StarFace>& faces);
  /// The cost of a triangulation: what best() makes least. For the largest angle minus its cosine.
  double cost_of(StarCost cost, std::span<const StarFace> faces) const;
  /// Unit normal of a face given by best(); does not depend on where the polygon starts.
  const Point& normal(const StarFace& face) const {
    return states_[index(face.first, face.middle, face.last)].normal;
  }
  /// A possible face made ready for distance queries.
  const TriangleQuery& query(const StarFace& face) {
    State& state = states_[index(face.first, face.middle, face.last)];
    if (!state.has_query) {
      state.has_query = true;
      state.query.set(polygon_->points[face.first], polygon_->points[face.middle],
                      polygon_->points[face.last], state.normal);
    }
    return state.query;
  }

 private:
  static constexpr int n_ = StarPolygon::max_size;
  struct State {
    Point normal;
    double area;              // twice the area of this face
    double cost;              // flat: best of the interval with this face on its base
    std::int8_t left, right;  // flat: middle of the best face beyond each side; -1: outer edge
    bool possible;
    bool has_query;
    TriangleQuery query;
  };
  static int index(int first, int middle, int last) { return (first * n_ + middle) * n_ + last; }
  bool may_join(int i, int j) const;
  double across(const Point& normal, const Point* other) const;
  bool best_flat(std::vector<StarFace>& faces);
  bool best_by_face(StarCost cost, std::vector<StarFace>& faces);

  const StarPolygon* polygon_ = nullptr;
  std::vector<State> states_;
};

}  // namespace arris
