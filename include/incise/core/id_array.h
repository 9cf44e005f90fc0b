// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "incise/core/grow_array.h"
#include "incise/core/id.h"

namespace incise {
inline namespace v0 {

/// A growing array that only its own id type indexes.
template <class IdType, class T>
class IdArray : public GrowArray<T> {
 public:
  /// The element of a slot, which must be below `size()`.
  T& operator[](IdType id) { return GrowArray<T>::operator[](id.value); }
  /// The same, to read.
  const T& operator[](IdType id) const { return GrowArray<T>::operator[](id.value); }
};

}  // namespace v0
}  // namespace incise
