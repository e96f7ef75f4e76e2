// Builds the tree of emissive triangles, and chooses by it.
#include "reference/light_tree.h"

#include <algorithm>
#include <cmath>

namespace reflet {

// All directions within an angle of the axis.
struct LightTree::Cone {
    vec3 axis{0.0F, 0.0F, 1.0F};
    float spread = pi;
};

namespace {

float sineOf(float cosine) {
    return std::sqrt(std::max(1.0F - cosine * cosine, 0.0F));
}

// Cosine of max(a - b, 0), of two angles between 0 and pi.
float cosineOfDifference(float cosA, float cosB) {
    return cosA >= cosB ? 1.0F : cosA * cosB + sineOf(cosA) * sineOf(cosB);
}

}  // namespace

LightTree::Cone LightTree::around(Cone a, Cone b) {
    if (a.spread < b.spread) {
        std::swap(a, b);
    }
    const float between = std::acos(std::clamp(glm::dot(a.axis, b.axis), -1.0F, 1.0F));
    if (between + b.spread <= a.spread) {
        return a;
    }
    const float spread = 0.5F * (a.spread + between + b.spread);
    const float sine = std::sin(between);
    if (spread >= pi || sine < 1e-4F) {
        return between < 1.0F ? Cone{a.axis, std::min(spread, pi)} : Cone{};
    }
    const float turn = spread - a.spread;
    return {glm::normalize((a.axis * std::sin(between - turn) + b.axis * std::sin(turn)) / sine), spread};
}

class LightTree::Builder {
public:
    Builder(LightTree& tree, std::span<const TriangleLight> lights) : tree_(tree), lights_(lights) {
        for (uint32_t i = 0; i < lights.size(); ++i) {
            if (lights[i].power > 0.0F) {
                order_.push_back(i);
            }
        }
        tree_.leaf_.assign(lights.size(), noLeaf);
        if (!order_.empty()) {
            tree_.nodes_.reserve(2 * order_.size() - 1);
            tree_.nodes_.emplace_back();
            build(0, order_, 0);
        }
    }

private:
    struct Bounds {
        vec3 low{std::numeric_limits<float>::max()};
        vec3 high{std::numeric_limits<float>::lowest()};
        Cone cone;
    };

    [[nodiscard]] vec3 middle(uint32_t light) const {
        const TriangleLight& t = lights_[light];
        return (glm::min(glm::min(t.a, t.b), t.c) + glm::max(glm::max(t.a, t.b), t.c)) * 0.5F;
    }

    // Past this depth halves have equal numbers of triangles, so that it stays bounded.
    static constexpr uint32_t mostBySpace = 40;

    // Splits in the middle of the longest side of what the triangles' middles cover.
    std::span<uint32_t> firstHalf(std::span<uint32_t> order, uint32_t depth) const {
        vec3 low(std::numeric_limits<float>::max());
        vec3 high(std::numeric_limits<float>::lowest());
        for (const uint32_t i : order) {
            low = glm::min(low, middle(i));
            high = glm::max(high, middle(i));
        }
        const vec3 size = high - low;
        const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
        const float cut = 0.5F * (low[axis] + high[axis]);
        // Not of std::ranges: Clang 14 does not compile libstdc++'s.
        const auto split =
            std::partition(order.begin(), order.end(), [&](uint32_t i) { return middle(i)[axis] < cut; });
        const auto count = static_cast<size_t>(split - order.begin());
        if (count > 0 && count < order.size() && depth < mostBySpace) {
            return order.first(count);
        }
        const auto half = order.begin() + static_cast<ptrdiff_t>(order.size() / 2);
        std::ranges::nth_element(order, half, {}, [&](uint32_t i) { return middle(i)[axis]; });
        return order.first(order.size() / 2);
    }

    Bounds leaf(uint32_t node, uint32_t light) {
        const TriangleLight& t = lights_[light];
        Node& n = tree_.nodes_[node];
        n.light = light;
        n.power = t.power;
        n.bothSides = t.bothSides;
        tree_.leaf_[light] = node;
        return {glm::min(glm::min(t.a, t.b), t.c), glm::max(glm::max(t.a, t.b), t.c), {t.normal, 0.0F}};
    }

    Bounds inner(uint32_t node, std::span<uint32_t> order, uint32_t depth) {
        const auto first = static_cast<uint32_t>(tree_.nodes_.size());
        tree_.nodes_.resize(tree_.nodes_.size() + 2);
        tree_.nodes_[node].first = first;
        tree_.nodes_[first].parent = tree_.nodes_[first + 1].parent = node;
        const std::span<uint32_t> half = firstHalf(order, depth);
        const Bounds a = build(first, half, depth + 1);
        Bounds b = build(first + 1, order.subspan(half.size()), depth + 1);
        const Node& one = tree_.nodes_[first];
        const Node& other = tree_.nodes_[first + 1];
        if (other.bothSides && glm::dot(a.cone.axis, b.cone.axis) < 0.0F) {
            b.cone.axis = -b.cone.axis;
        }
        tree_.nodes_[node].power = one.power + other.power;
        tree_.nodes_[node].bothSides = one.bothSides || other.bothSides;
        return {glm::min(a.low, b.low), glm::max(a.high, b.high), around(a.cone, b.cone)};
    }

    Bounds build(uint32_t node, std::span<uint32_t> order, uint32_t depth) {
        const Bounds bounds = order.size() == 1 ? leaf(node, order[0]) : inner(node, order, depth);
        Node& n = tree_.nodes_[node];
        n.center = 0.5F * (bounds.low + bounds.high);
        n.radius = 0.5F * glm::length(bounds.high - bounds.low);
        n.axis = bounds.cone.axis;
        n.cosSpread = std::cos(bounds.cone.spread);
        return bounds;
    }

    LightTree& tree_;
    std::span<const TriangleLight> lights_;
    std::vector<uint32_t> order_;
};

LightTree::LightTree(std::span<const TriangleLight> lights) {
    Builder(*this, lights);
}

float LightTree::estimate(const Node& node, const LightReceiver& at) {
    const vec3 offset = node.center - at.position;
    const float square = glm::dot(offset, offset);
    const float nearest = node.radius * node.radius;
    if (square <= nearest) {
        return nearest > 0.0F ? node.power / nearest : 0.0F;
    }
    const float distance = std::sqrt(square);
    const vec3 toLight = offset / distance;
    const float cosBall = sineOf(node.radius / distance);  // half of the angle that the sphere covers
    const float facing = -glm::dot(node.axis, toLight);
    const float emitted =
        cosineOfDifference(cosineOfDifference(node.bothSides ? std::abs(facing) : facing, node.cosSpread), cosBall);
    const float received = at.normal == vec3(0.0F) ? 1.0F : cosineOfDifference(glm::dot(at.normal, toLight), cosBall);
    return emitted > 0.0F && received > 0.0F ? node.power * emitted * received / square : 0.0F;
}

std::optional<LightTree::Choice> LightTree::draw(const LightReceiver& at, float u) const {
    if (nodes_.empty()) {
        return {};
    }
    Choice choice{.light = 0, .probability = 1.0F};
    uint32_t node = 0;
    while (nodes_[node].first != 0) {
        const uint32_t first = nodes_[node].first;
        const float one = estimate(nodes_[first], at);
        const float sum = one + estimate(nodes_[first + 1], at);
        if (!(sum > 0.0F)) {
            return {};
        }
        const float share = one / sum;
        const bool second = u >= share;
        u = std::min(second ? (u - share) / (1.0F - share) : u / share, 0x1.fffffep-1F);
        choice.probability *= second ? 1.0F - share : share;
        node = first + (second ? 1 : 0);
    }
    choice.light = nodes_[node].light;
    return choice;
}

float LightTree::probability(const LightReceiver& at, uint32_t light) const {
    uint32_t node = leaf_[light];
    if (node == noLeaf) {
        return 0.0F;
    }
    float product = 1.0F;
    while (node != 0) {
        const uint32_t first = nodes_[nodes_[node].parent].first;
        const float one = estimate(nodes_[first], at);
        const float sum = one + estimate(nodes_[first + 1], at);
        if (!(sum > 0.0F)) {
            return 0.0F;
        }
        const float share = one / sum;
        product *= node == first ? share : 1.0F - share;
        node = nodes_[node].parent;
    }
    return product;
}

}  // namespace reflet
