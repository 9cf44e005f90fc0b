// SPDX-License-Identifier: Apache-2.0
// Which tet of a lattice belongs to which label.
#pragma once

#include <cstdint>

#include "image/label_field.h"
#include "image/labelled_tets.h"

namespace incise {
inline namespace v0 {
namespace image {

/// Gives each tet the label that it has most of, on up to `threads` threads; then gives tets that stick out of an
/// interface, or into it, to the label that most of their neighbours have, where they have nearly as much of it.
void label_tets(const LabelField& field, unsigned threads, LabelledTets& mesh);

}  // namespace image
}  // namespace v0
}  // namespace incise
