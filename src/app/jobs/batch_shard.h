// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>

#include "incise/core/result.h"

namespace incise {
inline namespace v0 {
namespace app {

/// Which of a plan's items one worker computes: those whose number modulo `count` is `index`.
struct Shard {
  std::uint32_t index = 0;
  std::uint32_t count = 1;

  [[nodiscard]] bool has(std::uint64_t item) const { return item % count == index; }
};

/// The most shards of one batch.
inline constexpr std::uint32_t kMaxShards = 99'999;

/// "I/N": I from 0 to N - 1, or from 1 to N, where N of N is shard 0; so that either way of counting covers all items
/// once. Errors: kBadArgument for anything else.
[[nodiscard]] Result<Shard> parse_shard(std::string_view text);

/// The shard of a task of a Slurm array job, by the environment; nothing outside of one.
///
/// @param get  the value of an environment variable; nothing where it is not set.
/// Errors: kBadArgument for an array with gaps, whose tasks cannot be told apart.
[[nodiscard]] Result<std::optional<Shard>> slurm_shard(
    const std::function<std::optional<std::string>(const char* name)>& get);

}  // namespace app
}  // namespace v0
}  // namespace incise
