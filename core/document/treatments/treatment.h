#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/document/document.h"
#include "core/document/parameters.h"
#include "core/partitions/interactive_treatments.h"
#include "core/sharp_lines/interactive_treatments.h"

/// What the treatments by hand have in common (sections 6.3.2 and 7.2): their targets, how they
/// change a document, and how they are done again as corrections.
namespace arris {

/// Lines, partitions and boundaries of one mesh while treatments change them, at a cost that
/// follows the changes.
struct Ground {
  const Mesh& mesh;
  const Curvatures& curvatures;       ///< Of the mesh: boundaries are told by these.
  const std::vector<double>& values;  ///< The criterion: partitions are found by these.
  SharpLines lines;
  Partitions partitions;
  Boundaries boundaries;
  std::uint32_t next_id = 1;
  Criterion criterion = Criterion::kabs;
  LineEvidencePtr evidence;  ///< By which lines are found; null: the curvatures, by the walk.
  Context context{};         ///< Of the work: asked by treatments that may take long.

  /// How sharp edges and vertices are, by the method of the lines.
  const Curvatures& measures() const { return evidence ? *evidence->measures : curvatures; }
  PartitionGround partition_ground() const { return {mesh, values, lines, partitions}; }
  void change(const LineChanges& changes);
  void change(const FaceLabels& labels, const std::vector<Partition>& fresh = {});
  /// What was tried out on a copy is taken over.
  void change_to(Ground&& tried);
  /// Partitions that sharp edges on these paths have parted fall into their pieces: what lies
  /// beside the paths and is no longer joined to the largest piece gets an id of its own.
  void part_along(const std::vector<std::vector<VertexId>>& paths);
  /// A new partition without faces yet; takes an id.
  Partition new_partition(const CurvatureInterval& interval);
};

/// The ground of a document.
Ground ground_of(const Document& document);

/// When a treatment is done: for the first time, or again on lines or partitions found anew.
enum class Round { first, after_lines, after_partitions };

/// What a treatment did: a note where it had to adapt to what it found. Errors of a treatment leave
/// the ground as it was.
struct TreatmentOutcome {
  std::string adapted;  ///< Empty: just as meant.
};

/// Performs a treatment for the first time, and keeps it as a correction.
Result<Document> apply_treatment(const OperationKind& treatment, const Document& document,
                                 const nlohmann::json& parameters, const Context& context);

/// Does the corrections of a document again, in order, on lines (or partitions) found anew.
std::vector<CorrectionPtr> correct(const std::vector<CorrectionPtr>& corrections, Ground& ground,
                                   Round round, bool switched_on);

/// Lines found again on the current mesh with these parameters of find_sharp_lines (absent: none
/// are found, only drawn), and corrected.
Result<void> refind_lines(Document& document, const std::optional<nlohmann::json>& parameters,
                          const Context& context);
/// The same for partitions.
Result<void> refind_partitions(Document& document, const std::optional<nlohmann::json>& parameters,
                               const Context& context);

/// Parameters of find_sharp_lines or recompute_lines as options; what is not there stays default.
SharpLineOptions line_options_of(const nlohmann::json& parameters);
/// Bounds of the angle, convexity and candidates, as find_sharp_lines and recompute_lines take
/// them.
std::vector<Parameter> kinds_of_edges();

// Targets. A line is named by "line" or in "lines", a partition by "partition" or in "partitions",
// with anchors in "path", "paths", "anchor" and "anchors".

using Path = std::vector<VertexId>;

Path path_of(const nlohmann::json& json);
std::vector<Path> paths_of(const nlohmann::json& json);
std::vector<std::uint32_t> ids_of(const nlohmann::json& json);
BrushedRegion region_of(const nlohmann::json& json);
CurvatureInterval interval_of(const nlohmann::json& json);

/// "0 to 0.236", "above 0.236".
std::string interval_in_words(const CurvatureInterval& interval);
/// What a treatment of the elements under `one` ("line") or `many` ("lines") is of: "line 3", "24
/// lines"; `many` alone where none is named.
std::string targets_in_words(const nlohmann::json& parameters, const std::string& one,
                             const std::string& many);

/// The line meant: by its id at first, later by its anchor; `outcome` says where it is not the
/// same.
Result<LinePtr> find_line(const Ground& ground, std::uint32_t id, const Path& anchor, Round round,
                          TreatmentOutcome& outcome);
Result<PartitionPtr> find_partition(const Ground& ground, std::uint32_t id, const Triangle& anchor,
                                    Round round, TreatmentOutcome& outcome);

/// Deletes along paths. Again: with what is found near them, but for `spared` edges.
void remove_paths(Ground& ground, const std::vector<Path>& paths, const nlohmann::json& spared,
                  Round round);
/// The parameter of what a deletion has to spare, and its value for one along `paths`: what is
/// given, or what is near now.
Parameter spared_parameter();
void complete_spared(ParameterReader& reader, const std::vector<Path>& paths);
/// Edges found near `paths` and not on them, as vertex pairs: what a deletion has to spare.
nlohmann::json spared_near(const Document& document, const std::vector<Path>& paths);

}  // namespace arris
