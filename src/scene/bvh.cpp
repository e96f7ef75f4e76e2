// Builds the BVH top-down, with binned splits by the surface area heuristic (SAH).
#include "scene/bvh.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <optional>

namespace reflet {

namespace {

constexpr uint32_t binCount = 16;
constexpr uint32_t nodeCost = 1;          // in triangle tests
constexpr float smallestMargin = 1e-10F;  // metres, for boxes near the origin

// A triangle that is being sorted into a leaf.
struct Item {
    Aabb box;
    uint32_t triangle = 0;

    // Twice the centre: only comparisons matter.
    [[nodiscard]] vec3 center() const { return box.min + box.max; }
};

using Items = std::span<Item>;

float halfArea(const Aabb& box) {
    const vec3 s = box.size();
    return s.x * s.y + s.y * s.z + s.z * s.x;
}

struct Bin {
    Aabb box;
    uint32_t count = 0;

    void add(const Bin& other) {
        box.add(other.box);
        count += other.count;
    }
    [[nodiscard]] float cost() const { return count == 0 ? 0.0F : halfArea(box) * static_cast<float>(count); }
};

// Which bin a centre falls into.
struct Binning {
    vec3 start;
    vec3 scale;

    explicit Binning(const Aabb& centers) : start(centers.min) {
        const vec3 size = centers.size();
        for (int axis = 0; axis < 3; ++axis) {
            // Slightly less than the number of bins; 0 where all centres are in one plane.
            scale[axis] = size[axis] > 0.0F ? 0.99999F * static_cast<float>(binCount) / size[axis] : 0.0F;
            scale[axis] = std::isfinite(scale[axis]) ? scale[axis] : 0.0F;
        }
    }
    [[nodiscard]] uint32_t bin(const vec3& center, int axis) const {
        return std::min(static_cast<uint32_t>((center[axis] - start[axis]) * scale[axis]), binCount - 1);
    }
};

// Items of bins below `bin` go to the left.
struct Cut {
    int axis = 0;
    uint32_t bin = 0;
    float cost = 0.0F;
};

std::optional<Cut> bestCutOfAxis(const std::array<Bin, binCount>& bins, int axis) {
    std::array<float, binCount> right{};
    Bin sum;
    for (uint32_t i = binCount - 1; i > 0; --i) {
        sum.add(bins[i]);
        right[i] = sum.count > 0 ? sum.cost() : -1.0F;
    }
    std::optional<Cut> best;
    sum = {};
    for (uint32_t i = 1; i < binCount; ++i) {
        sum.add(bins[i - 1]);
        const float cost = sum.cost() + right[i];
        if (sum.count > 0 && right[i] >= 0.0F && (!best || cost < best->cost)) {
            best = Cut{axis, i, cost};
        }
    }
    return best;
}

std::optional<Cut> bestCut(Items items, const Binning& binning) {
    std::array<std::array<Bin, binCount>, 3> bins;
    for (const Item& item : items) {
        const vec3 center = item.center();
        for (int axis = 0; axis < 3; ++axis) {
            Bin& bin = bins[static_cast<size_t>(axis)][binning.bin(center, axis)];
            bin.box.add(item.box);
            ++bin.count;
        }
    }
    std::optional<Cut> best;
    for (int axis = 0; axis < 3; ++axis) {
        const auto cut = bestCutOfAxis(bins[static_cast<size_t>(axis)], axis);
        if (cut && (!best || cut->cost < best->cost)) {
            best = cut;
        }
    }
    return best;
}

class Builder {
public:
    Builder(const std::vector<SceneTriangle>& triangles, uint32_t maxDepth)
        : triangles_(triangles), maxDepth_(maxDepth) {
        items_.reserve(triangles.size());
        for (const SceneTriangle& t : triangles) {
            Item item;
            item.box.add(t.a);
            item.box.add(t.b);
            item.box.add(t.c);
            item.triangle = static_cast<uint32_t>(items_.size());
            items_.push_back(item);
        }
    }

    Bvh build() {
        Bvh bvh;
        bvh.nodes.reserve(items_.size());
        bvh.nodes.emplace_back();
        bvh.triangles.reserve(items_.size());
        // The root always has two children.
        const Items all = distinct(items_);
        const auto [left, right] = all.size() < 2 ? std::pair(all, all) : cut(all, 0).value();
        fill(bvh, 0, left, right, 1);
        return bvh;
    }

private:
    // Object median along the longest axis of the centres: the fallback where no binned split helps.
    static std::pair<Items, Items> cutInHalves(Items items, const Aabb& centers) {
        const vec3 size = centers.size();
        const int axis = size.x > size.y ? (size.x > size.z ? 0 : 2) : (size.y > size.z ? 1 : 2);
        const size_t half = items.size() / 2;
        std::ranges::nth_element(
            items, items.begin() + static_cast<std::ptrdiff_t>(half), [&](const auto& a, const auto& b) {
                return std::pair(a.center()[axis], a.triangle) < std::pair(b.center()[axis], b.triangle);
            });
        return {items.first(half), items.subspan(half)};
    }

    // Of very many triangles in one place, which nothing can part, the first of those with the same corners: a ray
    // would have to try them all.
    [[nodiscard]] Items distinct(Items items) const {
        const auto isElsewhere = [&](const Item& item) {
            return item.box.min != items.front().box.min || item.box.max != items.front().box.max;
        };
        if (items.size() <= bvhMaxLeaf || std::ranges::any_of(items, isElsewhere)) {
            return items;
        }
        const auto corners = [&](const Item& item) {
            const SceneTriangle& t = triangles_[item.triangle];
            return std::array{t.a.x, t.a.y, t.a.z, t.b.x, t.b.y, t.b.z, t.c.x, t.c.y, t.c.z};
        };
        std::ranges::sort(items, [&](const Item& a, const Item& b) {
            return std::pair(corners(a), a.triangle) < std::pair(corners(b), b.triangle);
        });
        const auto equal = [&](const Item& a, const Item& b) { return corners(a) == corners(b); };
        return items.first(static_cast<size_t>(std::unique(items.begin(), items.end(), equal) - items.begin()));
    }

    // nullopt: a leaf is cheaper. `depth` is that of the node that would hold the two parts.
    [[nodiscard]] std::optional<std::pair<Items, Items>> cut(Items items, uint32_t depth) const {
        Aabb box;
        Aabb centers;
        for (const Item& item : items) {
            box.add(item.box);
            centers.add(item.center());
        }
        const auto levels = static_cast<uint32_t>(std::bit_width(items.size() - 1));  // that halving needs
        const Binning binning(centers);
        const auto best = depth + levels < maxDepth_ ? bestCut(items, binning) : std::nullopt;
        const bool fits = items.size() <= bvhMaxLeaf && depth > 0;
        const float area = halfArea(box);
        const auto count = static_cast<float>(items.size());
        if (fits && (!best || best->cost + static_cast<float>(nodeCost) * area >= count * area)) {
            return std::nullopt;
        }
        if (!best) {
            return cutInHalves(items, centers);
        }
        const auto middle = std::partition(items.begin(), items.end(), [&](const Item& item) {
            return binning.bin(item.center(), best->axis) < best->bin;
        });
        const auto left = static_cast<size_t>(middle - items.begin());
        return std::pair(items.first(left), items.subspan(left));
    }

    void fill(Bvh& bvh, uint32_t node, Items left, Items right, uint32_t depth) {
        BvhNode n{};
        setBox(left, n.leftMin, n.leftMax);
        setBox(right, n.rightMin, n.rightMax);
        n.left = child(bvh, left, depth);
        n.right = child(bvh, right, depth);
        bvh.nodes[node] = n;
    }

    // Slightly enlarged, so that a ray that grazes a side does not miss the box by a rounding error.
    static void setBox(Items items, vec3& min, vec3& max) {
        Aabb box;
        for (const Item& item : items) {
            box.add(item.box);
        }
        if (items.empty()) {
            box.add(vec3(0.0F));
        }
        min = box.min - glm::max(glm::abs(box.min) * 0x1p-22F, vec3(smallestMargin));
        max = box.max + glm::max(glm::abs(box.max) * 0x1p-22F, vec3(smallestMargin));
    }

    uint32_t child(Bvh& bvh, Items items, uint32_t depth) {
        items = distinct(items);
        const auto parts = items.empty() ? std::nullopt : cut(items, depth);
        if (!parts) {
            return leaf(bvh, items);
        }
        const auto node = static_cast<uint32_t>(bvh.nodes.size());
        bvh.nodes.emplace_back();
        fill(bvh, node, parts->first, parts->second, depth + 1);
        return node;
    }

    uint32_t leaf(Bvh& bvh, Items items) const {
        const auto first = static_cast<uint32_t>(bvh.triangles.size());
        for (const Item& item : items) {
            bvh.triangles.push_back(triangles_[item.triangle]);
        }
        const auto count = std::max(static_cast<uint32_t>(items.size()), 1U);
        if (items.empty()) {
            bvh.triangles.push_back({});  // degenerate: nothing hits it
        }
        return bvhLeaf | ((count - 1) << bvhCountShift) | first;
    }

    const std::vector<SceneTriangle>& triangles_;
    uint32_t maxDepth_;
    std::vector<Item> items_;
};

// Box of a node's whole subtree.
void setBounds(const BvhNode& node, vec3& min, vec3& max) {
    min = glm::min(node.leftMin, node.rightMin);
    max = glm::max(node.leftMax, node.rightMax);
}

// Appends nodes and triangles of `from`.
void append(Bvh& to, const Bvh& from) {
    const auto firstNode = static_cast<uint32_t>(to.nodes.size());
    const auto firstTriangle = static_cast<uint32_t>(to.triangles.size());
    const auto moved = [&](uint32_t child) {
        return child +
               ((child & bvhLeaf) != 0 ? firstTriangle : firstNode);  // a leaf's first triangle has the low bits
    };
    for (BvhNode node : from.nodes) {
        node.left = moved(node.left);
        node.right = moved(node.right);
        to.nodes.push_back(node);
    }
    to.triangles.insert(to.triangles.end(), from.triangles.begin(), from.triangles.end());
}

}  // namespace

Bvh buildBvh(const std::vector<SceneTriangle>& triangles, uint32_t maxDepth) {
    return Builder(triangles, maxDepth).build();
}

Bvh joined(const Bvh& a, const Bvh& b) {
    Bvh both;
    both.nodes.reserve(1 + a.nodes.size() + b.nodes.size());
    both.triangles.reserve(a.triangles.size() + b.triangles.size());
    BvhNode& root = both.nodes.emplace_back();
    setBounds(a.nodes.front(), root.leftMin, root.leftMax);
    setBounds(b.nodes.front(), root.rightMin, root.rightMax);
    root.left = 1;
    root.right = static_cast<uint32_t>(1 + a.nodes.size());
    append(both, a);
    append(both, b);
    return both;
}

}  // namespace reflet
