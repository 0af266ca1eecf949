#pragma once

#include <optional>
#include <span>
#include <vector>

#include <QString>
#include <Qt>

namespace arris::ui {

/// What a drag of the mouse does with the camera.
enum class Motion { orbit, pan, zoom };

/// Whose mouse the view obeys: Arris's own, or what hands have learnt elsewhere.
enum class NavigationStyle { arris, catia, solidworks, nx, blender };

/// Buttons held together, with these modifiers.
struct NavigationRule {
  Motion motion;
  Qt::MouseButtons buttons;
  Qt::KeyboardModifiers modifiers = Qt::NoModifier;
  bool after_second = false;  ///< A second button was held, too, and was let go.
};

struct NavigationInfo {
  NavigationStyle style;
  const char* key;   ///< As settings keep it.
  const char* name;  ///< A program's, not translated.
  std::vector<NavigationRule> rules;
  bool wheel_up_is_away = false;  ///< Turned away from the hand it makes the part smaller.

  /// By a drag of the left button the part moves; else one draws a rectangle to select lines.
  bool left_moves() const;
};

/// All of them, in the order of a menu.
std::span<const NavigationInfo> navigation_table();
const NavigationInfo& navigation_info(NavigationStyle style);
/// Arris's own where the key is none.
NavigationStyle navigation_style(const QString& key);

/// The motion of what is held; nothing: the camera stays. A rule for exactly these modifiers, else
/// the one without any.
std::optional<Motion> motion_of(const NavigationInfo& info, Qt::MouseButtons buttons,
                                Qt::KeyboardModifiers modifiers, bool after_second = false);

/// How it is done, as a sentence begins: "Drag with the middle button and Shift".
QString how_to(const NavigationInfo& info, Motion motion);
/// How the part is turned, moved and zoomed, in one line.
QString navigation_summary(const NavigationInfo& info);

}  // namespace arris::ui
