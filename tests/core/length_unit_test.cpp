// What lengths are told in: guessed with doubt, said by the file or the user, kept, and without any
// influence on results.

#include "core/mesh/length_unit.h"

#include <algorithm>

#include <gtest/gtest.h>

#include "core/curvature/fields.h"
#include "core/document/curve_files.h"
#include "core/document/document.h"
#include "core/document/document_bytes.h"
#include "core/document/history.h"
#include "core/document/journal.h"
#include "core/guidance/worklist.h"
#include "core/mesh/scan.h"
#include "core/partitions/partition_surfaces.h"
#include "tests/support/documents.h"
#include "tests/support/packing.h"

namespace arris {
namespace {

using namespace arris::testing;
using nlohmann::json;
using enum LengthUnit;

Operation unit_is(const std::string& unit) { return {"set_unit", {{"unit", unit}}}; }

TEST(LengthUnits, AreKnownByEveryUsualName) {
  for (const auto& [name, unit] : {std::pair{"mm", millimetre},
                                   {"MM", millimetre},
                                   {"millimeter", millimetre},
                                   {"Millimetres", millimetre},
                                   {"cm", centimetre},
                                   {"m", metre},
                                   {"meter", metre},
                                   {"in", inch},
                                   {"inches", inch},
                                   {"Inch", inch},
                                   {"ft", foot},
                                   {"feet", foot},
                                   {"um", micrometre},
                                   {"µm", micrometre},
                                   {"micron", micrometre},
                                   {"unknown", unknown},
                                   {"none", unknown}})
    EXPECT_EQ(find_length_unit(name), unit) << name;
  for (const char* name : {"", "furlong", "mmm", "mm ", "°"})
    EXPECT_FALSE(find_length_unit(name)) << name;
  for (const LengthUnitInfo& info : length_unit_table()) {
    EXPECT_EQ(&info_of(info.unit), &info);
    EXPECT_EQ(find_length_unit(info.key), info.unit);
    EXPECT_EQ(find_length_unit(info.name), info.unit);
  }
}

TEST(LengthUnits, NothingIsSaidWhereTheUnitIsUnknown) {
  EXPECT_EQ(unit_text(millimetre), "mm");
  EXPECT_EQ(unit_text(inch, 2), "in²");
  EXPECT_EQ(unit_text(metre, -1), "1/m");
  EXPECT_EQ(unit_text(millimetre, -2), "1/mm²");
  EXPECT_EQ(with_unit("0.3", centimetre), "0.3 cm");
  EXPECT_EQ(length_in_words(3.25, micrometre), "3.25 µm");
  EXPECT_EQ(area_in_words(1234.5, millimetre), "1234 mm²");
  for (const int power : {-2, -1, 1, 2}) EXPECT_EQ(unit_text(unknown, power), "");
  EXPECT_EQ(with_unit("0.3", unknown), "0.3");
  EXPECT_EQ(length_in_words(3.25, unknown), "3.25 units");
  EXPECT_EQ(area_in_words(12.0, unknown), "12 units²");
  EXPECT_EQ(unit_of(Field::kabs, millimetre), "1/mm²");
  EXPECT_EQ(unit_of(Field::h, inch), "1/in");
  EXPECT_EQ(unit_of(Field::kabs, unknown), "");
  EXPECT_EQ(unit_of(Field::ihe, unknown), "°");
  EXPECT_EQ(unit_of(Field::ikabs, millimetre), "");
}

// A part that is scanned is some centimetres or decimetres large; most files are in millimetres.
TEST(LengthUnits, TheSizeTellsWhatIsLikelyAndWhereThereIsDoubt) {
  EXPECT_EQ(likely_units({180.0, 330.0, 30.0}), std::vector{millimetre}) << "no doubt";
  EXPECT_EQ(likely_units({900.0, 400.0, 300.0}), std::vector{millimetre});
  EXPECT_EQ(likely_units({0.18, 0.33, 0.03}).front(), metre);
  const std::vector<LengthUnit> small = likely_units({5.0, 4.0, 3.0});
  EXPECT_GT(small.size(), 1u);
  EXPECT_TRUE(std::ranges::count(small, millimetre) && std::ranges::count(small, inch))
      << "a small part in millimetres, or one as large as a hand in inches";
  EXPECT_EQ(likely_units({150000.0, 90000.0, 40000.0}).front(), micrometre);
  // The order of the axes does not matter, and the likeliest never is one that makes a part of the
  // size of a street or a grain where another makes one that fits on a table.
  for (double extent = 1e-3; extent < 1e6; extent *= 1.7) {
    const std::vector<LengthUnit> units = likely_units({0.1 * extent, extent, 0.4 * extent});
    EXPECT_EQ(units, likely_units({extent, 0.4 * extent, 0.1 * extent}));
    ASSERT_FALSE(units.empty());
    const double millimetres = extent * info_of(units[0]).millimetres;
    if (extent > 0.01 && extent < 3e5) {
      EXPECT_GT(millimetres, 2.0) << extent;
      EXPECT_LT(millimetres, 30000.0) << extent;
    }
  }
  for (const double none : {0.0, -1.0, HUGE_VAL, std::nan("")})
    EXPECT_FALSE(likely_units({none, none, none}).empty());
  EXPECT_EQ(size_in_words({0.18, 0.33, 0.03}), "0.18 × 0.33 × 0.03");
}

class UnitOfAPart : public ::testing::Test {
 protected:
  TempFolder folder;
  std::string part = write_mesh(folder, "part.ply", sample_mould(3.0));
  static void run_ok(History& history, const Operation& operation) {
    const Result<void> done = history.run(operation);
    ASSERT_TRUE(done) << done.error().message;
  }
  /// Opened and segmented; told first what it is in, unless `unit` is empty.
  History segmented(const std::string& unit) const {
    History history;
    run_ok(history, {"open", {{"file", part}}});
    if (!unit.empty()) run_ok(history, unit_is(unit));
    run_ok(history, {"find_sharp_lines", json::object()});
    run_ok(history, {"find_partitions", json::object()});
    return history;
  }
  static std::string without_comment(const std::string& obj) { return obj.substr(obj.find('\n')); }
};

TEST_F(UnitOfAPart, IsWhatTheFileSaysElseUnknown) {
  EXPECT_EQ(length_unit_of(Document()), unknown);
  History history;
  run_ok(history, {"open", {{"file", part}}});
  EXPECT_EQ(length_unit_of(history.current()), unknown) << "PLY has no units";
  const std::string triangle =
      "<object id=\"1\"><mesh><vertices><vertex x=\"0\" y=\"0\" z=\"0\"/><vertex x=\"1\" y=\"0\" "
      "z=\"0\"/><vertex x=\"0\" y=\"1\" z=\"0\"/></vertices><triangles><triangle v1=\"0\" v2=\"1\" "
      "v3=\"2\"/></triangles></mesh></object>";
  for (const auto& [attribute, unit] : {std::pair{"", millimetre},
                                        {"unit=\"inch\"", inch},
                                        {"unit=\"micron\"", micrometre},
                                        {"unit=\"centimeter\"", centimetre},
                                        {"unit=\"foot\"", foot},
                                        {"unit=\"meter\"", metre}}) {
    const std::string file = folder.write(
        "part.3mf",
        zipped({{"3D/3dmodel.model", model_3mf(attribute, triangle, "<item objectid=\"1\"/>")}}));
    run_ok(history, {"open", {{"file", file}}});
    EXPECT_EQ(length_unit_of(history.current()), unit) << attribute;
  }
  run_ok(history, unit_is("in"));
  EXPECT_EQ(length_unit_of(history.current()), inch) << "files may be wrong";
  run_ok(history, {"open", {{"file", part}}});
  EXPECT_EQ(length_unit_of(history.current()), unknown) << "another scan is another matter";
}

TEST_F(UnitOfAPart, IsAnOperationThatIsUndoneAndKept) {
  History history = segmented("inches");
  EXPECT_EQ(history.entries()[1].operation.parameters["unit"], "in");
  EXPECT_EQ(describe(history.entries()[1].operation), "Unit inches");
  EXPECT_EQ(length_unit_of(history.current()), inch);
  ASSERT_TRUE(history.travel(1));
  EXPECT_EQ(length_unit_of(history.current()), unknown);
  ASSERT_TRUE(history.travel(4));
  const Result<void> again = history.run(unit_is("in"));
  ASSERT_FALSE(again);
  EXPECT_TRUE(again.error().nothing_to_do);
  EXPECT_FALSE(history.run(unit_is("furlong")));
  EXPECT_NE(history.run(unit_is("")).error().message.find("um, mm, cm, m, in, ft or unknown"),
            std::string::npos);
  EXPECT_FALSE(History().run(unit_is("mm"))) << "of no part";

  const std::string journal = folder.write("session.jsonl", journal_text(history));
  const Replay replayed = value_of(replay(journal));
  EXPECT_TRUE(replayed.warnings.empty());
  EXPECT_EQ(length_unit_of(replayed.history.current()), inch);
  EXPECT_EQ(journal_text(replayed.history), journal_text(history));
  // So does a snapshot, and one from before there were units.
  const Document opened = value_of(history.document_at(1));
  const std::optional<std::string> bytes = bytes_of(history.current());
  ASSERT_TRUE(bytes);
  const std::optional<Document> restored = document_from(*bytes, opened);
  ASSERT_TRUE(restored);
  EXPECT_EQ(restored->unit, inch);
  EXPECT_EQ(hash_of(*restored), hash_of(history.current()));
  run_ok(history, unit_is("unknown"));
  EXPECT_EQ(length_unit_of(history.current()), unknown);
  EXPECT_EQ(history.current().unit, unknown) << "said, which is not the same as never asked";
}

// Of the time before: a part whose unit nobody told has the hash that it always had.
TEST_F(UnitOfAPart, JournalsFromBeforeThereWereUnitsOpen) {
  History history = segmented("");
  EXPECT_EQ(journal_text(history).find("unit"), std::string::npos);
  Document document = history.current();
  document.unit = std::nullopt;
  EXPECT_EQ(hash_of(document), history.entries().back().hash);
  document.unit = millimetre;
  EXPECT_NE(hash_of(document), history.entries().back().hash);
}

TEST_F(UnitOfAPart, ChangesNothingButHowResultsAreTold) {
  const Document plain = segmented("").current(), inches = segmented("in").current();
  EXPECT_EQ(inches.mesh->hash(), plain.mesh->hash());
  EXPECT_EQ(inches.lines.edges.hash(), plain.lines.edges.hash());
  EXPECT_EQ(inches.partitions.labels.hash(), plain.partitions.labels.hash());
  for (const auto curves : {handed_lines, handed_boundaries})
    EXPECT_EQ(without_comment(curves_obj(curves(inches))),
              without_comment(curves_obj(curves(plain))));
  const std::string in_inches = curves_obj(handed_lines(inches));
  EXPECT_EQ(in_inches.substr(0, in_inches.find('\n')), "# Arris; lengths in inches");
  EXPECT_EQ(curves_obj(handed_lines(plain)).find("mm"), std::string::npos);

  const auto items = value_of(worklist(plain)), same = value_of(worklist(inches));
  ASSERT_EQ(items.size(), same.size());
  std::size_t told = 0;
  for (std::size_t k = 0; k < items.size(); ++k) {
    EXPECT_EQ(items[k].sentence.find(" mm"), std::string::npos) << items[k].sentence;
    told += same[k].sentence.find(" in") != std::string::npos &&
            items[k].sentence.find(" units") != std::string::npos;
  }
  EXPECT_GT(told, 0u);
  for (const PartitionSurface& fit :
       value_of(fit_partition_surfaces(*plain.mesh, plain.lines, plain.partitions)))
    EXPECT_EQ(size_text(fit.surface, unknown).find("mm"), std::string::npos);
}

// PLY has no units; ours say theirs in a comment, and read it again.
TEST_F(UnitOfAPart, WhatArrisWritesKeepsItsUnit) {
  const MeshPtr mesh = mesh_of(sample_mould(3.0));
  ASSERT_TRUE(write_ply(folder.file("inches.ply"), *mesh, {}, inch));
  EXPECT_EQ(value_of(load_scan(folder.file("inches.ply")))->report.unit, "inches");
  ASSERT_TRUE(write_ply(folder.file("none.ply"), *mesh, {}));
  EXPECT_EQ(value_of(load_scan(folder.file("none.ply")))->report.unit, "");
  EXPECT_EQ(folder.read("none.ply").find("lengths in"), std::string::npos);
  const std::string
      begin = "ply\nformat ascii 1.0\n",
      end =
          "element vertex 3\nproperty float x\nproperty float y\nproperty float z\nelement face 1\n"
          "property list uchar int vertex_indices\nend_header\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n";
  for (const char* comment : {"comment lengths in furlongs\n", "comment lengths\n", "comment\n",
                              "comment in millimetres\n", "obj_info lengths in metres\n"})
    EXPECT_EQ(value_of(load_scan(folder.write("odd.ply", begin + comment + end)))->report.unit, "")
        << comment;
}

}  // namespace
}  // namespace arris
