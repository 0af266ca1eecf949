#pragma once

#include <cstdint>
#include <string>

#include "core/base/random.h"
#include "tests/support/meshes.h"

/// Triangles that no program should write and some do, made by code.
namespace arris::testing {

/// What a soup begins as.
enum class SoupKind : std::uint8_t {
  cloud,    ///< Triangles between any points of a coarse lattice: touching, coincident, flat.
  surface,  ///< A sound surface, open or closed.
  fans,     ///< Sheets round shared edges and vertices.
  little,   ///< No face, one or a few.
};
inline constexpr int soup_kinds = 4;

/// A soup of at most some hundred triangles: one of that kind with damage done to it (faces
/// doubled, inverted, left out, with corners exchanged, of repeated corners, vertices thrown
/// together, coordinates that are infinite, no numbers, denormal or huge), of any size from 1e-310
/// to 1e308. The same for the same random numbers.
Triangles random_soup(SoupKind kind, Random& random);

}  // namespace arris::testing
