// Void-and-cluster: cells are switched on one after another, each in the largest void between the earlier ones.
//
// The energy of a cell is the sum, over all cells that are on, of a Gaussian of their distance. Energies are integers,
// so switching a cell off exactly undoes switching it on, and results do not depend on rounding.
#include "noise/void_and_cluster.h"

#include <algorithm>
#include <cmath>

namespace reflet {

namespace {

constexpr double sigma = 1.9;         // pixels
constexpr uint32_t largestReach = 8;  // pixels; the energy beyond 4 sigma is negligible
constexpr double energyScale = 1 << 20U;
constexpr uint32_t cellsPerInitialPoint = 10;  // one in this many cells is on in the initial pattern

uint32_t energyAt(double squaredDistance) {
    return static_cast<uint32_t>(std::lround(energyScale * std::exp(-squaredDistance / (2.0 * sigma * sigma))));
}

class Pattern {
public:
    explicit Pattern(uint32_t side);

    /// Switches a cell on, or off.
    void flip(uint32_t cell);
    /// The off cell with the lowest energy.
    uint32_t largestVoid();
    /// The on cell with the highest energy.
    uint32_t tightestCluster();

    [[nodiscard]] uint32_t cellCount() const { return static_cast<uint32_t>(energy_.size()); }
    [[nodiscard]] uint32_t energy(uint32_t cell) const { return energy_[cell]; }
    [[nodiscard]] bool isOn(uint32_t cell) const { return on_[cell] != 0; }

private:
    /// The best energy of each row, and whether it is out of date.
    struct RowBests {
        std::vector<uint32_t> energy;
        std::vector<uint8_t> stale;
    };

    template <class Key, class Better>
    uint32_t bestCell(RowBests& bests, const Key& key, const Better& better);

    uint32_t side_;
    uint32_t reach_;
    std::vector<uint32_t> kernel_;  ///< (2 reach + 1)²
    std::vector<uint32_t> energy_;
    std::vector<uint32_t> on_;  ///< all bits, or none
    RowBests voids_;
    RowBests clusters_;
};

Pattern::Pattern(uint32_t side)
    : side_(side),
      reach_(std::min(largestReach, (side - 1) / 2)),
      energy_(size_t{side} * side, 0),
      on_(energy_.size(), 0) {
    const auto reach = static_cast<int>(reach_);
    for (int y = -reach; y <= reach; ++y) {
        for (int x = -reach; x <= reach; ++x) {
            kernel_.push_back(energyAt(x * x + y * y));
        }
    }
    voids_ = clusters_ = {std::vector<uint32_t>(side), std::vector<uint8_t>(side, 1)};
}

void Pattern::flip(uint32_t cell) {
    on_[cell] = ~on_[cell];
    const uint32_t sign = isOn(cell) ? 1 : ~0U;  // times -1, modulo 2^32
    const uint32_t width = 2 * reach_ + 1;
    const uint32_t left = cell % side_ + side_ - reach_;
    const uint32_t top = cell / side_ + side_ - reach_;
    for (uint32_t j = 0; j < width; ++j) {
        const uint32_t row = (top + j) % side_;
        voids_.stale[row] = clusters_.stale[row] = 1;
        const uint32_t* kernel = &kernel_[size_t{j} * width];
        uint32_t* energies = &energy_[size_t{row} * side_];
        for (uint32_t i = 0; i < width; ++i) {
            energies[(left + i) % side_] += sign * kernel[i];
        }
    }
}

// Rescans only rows that have changed: a flip affects few of them.
template <class Key, class Better>
uint32_t Pattern::bestCell(RowBests& bests, const Key& key, const Better& better) {
    size_t bestRow = 0;
    for (size_t row = 0; row < bests.energy.size(); ++row) {
        if (bests.stale[row] != 0) {
            uint32_t best = key(row * side_);
            for (size_t cell = row * side_ + 1; cell < (row + 1) * side_; ++cell) {
                best = better(best, key(cell));
            }
            bests.energy[row] = best;
            bests.stale[row] = 0;
        }
        if (bests.energy[row] != bests.energy[bestRow] &&
            better(bests.energy[row], bests.energy[bestRow]) == bests.energy[row]) {
            bestRow = row;
        }
    }
    size_t cell = bestRow * side_;
    while (key(cell) != bests.energy[bestRow]) {
        ++cell;
    }
    return static_cast<uint32_t>(cell);
}

uint32_t Pattern::largestVoid() {
    return bestCell(
        voids_, [&](size_t cell) { return energy_[cell] | on_[cell]; },
        [](uint32_t a, uint32_t b) { return std::min(a, b); });
}

uint32_t Pattern::tightestCluster() {
    return bestCell(
        clusters_, [&](size_t cell) { return energy_[cell] & on_[cell]; },
        [](uint32_t a, uint32_t b) { return std::max(a, b); });
}

// Own random numbers (constants: Knuth's MMIX), so that the mask does not depend on the standard library.
class Random {
public:
    explicit Random(uint32_t seed) : state_(seed) {}
    uint32_t below(uint32_t count) {
        state_ = state_ * 6364136223846793005U + 1442695040888963407U;
        return static_cast<uint32_t>((state_ >> 32U) * count >> 32U);
    }

private:
    uint64_t state_;
};

// The initial pattern: random cells, moved from the tightest cluster to the largest void until that brings no
// improvement.
Pattern startingPattern(uint32_t side, uint32_t seed, uint32_t& count) {
    Pattern pattern(side);
    Random random(seed);
    count = std::max(1U, pattern.cellCount() / cellsPerInitialPoint);
    for (uint32_t placed = 0; placed < count;) {
        if (const uint32_t cell = random.below(pattern.cellCount()); !pattern.isOn(cell)) {
            pattern.flip(cell);
            ++placed;
        }
    }
    while (true) {
        const uint32_t from = pattern.tightestCluster();
        pattern.flip(from);
        const uint32_t to = pattern.largestVoid();
        if (pattern.energy(to) >= pattern.energy(from)) {
            pattern.flip(from);
            return pattern;
        }
        pattern.flip(to);
    }
}

// All cells in the order in which they are switched on. Ulichney's third phase, which fills the tightest clusters of
// off cells, is the same as the second: on a torus the energies of on and off cells have the same sum everywhere.
std::vector<uint32_t> cellsInOrder(uint32_t side, uint32_t seed) {
    uint32_t count = 0;
    Pattern pattern = startingPattern(side, seed, count);
    std::vector<uint32_t> order(pattern.cellCount());
    Pattern emptied = pattern;
    for (uint32_t i = count; i-- > 0;) {
        order[i] = emptied.tightestCluster();
        emptied.flip(order[i]);
    }
    for (uint32_t i = count; i < order.size(); ++i) {
        order[i] = pattern.largestVoid();
        pattern.flip(order[i]);
    }
    return order;
}

}  // namespace

std::vector<uint32_t> voidAndClusterRanks(uint32_t side, uint32_t seed) {
    std::vector<uint32_t> ranks(size_t{side} * side);
    uint32_t next = 0;
    for (const uint32_t cell : cellsInOrder(side, seed)) {
        ranks[cell] = next++;
    }
    return ranks;
}

}  // namespace reflet
