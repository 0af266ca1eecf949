#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>

#include "core/document/operation.h"

namespace arris {

/// What became of a correction when lines or partitions were last found again.
enum class CorrectionState : std::uint8_t {
  applied,  ///< As it was made.
  adapted,  ///< To something that is not quite what it was made on; `message` says to what.
  failed,   ///< What it was made on is gone; it stays in the list and is tried again.
  off,      ///< Finding was asked to leave corrections out.
};

std::string_view name_of(CorrectionState state);

/// A treatment made by hand, kept so that it is done again when lines or partitions are found again
/// with other thresholds (document.md, rule 6). Its operation is resolved: it names its targets by
/// id, for the moment it was made, and by an anchor, for later: vertex paths for lines, a face
/// for partitions.
///
/// Doing it again differs from doing it the first time in two ways. Targets are found by their
/// anchors. And a deletion holds down what is found within 1.5 mean edges of its path, since
/// another threshold draws the same line a little differently; but never an edge that was there
/// when the line was deleted and was not deleted with it ("spared"), so that finding again with the
/// same thresholds gives the same document.
struct Correction {
  Correction(std::uint32_t id_, Operation operation_, CorrectionState state_, std::string message_);

  std::uint32_t id = 0;
  Operation operation;
  CorrectionState state = CorrectionState::applied;
  std::string message;  ///< Empty where applied.
  std::string hash;     ///< Of all that.

  std::size_t bytes() const;
};

using CorrectionPtr = std::shared_ptr<const Correction>;

}  // namespace arris
