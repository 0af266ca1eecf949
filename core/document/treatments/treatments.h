#pragma once

#include <span>

#include "core/document/operation.h"
#include "core/document/treatments/treatment.h"

/// The treatments by hand, each a row of the operation table that is kept as a correction.
namespace arris {

std::span<const Treatment* const> all_treatments();

extern const Treatment delete_lines_treatment, extend_line_treatment, trim_line_treatment,
    split_line_treatment, merge_lines_treatment, draw_line_treatment, reroute_line_treatment,
    recompute_lines_treatment;
extern const OperationKind delete_lines_operation, extend_line_operation, trim_line_operation,
    split_line_operation, merge_lines_operation, draw_line_operation, reroute_line_operation,
    recompute_lines_operation;

extern const Treatment connect_partitions_treatment, extend_partition_treatment,
    remove_partitions_treatment, remove_small_partitions_treatment, fill_unassigned_treatment,
    restart_partitions_treatment, recompute_partitions_treatment, split_partition_treatment,
    split_to_four_sides_treatment, paint_partition_treatment, smooth_boundaries_treatment;
extern const OperationKind connect_partitions_operation, extend_partition_operation,
    remove_partitions_operation, remove_small_partitions_operation, fill_unassigned_operation,
    restart_partitions_operation, recompute_partitions_operation, split_partition_operation,
    split_to_four_sides_operation, paint_partition_operation, smooth_boundaries_operation;

// Not corrections themselves.
extern const OperationKind lock_operation, lift_correction_operation;

}  // namespace arris
