#include "core/document/flow.h"

#include "core/document/chain.h"

namespace arris {

std::vector<Operation> operations_of(Flow flow, const StepParameters& wanted) {
  StepParameters steps;
  if (flow == Flow::paper)
    steps = {{"simplify", nlohmann::json::object()},
             {"find_sharp_lines", {{"method", "walk"}}},
             {"equilateralize", nlohmann::json::object()},
             {"find_partitions", {{"method", "fronts"}}}};
  else
    for (const ChainStep& step : chain_steps)
      if (!step.on_demand) steps[std::string(step.name)] = nlohmann::json::object();
  for (const auto& [name, parameters] : wanted) {
    nlohmann::json& own = steps.try_emplace(name, nlohmann::json::object()).first->second;
    own.update(parameters);
  }
  std::vector<Operation> operations;
  for (const ChainStep& step : chain_steps)
    if (const auto own = steps.find(step.name); own != steps.end())
      operations.push_back({own->first, own->second});
  return operations;
}

}  // namespace arris
