#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <string_view>

namespace arris {

/// A step of figure 2: an operation whose last run the document remembers, and that starts from
/// what the steps before it left.
struct ChainStep {
  std::string_view name;      ///< Of its operation.
  std::string_view title;     ///< What it is called on its card: "Sharp lines".
  bool on_demand = false;     ///< Lines and partitions of a scan can be had without it.
  bool changes_mesh = false;  ///< The document's mesh is another one after it.
  bool leaves_mesh = false;   ///< Its mesh is kept for the steps after it to start from.
  /// Came after version 0.1: it is in the hash of documents in which it was run, and no other's
  /// hash changes by it.
  bool later = false;
};

/// The one table of steps, in the order in which they run (document.md, rule 3).
inline constexpr std::array chain_steps{
    ChainStep{"simplify", "Simplification", true, true, true},
    ChainStep{"swap_edges", "Edge swapping", true, true, true},
    ChainStep{"find_sharp_lines", "Sharp lines"},
    ChainStep{"equilateralize", "Equilateralisation", true, true},
    ChainStep{"smooth_curvature", "Curvature smoothing", true},
    ChainStep{"find_partitions", "Partitions"},
};

/// The place of a step in the chain; chain_steps.size() for names that are no step.
constexpr std::size_t place_in_chain(std::string_view name) {
  std::size_t place = 0;
  while (place < chain_steps.size() && chain_steps[place].name != name) ++place;
  return place;
}

/// A step by its name. A literal that names none does not compile.
class StepName {
 public:
  template <std::size_t size>
  consteval StepName(const char (&literal)[size]) : place(place_in_chain(literal)) {
    if (place == chain_steps.size()) throw "no step has this name";
  }
  StepName(std::string_view name) : place(place_in_chain(name)) {}
  StepName(const std::string& name) : place(place_in_chain(name)) {}

  std::size_t place;  ///< chain_steps.size(): there is no such step.
};

}  // namespace arris
