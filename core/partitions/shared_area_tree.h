#pragma once

#include <atomic>
#include <memory>
#include <mutex>
#include <utility>

#include "core/base/chunked_array.h"
#include "core/base/context.h"
#include "core/base/result.h"
#include "core/mesh/mesh.h"
#include "core/sharp_lines/lines.h"

namespace arris {

struct AreaTree;
using AreaTreePtr = std::shared_ptr<const AreaTree>;

/// The tree between the lines of a mesh, grown when it is first asked for and again where the lines
/// are others than they were; shared by all snapshots that have this mesh. It follows from mesh and
/// lines, so that it makes no difference who asks first.
class SharedAreaTree {
 public:
  explicit SharedAreaTree(MeshPtr mesh) : mesh_(std::move(mesh)) {}

  const MeshPtr& mesh() const { return mesh_; }
  /// Errors: cancelled.
  Result<AreaTreePtr> get(const SharpLines& lines, const Context& context = {}) const;
  std::size_t bytes() const;  ///< Never waits.

 private:
  MeshPtr mesh_;
  mutable std::mutex working_;
  mutable ChunkedArray<Origin> edges_;  // that known_ was grown between
  mutable std::atomic<AreaTreePtr> known_;
};

using SharedAreaTreePtr = std::shared_ptr<const SharedAreaTree>;

}  // namespace arris
