#pragma once

#include <vector>

#include "tests/bench/accuracy/part.h"

namespace arris::accuracy {

/// Each case `times` times more, turned in space another way each time. What is found must not
/// depend on how a part lies, but near a threshold the last digits decide: how far the counts of
/// the same parts differ is how little a difference between two methods may mean.
std::vector<Case> turned_cases(const std::vector<Case>& cases, int times);

}  // namespace arris::accuracy
