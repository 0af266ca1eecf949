#include "ui/view/navigation.h"

#include <algorithm>
#include <array>

#include <QStringList>

#include "ui/view/translated.h"

namespace arris::ui {

bool NavigationInfo::left_moves() const {
  return std::ranges::any_of(rules,
                             [](const NavigationRule& r) { return r.buttons == Qt::LeftButton; });
}

std::span<const NavigationInfo> navigation_table() {
  using enum Motion;
  constexpr auto left = Qt::LeftButton, middle = Qt::MiddleButton, right = Qt::RightButton;
  constexpr auto shift = Qt::ShiftModifier, control = Qt::ControlModifier;
  static const std::array<NavigationInfo, 5> table{
      {{NavigationStyle::arris,
        "arris",
        "Arris",
        {{orbit, left},
         {pan, left, control},
         {pan, middle},
         {orbit, middle, shift},
         {zoom, right}}},
       {NavigationStyle::catia,
        "catia",
        "CATIA",
        {{orbit, middle | left},
         {orbit, middle | right},
         {pan, middle},
         {zoom, middle, Qt::NoModifier, true}}},
       {NavigationStyle::solidworks,
        "solidworks",
        "SolidWorks",
        {{orbit, middle}, {pan, middle, control}, {zoom, middle, shift}},
        true},
       {NavigationStyle::nx,
        "nx",
        "NX",
        {{orbit, middle},
         {pan, middle, shift},
         {pan, middle | right},
         {zoom, middle, control},
         {zoom, middle | left}}},
       {NavigationStyle::blender,
        "blender",
        "Blender",
        {{orbit, middle}, {pan, middle, shift}, {zoom, middle, control}}}}};
  return table;
}

const NavigationInfo& navigation_info(NavigationStyle style) {
  return *std::ranges::find(navigation_table(), style, &NavigationInfo::style);
}

NavigationStyle navigation_style(const QString& key) {
  for (const NavigationInfo& info : navigation_table())
    if (key == info.key) return info.style;
  return NavigationStyle::arris;
}

std::optional<Motion> motion_of(const NavigationInfo& info, Qt::MouseButtons buttons,
                                Qt::KeyboardModifiers modifiers, bool after_second) {
  modifiers &= Qt::ShiftModifier | Qt::ControlModifier;
  std::optional<Motion> plain;
  for (const bool after : {after_second, false}) {
    for (const NavigationRule& rule : info.rules) {
      if (rule.buttons != buttons || rule.after_second != after) continue;
      if (rule.modifiers == modifiers) return rule.motion;
      if (rule.modifiers == Qt::NoModifier && !plain) plain = rule.motion;
    }
    if (plain) return plain;
  }
  return plain;
}

namespace {

/// What is held for a motion: "the middle button and Shift".
QString held_for(const NavigationInfo& info, Motion motion) {
  const auto rule = std::ranges::find(info.rules, motion, &NavigationRule::motion);
  if (rule == info.rules.end()) return {};
  if (rule->after_second) return translated("the middle button, after a click of the left one");
  QStringList held;
  for (const auto& [button, name] : {std::pair{Qt::MiddleButton, translated("middle")},
                                     {Qt::LeftButton, translated("left")},
                                     {Qt::RightButton, translated("right")}})
    if (rule->buttons.testFlag(button)) held << name;
  if (held.size() == 2) return translated("the %1 and the %2 button").arg(held[0], held[1]);
  if (rule->modifiers.testFlag(Qt::ShiftModifier))
    return translated("the %1 button and Shift").arg(held[0]);
  if (rule->modifiers.testFlag(Qt::ControlModifier))
    return translated("the %1 button and Ctrl").arg(held[0]);
  return translated("the %1 button").arg(held[0]);
}

}  // namespace

QString how_to(const NavigationInfo& info, Motion motion) {
  return translated("Drag with %1").arg(held_for(info, motion));
}

QString navigation_summary(const NavigationInfo& info) {
  return translated("Turn with %1, move with %2, zoom with %3 or the wheel")
      .arg(held_for(info, Motion::orbit), held_for(info, Motion::pan),
           held_for(info, Motion::zoom));
}

}  // namespace arris::ui
