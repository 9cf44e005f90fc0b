// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "app/view/picture.h"
#include "incise/geom/box.h"

namespace incise {
inline namespace v0 {
namespace render {

/// The box of a body with all that is drawn beside it, so that planes of the view do not cut that off. What is not
/// finite is left out.
[[nodiscard]] Box box_of_all(const app::Picture& picture, const Box& body);

}  // namespace render
}  // namespace v0
}  // namespace incise
