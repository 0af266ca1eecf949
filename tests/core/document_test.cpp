#include "core/document/document.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <set>

#include "core/base/random.h"
#include "core/base/thread_limit.h"
#include "core/document/curve_files.h"
#include "core/document/operation.h"
#include "tests/support/documents.h"

namespace arris {
namespace {

using namespace arris::testing;
using nlohmann::json;

/// A sentence a user can act on: one line, begins with a word, ends with a full stop.
void expect_sentence(const Error& error) {
  EXPECT_FALSE(error.message.empty());
  EXPECT_FALSE(error.cancelled);
  EXPECT_EQ(error.message.find('\n'), std::string::npos) << error.message;
  EXPECT_EQ(error.message.back(), '.') << error.message;
  EXPECT_GE(std::ranges::count(error.message, ' '), 3) << error.message;
}

std::set<EdgeVertices> sharp_pairs(const Document& document) {
  std::set<EdgeVertices> pairs;
  for (EdgeId e = 0; e < document.mesh->edge_count(); ++e)
    if (document.lines.is_sharp(e)) pairs.insert(document.mesh->edge(e));
  return pairs;
}

std::set<std::uint32_t> line_ids(const Document& document) {
  std::set<std::uint32_t> ids;
  for (const LinePtr& line : document.lines.lines) ids.insert(line->id);
  return ids;
}

json faces_where(const Mesh& mesh, const std::function<bool(const Point&)>& chosen) {
  json faces = json::array();
  for (FaceId f = 0; f < mesh.face_count(); ++f) {
    const Triangle& t = mesh.triangle(f);
    if (chosen((mesh.point(t[0]) + mesh.point(t[1]) + mesh.point(t[2])) / 3.0)) faces.push_back(t);
  }
  return faces;
}

/// Two steps, one beside the other: lines, three levels, and a component of its own.
Triangles two_parts() {
  Triangles part = stepped_plate(10.0, 20.0, 4.0, 1.0);
  const Triangles other = roof(1.0, 2.0, 4.0, 1.0);
  const auto offset = static_cast<VertexId>(part.points.size());
  for (const Point& p : other.points) part.points.push_back(p + Point(50.0, 0.0, 0.0));
  for (const Triangle& t : other.triangles)
    part.triangles.push_back({t[0] + offset, t[1] + offset, t[2] + offset});
  return part;
}

class Operations : public ::testing::Test {
 protected:
  TempFolder folder;
  std::string path = write_mesh(folder, "part.ply", two_parts());
  Document part = applied({}, {"open", {{"file", path}}});

  /// One or more of each kind, applicable to `part`.
  std::vector<Operation> samples() const {
    return {
        {"open", {{"file", path}}},
        {"flip_orientation", json::object()},
        {"delete_faces", {{"faces", json::array({part.mesh->triangle(3)})}}},
        {"delete_faces", {{"components_under", 100}}},
        {"delete_faces", {{"box", {0, 0, -1, 5, 5, 9}}}},
        {"delete_faces", {{"box", {-20, -1, -9, 20, 15, 9}}, {"side", "outside"}}},
        {"find_sharp_lines", json::object()},
        {"find_sharp_lines", {{"angle", 25}, {"parallel_distance", 2}, {"bridge_gap", 1.5}}},
        {"simplify", {{"error_zone", 0.05}}},
        {"simplify", {{"error_zone", 0.02}, {"max_edge_length", 4}, {"cost", "angle"}}},
        {"swap_edges", json::object()},
        {"equilateralize", json::object()},
        {"smooth_curvature", json::object()},
        {"smooth_curvature", {{"passes", 4}}},
        {"set_unit", {{"unit", "in"}}},
        {"find_partitions", json::object()},
        {"find_partitions",
         {{"criterion", "ikabs"}, {"intervals", {{0, 0.5}, {0.5, nullptr}}}, {"min_faces", 2}}}};
  }
};

TEST_F(Operations, TableHoldsEachOnceWithTitleAndVersion) {
  std::set<std::string_view> names;
  for (const OperationKind& kind : operation_table()) {
    EXPECT_TRUE(names.insert(kind.name).second);
    EXPECT_EQ(find_operation(kind.name), &kind);
    EXPECT_FALSE(kind.title.empty());
    EXPECT_GE(kind.version, 1);
  }
  EXPECT_EQ(find_operation("no such thing"), nullptr);
  std::set<std::string_view> covered;
  for (const Operation& operation : samples()) covered.insert(find_operation(operation.name)->name);
  // Treatments need lines and partitions: line_treatments_test.cpp and the like.
  for (const OperationKind& kind : operation_table())
    if (kind.is_treatment()) covered.insert(kind.name);
  covered.insert({"lock", "lift_correction"});
  EXPECT_EQ(covered, names) << "every operation takes part in these tests";
}

TEST_F(Operations, ResolvedOnceIsResolvedForGood) {
  for (const Operation& operation : samples()) {
    SCOPED_TRACE(operation.text());
    const Operation once = value_of(resolve(part, operation));
    EXPECT_TRUE(once.parameters.contains("version"));
    for (const auto& [name, value] : operation.parameters.items())
      EXPECT_EQ(once.parameters.value(name, json()), value) << "what was given stays";
    EXPECT_EQ(value_of(resolve(part, once)).text(), once.text());
    const Performed performed = value_of(perform(part, operation));
    EXPECT_EQ(value_of(resolve(part, performed.operation)).text(), performed.operation.text());
    EXPECT_EQ(hash_of(applied(part, once)), hash_of(performed.document));
    EXPECT_EQ(hash_of(applied(part, performed.operation)), hash_of(performed.document));
  }
}

TEST_F(Operations, GoThroughJsonUnchanged) {
  for (const Operation& operation : samples()) {
    SCOPED_TRACE(operation.text());
    const Performed performed = value_of(perform(part, operation));
    const Operation read = value_of(Operation::parse(performed.operation.text()));
    EXPECT_EQ(read, performed.operation);
    EXPECT_EQ(read.text(), performed.operation.text());
    EXPECT_EQ(read.text().find('\n'), std::string::npos);
    EXPECT_EQ(hash_of(applied(part, read)), hash_of(performed.document));
    EXPECT_FALSE(describe(read).empty());
  }
}

TEST_F(Operations, DefaultsAreComplete) {
  const auto names = [&](const Operation& operation) {
    const Operation complete = value_of(perform(part, operation)).operation;
    std::set<std::string> result;
    for (const auto& [name, value] : complete.parameters.items()) result.insert(name);
    return result;
  };
  using Names = std::set<std::string>;
  EXPECT_EQ(names({"open", {{"file", path}}}), (Names{"file", "hash", "weld", "version"}));
  EXPECT_EQ(names({"flip_orientation", json::object()}), (Names{"version"}));
  EXPECT_EQ(names({"delete_faces", {{"box", {0, 0, -1, 5, 5, 9}}}}),
            (Names{"box", "side", "version"}));
  EXPECT_EQ(names({"find_sharp_lines", json::object()}),
            (Names{"method", "angle", "candidates", "min_length", "parallel_distance", "bridge_gap",
                   "max_angle", "convexity", "corrections", "version"}));
  EXPECT_EQ(names({"smooth_curvature", json::object()}), (Names{"passes", "version"}));
  EXPECT_EQ(names({"find_partitions", json::object()}),
            (Names{"method", "detail", "criterion", "intervals", "min_faces", "fill_holes",
                   "corrections", "version"}));
}

TEST_F(Operations, LeaveTheDocumentTheyStartFromAlone) {
  const Document lined = applied(part, {"find_sharp_lines", json::object()});
  const Document before = applied(lined, {"find_partitions", json::object()});
  const std::string hash = hash_of(before);
  for (const Operation& operation : samples()) {
    applied(before, operation);
    EXPECT_EQ(hash_of(before), hash) << operation.text();
  }
}

TEST_F(Operations, FaultsAreSentences) {
  const json good_box{0, 0, -1, 5, 5, 9};
  const std::vector<std::pair<Operation, std::string>> faults{
      // name or value that the sentence must show
      {{"open", json::object()}, "file"},
      {{"open", {{"file", 7}}}, "file"},
      {{"open", {{"file", ""}}}, "file"},
      {{"open", {{"file", folder.file("none.ply")}}}, "none.ply"},
      {{"open", {{"file", folder.path().string()}}}, folder.path().string()},
      {{"open", {{"file", path}, {"hash", "0123"}}}, "part.ply"},
      {{"open", {{"file", path}, {"hash", 5}}}, "hash"},
      {{"open", {{"file", path}, {"colour", "red"}}}, "colour"},
      {{"flip_orientation", {{"axis", 1}}}, "axis"},
      {{"delete_faces", json::object()}, "faces"},
      {{"delete_faces", {{"components_under", 100}, {"box", good_box}}}, "exactly one"},
      {{"delete_faces", {{"faces", 5}}}, "faces"},
      {{"delete_faces", {{"faces", {{1, 2}}}}}, "faces"},
      {{"delete_faces", {{"faces", {{1, 2, -3}}}}}, "faces"},
      {{"delete_faces", {{"faces", {{1.5, 2, 3}}}}}, "faces"},
      {{"delete_faces", {{"faces", {{0, 1, 99999999}}}}}, "99999999"},
      {{"delete_faces", {{"faces", {{0, 1, 12345678901}}}}}, "faces"},
      {{"delete_faces", {{"faces", json::array()}}}, "nothing"},
      {{"delete_faces", {{"components_under", 0}}}, "components_under"},
      {{"delete_faces", {{"components_under", "all"}}}, "components_under"},
      {{"delete_faces", {{"components_under", 1}}}, "nothing"},
      {{"delete_faces", {{"components_under", 1000000}}}, "whole"},
      {{"delete_faces", {{"box", {0, 0, 0, 1, 1}}}}, "box"},
      {{"delete_faces", {{"box", "big"}}}, "box"},
      {{"delete_faces", {{"box", {0, 0, 0, 1, 1, "1"}}}}, "box"},
      {{"delete_faces", {{"box", good_box}, {"side", "left"}}}, "side"},
      {{"delete_faces", {{"box", {900, 900, 900, 901, 901, 901}}}}, "nothing"},
      {{"find_sharp_lines", {{"angle", "steep"}}}, "angle"},
      {{"find_sharp_lines", {{"angle", 0}}}, "angle"},
      {{"find_sharp_lines", {{"angle", -5}}}, "-5"},
      {{"find_sharp_lines", {{"angle", 180}}}, "angle"},
      {{"find_sharp_lines", {{"candidates", 0}}}, "candidates"},
      {{"find_sharp_lines", {{"candidates", 2.5}}}, "candidates"},
      {{"find_sharp_lines", {{"min_length", -1}}}, "min_length"},
      {{"find_sharp_lines", {{"min_length", 1e300}}}, "min_length"},
      {{"find_sharp_lines", {{"parallel_distance", 99}}}, "parallel_distance"},
      {{"find_sharp_lines", {{"bridge_gap", true}}}, "bridge_gap"},
      {{"find_sharp_lines", {{"angel", 30}}}, "angel"},
      {{"find_sharp_lines", {{"version", 99}}}, "99"},
      {{"find_sharp_lines", {{"version", "new"}}}, "version"},
      {{"smooth_curvature", {{"passes", 0}}}, "passes"},
      {{"smooth_curvature", {{"passes", "some"}}}, "passes"},
      {{"smooth_curvature", {{"radius", 2}}}, "radius"},
      {{"find_partitions", {{"criterion", "gauss"}}}, "gauss"},
      {{"find_partitions", {{"criterion", 3}}}, "criterion"},
      {{"find_partitions", {{"intervals", 3}}}, "intervals"},
      {{"find_partitions", {{"intervals", {{0}}}}}, "intervals"},
      {{"find_partitions", {{"intervals", {{1, 0}}}}}, "intervals"},
      {{"find_partitions", {{"intervals", {{0, 0}}}}}, "intervals"},
      {{"find_partitions", {{"intervals", {{-1, 1}}}}}, "intervals"},
      {{"find_partitions", {{"intervals", {{nullptr, 1}}}}}, "intervals"},
      {{"find_partitions", {{"intervals", {{"a", "b"}}}}}, "intervals"},
      {{"find_partitions", {{"min_faces", 0}}}, "min_faces"},
      {{"find_partitions", {{"min_faces", 1e12}}}, "min_faces"},
      {{"find_partitions", {{"fill_holes", -1}}}, "fill_holes"},
      {{"paint", json::object()}, "paint"},
  };
  for (const auto& [operation, shown] : faults) {
    SCOPED_TRACE(operation.text());
    const Result<Document> result = apply(part, operation);
    ASSERT_FALSE(result);
    expect_sentence(result.error());
    EXPECT_NE(result.error().message.find(shown), std::string::npos) << result.error().message;
  }
}

TEST_F(Operations, NeedAPartExceptOpen) {
  for (const Operation& operation : samples()) {
    const Result<Document> result = apply({}, operation);
    EXPECT_EQ(result.has_value(), operation.name == "open") << operation.text();
    if (!result) {
      expect_sentence(result.error());
      EXPECT_NE(result.error().message.find("no part"), std::string::npos);
    }
  }
}

TEST_F(Operations, TextThatIsNoOperationIsRefused) {
  for (const std::string text : {"", "{", "[]", "3", "null", "{}", R"({"operation": 3})",
                                 R"({"operation": "paint"})", R"({"Operation": "open"})"}) {
    const Result<Operation> result = Operation::parse(text);
    ASSERT_FALSE(result) << text;
    expect_sentence(result.error());
  }
}

TEST_F(Operations, NumbersThatJsonCannotHoldAreRefused) {
  // Written down they would turn into null: a journal with them could not be replayed.
  constexpr double infinite = std::numeric_limits<double>::infinity();
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  for (const Operation& operation :
       {Operation{"delete_faces", {{"box", {-infinite, 0.0, -1.0, 5.0, 5.0, 9.0}}}},
        Operation{"delete_faces", {{"box", {nan, 0.0, -1.0, 5.0, 5.0, 9.0}}, {"side", "outside"}}},
        Operation{"find_sharp_lines", {{"angle", nan}}},
        Operation{"find_sharp_lines", {{"bridge_gap", infinite}}},
        Operation{"find_partitions", {{"intervals", {{0.0, nan}}}}},
        Operation{"find_partitions", {{"intervals", {{infinite, nullptr}}}}}}) {
    const Result<Document> result = apply(part, operation);
    EXPECT_FALSE(result) << operation.text();
  }
}

TEST_F(Operations, CancelledWorkIsAnErrorThatSaysSo) {
  std::stop_source stop;
  stop.request_stop();
  const Context context(nullptr, stop.get_token());
  for (const Operation& operation : samples()) {
    const Result<Document> result = apply(part, operation, context);
    EXPECT_TRUE(result || result.error().cancelled) << operation.text();
  }
  for (const char* name : {"find_sharp_lines", "find_partitions"})
    EXPECT_FALSE(apply(part, {name, json::object()}, context)) << name;
}

TEST_F(Operations, DescriptionsAreForPeople) {
  EXPECT_EQ(describe({"find_sharp_lines", {{"angle", 24}}}), "Find sharp lines, 24°");
  EXPECT_EQ(describe({"open", {{"file", "/a/b/part.stl"}}}), "Open part.stl");
  EXPECT_EQ(describe({"flip_orientation", json::object()}), "Flip orientation");
}

TEST_F(Operations, FileNameThatIsNotUtf8DoesNotThrow) {
  const std::string odd = folder.file("caf\xe9.ply");
  std::filesystem::copy_file(path, odd);
  EXPECT_NO_THROW({
    const Result<Performed> opened = perform({}, {"open", {{"file", odd}}});
    if (opened)
      EXPECT_FALSE(opened->operation.text().empty());
    else
      expect_sentence(opened.error());
  });
}

TEST_F(Operations, FileNamesOfAnyBytesAreOpenedAndWrittenDown) {
  const std::string odd = folder.file("caf\xe9.ply");
  std::filesystem::copy_file(path, odd);
  const Performed opened = value_of(perform({}, open_file(odd)));
  EXPECT_EQ(opened.document.scan_path, odd);
  const Operation again = value_of(Operation::parse(opened.operation.text()));
  EXPECT_EQ(value_of(perform({}, again)).document.scan_path, odd);
  EXPECT_EQ(open_file(path), (Operation{"open", {{"file", path}}}));
  EXPECT_FALSE(perform({}, {"open", {{"file", "x"}, {"file_bytes", "6"}}}));
  EXPECT_FALSE(perform({}, {"open", {{"file", "x"}, {"file_bytes", "zz"}}}));
}

TEST_F(Operations, RowsOfVersionOneOpenAsTheyDidThen) {
  // Two triangles side by side, each with vertices of its own.
  const std::string scan = folder.write(
      "apart.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3\nf 4 5 6\n");
  const auto vertices = [&](const nlohmann::json& parameters) {
    return value_of(perform({}, {"open", parameters})).document.mesh->vertex_count();
  };
  EXPECT_EQ(vertices({{"file", scan}}), 4u);
  EXPECT_EQ(vertices({{"file", scan}, {"weld", false}}), 6u);
  EXPECT_EQ(vertices({{"file", scan}, {"version", 1}}), 6u);
}

// ---- what is shared, what is kept ----

TEST_F(Operations, LineAndPartitionEditsShareTheMesh) {
  const Document lined = applied(part, {"find_sharp_lines", json::object()});
  const Document parted = applied(lined, {"find_partitions", json::object()});
  for (const Document* document : {&lined, &parted}) {
    EXPECT_EQ(document->scan, part.scan);
    EXPECT_EQ(document->mesh, part.mesh);
    EXPECT_EQ(document->curvatures, part.curvatures);
  }
  EXPECT_EQ(parted.lines.lines, lined.lines.lines);
  EXPECT_LT(bytes_beyond(parted, parted), 4096u);
  EXPECT_GT(lined.lines.lines.size(), 0u);
  EXPECT_GT(parted.partitions.partitions.size(), 0u);
}

TEST_F(Operations, FindingTheSameAgainKeepsIdsAndShares) {
  const Operation lines{"find_sharp_lines", json::object()},
      areas{"find_partitions", json::object()};
  const Document once = applied(applied(part, lines), areas);
  const Document twice = applied(applied(once, lines), areas);
  EXPECT_EQ(hash_of(twice), hash_of(once));
  EXPECT_EQ(twice.lines.lines, once.lines.lines);
  EXPECT_EQ(twice.partitions.partitions, once.partitions.partitions);
  EXPECT_EQ(twice.next_id, once.next_id);
}

TEST_F(Operations, StepsKnowWhenAnEarlierOneChanged) {
  Document document = applied(part, {"find_sharp_lines", json::object()});
  EXPECT_FALSE(document.step("find_sharp_lines")->out_of_date);
  EXPECT_FALSE(document.step("find_partitions").has_value());
  document = applied(document, {"find_partitions", json::object()});
  EXPECT_FALSE(document.step("find_partitions")->out_of_date);
  document = applied(document, {"find_sharp_lines", {{"angle", 40}}});
  EXPECT_FALSE(document.step("find_sharp_lines")->out_of_date);
  EXPECT_TRUE(document.step("find_partitions")->out_of_date);
  EXPECT_EQ(document.step("find_sharp_lines")->parameters["angle"], 40);
  document = applied(document, {"find_partitions", json::object()});
  EXPECT_FALSE(document.step("find_partitions")->out_of_date);
  document = applied(document, {"smooth_curvature", json::object()});
  EXPECT_FALSE(document.step("smooth_curvature")->out_of_date);
  EXPECT_TRUE(document.step("find_partitions")->out_of_date);
  document = applied(document, {"find_sharp_lines", {{"angle", 45}}});
  EXPECT_TRUE(document.step("smooth_curvature")->out_of_date);
  document = applied(document, {"delete_faces", {{"components_under", 100}}});
  EXPECT_TRUE(document.step("find_sharp_lines")->out_of_date);
  EXPECT_TRUE(document.step("smooth_curvature")->out_of_date);
  EXPECT_TRUE(document.step("find_partitions")->out_of_date);
  EXPECT_TRUE(document.partitions.partitions.empty());
  EXPECT_TRUE(document.partitions.labels.empty());
}

TEST_F(Operations, OpeningAnotherPartForgetsTheFirstButNotItsIds) {
  const Document lined = applied(part, {"find_sharp_lines", json::object()});
  const Document other = applied(lined, {"open", {{"file", path}}});
  EXPECT_TRUE(other.lines.lines.empty());
  EXPECT_FALSE(other.step("find_sharp_lines").has_value());
  const Document again = applied(other, {"find_sharp_lines", json::object()});
  for (const std::uint32_t id : line_ids(again)) EXPECT_FALSE(line_ids(lined).contains(id));
}

// ---- delete_faces ----

void expect_faces_of_the_scan(const Document& document) {
  ASSERT_TRUE(document.scan_faces);
  ASSERT_EQ(document.scan_faces->size(), document.mesh->face_count());
  for (FaceId f = 0; f < document.mesh->face_count(); ++f) {
    const Triangle& now = document.mesh->triangle(f);
    const Triangle& then = document.scan->mesh->triangle((*document.scan_faces)[f]);
    for (int k = 0; k < 3; ++k)
      EXPECT_EQ(document.mesh->point(now[k]), document.scan->mesh->point(then[k]));
  }
  EXPECT_TRUE(std::ranges::is_sorted(*document.scan_faces));
}

TEST_F(Operations, DeletedFacesAreThoseMeantAndNoOthers) {
  const Mesh& mesh = *part.mesh;
  const auto in_box = [](const Point& p) {
    return p.x() >= 0 && p.x() <= 5 && p.y() >= 0 && p.y() <= 5 && p.z() >= -1 && p.z() <= 9;
  };
  const auto outside = [&](const Point& p) { return !in_box(p); };
  const auto far = [](const Point& p) { return p.x() > 40; };
  const json box{0, 0, -1, 5, 5, 9}, turned{5, 5, 9, 0, 0, -1};
  const std::vector<std::pair<json, std::function<bool(const Point&)>>> ways{
      {{{"faces", faces_where(mesh, in_box)}}, in_box},
      {{{"box", box}}, in_box},
      {{{"box", turned}}, in_box},
      {{{"box", box}, {"side", "outside"}}, outside},
      {{{"components_under", 100}}, far},
  };
  for (const auto& [parameters, gone] : ways) {
    SCOPED_TRACE(parameters.dump().substr(0, 60));
    const Document document = applied(part, {"delete_faces", parameters});
    const std::size_t expected = faces_where(mesh, gone).size();
    EXPECT_GT(expected, 0u);
    EXPECT_EQ(document.mesh->face_count(), mesh.face_count() - expected);
    EXPECT_TRUE(faces_where(*document.mesh, gone).empty());
    EXPECT_EQ(document.scan, part.scan);
    ASSERT_EQ(document.mesh->vertex_count(), mesh.vertex_count()) << "ids are for life";
    for (VertexId v = 0; v < mesh.vertex_count(); ++v)
      EXPECT_EQ(document.mesh->point(v), mesh.point(v));
    expect_faces_of_the_scan(document);
  }
}

TEST_F(Operations, SharpEdgesThatSurviveADeletionStay) {
  const Document lined = applied(part, {"find_sharp_lines", json::object()});
  ASSERT_GT(line_ids(lined).size(), 0u);
  const Document less = applied(lined, {"delete_faces", {{"box", {-20, -1, -9, 20, 6, 9}}}});
  std::set<EdgeVertices> expected;
  for (const EdgeVertices& pair : sharp_pairs(lined))
    if (const auto e = less.mesh->find_edge(pair[0], pair[1]); e && !less.mesh->is_border_edge(*e))
      expected.insert(pair);
  EXPECT_LT(expected.size(), sharp_pairs(lined).size());
  EXPECT_GT(expected.size(), 0u);
  EXPECT_EQ(sharp_pairs(less), expected);
  EXPECT_EQ(line_ids(less), line_ids(lined)) << "each line lost a part and kept its id";
  EXPECT_EQ(less.next_id, lined.next_id);
  for (const LinePtr& line : less.lines.lines)
    EXPECT_LT(line->length, lined.lines.find(line->id)->length + 1e-9);
}

TEST_F(Operations, VertexLeftWithTwoFansIsSplitIntoACopyAtTheEnd) {
  const Document plate = document_of(noisy_plane(6.0, 1.0, 0.0, 0.0, 1));
  // Two squares that touch in the vertex (3, 3) go, and with them all but two fans round it.
  const Document document = applied(
      plate, {"delete_faces", {{"faces", faces_where(*plate.mesh, [](const Point& p) {
                                  return (p.x() > 2 && p.x() < 3 && p.y() > 2 && p.y() < 3) ||
                                         (p.x() > 3 && p.x() < 4 && p.y() > 3 && p.y() < 4);
                                })}}});
  EXPECT_EQ(document.mesh->vertex_count(), plate.mesh->vertex_count() + 1);
  for (VertexId v = 0; v < plate.mesh->vertex_count(); ++v)
    EXPECT_EQ(document.mesh->point(v), plate.mesh->point(v));
  const Point& copy = document.mesh->point(static_cast<VertexId>(plate.mesh->vertex_count()));
  EXPECT_EQ(copy, Point(3.0, 3.0, 0.0));
  expect_faces_of_the_scan(document);
}

TEST_F(Operations, DeletingTwiceStillKnowsTheScan) {
  Document document = applied(part, {"delete_faces", {{"box", {-20, -1, -9, 20, 6, 9}}}});
  document = applied(document, {"delete_faces", {{"components_under", 100}}});
  expect_faces_of_the_scan(document);
  // Deleted already: no longer a face of the part.
  EXPECT_FALSE(apply(document, {"delete_faces", {{"faces", {part.mesh->triangles().back()}}}}));
}

TEST_F(Operations, LabelsAreCarriedToTheFacesOfTheScan) {
  Document document = applied(part, {"delete_faces", {{"box", {-20, -1, -9, 20, 6, 9}}}});
  document = applied(document, {"find_sharp_lines", json::object()});
  document = applied(document, {"find_partitions", {{"intervals", {{0, nullptr}}}}});
  const std::vector<std::uint32_t> labels = labels_on_scan(document);
  ASSERT_EQ(labels.size(), part.mesh->face_count());
  std::size_t assigned = 0;
  for (FaceId f = 0; f < labels.size(); ++f) {
    const auto now = document.mesh->find_face(part.mesh->triangle(f));
    EXPECT_EQ(labels[f], now ? document.partitions.label(*now) : 0u) << "face " << f;
    assigned += labels[f] != 0;
  }
  EXPECT_GT(assigned, 0u);
  EXPECT_LT(assigned, labels.size());
  EXPECT_GT(assigned_share(document), 0.5);
  EXPECT_LE(assigned_share(document), 1.0 + 1e-12);
  EXPECT_EQ(assigned_share(part), 0.0);
}

// ---- flip_orientation ----

TEST_F(Operations, FlipChangesSignsAndNothingElse) {
  const Document before = applied(applied(part, {"find_sharp_lines", json::object()}),
                                  {"find_partitions", json::object()});
  const Document after = applied(before, {"flip_orientation", json::object()});
  EXPECT_EQ(after.scan, before.scan);
  EXPECT_EQ(sharp_pairs(after), sharp_pairs(before));
  ASSERT_EQ(line_ids(after), line_ids(before));
  for (const LinePtr& line : before.lines.lines) {
    EXPECT_EQ(after.lines.find(line->id)->vertices, line->vertices);
    EXPECT_NEAR(after.lines.find(line->id)->mean_angle, -line->mean_angle, 1e-4);
  }
  EXPECT_TRUE(after.partitions.labels == before.partitions.labels);
  for (FaceId f = 0; f < part.mesh->face_count(); ++f)
    EXPECT_EQ(after.mesh->find_face(part.mesh->triangle(f)), f);
  for (VertexId v = 0; v < part.mesh->vertex_count(); ++v) {
    if (part.mesh->is_border(v)) continue;
    EXPECT_NEAR(after.curvatures->h[v], -before.curvatures->h[v], 1e-6);
    EXPECT_NEAR(after.curvatures->kabs[v], before.curvatures->kabs[v], 1e-6);
  }
  EXPECT_NE(hash_of(after), hash_of(before));
  EXPECT_EQ(hash_of(applied(after, {"flip_orientation", json::object()})), hash_of(before));
}

TEST_F(Operations, FlippedPartGivesTheSameLinesAndPartitions) {
  const auto run = [](Document document) {
    document = applied(document, {"find_sharp_lines", {{"angle", 30}}});
    return applied(document, {"find_partitions", {{"intervals", {{0, 0.5}, {0.5, nullptr}}}}});
  };
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    const Document straight = document_of(random_terrain(20, seed));
    const Document flipped = applied(straight, {"flip_orientation", json::object()});
    const Document a = run(straight), b = run(flipped);
    EXPECT_EQ(sharp_pairs(a), sharp_pairs(b)) << "seed " << seed;
    EXPECT_TRUE(a.partitions.labels == b.partitions.labels) << "seed " << seed;
  }
}

TEST_F(Operations, FlippedTwiceGoesOnAsIfNeverFlipped) {
  // Whatever was run before, out of date or not: equal hashes must mean equal futures.
  const Operation flip{"flip_orientation", json::object()};
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    Document document = document_of(random_terrain(20, seed));
    for (const Operation& operation : {Operation{"find_sharp_lines", {{"angle", 20}}},
                                       Operation{"smooth_curvature", {{"passes", 3}}},
                                       Operation{"find_sharp_lines", {{"angle", 60}}},
                                       Operation{"find_partitions", json::object()}})
      document = applied(document, operation);
    const Document twice = applied(applied(document, flip), flip);
    EXPECT_EQ(hash_of(twice), hash_of(document)) << "seed " << seed;
    const Operation next{"find_partitions", {{"intervals", {{0, 0.5}, {0.5, nullptr}}}}};
    EXPECT_EQ(hash_of(applied(twice, next)), hash_of(applied(document, next))) << "seed " << seed;
  }
}

// ---- equality ----

TEST_F(Operations, SameOperationsGiveTheSameHashOnAnyNumberOfThreads) {
  const std::string mould = write_mesh(folder, "mould.ply", sample_mould(2.0));
  const auto run = [&](int threads) {
    const ThreadLimit limit(threads);
    Document document = applied({}, {"open", {{"file", mould}}});
    std::vector<std::string> hashes{hash_of(document)};
    for (const Operation& operation :
         {Operation{"find_sharp_lines", json::object()},
          Operation{"find_partitions", json::object()},
          Operation{"flip_orientation", json::object()},
          Operation{"delete_faces", {{"box", {0, 0, -99, 40, 40, 99}}}},
          Operation{"find_sharp_lines", {{"angle", 35}}},
          Operation{"smooth_curvature", json::object()},
          Operation{"find_partitions", {{"criterion", "ikabs"}}}}) {
      document = applied(document, operation);
      hashes.push_back(hash_of(document));
    }
    hashes.push_back(curves_obj(handed_lines(document)));
    hashes.push_back(curves_obj(handed_boundaries(document)));
    return hashes;
  };
  const std::vector<std::string> one = run(1);
  EXPECT_EQ(run(1), one);
  EXPECT_EQ(run(2), one);
  EXPECT_EQ(run(5), one);
  EXPECT_EQ(std::set(one.begin(), one.end()).size(), one.size()) << "each step changes the hash";
}

TEST_F(Operations, HashTellsDocumentsApart) {
  const Document lined = applied(part, {"find_sharp_lines", json::object()});
  std::set<std::string> hashes{hash_of({}), hash_of(part), hash_of(lined)};
  Document other = lined;
  other.next_id += 1;
  hashes.insert(hash_of(other));
  other = lined;
  other.step("find_sharp_lines")->out_of_date = true;
  hashes.insert(hash_of(other));
  other = lined;
  for (EdgeId e = 0; e < other.mesh->edge_count(); ++e)
    if (other.lines.is_sharp(e)) {
      other.lines.edges.set(e, Origin::drawn);
      break;
    }
  hashes.insert(hash_of(other));
  EXPECT_EQ(hashes.size(), 6u);
  other = lined;
  other.scan_path = "elsewhere.ply";
  EXPECT_EQ(hash_of(other), hash_of(lined)) << "where the file lies does not matter";
}

}  // namespace
}  // namespace arris
