// SPDX-License-Identifier: Apache-2.0
// Texts of people in pages and in XML.
#include "app/text/markup.h"

#include <gtest/gtest.h>

namespace incise::test::markup_test {
namespace {

TEST(Markup, cannot_open_an_element_nor_end_an_attribute) {
  EXPECT_EQ(app::as_markup("\"a\" <b> & c's"), "&quot;a&quot; &lt;b&gt; &amp; c's");
  EXPECT_EQ(app::as_markup(""), "");
}

}  // namespace
}  // namespace incise::test::markup_test
