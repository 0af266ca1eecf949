#include "core/mesh/brush.h"

#include <algorithm>
#include <unordered_set>

#include "core/mesh/distance.h"

namespace arris {

std::vector<FaceId> faces_within(const Mesh& mesh, FaceId start, const Point& centre,
                                 double radius) {
  const auto reaches = [&](FaceId f) {
    const Triangle& t = mesh.triangle(f);
    return squared_distance_to_triangle(centre, mesh.point(t[0]), mesh.point(t[1]),
                                        mesh.point(t[2])) <= radius * radius;
  };
  std::vector<FaceId> faces;
  if (!reaches(start)) return faces;
  std::unordered_set<FaceId> known{start};
  faces.push_back(start);
  for (std::size_t i = 0; i < faces.size(); ++i) {
    const HalfEdgeId first = mesh.face_half_edge(faces[i]);
    HalfEdgeId h = first;
    do {
      const FaceId beside = mesh.face(Mesh::opposite(h));
      if (beside != no_id && known.insert(beside).second && reaches(beside))
        faces.push_back(beside);
      h = mesh.next(h);
    } while (h != first);
  }
  std::sort(faces.begin(), faces.end());
  return faces;
}

}  // namespace arris
