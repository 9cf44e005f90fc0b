// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace incise::test {

/// How long a campaign of moving blades goes on; the first limit that is reached ends it.
struct MotionLimits {
  std::uint64_t first_seed = 1;
  std::uint64_t cases = 0, strokes = 0;  ///< 0: no such limit
  double seconds = 0;                    ///< 0: no such limit; 100 cases where there is none at all
};

/// The real meshes that can be read and are not too large to be cut very often.
std::vector<std::filesystem::path> sound_models();

// The bodies are `models`, or made ones where there are none.

/// The random cases of one seed after the other. Returns what the program should.
int soak_motions(const MotionLimits& limits, const std::vector<std::filesystem::path>& models);
/// The cases of a file of seeds, with made bodies: one per line, anything after `#` is comment.
int soak_seeds(const std::string& file);
/// Says what the cases are.
int describe_seeds(const std::vector<std::uint64_t>& seeds, const std::vector<std::filesystem::path>& models);
/// Makes failing cases small, prints what is left of them, and writes their strokes to seed-N.json.
int minimise_seeds(const std::vector<std::uint64_t>& seeds, const std::vector<std::filesystem::path>& models);

}  // namespace incise::test
