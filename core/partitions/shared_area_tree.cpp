#include "core/partitions/shared_area_tree.h"

#include "core/partitions/area_tree.h"

namespace arris {

Result<AreaTreePtr> SharedAreaTree::get(const SharpLines& lines, const Context& context) const {
  const std::lock_guard lock(working_);
  if (tree_ && edges_ == lines.edges) return tree_;
  Result<AreaTree> grown = grow_area_tree(*mesh_, lines, {}, context);
  if (!grown) return tl::unexpected<Error>(grown.error());
  tree_ = std::make_shared<const AreaTree>(std::move(*grown));
  edges_ = lines.edges;
  return tree_;
}

std::size_t SharedAreaTree::bytes() const {
  const std::lock_guard lock(working_);
  return sizeof *this + (tree_ ? tree_->bytes() : 0);
}

}  // namespace arris
