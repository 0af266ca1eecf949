#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/base/json.h"
#include "ui/view/view_camera.h"

class QAction;

namespace arris::ui {

class ElementsPresenter;
class FieldPresenter;
class MeshView;
class SectionPresenter;
class ViewPresenter;

/// Those who know how the part is looked at.
struct ViewKeepers {
  MeshView* view;
  FieldPresenter* fields;
  ElementsPresenter* elements;
  SectionPresenter* section;
  ViewPresenter* surface;
  QAction* partitions;            ///< Checked: partitions colour the surface, else the field.
  std::vector<QAction*> toggles;  ///< What is visible, each known by its object name.
};

/// How the part is looked at, as a session keeps it: camera, field with its range and colours, what
/// is visible, what is hidden, the section.
std::string saved_view(const ViewKeepers& keepers);

/// Looks at the part like that again. The text may be a stranger's: what it says that cannot be is
/// passed over. False where it says nothing.
bool restore_view(const ViewKeepers& keepers, const std::string& text);

/// Values of a JSON object of a file, of which nothing is certain; absent or out of its range: the
/// other one.
double saved_number(const nlohmann::json& object, const char* key, double otherwise,
                    double least = -1e300, double most = 1e300);
bool saved_flag(const nlohmann::json& object, const char* key, bool otherwise);
std::optional<Point> saved_point(const nlohmann::json& object, const char* key);

}  // namespace arris::ui
