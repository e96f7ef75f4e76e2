// Blue-noise masks by void-and-cluster (Ulichney, The Void-and-Cluster Method for Dither Array Generation, 1993).
#pragma once

#include <cstdint>
#include <vector>

namespace reflet {

/// Ranks for a torus of side · side cells, x fastest: 0 to side² - 1, each once. For any threshold, the cells below it
/// are evenly spread. Deterministic. side: at least 2.
std::vector<uint32_t> voidAndClusterRanks(uint32_t side, uint32_t seed);

}  // namespace reflet
