// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "incise/improve/options.h"
#include "incise/mesh/transaction.h"
#include "paper/held.h"

namespace incise {
inline namespace v0 {
namespace paper {

/// Face Swapping: turns two tets at a face into three around an edge, three into two, or two whose outer faces lie in
/// one plane into two others, where the worst of them gets better by that.
///
/// One pass over `tets` in the order given; those that swaps made are not looked at again. Boundaries and borders
/// between regions stay in place: two boundary faces of one surface in one plane (`kFlatSine`) may become two others
/// there. Inside the body the tets behind the plane turn with those before it: four into four. The worst tet of the
/// mesh never gets worse. Cost: O(tets). **Source:** Paper §3.3, Figure 8. The quality of a configuration is read as
/// that of its worst tet, since flat tets are what swapping is to remove; an average over two tets and one over three
/// do not compare.
MaintainStatistics swap_faces(Transaction& transaction, const std::vector<TetId>& tets, const Held& held = {});

}  // namespace paper
}  // namespace v0
}  // namespace incise
