// SPDX-License-Identifier: Apache-2.0
// Handles of the C interface that free themselves, for its tests in C++.
#pragma once

#include <gtest/gtest.h>

#include <memory>
#include <vector>

#include "incise/c/incise.h"

namespace incise_test {

struct FreeEngine {
  void operator()(incise_engine* engine) const { EXPECT_EQ(incise_engine_free(engine), INCISE_OK); }
};
using EngineHandle = std::unique_ptr<incise_engine, FreeEngine>;

struct FreeSimulation {
  void operator()(incise_simulation* simulation) const { EXPECT_EQ(incise_simulation_free(simulation), INCISE_OK); }
};
using SimulationHandle = std::unique_ptr<incise_simulation, FreeSimulation>;

/// A struct of the interface with its size, everything else zero.
template <class T>
T sized() {
  T value{};
  value.size = sizeof value;
  return value;
}

/// The unit cube of 6 n³ tets.
inline EngineHandle cube(std::uint32_t n, const incise_engine_options* options = nullptr) {
  const double low[3] = {0, 0, 0}, high[3] = {1, 1, 1};
  const std::uint32_t cells[3] = {n, n, n};
  incise_engine* engine = nullptr;
  EXPECT_EQ(incise_engine_create_box(low, high, cells, options, &engine), INCISE_OK) << incise_last_error();
  return EngineHandle(engine);
}

inline std::uint64_t hash(const incise_engine* engine) {
  std::uint64_t hash = 0;
  EXPECT_EQ(incise_engine_hash(engine, &hash), INCISE_OK);
  return hash;
}

inline incise_counts counts(const incise_engine* engine) {
  auto counts = sized<incise_counts>();
  EXPECT_EQ(incise_engine_counts(engine, &counts), INCISE_OK);
  return counts;
}

inline void cut_plane(incise_engine* engine, double x, double y, double z, double offset) {
  const double normal[3] = {x, y, z};
  EXPECT_EQ(incise_engine_cut_plane(engine, normal, offset, nullptr), INCISE_OK) << incise_last_error();
}

/// A whole array by slot.
template <class T>
std::vector<T> rows(const incise_engine* engine, std::int32_t which) {
  auto view = sized<incise_view>();
  EXPECT_EQ(incise_engine_view(engine, which, &view), INCISE_OK);
  const T* begin = static_cast<const T*>(view.data);
  return {begin, begin + view.rows * view.stride / sizeof(T)};
}

}  // namespace incise_test
