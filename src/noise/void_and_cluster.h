// Blue-noise masks by void-and-cluster (Ulichney, The Void-and-Cluster Method for Dither Array Generation, 1993), in
// space and time (Wolfe et al., Spatiotemporal Blue Noise Masks, EGSR 2022).
#pragma once

#include <cstdint>
#include <vector>

namespace reflet {

/// Ranks for a torus of side · side · slices cells, x fastest, slices last: within each slice, 0 to side² - 1, each
/// once. The cells below any threshold are evenly spread over their slice, and over time at their pixel. Deterministic.
/// side and slices: at least 2.
std::vector<uint32_t> voidAndClusterRanks(uint32_t side, uint32_t slices, uint32_t seed);

}  // namespace reflet
