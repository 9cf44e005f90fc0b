// SPDX-License-Identifier: Apache-2.0
// Takes from the middle: what went wrong stands at the beginning of a message, the remedy at its end.
#include "app/text/shortened.h"

namespace incise {
inline namespace v0 {
namespace app {
namespace {

constexpr std::string_view kGap = " ... ";
constexpr std::size_t kEnd = 160;

}  // namespace

std::string shortened(std::string_view text) {
  if (text.size() <= kLongestMessage) return std::string(text);
  const auto is_inside = [&](std::size_t at) { return (static_cast<unsigned char>(text[at]) & 0xC0U) == 0x80U; };
  std::size_t head = kLongestMessage - kEnd - kGap.size(), tail = text.size() - kEnd;
  while (head > 0 && is_inside(head)) --head;
  while (tail < text.size() && is_inside(tail)) ++tail;
  return std::string(text.substr(0, head)).append(kGap).append(text.substr(tail));
}

}  // namespace app
}  // namespace v0
}  // namespace incise
