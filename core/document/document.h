#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/json.h"
#include "core/curvature/curvature.h"
#include "core/document/chain.h"
#include "core/document/corrections.h"
#include "core/document/operation.h"
#include "core/mesh/length_unit.h"
#include "core/mesh/mesh.h"
#include "core/mesh/scan.h"
#include "core/partitions/boundaries.h"
#include "core/partitions/partitions.h"
#include "core/partitions/shared_area_tree.h"
#include "core/sharp_lines/lines.h"
#include "core/sharp_lines/sharp_lines.h"
#include "core/simplification/error_zones.h"

namespace arris {

/// A step of figure 2 that has been run: its resolved parameters, and whether an earlier step has
/// changed since.
struct Step {
  nlohmann::json parameters;
  bool out_of_date = false;
  bool operator==(const Step&) const = default;
};

/// What a step of figure 2 that changes the mesh leaves to the next one.
struct Stage {
  MeshPtr mesh;  ///< Null: the step has no output.
  CurvaturesPtr curvatures;
  ErrorZonesPtr zones;                       ///< Null: every vertex is its own zone.
  SharedLineEvidencePtr evidence = nullptr;  ///< Of the mesh; null: nobody has needed it yet.
};

/// The document: an immutable value whose parts are shared between snapshots (document.md, rule 2).
/// Copying it costs a few pointers. Camera, selection and colours are not part of it.
struct Document {
  ScanPtr scan;              ///< Null in the empty document.
  std::string scan_path;     ///< As the user gave it; not part of what makes documents equal.
  MeshPtr mesh;              ///< The one current mesh.
  CurvaturesPtr curvatures;  ///< Of `mesh`; derived, shared.
  ErrorZonesPtr zones;       ///< Of `mesh`; null: nothing was simplified or swapped.
  /// What tells sharp lines on `mesh`; derived, shared, and worked out when it is first needed.
  SharedLineEvidencePtr evidence;
  /// Areas of `mesh` between its lines; derived, shared. Null, or of another mesh: nobody has
  /// needed it yet.
  SharedAreaTreePtr areas = nullptr;
  /// The scan (flipped, cropped), and what each step that leaves a mesh left, in the order of the
  /// chain. Running a step again starts from the last of those before it (document.md, rule 3).
  Stage opened;
  std::array<Stage, chain_steps.size()> outputs;
  /// For each face of opened.mesh its face in scan->mesh; null: the same numbers.
  std::shared_ptr<const std::vector<FaceId>> scan_faces;

  SharpLines lines;
  Partitions partitions;
  /// Borderlines of the lines and partitions; derived, shared. Null in the empty document.
  std::shared_ptr<const Boundaries> boundaries;
  /// What was corrected by hand, in order; done again when lines or partitions are found again.
  std::vector<CorrectionPtr> corrections;
  CurvaturesPtr smoothed;  ///< Output of smooth_curvature; null: not run on this mesh.
  std::array<std::optional<Step>, chain_steps.size()>
      steps;                       ///< As last run, in the chain's order.
  std::uint32_t next_id = 1;       ///< Of the next line or partition; never goes back.
  std::optional<LengthUnit> unit;  ///< As set_unit said; absent: as the scan's file says.

  bool empty() const { return !scan; }
  /// The step of this name as last run; absent for one never run, and for names that are no step.
  const std::optional<Step>& step(StepName name) const;
  std::optional<Step>& step(StepName name) { return steps.at(name.place); }
  const Stage& output(StepName name) const { return outputs.at(name.place); }
  /// Same lines and partitions on the same mesh: the boundaries are the same, too.
  bool is_divided_as(const Document& other) const;
  /// The criterion by which the partitions were found; kabs where they were not.
  Criterion criterion() const;
  /// The method by which the partitions were found; surfaces where they were not.
  PartitionMethod partition_method() const;
  /// The method by which the lines were found; normal_jump where they were not.
  LineMethod line_method() const;
  /// What is shown and what partitions are found by: smoothed where that was run.
  const CurvaturesPtr& shown_curvatures() const { return smoothed ? smoothed : curvatures; }
};

/// A resolved operation and the snapshot it led to.
struct Performed {
  Operation operation;
  Document document;
};

/// The evidence that the document's lines are found and treated by; null where they are found by
/// the walk, or were not found. Works it out where nobody has asked before. Errors: cancelled.
Result<LineEvidencePtr> line_evidence_of(const Document& document, const Context& context = {});

/// What tells how sharp an edge or a vertex of the document's mesh is, by the method its lines are
/// found by: IHe and IKabs, or the normal jump in their place.
CurvaturesPtr line_measures(const Document& document);

/// Content hash of the canonical serialisation: mesh, sharp edges with provenance, lines, labels,
/// partitions, steps and next_id. Two documents are equal where it is.
std::string hash_of(const Document& document);

/// The labels carried to the faces of scan->mesh: one per face, 0 where unassigned or deleted.
///
/// A face of the scan takes the label of the nearest face of the working mesh (by its centre),
/// looked for only among the faces that answer for its vertices, those round the vertices of it
/// that are still there, and their neighbours. So labels cannot leak to a sheet that is near in
/// space but far on the surface; and since the front never crosses a sharp line and the lines are
/// edges of the working mesh, a face takes the label of the side of the line on which its centre
/// lies. Equally near faces: the one whose normal agrees better, then the lower number.
std::vector<std::uint32_t> labels_on_scan(const Document& document);

/// Bytes that `document` holds and `base` does not share (as the history's budget counts them).
std::size_t bytes_beyond(const Document& document, const Document& base);

/// What lengths are told in: as the user said, else as the scan's file says, else unknown.
LengthUnit length_unit_of(const Document& document);

/// Share of the area that belongs to a partition, 0 to 1.
double assigned_share(const Document& document);

}  // namespace arris
