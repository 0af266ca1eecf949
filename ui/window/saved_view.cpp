#include "ui/window/saved_view.h"

#include <cmath>

#include <Eigen/Geometry>
#include <QAction>
#include <QActionGroup>

#include "core/document/journal.h"
#include "ui/view/mesh_view.h"
#include "ui/window/elements_presenter.h"
#include "ui/window/field_presenter.h"
#include "ui/window/section_presenter.h"
#include "ui/window/view_presenter.h"

namespace arris::ui {

namespace {

nlohmann::json from_point(const Point& point) { return {point.x(), point.y(), point.z()}; }

/// A part that fills the view fills it again, whatever the size of the window then.
nlohmann::json from_camera(const MeshView& view) {
  const ViewCamera& camera = view.camera();
  return {{"fitted", view.is_fitted()},
          {"towards_viewer", from_point(camera.towards_viewer())},
          {"up", from_point(camera.up())},
          {"focus", from_point(camera.focus())},
          {"height", camera.height()}};
}

void restore_camera(MeshView& view, const nlohmann::json& saved) {
  const auto towards = saved_point(saved, "towards_viewer"), up = saved_point(saved, "up");
  const auto focus = saved_point(saved, "focus");
  constexpr double least = 1e-3;  // length of what has a direction
  if (!towards || !up || !focus || !(up->cross(*towards).norm() > least)) return;
  ViewCamera camera = view.camera();
  camera.look(*towards, *up);
  camera.set_focus(*focus);
  const double height = saved_number(saved, "height", 0.0, 0.0);
  if (height > 0.0) camera.set_height(height);
  view.set_camera(camera);
  if (saved_flag(saved, "fitted", true) || !(height > 0.0)) view.fit();
}

}  // namespace

std::string saved_view(const ViewKeepers& keepers) {
  nlohmann::json toggles = nlohmann::json::object();
  for (const QAction* toggle : keepers.toggles)
    toggles[toggle->objectName().toStdString()] = toggle->isChecked();
  const nlohmann::json saved{{"camera", from_camera(*keepers.view)},
                             {"field", keepers.fields->saved()},
                             {"partitions", keepers.partitions->isChecked()},
                             {"surface", static_cast<int>(keepers.view->surface())},
                             {"hidden", keepers.elements->saved_visibility()},
                             {"section", keepers.section->saved()},
                             {"shown", toggles}};
  return saved.dump();
}

bool restore_view(const ViewKeepers& keepers, const std::string& text) {
  const nlohmann::json saved = parse_record(text);
  if (!saved.is_object()) return false;
  const auto part = [&](const char* key) {
    const auto found = saved.find(key);
    return found != saved.end() && found->is_object() ? *found : nlohmann::json::object();
  };
  const nlohmann::json toggles = part("shown");
  for (QAction* toggle : keepers.toggles)
    toggle->setChecked(
        saved_flag(toggles, toggle->objectName().toUtf8().constData(), toggle->isChecked()));
  keepers.fields->restore(part("field"));
  const bool divided = saved_flag(saved, "partitions", false);
  for (QAction* one : keepers.partitions->actionGroup()->actions())  // or the field
    if ((one == keepers.partitions) == divided) one->setChecked(true);
  const double surface = saved_number(saved, "surface", 0.0, 0.0, 2.0);
  keepers.surface->set_surface(static_cast<ShownSurface>(static_cast<int>(surface)));
  keepers.elements->restore_visibility(part("hidden"));
  // What is cut away depends on it, so it comes before the section.
  restore_camera(*keepers.view, part("camera"));
  keepers.section->restore(part("section"));
  return true;
}

double saved_number(const nlohmann::json& object, const char* key, double otherwise, double least,
                    double most) {
  const auto found = object.find(key);
  if (found == object.end() || !found->is_number()) return otherwise;
  const double value = found->get<double>();
  return value >= least && value <= most ? value : otherwise;
}

bool saved_flag(const nlohmann::json& object, const char* key, bool otherwise) {
  const auto found = object.find(key);
  return found != object.end() && found->is_boolean() ? found->get<bool>() : otherwise;
}

std::optional<Point> saved_point(const nlohmann::json& object, const char* key) {
  const auto found = object.find(key);
  if (found == object.end() || !found->is_array() || found->size() != 3) return std::nullopt;
  Point point;
  for (int k = 0; k < 3; ++k) {
    const nlohmann::json& value = (*found)[static_cast<std::size_t>(k)];
    if (!value.is_number()) return std::nullopt;
    point[k] = value.get<double>();
    if (!(std::abs(point[k]) < 1e100)) return std::nullopt;
  }
  return point;
}

}  // namespace arris::ui
