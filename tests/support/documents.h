#pragma once

#include <cmath>
#include <functional>
#include <numbers>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "core/document/document.h"
#include "core/document/operation.h"
#include "core/mesh/write_ply.h"
#include "core/samples/mould.h"
#include "tests/support/meshes.h"
#include "tests/support/temp_folder.h"

/// Documents and their parts, made in one line. Each helper throws where it cannot, which fails the
/// test at once.
namespace arris::testing {

template <class T>
T value_of(Result<T> result) {
  if (!result) throw std::logic_error(result.error().message);
  return std::move(*result);
}

inline CurvaturesPtr curvatures_of(const Mesh& mesh) { return value_of(compute_curvatures(mesh)); }

/// An opened part that never was a file.
inline Document document_of(const Triangles& triangles) {
  PolygonFile file;
  file.format = "PLY";
  file.points = triangles.points;
  file.starts.push_back(0);
  for (const Triangle& t : triangles.triangles) {
    file.corners.insert(file.corners.end(), t.begin(), t.end());
    file.starts.push_back(file.corners.size());
  }
  Document document;
  document.scan = value_of(make_scan(std::move(file), "memory"));
  document.mesh = document.scan->mesh;
  document.curvatures = curvatures_of(*document.mesh);
  document.evidence =
      std::make_shared<const SharedLineEvidence>(document.mesh, document.curvatures);
  document.opened = {document.mesh, document.curvatures, nullptr, document.evidence};
  document.boundaries = std::make_shared<const Boundaries>();
  return document;
}

/// Writes a mesh as a file of the folder and returns its path.
inline std::string write_mesh(const TempFolder& folder, const std::string& name,
                              const Triangles& triangles) {
  if (const auto written = write_ply(folder.file(name), *mesh_of(triangles), {}); !written)
    throw std::logic_error(written.error().message);
  return folder.file(name);
}

inline Triangles sample_mould(double edge_length) {
  MouldOptions options;
  options.edge_length = edge_length;
  SampleMould mould = make_mould(options);
  return {std::move(mould.points), std::move(mould.triangles)};
}

/// The same with about so many faces; above a million in steps of four.
Triangles mould_of(double faces);

/// A flat square lattice from (0, 0) to (size, size) whose vertices are moved by `place(x, y)`.
inline Triangles shaped_lattice(double size, double h,
                                const std::function<Point(double, double)>& place) {
  Triangles mesh = noisy_plane(size, h, 0.0, 0.0, 1);
  for (Point& p : mesh.points) p = place(p.x(), p.y());
  return mesh;
}

/// Two planes, `flat` wide each, at a right angle with a fillet between them.
inline Triangles filleted_edge(double flat, double radius, double h) {
  const double arc = radius * std::numbers::pi / 2.0;
  return shaped_lattice(2.0 * flat + arc, h, [=](double x, double y) {
    if (x <= flat) return Point(x - flat, y, 0.0);
    if (x >= flat + arc) return Point(radius, y, -radius - (x - flat - arc));
    const double turn = (x - flat) / radius;
    return Point(radius * std::sin(turn), y, radius * (std::cos(turn) - 1.0));
  });
}

inline Document applied(const Document& document, const Operation& operation) {
  return value_of(apply(document, operation));
}

/// A document divided as a cube is: at its sharp edges, into sides.
inline Document divided_at_edges(const Document& document) {
  return applied(
      applied(document, {"find_sharp_lines", {{"angle", 30.0}, {"min_length", 0.0}}}),
      {"find_partitions", {{"intervals", {{0.0, 1.0}}}, {"min_faces", 1}, {"fill_holes", 0}}});
}

/// A cube of 10 with its 12 edges as lines and its 6 sides as partitions.
inline Document cube_document() { return divided_at_edges(document_of(divided_cube(10.0, 10))); }

}  // namespace arris::testing
