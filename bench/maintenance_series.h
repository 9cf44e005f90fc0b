// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "maintenance_cases.h"
#include "maintenance_figures.h"

namespace incise::bench {

/// The worst L/r against the time spent on maintenance, for cuts A, B and C of Kuhn cubes: printed, and written to
/// maintenance_anytime.csv. Appends lines of acceptance.
void study_anytime(const Settings& settings, const std::vector<Cube>& cubes, std::vector<Acceptance>& lines);

/// Fifty cuts of one mesh, three times: printed in part, written cut by cut to maintenance_repeated.csv. One path again
/// and again; patches of a third of the cube's width in 48000 tets, and in 3072. Appends lines of acceptance.
void study_repeated(const Settings& settings, std::vector<Acceptance>& lines);

}  // namespace incise::bench
