// SPDX-License-Identifier: Apache-2.0
#include "incise/sim/material.h"

#include <gtest/gtest.h>

#include <limits>

namespace incise::material_test {
namespace {

TEST(Material, LameParametersFollowFromYoungAndPoisson) {
  const Material material{1000, 30e3, 0.25, 0, 0};
  EXPECT_DOUBLE_EQ(material.mu(), 12e3);
  EXPECT_DOUBLE_EQ(material.lambda(), 12e3);
}

TEST(Material, RegionsWithoutAnEntryHaveTheFallback) {
  Materials materials;
  materials.by_region.push_back({7, Material{900, 1e3, 0.3, 200, 0}});
  EXPECT_EQ(materials.of(7).density, 900);
  EXPECT_EQ(materials.of(8).density, materials.fallback.density);
  EXPECT_TRUE(check(materials).ok());
}

TEST(Material, NumbersOutOfRangeAreNamed) {
  Materials materials;
  materials.fallback.poisson = 0.5;
  EXPECT_NE(check(materials).error().message.find("Poisson"), std::string::npos);
  materials.fallback = {};
  materials.by_region.push_back({3, Material{std::numeric_limits<double>::quiet_NaN(), 1e3, 0.3, 0, 0}});
  EXPECT_NE(check(materials).error().message.find("region 3: the density"), std::string::npos);
  materials.by_region.clear();
  materials.fallback.stiffening = -1;
  EXPECT_NE(check(materials).error().message.find("stiffening"), std::string::npos);
  materials.fallback = {};
  materials.fallback.rupture = 0.6;
  EXPECT_NE(check(materials).error().message.find("rupture"), std::string::npos);
  materials.fallback = {};
  materials.fallback.fibre_young = 1e4;
  EXPECT_NE(check(materials).error().message.find("fibres need a direction"), std::string::npos);
  materials.fallback.fibre_young = -1;
  EXPECT_NE(check(materials).error().message.find("what fibres add"), std::string::npos);
  materials.fallback = {};
  materials.fallback.prony[1] = {0.5, 0};
  EXPECT_NE(check(materials).error().message.find("must relax within"), std::string::npos);
  materials.fallback.prony[1] = {-0.5, 1};
  EXPECT_NE(check(materials).error().message.find("share of a Prony term"), std::string::npos);
  materials.fallback = {};
  materials.by_region = {{3, {}}, {3, {}}};
  EXPECT_NE(check(materials).error().message.find("twice"), std::string::npos);
}

}  // namespace
}  // namespace incise::material_test
