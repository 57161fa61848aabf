// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "broad/page_array.hpp"
#include "broad/wide_tree.hpp"

namespace carom::broad {

/// Sorts items along a Morton curve through their centres, 14 bits an axis; the key stays in
/// bounds[7] and bounds[3] keeps the index.
void sort_by_morton(PageArray<BuildItem>& items);

/// The tree whose splits are those of the curve; boxes are not set. Source: Lauterbach et al. 2009,
/// "Fast BVH construction on GPUs".
void build_sorted(BuildTarget& target);

}  // namespace carom::broad
