#include "core/document/curve_files.h"

#include <algorithm>
#include <array>
#include <unordered_map>
#include <utility>

#include "core/base/number_text.h"

namespace arris {

namespace {

std::string coordinates(const Point& p, std::string_view between) {
  std::string text = number_text(p.x(), file_digits);
  for (const double value : {p.y(), p.z()}) {
    text += between;
    text += number_text(value, file_digits);
  }
  return text;
}

/// The vertices that curves pass, each once, numbered in the order in which they are met.
class Points {
 public:
  /// The number of v, and whether it is a new one.
  std::pair<std::size_t, bool> number(VertexId v) {
    const auto [it, fresh] = number_.try_emplace(v, order_.size());
    if (fresh) order_.push_back(v);
    return {it->second, fresh};
  }
  const std::vector<VertexId>& order() const { return order_; }

 private:
  std::unordered_map<VertexId, std::size_t> number_;
  std::vector<VertexId> order_;
};

/// A real number of STEP has a decimal point.
std::string step_real(double value) {
  std::string text = number_text(value, file_digits);
  const std::size_t exponent = text.find('e');
  if (text.find('.') == std::string::npos)
    text.insert(exponent == std::string::npos ? text.size() : exponent, ".");
  if (const std::size_t e = text.find('e'); e != std::string::npos) text[e] = 'E';
  return text;
}

/// The number of a unit in DXF; 0: none.
std::string_view dxf_unit(LengthUnit unit) {
  switch (unit) {
    case LengthUnit::inch:
      return "1";
    case LengthUnit::foot:
      return "2";
    case LengthUnit::millimetre:
      return "4";
    case LengthUnit::centimetre:
      return "5";
    case LengthUnit::metre:
      return "6";
    case LengthUnit::micrometre:
      return "13";
    case LengthUnit::unknown:
      break;
  }
  return "0";
}

}  // namespace

std::string curves_obj(const HandedCurves& curves) {
  std::string text = "# Arris; lengths in " + lengths_in(curves.unit) + "\n";
  Points points;
  for (const HandedCurve& curve : curves.curves) {
    std::string indices;
    for (const VertexId v : *curve.path) {
      const auto [number, fresh] = points.number(v);
      if (fresh) text += "v " + coordinates(curves.mesh.point(v), " ") + "\n";
      indices += " " + std::to_string(number + 1);
    }
    text += "g " + curve.name + "\nl" + indices + "\n";
  }
  return text;
}

namespace {

/// A DXF file as groups of a code and a value, a line each.
struct DxfText {
  std::string text;

  void put(int code, std::string_view value) {
    text += std::to_string(code) + "\n";
    text += value;
    text += "\n";
  }
  void put_point(const Point& p) {
    for (int axis = 0; axis < 3; ++axis) put(10 * (axis + 1), number_text(p[axis], file_digits));
  }
  void put_line_types();
  void put_layers(const std::vector<std::string_view>& layers);
  void put_polyline(const Mesh& mesh, const HandedCurve& curve);
};

void DxfText::put_line_types() {
  put(0, "TABLE");
  put(2, "LTYPE");
  put(70, "1");
  put(0, "LTYPE");
  put(2, "CONTINUOUS");
  put(70, "0");
  put(3, "Solid line");
  put(72, "65");
  put(73, "0");
  put(40, "0.0");
  put(0, "ENDTAB");
}

void DxfText::put_layers(const std::vector<std::string_view>& layers) {
  put(0, "TABLE");
  put(2, "LAYER");
  put(70, std::to_string(layers.size()));
  constexpr std::array colours{"1", "5", "3", "6", "2"};  // red, blue, green, magenta, yellow
  for (std::size_t k = 0; k < layers.size(); ++k) {
    put(0, "LAYER");
    put(2, layers[k]);
    put(70, "0");
    put(62, colours[k % colours.size()]);
    put(6, "CONTINUOUS");
  }
  put(0, "ENDTAB");
}

void DxfText::put_polyline(const Mesh& mesh, const HandedCurve& curve) {
  put(0, "POLYLINE");
  put(8, curve.layer);
  put(66, "1");
  put_point(Point::Zero());
  put(70, curve.closed ? "9" : "8");  // 8: in space, 1: closed
  const std::size_t count = curve.path->size() - (curve.closed ? 1 : 0);
  for (std::size_t k = 0; k < count; ++k) {
    put(0, "VERTEX");
    put(8, curve.layer);
    put_point(mesh.point((*curve.path)[k]));
    put(70, "32");
  }
  put(0, "SEQEND");
  put(8, curve.layer);
}

}  // namespace

std::string curves_dxf(const HandedCurves& curves) {
  DxfText dxf;
  Point low = Point::Zero(), high = Point::Zero();
  bool any = false;
  std::vector<std::string_view> layers;
  for (const HandedCurve& curve : curves.curves) {
    if (std::ranges::find(layers, curve.layer) == layers.end()) layers.push_back(curve.layer);
    for (const VertexId v : *curve.path) {
      const Point& p = curves.mesh.point(v);
      low = any ? Point(low.cwiseMin(p)) : p;
      high = any ? Point(high.cwiseMax(p)) : p;
      any = true;
    }
  }
  dxf.put(999, "Arris: " + curves.title + "; lengths in " + lengths_in(curves.unit));
  dxf.put(0, "SECTION");
  dxf.put(2, "HEADER");
  dxf.put(9, "$ACADVER");
  dxf.put(1, "AC1009");
  dxf.put(9, "$INSUNITS");
  dxf.put(70, dxf_unit(curves.unit));
  dxf.put(9, "$EXTMIN");
  dxf.put_point(low);
  dxf.put(9, "$EXTMAX");
  dxf.put_point(high);
  dxf.put(0, "ENDSEC");
  dxf.put(0, "SECTION");
  dxf.put(2, "TABLES");
  dxf.put_line_types();
  dxf.put_layers(layers);
  dxf.put(0, "ENDSEC");
  dxf.put(0, "SECTION");
  dxf.put(2, "ENTITIES");
  for (const HandedCurve& curve : curves.curves) dxf.put_polyline(curves.mesh, curve);
  dxf.put(0, "ENDSEC");
  dxf.put(0, "EOF");
  return dxf.text;
}

std::string curves_step(const HandedCurves& curves) {
  const double millimetres =
      curves.unit == LengthUnit::unknown ? 1.0 : info_of(curves.unit).millimetres;
  std::string text =
      "ISO-10303-21;\nHEADER;\n"
      "FILE_DESCRIPTION(('Arris: " +
      curves.title +
      "'),'2;1');\n"
      "FILE_NAME('" +
      curves.title +
      ".step','',(''),(''),'Arris','Arris','');\n"
      "FILE_SCHEMA(('AUTOMOTIVE_DESIGN { 1 0 10303 214 1 1 1 1 }'));\nENDSEC;\nDATA;\n";
  std::size_t last = 0;
  const auto put = [&](const std::string& entity) {
    text += "#" + std::to_string(++last) + "=" + entity + ";\n";
    return "#" + std::to_string(last);
  };
  const std::string application =
      put("APPLICATION_CONTEXT('core data for automotive mechanical design processes')");
  put("APPLICATION_PROTOCOL_DEFINITION('international standard','automotive_design',2000," +
      application + ")");
  const std::string product_context = put("PRODUCT_CONTEXT(''," + application + ",'mechanical')");
  const std::string product =
      put("PRODUCT('" + curves.title + "','" + curves.title + "','',(" + product_context + "))");
  put("PRODUCT_RELATED_PRODUCT_CATEGORY('part','',(" + product + "))");
  const std::string formation = put("PRODUCT_DEFINITION_FORMATION('',''," + product + ")");
  const std::string definition_context =
      put("PRODUCT_DEFINITION_CONTEXT('part definition'," + application + ",'design')");
  const std::string definition =
      put("PRODUCT_DEFINITION('design',''," + formation + "," + definition_context + ")");
  const std::string shape = put("PRODUCT_DEFINITION_SHAPE('',''," + definition + ")");
  const std::string length = put("(LENGTH_UNIT()NAMED_UNIT(*)SI_UNIT(.MILLI.,.METRE.))");
  const std::string angle = put("(NAMED_UNIT(*)PLANE_ANGLE_UNIT()SI_UNIT($,.RADIAN.))");
  const std::string solid = put("(NAMED_UNIT(*)SI_UNIT($,.STERADIAN.)SOLID_ANGLE_UNIT())");
  const std::string uncertainty = put("UNCERTAINTY_MEASURE_WITH_UNIT(LENGTH_MEASURE(1.E-6)," +
                                      length + ",'distance_accuracy_value','')");
  const std::string context =
      put("(GEOMETRIC_REPRESENTATION_CONTEXT(3)GLOBAL_UNCERTAINTY_ASSIGNED_CONTEXT((" +
          uncertainty + "))GLOBAL_UNIT_ASSIGNED_CONTEXT((" + length + "," + angle + "," + solid +
          "))REPRESENTATION_CONTEXT('',''))");
  const auto put_point = [&](const Point& p) {
    return put("CARTESIAN_POINT('',(" + step_real(p.x()) + "," + step_real(p.y()) + "," +
               step_real(p.z()) + "))");
  };
  const std::string origin = put_point(Point::Zero());
  const std::string up = put("DIRECTION('',(0.,0.,1.))");
  const std::string along = put("DIRECTION('',(1.,0.,0.))");
  std::string items = put("AXIS2_PLACEMENT_3D(''," + origin + "," + up + "," + along + ")");
  std::unordered_map<VertexId, std::string> points;
  std::string all;
  for (const HandedCurve& curve : curves.curves) {
    std::string path;
    for (const VertexId v : *curve.path) {
      std::string& point = points[v];
      if (point.empty()) point = put_point(millimetres * curves.mesh.point(v));
      path += (path.empty() ? "" : ",") + point;
    }
    const std::string own = put("POLYLINE('" + curve.name + "',(" + path + "))");
    all += (all.empty() ? "" : ",") + own;
  }
  if (!all.empty()) items += "," + put("GEOMETRIC_CURVE_SET('" + curves.title + "',(" + all + "))");
  const std::string wires = put("GEOMETRICALLY_BOUNDED_WIREFRAME_SHAPE_REPRESENTATION('" +
                                curves.title + "',(" + items + ")," + context + ")");
  put("SHAPE_DEFINITION_REPRESENTATION(" + shape + "," + wires + ")");
  return text + "ENDSEC;\nEND-ISO-10303-21;\n";
}

std::string curves_vtp(const HandedCurves& curves) {
  Points points;
  std::string connectivity, offsets;
  std::size_t end = 0;
  for (const HandedCurve& curve : curves.curves) {
    for (const VertexId v : *curve.path)
      connectivity += std::to_string(points.number(v).first) + " ";
    end += curve.path->size();
    connectivity += "\n";
    offsets += std::to_string(end) + "\n";
  }
  std::string text =
      "<?xml version=\"1.0\"?>\n<VTKFile type=\"PolyData\" version=\"0.1\" "
      "byte_order=\"LittleEndian\">\n<PolyData>\n<Piece NumberOfPoints=\"" +
      std::to_string(points.order().size()) + "\" NumberOfVerts=\"0\" NumberOfLines=\"" +
      std::to_string(curves.curves.size()) +
      "\" NumberOfStrips=\"0\" NumberOfPolys=\"0\">\n<CellData>\n";
  for (std::size_t k = 0; k < curves.columns.size(); ++k) {
    text += "<DataArray type=\"Float64\" format=\"ascii\" Name=\"";
    text += curves.columns[k];
    text += "\">\n";
    for (const HandedCurve& curve : curves.curves)
      text += number_text(curve.values[k], file_digits) + "\n";
    text += "</DataArray>\n";
  }
  text +=
      "</CellData>\n<Points>\n<DataArray type=\"Float64\" NumberOfComponents=\"3\" "
      "format=\"ascii\">\n";
  for (const VertexId v : points.order()) text += coordinates(curves.mesh.point(v), " ") + "\n";
  text +=
      "</DataArray>\n</Points>\n<Lines>\n<DataArray type=\"Int64\" Name=\"connectivity\" "
      "format=\"ascii\">\n" +
      connectivity +
      "</DataArray>\n<DataArray type=\"Int64\" Name=\"offsets\" format=\"ascii\">\n" + offsets +
      "</DataArray>\n</Lines>\n</Piece>\n</PolyData>\n</VTKFile>\n";
  return text;
}

std::string curves_csv(const HandedCurves& curves) {
  std::string text = "curve,point,x,y,z\n";
  for (const HandedCurve& curve : curves.curves)
    for (std::size_t k = 0; k < curve.path->size(); ++k)
      text += curve.name + "," + std::to_string(k + 1) + "," +
              coordinates(curves.mesh.point((*curve.path)[k]), ",") + "\n";
  return text;
}

}  // namespace arris
