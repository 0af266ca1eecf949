// Long sessions of random treatments: the invariants hold after each, and all of them replay.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <optional>
#include <string>

#include "core/base/random.h"
#include "core/document/history.h"
#include "core/document/journal.h"
#include "tests/core/treatments_fixture.h"
#include "tests/support/documents.h"
#include "tests/support/shrinking.h"

namespace arris {
namespace {

using nlohmann::json;
using testing::expect_invariants;

/// A random operation on what the document holds; it may be refused.
class RandomEdits {
 public:
  explicit RandomEdits(std::uint64_t seed) : random_(seed) {}

  Operation next(const Document& document) {
    const Mesh& mesh = *document.mesh;
    const auto line = [&]() -> const Line& { return *pick(document.lines.lines); };
    const auto partition = [&]() -> const Partition& {
      return *pick(document.partitions.partitions);
    };
    const double edge = mesh.mean_edge_length();
    const auto region = [&] {
      json stroke = json::array();
      VertexId v = vertex(mesh);
      for (int k = 0; k < 4; ++k) {
        stroke.push_back(v);
        v = step_from(mesh, v, 2);
      }
      return json{{"vertices", stroke}, {"radius", edge * random_.uniform(1.0, 6.0)}};
    };
    const bool has_lines = !document.lines.lines.empty();
    const bool has_partitions = !document.partitions.partitions.empty();
    const double highest =
        has_partitions ? random_.uniform(0.0, 2.0) * middle_value(document) : 1.0;
    for (;;) {
      const std::uint64_t kind = random_.bits() % 30;
      if (kind < 8 && kind != 4 && kind != 5 && !has_lines) continue;
      if (kind >= 10 && kind < 20 && !has_partitions) continue;
      switch (kind) {
        case 0:
          return {"delete_lines", {{"lines", {line().id}}}};
        case 1:
          return {"extend_line", {{"line", line().id}, {"angle", random_.uniform(5.0, 60.0)}}};
        case 2: {
          const Line& l = line();
          return {"trim_line",
                  {{"line", l.id},
                   {"vertex", l.vertices[random_.bits() % l.vertices.size()]},
                   {"side", random_.bits() % 2 ? "first" : "last"}}};
        }
        case 3: {
          const Line& l = line();
          return {"split_line",
                  {{"line", l.id}, {"vertex", l.vertices[random_.bits() % l.vertices.size()]}}};
        }
        case 4: {
          const VertexId from = vertex(mesh);
          if (random_.bits() % 2)
            return {"draw_line", {{"vertices", {from, step_from(mesh, from, 12)}}}};
          const VertexId other = vertex(mesh);
          return {"draw_line",
                  {{"paths",
                    {{from, step_from(mesh, from, 12)}, {other, step_from(mesh, other, 12)}}}}};
        }
        case 5:
          return {"recompute_lines", {{"region", region()}, {"angle", random_.uniform(5.0, 60.0)}}};
        case 6:
          return {"merge_lines", {{"a", line().id}, {"b", line().id}}};
        case 7: {
          const Line& l = line();
          const std::size_t n = l.vertices.size();
          const std::size_t a = random_.bits() % n, b = random_.bits() % n;
          return {"reroute_line",
                  {{"line", l.id},
                   {"from", l.vertices[std::min(a, b)]},
                   {"to", l.vertices[std::max(a, b)]},
                   {"via", step_from(mesh, l.vertices[a], 3)}}};
        }
        case 8:
          return {"find_sharp_lines", {{"angle", random_.uniform(15.0, 60.0)}}};
        case 9:
          return {"find_partitions", json::object()};
        case 10:
        case 11: {
          if (document.boundaries->empty()) continue;
          const Boundary& b = *pick(*document.boundaries);
          return {"connect_partitions",
                  {{"partitions", {b.left, b.right}},
                   {"lines", random_.bits() % 2 ? "keep" : "remove"}}};
        }
        case 12:
          return {"extend_partition",
                  {{"partition", partition().id}, {"interval", {0.0, highest + 1e-12}}}};
        case 13:
          return {"remove_partitions", {{"partitions", {partition().id}}}};
        case 14:
          return {"remove_small_partitions",
                  {{"faces", 2 + random_.bits() % 20}, {"fill", random_.bits() % 2 == 0}}};
        case 15:
          return {"restart_partitions",
                  {{"partitions", {partition().id}}, {"interval", {0.0, highest + 1e-12}}}};
        case 16:
          return {"recompute_partitions",
                  {{"region", region()}, {"interval", {0.0, highest + 1e-12}}}};
        case 17:
        case 18:
          return {
              "paint_partition",
              {{"partition", random_.bits() % 3 == 0 ? 0u : partition().id}, {"region", region()}}};
        case 19: {
          const VertexId from = vertex(mesh);
          return {"split_partition",
                  {{"partition", partition().id}, {"vertices", {from, step_from(mesh, from, 20)}}}};
        }
        case 20:
          if (!has_partitions) continue;
          return {"smooth_boundaries", {{"rounds", 3}}};
        case 21:
          if (!has_lines) continue;
          return {"lock", {{"lines", {line().id}}, {"locked", random_.bits() % 4 == 0}}};
        case 22:
          if (!has_partitions) continue;
          return {"lock", {{"partitions", {partition().id}}, {"locked", random_.bits() % 4 == 0}}};
        case 23:
          if (document.corrections.empty()) continue;
          return {"lift_correction", {{"correction", pick(document.corrections)->id}}};
        case 24:
          if (!has_partitions) continue;
          return {"split_to_four_sides",
                  random_.bits() % 8 ? json{{"partitions", {partition().id}}} : json::object()};
        case 25:
          if (!has_partitions) continue;
          return {"fill_unassigned",
                  random_.bits() % 2 ? json{{"faces", 1 + random_.bits() % 50}} : json::object()};
        case 26: {
          if (!has_partitions) continue;
          const std::uint32_t a = partition().id, b = partition().id;
          return {"extend_partition",
                  {{"partitions", a == b ? json{a} : json{a, b}},
                   {"interval", {0.0, highest + 1e-12}}}};
        }
        default:
          return {random_.bits() % 3 == 0 ? "undo" : "redo", json::object()};
      }
    }
  }

 private:
  template <class T>
  const T& pick(const std::vector<T>& from) {
    return from[random_.bits() % from.size()];
  }
  VertexId vertex(const Mesh& mesh) {
    for (;;) {
      const auto v = static_cast<VertexId>(random_.bits() % mesh.vertex_count());
      if (!mesh.is_isolated(v)) return v;
    }
  }
  VertexId step_from(const Mesh& mesh, VertexId v, int steps) {
    for (int k = 0; k < steps; ++k) {
      std::vector<VertexId> ring;
      mesh.for_ring(v, [&](HalfEdgeId h) { ring.push_back(mesh.to(h)); });
      v = pick(ring);
    }
    return v;
  }
  static double middle_value(const Document& document) {
    const Partition& p = *document.partitions.partitions.front();
    return std::isfinite(p.interval.max) ? p.interval.max : p.interval.min + 1.0;
  }

  Random random_;
};

void expect_replays(const History& history, const std::string& file) {
  const testing::TempFolder folder;
  const auto replayed = replay(folder.write("operations.jsonl", journal_text(history)), {file});
  ASSERT_TRUE(replayed.has_value()) << replayed.error().message;
  ASSERT_EQ(hash_of(replayed->history.current()), hash_of(history.current()));
  ASSERT_TRUE(replayed->warnings.empty());
}

struct Tally {
  int performed = 0, refused = 0;
};

/// Random edits with undo and redo in between, one by each choice. After each: the invariants hold,
/// a second document fed the same operation through JSON is equal; at one random point and at the
/// end a full replay is.
void run_edits(const std::string& file, const testing::Choices& choices, Tally& tally) {
  History history;
  if (const auto done = history.run({"open", {{"file", file}}}); !done)
    FAIL() << done.error().message;
  ASSERT_TRUE(history.run({"find_sharp_lines", {{"angle", 30.0}}}).has_value());
  ASSERT_TRUE(history.run({"find_partitions", json::object()}).has_value());
  std::string told;  // the session so far, for whoever has to find the fault
  const std::size_t replayed_at = choices.empty() ? 0 : choices.front() % choices.size();
  for (std::size_t k = 0; k < choices.size(); ++k) {
    if (k == replayed_at) {
      ASSERT_NO_FATAL_FAILURE(expect_replays(history, file)) << told;
    }
    const Operation operation = RandomEdits(choices[k]).next(history.current());
    told += operation.text() + "\n";
    if (operation.name == "undo" || operation.name == "redo") {
      if (operation.name == "undo" && history.head() > 3) {
        const std::uint32_t parent = history.entries()[history.head() - 1].parent;
        ASSERT_TRUE(history.undo().has_value()) << told;
        ASSERT_EQ(hash_of(history.current()), history.entries()[parent - 1].hash) << told;
      } else if (operation.name == "redo" && history.can_redo()) {
        ASSERT_TRUE(history.redo().has_value()) << told;
        ASSERT_EQ(hash_of(history.current()), history.entries()[history.head() - 1].hash) << told;
      }
      continue;
    }
    const Document before = history.current();
    const std::string hash = hash_of(before);
    const auto done = history.run(operation);
    if (!done) {
      ++tally.refused;
      ASSERT_FALSE(done.error().message.empty()) << told;
      ASSERT_EQ(hash_of(history.current()), hash) << told;
      continue;
    }
    ++tally.performed;
    // The same through JSON, on the document before.
    const auto parsed = Operation::parse(history.entries().back().operation.text());
    ASSERT_TRUE(parsed.has_value()) << told;
    const Result<Document> second = apply(before, *parsed);
    ASSERT_TRUE(second.has_value()) << second.error().message << "\n" << told;
    ASSERT_EQ(hash_of(*second), history.entries().back().hash) << told;
    ASSERT_NO_FATAL_FAILURE(expect_invariants(history.current())) << told;
  }
  ASSERT_NO_FATAL_FAILURE(expect_replays(history, file)) << told;
}

/// The same; where it fails, with the few edits that cause it.
void run_random_edits(const std::string& file, std::size_t count, std::uint64_t seed) {
  std::optional<Tally> first;
  testing::expect_holds(testing::choices_of(count, seed), [&](const testing::Choices& choices) {
    Tally tally;
    run_edits(file, choices, tally);
    if (!first) first = tally;
  });
  EXPECT_GT(first->performed, first->refused);
}

TEST(RandomTreatments, KeepTheInvariantsOnTheSampleMould) {
  const testing::TempFolder folder;
  const std::string file = testing::write_mesh(folder, "mould.ply", testing::sample_mould(4.0));
  run_random_edits(file, 400, 1);
}

std::string name_of_seed(const ::testing::TestParamInfo<int>& seed) {
  return "seed_" + std::to_string(seed.param);
}

/// On noise lines and partitions lie where nobody put them.
class RandomTreatmentsOnANoisyMesh : public ::testing::TestWithParam<int> {};

TEST_P(RandomTreatmentsOnANoisyMesh, KeepTheInvariants) {
  const auto seed = static_cast<std::uint64_t>(GetParam());
  const testing::TempFolder folder;
  const std::string file = testing::write_mesh(
      folder, "mould.ply", testing::noisy(testing::sample_mould(4.0), 0.15, seed));
  run_random_edits(file, 150, seed);
}

INSTANTIATE_TEST_SUITE_P(Sessions, RandomTreatmentsOnANoisyMesh, ::testing::Range(1, 5),
                         name_of_seed);

/// Sessions as long as a user's, one after the other: 20 of 500 edits.
class RandomTreatmentsOnARealMesh : public ::testing::TestWithParam<int> {};

TEST_P(RandomTreatmentsOnARealMesh, KeepTheInvariants) {
  const std::filesystem::path file =
      std::filesystem::path(ARRIS_SOURCE_DIR) / "../shared/data/pairs/block_n1.obj";
  if (!std::filesystem::exists(file)) GTEST_SKIP() << "no ../shared/data";
  run_random_edits(file.string(), 500, static_cast<std::uint64_t>(GetParam()));
}

INSTANTIATE_TEST_SUITE_P(Sessions, RandomTreatmentsOnARealMesh, ::testing::Range(100, 120),
                         name_of_seed);

/// Fails once a session has deleted lines in two operations.
TEST(Shrinking, OfASessionThatFailsLeavesTheEditsThatCauseIt) {
  const testing::TempFolder folder;
  const std::string file = testing::write_mesh(folder, "mould.ply", testing::sample_mould(8.0));
  const auto fault = testing::shrink(testing::choices_of(60, 1), [&](const auto& choices) {
    History history;
    ASSERT_TRUE(history.run({"open", {{"file", file}}}).has_value());
    ASSERT_TRUE(history.run({"find_sharp_lines", {{"angle", 30.0}}}).has_value());
    int deleted = 0;
    for (const std::uint64_t choice : choices) {
      const Operation operation = RandomEdits(choice).next(history.current());
      if (operation.name != "undo" && operation.name != "redo" && history.run(operation))
        deleted += operation.name == "delete_lines";
      ASSERT_LT(deleted, 2) << operation.name;
    }
  });
  ASSERT_TRUE(fault.has_value());
  EXPECT_EQ(fault->choices.size(), 2u);
  EXPECT_NE(fault->fault.find("delete_lines"), std::string::npos) << fault->fault;
}

TEST(Shrinking, OfWhatHoldsFindsNothingAndRunsItOnce) {
  int runs = 0;
  EXPECT_FALSE(testing::shrink(testing::choices_of(60, 1), [&](const auto&) { ++runs; }));
  EXPECT_EQ(runs, 1);
}

TEST(Shrinking, EndsInTimeWithTheLeastSoFar) {
  int runs = 0;
  const auto fault = testing::shrink(
      testing::choices_of(60, 1), [&](const auto&) { FAIL() << "run " << ++runs; },
      std::chrono::seconds(0));
  ASSERT_TRUE(fault.has_value());
  EXPECT_EQ(fault->choices.size(), 60u);
  EXPECT_NE(fault->fault.find("run 1"), std::string::npos);
}

TEST(ThousandEdits, OfAMillionFacesCostLessThan200Megabytes) {
  const testing::TempFolder folder;
  const std::string file =
      testing::write_mesh(folder, "cube.ply", testing::divided_cube(100.0, 290));
  History history;
  const auto run = [&](const Operation& operation) { return history.run(operation).has_value(); };
  ASSERT_TRUE(run({"open", {{"file", file}}}));
  ASSERT_TRUE(run({"find_sharp_lines", {{"angle", 30.0}}}));
  ASSERT_TRUE(run({"find_partitions", {{"intervals", {{0.0, 1.0}}}}}));
  ASSERT_GT(history.current().mesh->face_count(), 1000000u);
  const std::size_t before = history.bytes();
  RandomEdits edits(9);
  int performed = 0;
  for (int k = 0; k < 10000 && performed < 1000; ++k) {
    const Operation operation = edits.next(history.current());
    // The edits of a hand; what is found again is paid for by the finding.
    if (operation.name.starts_with("find_") || operation.name == "undo" ||
        operation.name == "redo" || operation.name == "lift_correction" ||
        operation.name == "connect_partitions" || operation.name == "restart_partitions" ||
        operation.name == "remove_partitions")
      continue;
    performed += run(operation);
  }
  ASSERT_EQ(performed, 1000);
  EXPECT_LT(history.bytes() - before, 200u << 20);
  expect_invariants(history.current());
  const std::string hash = hash_of(history.current());
  for (int k = 0; k < performed; ++k) ASSERT_TRUE(history.undo().has_value());
  for (int k = 0; k < performed; ++k) ASSERT_TRUE(history.redo().has_value());
  EXPECT_EQ(hash_of(history.current()), hash);
}

}  // namespace
}  // namespace arris
