#include "core/document/corrections.h"

#include <array>

#include "core/base/hash.h"

namespace arris {

std::string_view name_of(CorrectionState state) {
  static constexpr std::array<std::string_view, 4> names{"applied", "adapted", "failed", "off"};
  return names[static_cast<std::size_t>(state)];
}

Correction::Correction(std::uint32_t id_, Operation operation_, CorrectionState state_,
                       std::string message_)
    : id(id_), operation(std::move(operation_)), state(state_), message(std::move(message_)) {
  Hasher hasher;
  hasher.number(id);
  hasher.text(operation.text());
  hasher.number(static_cast<std::uint64_t>(state));
  hasher.text(message);
  hash = hasher.hex();
}

std::size_t Correction::bytes() const {
  // A JSON number in an array takes 16 bytes.
  std::size_t bytes = sizeof(Correction) + message.capacity();
  for (const auto& [key, value] : operation.parameters.items())
    bytes += 64 + key.size() + 16 * value.flatten().size();
  return bytes;
}

}  // namespace arris
