#pragma once

#include <array>
#include <cstddef>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/curvature/curvature.h"
#include "core/mesh/length_unit.h"
#include "core/mesh/mesh.h"

namespace arris {

/// The fields that can be shown and read under the pointer.
enum class Field { k, h, kabs, ih, ik, ikabs, ihe, normal_jump, shape, deviation, face_quality };
inline constexpr std::size_t field_count = static_cast<std::size_t>(Field::face_quality) + 1;

/// What a field has one value for.
enum class Element { vertex, edge, face };

struct FieldInfo {
  Field field;
  char key;                   ///< With Alt, shows it in the window.
  std::string_view name;      ///< As in files and on the command line: "Kabs".
  std::string_view own_unit;  ///< "°", "% of zone"; empty: none, or that of lengths.
  std::string_view meaning;   ///< One sentence.
  Element element = Element::vertex;
  bool is_signed = false;
  bool is_class = false;  ///< Values are class numbers (Shape).
  int length_power = 0;   ///< -2 for one over an area; 0: no matter of lengths.
};

/// All fields in the order of the enumeration.
std::span<const FieldInfo, field_count> field_table();
const FieldInfo& info_of(Field field);
/// "1/mm²", "°", or empty.
std::string unit_of(Field field, LengthUnit lengths);
/// By name, upper or lower case.
std::optional<Field> find_field(std::string_view name);

/// Names of the classes of the field Shape: class k is Shape k + 1 (undefined is NaN there).
const std::array<std::string_view, 6>& shape_names();

/// The values of a field of curvature, one per element. IHe is given in degrees; shapes as class
/// numbers, NaN where undefined. IH and IK are those of the chosen pairing. Empty for other fields.
std::vector<double> field_values(const Curvatures& curvatures, Field field);

/// What an element of the field stands for in area, mm^2: a third of the faces around a vertex or
/// of the two faces of an edge, or the face.
std::vector<double> field_weights(const Mesh& mesh, Field field);

}  // namespace arris
