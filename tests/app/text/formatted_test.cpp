// SPDX-License-Identifier: Apache-2.0
#include "app/text/formatted.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <limits>
#include <string_view>

namespace formatted_test {
namespace {

using incise::app::formatted;

TEST(Formatted, puts_values_of_all_kinds_in) {
  const std::string name = "cube";
  EXPECT_EQ(formatted("{}", "as it stands: {} \xC3\xA4"), "as it stands: {} \xC3\xA4");
  EXPECT_EQ(formatted("{} {} {} {}", name, std::string_view("of"), 6U, 'x'), "cube of 6 x");
  EXPECT_EQ(formatted("{:05}-{:016x}", 7, std::uint64_t{255}), "00007-00000000000000ff");
  EXPECT_EQ(formatted("{:>9}|{:<4}|", 1.5, true), "      1.5|true|");
}

TEST(Formatted, gives_numbers_as_the_language_does_not_the_country) {
  EXPECT_EQ(formatted("{:.3g} {:.2f} {:.9g}", 1234567.0, 1.005, 1e-9), "1.23e+06 1.00 1e-09");
  EXPECT_EQ(formatted("{} {}", std::numeric_limits<double>::infinity(), std::numeric_limits<double>::max()),
            "inf 1.7976931348623157e+308");
  EXPECT_EQ(formatted("{} {}", 0.1, 0.1F), "0.1 0.1");
}

}  // namespace
}  // namespace formatted_test
