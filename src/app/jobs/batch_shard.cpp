// SPDX-License-Identifier: Apache-2.0
// The two ways to count shards differ in the last one alone: N of N, which is taken modulo N.
#include "app/jobs/batch_shard.h"

namespace incise {
inline namespace v0 {
namespace app {
namespace {

constexpr std::size_t kMaxDigits = 9;

std::optional<std::uint32_t> whole_number(std::string_view text) {
  if (text.empty() || text.size() > kMaxDigits) return std::nullopt;
  if (text.find_first_not_of("0123456789") != std::string_view::npos) return std::nullopt;
  return static_cast<std::uint32_t>(std::stoul(std::string(text)));
}

Error bad_array(const std::string& what) {
  return {ErrorCode::kBadArgument,
          "the variables SLURM_ARRAY_TASK_* " + what + "; give the array without gaps, as in --array=0-15, or --shard",
          {}};
}

}  // namespace

Result<Shard> parse_shard(std::string_view text) {
  const std::size_t slash = text.find('/');
  const auto index = whole_number(text.substr(0, slash));
  const auto count = slash == std::string_view::npos ? std::nullopt : whole_number(text.substr(slash + 1));
  if (index && count && *count > 0 && *count <= kMaxShards && *index <= *count) {
    return Shard{*index % *count, *count};
  }
  return Error{ErrorCode::kBadArgument,
               "--shard " + std::string(text) + ": give I/N, N shards from 1 to " + std::to_string(kMaxShards) +
                   " and I from 0 to N - 1 or from 1 to N",
               {}};
}

Result<std::optional<Shard>> slurm_shard(const std::function<std::optional<std::string>(const char* name)>& get) {
  const auto id_text = get("SLURM_ARRAY_TASK_ID");
  if (!id_text) return std::optional<Shard>();
  const auto number = [&](const char* name, const std::string& otherwise) {
    return whole_number(get(name).value_or(otherwise));
  };
  const auto id = whole_number(*id_text);
  const auto low = number("SLURM_ARRAY_TASK_MIN", ""), step = number("SLURM_ARRAY_TASK_STEP", "1");
  const auto high = number("SLURM_ARRAY_TASK_MAX", ""), count = number("SLURM_ARRAY_TASK_COUNT", "");
  if (!id || !low || !high || !step || !count || *id < *low || *id > *high || *step == 0 || *count > kMaxShards) {
    return bad_array("are incomplete");
  }
  if ((*high - *low) / *step + 1 != *count || (*id - *low) % *step != 0) return bad_array("tell of an array with gaps");
  const std::uint32_t index = (*id - *low) / *step;
  return std::optional<Shard>(Shard{index, *count});
}

}  // namespace app
}  // namespace v0
}  // namespace incise
