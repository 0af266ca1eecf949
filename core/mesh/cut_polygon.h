#pragma once

#include <span>
#include <vector>

#include "core/mesh/mesh.h"

namespace arris {

enum class PolygonCut {
  whole,    ///< The triangles cover the polygon and do not overlap.
  crossed,  ///< The outline crosses itself (or is too intricate): the triangles overlap.
};

/// Cuts a polygon of four or more corners into triangles, which are added to `triangles`: a fan
/// where one corner sees all others, else ear by ear, the fullest first, in the plane that fits the
/// outline best. The outline may be concave and may touch itself along a bridge that leads to a
/// hole and back (a key-hole), so that a vertex or an edge is named twice. An outline that runs to
/// a vertex and straight back is cut off there.
///
/// No corner may be named twice in a row, and all points must be finite. Takes some n log n steps
/// for outlines as people draw them, and a bounded number for any.
PolygonCut cut_polygon(std::span<const Point> points, std::span<const VertexId> polygon,
                       std::vector<Triangle>& triangles);

}  // namespace arris
