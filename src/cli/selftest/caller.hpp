#pragma once
// Cases about ray streams by themselves, for comparing libraries.

#include "cli/selftest/case.hpp"

namespace lanecast::selftest {

void test_streams(const Block& block, Tally& tally);
void test_scaled_streams(const Block& block, Tally& tally);
void test_far_scaled_streams(const Block& block, Tally& tally);
void test_started_rays(const Block& block, Tally& tally);
void test_shortened_rays(const Block& block, Tally& tally);
void test_filtered_rays(const Block& block, Tally& tally);

} // namespace lanecast::selftest
