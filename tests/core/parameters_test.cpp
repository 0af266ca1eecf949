// The table of parameters, from which cards, bars, options, manual, schema and reports are made.

#include <cmath>
#include <map>
#include <set>

#include <gtest/gtest.h>

#include "core/document/chain.h"
#include "core/document/flow.h"
#include "core/document/operation.h"
#include "core/document/operation_schema.h"
#include "tests/support/documents.h"

namespace arris {
namespace {

using namespace testing;
using nlohmann::json;

class Parameters : public ::testing::Test {
 protected:
  /// With lines and partitions.
  const Document part =
      applied(applied(document_of(sample_mould(1.7)), {"find_sharp_lines"}), {"find_partitions"});

  /// Operations that can be done without anything given, with what they resolve to.
  std::map<const OperationKind*, json> resolvable() const {
    std::map<const OperationKind*, json> all;
    for (const OperationKind& kind : operation_table())
      if (auto resolved = kind.resolve(part, json::object())) all[&kind] = std::move(*resolved);
    return all;
  }
};

bool is_number(const Parameter& parameter) {
  return parameter.kind == ParameterKind::real || parameter.kind == ParameterKind::whole;
}

TEST_F(Parameters, SayWhatTheyAre) {
  for (const OperationKind& kind : operation_table()) {
    EXPECT_TRUE(kind.help.ends_with('.')) << kind.name;
    std::set<std::string_view> names;
    for (const Parameter& parameter : kind.parameters) {
      SCOPED_TRACE(std::string(kind.name) + " " + std::string(parameter.name));
      EXPECT_TRUE(names.insert(parameter.name).second);
      EXPECT_FALSE(parameter.help.empty());
      EXPECT_FALSE(form_of(parameter).empty());
      if (is_number(parameter)) {
        EXPECT_LT(parameter.least, parameter.most);
        EXPECT_LE(parameter.from, parameter.to);
        EXPECT_LE(parameter.to, parameter.most);
        // A slider over the logarithm starts above 0.
        EXPECT_TRUE(!parameter.logarithmic || parameter.least > 0.0);
      }
      EXPECT_EQ(parameter.kind == ParameterKind::choice, !parameter.choices.empty());
      EXPECT_EQ(parameter.kind == ParameterKind::line || parameter.kind == ParameterKind::lines ||
                    parameter.kind == ParameterKind::partition ||
                    parameter.kind == ParameterKind::partitions,
                !parameter.anchors.empty());
      if (!parameter.method.empty() || parameter.by_method) {
        const Parameter* method = kind.find("method");
        ASSERT_NE(method, nullptr);
        EXPECT_TRUE(parameter.method.empty() ||
                    std::ranges::any_of(method->choices, [&](const ParameterChoice& choice) {
                      return choice.key == parameter.method;
                    }));
      }
    }
  }
}

TEST_F(Parameters, ResolvingGivesEachItsDefaultAndNothingElse) {
  std::size_t told = 0;
  for (const auto& [kind, resolved] : resolvable()) {
    std::set<std::string> allowed;
    for (const Parameter& parameter : kind->parameters) {
      SCOPED_TRACE(std::string(kind->name) + " " + std::string(parameter.name));
      allowed.insert(std::string(parameter.name));
      if (!parameter.anchors.empty()) allowed.insert(std::string(parameter.anchors));
      if (!parameter.otherwise.constant().is_null() && !kind->understood) {
        EXPECT_EQ(resolved.at(parameter.name), parameter.otherwise.constant());
        ++told;
      }
    }
    for (const auto& [name, value] : resolved.items())
      EXPECT_TRUE(allowed.contains(name)) << kind->name << " " << name;
  }
  EXPECT_GT(told, 10u);
}

TEST_F(Parameters, NumbersTakeTheirBoundsAndNothingBeyond) {
  std::size_t tried = 0;
  for (const auto& [kind, resolved] : resolvable())
    for (const Parameter& parameter : kind->parameters) {
      if (!is_number(parameter)) continue;
      SCOPED_TRACE(std::string(kind->name) + " " + std::string(parameter.name));
      const bool whole = parameter.kind == ParameterKind::whole;
      const double scale = parameter.unit == unit_of_part ? part.mesh->diagonal() : 1.0;
      const auto taken = [&, kind = kind](const json& value) {
        const auto result = kind->resolve(part, {{std::string(parameter.name), value}});
        if (!result) {
          EXPECT_NE(result.error().message.find(parameter.name), std::string::npos);
        }
        return result.has_value();
      };
      const auto number = [&](double value) {
        return whole ? json(static_cast<std::int64_t>(value)) : json(value);
      };
      const double beyond = whole ? 1.0 : 1e-6;
      EXPECT_TRUE(taken(number(parameter.least)));
      EXPECT_TRUE(taken(number(parameter.most * scale)));
      EXPECT_FALSE(taken(number(parameter.least - beyond)));
      EXPECT_FALSE(taken(number(parameter.most * scale * (1.0 + 1e-9) + beyond)));
      EXPECT_FALSE(taken("5"));
      EXPECT_FALSE(taken(true));
      if (whole) {
        EXPECT_FALSE(taken(parameter.least + 0.5));
      }
      ++tried;
    }
  EXPECT_GT(tried, 10u);
}

TEST_F(Parameters, ChoicesTakeTheirKeysAndNothingElse) {
  for (const auto& [kind, resolved] : resolvable())
    for (const Parameter& parameter : kind->parameters) {
      if (parameter.kind != ParameterKind::choice || !parameter.only_with.empty()) continue;
      const std::string name(parameter.name);
      for (const ParameterChoice& choice : parameter.choices)
        EXPECT_EQ(value_of(kind->resolve(part, {{name, choice.key}})).at(name), choice.key);
      EXPECT_FALSE(kind->resolve(part, {{name, "no such choice"}}));
      EXPECT_FALSE(kind->resolve(part, {{name, 1}}));
    }
}

// The command line gives the options of all steps to one command.
// Found by fuzzing: rows of a session are read before anything judges their parameters.
TEST_F(Parameters, OfAnyKindLeaveAnOperationItsWords) {
  const std::vector<json> odd{nullptr,        true,
                              -1.5,           "x",
                              json::array(),  json::object(),
                              {{1, "y"}, {}}, {{"vertices", 3}},
                              1.0e300,        {nullptr, {nullptr}}};
  for (const OperationKind& kind : operation_table()) {
    EXPECT_FALSE(describe({std::string(kind.name), json::object()}).empty()) << kind.name;
    for (const Parameter& parameter : kind.parameters)
      for (const json& value : odd) {
        json parameters = json::object();
        if (const auto resolved = kind.resolve(part, json::object())) parameters = *resolved;
        parameters[std::string(parameter.name)] = value;
        EXPECT_FALSE(describe({std::string(kind.name), parameters}).empty())
            << kind.name << " " << parameters.dump();
      }
  }
}

TEST_F(Parameters, OfStepsHaveOptionsOfTheirOwn) {
  std::set<std::string_view> options;
  for (const ChainStep& step : chain_steps)
    for (const Parameter& parameter : find_operation(step.name)->parameters)
      if (!parameter.option.empty()) {
        EXPECT_TRUE(options.insert(parameter.option).second) << parameter.option;
      }
  EXPECT_GT(options.size(), 10u);
}

TEST_F(Parameters, StepsOfTheChainSayWhatCameOfThem) {
  for (const ChainStep& step : chain_steps) {
    const OperationKind* kind = find_operation(step.name);
    ASSERT_NE(kind, nullptr) << step.name;
    ASSERT_NE(kind->outcome, nullptr) << step.name;
    const Document after = applied(part, {std::string(step.name)});
    ASSERT_TRUE(after.step(step.name)) << step.name;
    EXPECT_NE(kind->outcome(after), "") << step.name;
    EXPECT_EQ(after.mesh != part.mesh, step.changes_mesh) << step.name;
    EXPECT_EQ(after.outputs[place_in_chain(step.name)].mesh != nullptr, step.leaves_mesh)
        << step.name;
  }
}

TEST_F(Parameters, FlowsFollowTheChain) {
  const auto names = [](const std::vector<Operation>& operations) {
    std::vector<std::string> result;
    for (const Operation& operation : operations) result.push_back(operation.name);
    return result;
  };
  EXPECT_EQ(names(operations_of(Flow::scan)),
            (std::vector<std::string>{"find_sharp_lines", "find_partitions"}));
  EXPECT_EQ(names(operations_of(Flow::scan, {{"smooth_curvature", {{"passes", 2}}}})),
            (std::vector<std::string>{"find_sharp_lines", "smooth_curvature", "find_partitions"}));
  const auto paper = operations_of(Flow::paper, {{"find_sharp_lines", {{"angle", 40.0}}}});
  EXPECT_EQ(names(paper), (std::vector<std::string>{"simplify", "find_sharp_lines",
                                                    "equilateralize", "find_partitions"}));
  EXPECT_EQ(paper[1].parameters, (json{{"method", "walk"}, {"angle", 40.0}}));
}

TEST_F(Parameters, TheSchemaKnowsWhatResolvingTakes) {
  const json schema = operation_schema();
  ASSERT_EQ(schema["oneOf"].size(), operation_table().size());
  for (std::size_t k = 0; k < operation_table().size(); ++k) {
    const OperationKind& kind = operation_table()[k];
    const json& own = schema["oneOf"][k];
    EXPECT_EQ(own["properties"]["operation"]["const"], kind.name);
    const auto resolved = kind.resolve(part, json::object());
    // What must be given by the schema is missing in the one, and may be left out in the other.
    if (!kind.understood) {
      EXPECT_EQ(resolved.has_value(),
                own["required"].size() == 1 && !own.contains("oneOf") && kind.name != "lock")
          << kind.name;
    }
    if (!resolved) continue;
    for (const auto& [name, value] : resolved->items())
      EXPECT_TRUE(own["properties"].contains(name)) << kind.name << " " << name;
  }
}

}  // namespace
}  // namespace arris
