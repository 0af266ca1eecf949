#pragma once

#include <string>

#include "core/document/handed_curves.h"

namespace arris {

/// Curves in the formats that CAD programs and viewers read, each the text of a whole file.
/// Coordinates have 12 digits; where curves meet they have the same point.

/// Wavefront OBJ: one group a curve, each one `l` polyline.
std::string curves_obj(const HandedCurves& curves);

/// AutoCAD DXF R12, which every CAD program reads: one 3D polyline a curve, on the layer of its
/// kind.
std::string curves_dxf(const HandedCurves& curves);

/// STEP (AP214): a geometric curve set of polylines, each with the name of its curve. In mm,
/// whatever the unit of the part; as they are where that is not known.
std::string curves_step(const HandedCurves& curves);

/// VTK PolyData for ParaView and the like: one polyline a curve, its values as cell data.
std::string curves_vtp(const HandedCurves& curves);

/// A row for each point: name of the curve, number of the point in it, x, y, z.
std::string curves_csv(const HandedCurves& curves);

}  // namespace arris
