// SPDX-License-Identifier: Apache-2.0
// The fallback: sequential XPBD. It stays bounded where nothing else does, on the worst slivers and from any start, but
// is far too soft at few iterations.
#pragma once

#include "sim/body/body_state.h"

namespace incise {
inline namespace v0 {
namespace detail {

/// Goes through one substep of `h` seconds: from where inertia and gravity take the awake vertices to where the tets
/// and pulls leave them. Two constraints per tet (Macklin and Müller 2021): |F| with compliance 1/(μ V), and
/// det F − 1 − μ/λ with 1/(λ V). Works in double precision. Cost: O(tets · iterations), about 0.2 µs each.
void project(DeformableBody::State& state, double h);

}  // namespace detail
}  // namespace v0
}  // namespace incise
