// SPDX-License-Identifier: Apache-2.0
#include "render/headless_context.h"

#include <gtest/gtest.h>

#include <thread>

#include "pictures.h"

using incise::render::HeadlessContext;

TEST(HeadlessContext, names_its_renderer) {
  const auto context = HeadlessContext::create();
  if (!context.ok()) GTEST_SKIP() << context.error().message;
  EXPECT_FALSE(context->renderer_name().empty());
  EXPECT_EQ(context->is_software(), incise::render::is_software_renderer(context->renderer_name()));
}

TEST(HeadlessContext, knows_software_by_name) {
  EXPECT_TRUE(incise::render::is_software_renderer("llvmpipe (LLVM 15.0.6, 256 bits)"));
  EXPECT_TRUE(incise::render::is_software_renderer("Google SwiftShader"));
  EXPECT_FALSE(incise::render::is_software_renderer("AMD Radeon RX 6600"));
  EXPECT_FALSE(incise::render::is_software_renderer(""));
}

TEST(HeadlessContext, error_names_packages) {
  const auto context = HeadlessContext::create();
  if (context.ok()) GTEST_SKIP() << "there is a context here";
  EXPECT_EQ(context.error().code, incise::ErrorCode::kUnsupported);
  EXPECT_NE(context.error().message.find("libegl1"), std::string::npos) << context.error().message;
}

TEST(HeadlessContext, several_live_side_by_side_and_move) {
  auto first = HeadlessContext::create();
  if (!first.ok()) GTEST_SKIP() << first.error().message;
  {
    auto second = HeadlessContext::create();
    ASSERT_TRUE(second.ok());
    HeadlessContext moved = std::move(second).value();
    EXPECT_TRUE(moved.make_current().ok());
  }
  EXPECT_TRUE(first->make_current().ok());
}

TEST(HeadlessContext, another_thread_is_refused_while_one_has_it) {
  auto context = HeadlessContext::create();
  if (!context.ok()) GTEST_SKIP() << context.error().message;
  bool was_taken = true;
  std::thread([&] { was_taken = context->make_current().ok(); }).join();
  EXPECT_FALSE(was_taken);
}

TEST(Renderer, is_refused_without_samples_in_range) {
  const auto context = HeadlessContext::create();
  if (!context.ok()) GTEST_SKIP() << context.error().message;
  const auto renderer = incise::render::Renderer::create(1000);
  ASSERT_FALSE(renderer.ok());
  EXPECT_EQ(renderer.error().code, incise::ErrorCode::kBadArgument);
}
