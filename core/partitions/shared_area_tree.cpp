#include "core/partitions/shared_area_tree.h"

#include "core/partitions/area_tree.h"

namespace arris {

Result<AreaTreePtr> SharedAreaTree::get(const SharpLines& lines, const Context& context) const {
  const std::lock_guard lock(working_);
  if (AreaTreePtr known = known_.load(); known && edges_ == lines.edges) return known;
  Result<AreaTree> grown = grow_area_tree(*mesh_, lines, {}, context);
  if (!grown) return tl::unexpected<Error>(grown.error());
  auto tree = std::make_shared<const AreaTree>(std::move(*grown));
  edges_ = lines.edges;
  known_.store(tree);
  return tree;
}

std::size_t SharedAreaTree::bytes() const {
  const AreaTreePtr known = known_.load();
  return sizeof *this + (known ? known->bytes() : 0);
}

}  // namespace arris
