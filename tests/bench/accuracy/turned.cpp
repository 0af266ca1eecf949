#include "tests/bench/accuracy/turned.h"

#include <string>
#include <utility>

#include <Eigen/Geometry>

#include "core/base/random.h"

namespace arris::accuracy {

namespace {

Result<Part> turned(Part part, const Eigen::Matrix3d& turn) {
  const Mesh& mesh = *part.scan->mesh;
  std::vector<Point> points;
  for (VertexId v = 0; v < mesh.vertex_count(); ++v) points.push_back(turn * mesh.point(v));
  std::vector<Triangle> triangles;
  for (FaceId f = 0; f < mesh.face_count(); ++f) triangles.push_back(mesh.triangle(f));
  Result<ScanPtr> scan = scan_of(std::move(points), triangles);
  if (!scan) return tl::unexpected<Error>(scan.error());
  if ((*scan)->mesh->face_count() != mesh.face_count())
    return fail("Turned, the part has other faces: its labels mean nothing.");
  part.scan = std::move(*scan);
  for (TrueCurve& curve : part.truth.curves)
    for (Point& point : curve.points) point = turn * point;
  return part;
}

}  // namespace

std::vector<Case> turned_cases(const std::vector<Case>& cases, int times) {
  std::vector<Case> result;
  for (int k = 1; k <= times; ++k) {
    Random random(static_cast<std::uint64_t>(k));
    const Eigen::Quaterniond turn(random.gaussian(), random.gaussian(), random.gaussian(),
                                  random.gaussian());
    const std::string suffix = ", turned " + std::to_string(k);
    for (const Case& item : cases) {
      Case other;
      other.name = item.name + suffix;
      for (const std::string& group : item.groups) other.groups.push_back(group + suffix);
      other.make = [make = item.make, matrix = turn.normalized().toRotationMatrix()] {
        Result<Part> part = make();
        return part ? turned(std::move(*part), matrix) : part;
      };
      result.push_back(std::move(other));
    }
  }
  return result;
}

}  // namespace arris::accuracy
