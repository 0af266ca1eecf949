// How inputs of JSON lines are changed: half the time within the JSON, so that what comes out still
// is an operation, else as any bytes.

#include <algorithm>
#include <cstring>
#include <random>
#include <sstream>
#include <vector>

#include <nlohmann/json.hpp>

#include "core/document/operation.h"
#include "tests/fuzz/fuzz.h"

extern "C" std::size_t LLVMFuzzerMutate(std::uint8_t* data, std::size_t size, std::size_t most);
extern "C" std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size,
                                               std::size_t most, unsigned int seed);

namespace {

using nlohmann::json;
using Random = std::minstd_rand;

json odd_value(Random& random) {
  switch (random() % 14) {
    case 0:
      return nullptr;
    case 1:
      return random() % 2 == 0;
    case 2:
      return static_cast<double>(random() % 2000) / 100.0;
    case 3:
      return -1;
    case 4:
      return 1e300;
    case 5:
      return 5e-324;
    case 6:
      return 4294967295u;
    case 7:
      return 9223372036854775807;
    case 8:
      return json::array();
    case 9:
      return json::object();
    case 10:
      return "keep";
    case 11:
      return json::array({random() % 60, random() % 60, random() % 60});
    default:
      return random() % 60;
  }
}

/// Changes something in a value, mostly deep within.
void change(json& value, Random& random) {
  if (value.is_structured() && !value.empty() && random() % 5 != 0) {
    auto at = value.begin();
    std::advance(at, static_cast<long>(random() % value.size()));
    switch (random() % 8) {
      case 0:
        value.erase(at);
        return;
      case 1:
        if (value.is_array()) {
          const json copy = *at;
          value.insert(at, copy);
          return;
        }
        [[fallthrough]];
      default:
        change(*at, random);
        return;
    }
  }
  if (value.is_number() && random() % 2 == 0)
    value = value.get<double>() < 1000.0 ? json(value.get<double>() * 0.5) : json(0);
  else
    value = odd_value(random);
}

}  // namespace

std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size, std::size_t most,
                                    unsigned int seed) {
  Random random(seed);
  if (random() % 3 == 0) return LLVMFuzzerMutate(data, size, most);
  std::vector<std::string> lines;
  std::istringstream text(std::string(reinterpret_cast<const char*>(data), size));
  for (std::string line; std::getline(text, line);) lines.push_back(line);
  if (lines.empty()) return LLVMFuzzerMutate(data, size, most);
  const std::size_t at = random() % lines.size();
  switch (random() % 8) {
    case 0:
      lines.erase(lines.begin() + static_cast<long>(at));
      break;
    case 1:
      lines.insert(lines.begin() + static_cast<long>(at), lines[random() % lines.size()]);
      break;
    case 2:
      std::swap(lines[at], lines[random() % lines.size()]);
      break;
    default: {
      json value = json::parse(lines[at], nullptr, false);
      if (!value.is_object()) return LLVMFuzzerMutate(data, size, most);
      if (random() % 10 == 0) {
        const auto table = arris::operation_table();
        value["operation"] = std::string(table[random() % table.size()].name);
      } else {
        change(value, random);
      }
      lines[at] = value.dump(-1, ' ', false, json::error_handler_t::replace);
    }
  }
  std::string result;
  for (const std::string& line : lines) result += line + "\n";
  if (result.empty() || result.size() > most) return LLVMFuzzerMutate(data, size, most);
  std::memcpy(data, result.data(), result.size());
  return result.size();
}
