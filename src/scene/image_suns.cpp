// Finds suns in environment images.
#include "scene/image_suns.h"

#include "base/color.h"
#include "scene/environment.h"

#include <algorithm>
#include <cmath>

namespace reflet {
namespace {

using glm::dvec3;

constexpr double contrast = 12.0;          // to the mean radiance of what is left: how bright rays may find a texel
constexpr double leastShare = 1.0 / 64.0;  // of all light
constexpr double largestRadius = 4.0 * glm::pi<double>() / 180.0;
constexpr int mostRounds = 8;

struct Texel {
    uint32_t x;
    uint32_t y;
};

/// Texels that hang together.
struct Cluster {
    uint32_t id = 0;
    std::vector<Texel> texels;
    dvec3 axis{0.0};  ///< unit, toward its middle
};

class Finder {
public:
    explicit Finder(const FloatImage& image)
        : image_(image), luminance_(size_t(image.width) * image.height), owners_(luminance_.size(), 0) {
        for (size_t i = 0; i < luminance_.size(); ++i) {
            luminance_[i] = luminance(vec3(image.data[3 * i], image.data[3 * i + 1], image.data[3 * i + 2]));
        }
    }

    ImageSuns find();

private:
    [[nodiscard]] size_t indexOf(Texel t) const { return size_t(t.y) * image_.width + t.x; }
    [[nodiscard]] dvec3 radiance(Texel t) const {
        const float* values = &image_.data[3 * indexOf(t)];
        return {values[0], values[1], values[2]};
    }
    [[nodiscard]] dvec3 direction(Texel t) const {
        return environmentDirection((vec2(t.x, t.y) + 0.5F) / vec2(image_.width, image_.height), 0.0F);
    }
    [[nodiscard]] double solidAngle(uint32_t row) const;
    [[nodiscard]] double flux() const;
    template <typename Visit>
    void visitNeighbours(Texel t, const Visit& visit) const;
    [[nodiscard]] Cluster grow(Texel seed, double threshold, std::vector<uint8_t>& seen) const;
    [[nodiscard]] bool isCompact(const Cluster& cluster) const;
    bool extend(double threshold);
    [[nodiscard]] dvec3 surroundings(const Cluster& cluster) const;
    [[nodiscard]] ImageSun sunOf(const Cluster& cluster, const dvec3& around) const;

    const FloatImage& image_;
    std::vector<float> luminance_;
    std::vector<uint32_t> owners_;  ///< Cluster::id; 0: none
    std::vector<Cluster> clusters_;
    double rest_ = 0.0;  ///< flux of what no cluster has
    uint32_t lastId_ = 0;
};

double Finder::solidAngle(uint32_t row) const {
    const auto edge = [&](uint32_t i) { return std::cos(glm::pi<double>() * i / image_.height); };
    return 2.0 * glm::pi<double>() / image_.width * (edge(row) - edge(row + 1));
}

// Luminance of the image, integrated over all directions.
double Finder::flux() const {
    double sum = 0.0;
    for (uint32_t y = 0; y < image_.height; ++y) {
        double row = 0.0;
        for (size_t i = indexOf({0, y}); i < indexOf({0, y + 1}); ++i) {
            row += double(luminance_[i]);
        }
        sum += row * solidAngle(y);
    }
    return sum;
}

// The eight around a texel; across the left and right edge, and across the poles.
template <typename Visit>
void Finder::visitNeighbours(Texel t, const Visit& visit) const {
    const auto width = static_cast<int>(image_.width);
    const auto height = static_cast<int>(image_.height);
    for (int i = 0; i < 9; ++i) {
        int y = static_cast<int>(t.y) + i / 3 - 1;
        const bool overPole = y < 0 || y >= height;
        y = std::clamp(y, 0, height - 1);
        const int x = static_cast<int>(t.x) + i % 3 - 1 + (overPole ? width / 2 : 0);
        visit(Texel{static_cast<uint32_t>((x + width) % width), static_cast<uint32_t>(y)});
    }
}

// All texels above the threshold that hang together with the seed.
Cluster Finder::grow(Texel seed, double threshold, std::vector<uint8_t>& seen) const {
    Cluster cluster{.texels = {seed}};
    dvec3 middle(0.0);
    seen[indexOf(seed)] = 1;
    for (size_t next = 0; next < cluster.texels.size(); ++next) {
        const Texel t = cluster.texels[next];
        middle += solidAngle(t.y) * double(luminance_[indexOf(t)]) * direction(t);
        visitNeighbours(t, [&](Texel other) {
            const size_t i = indexOf(other);
            if (seen[i] == 0 && luminance_[i] > threshold) {
                seen[i] = 1;
                cluster.texels.push_back(other);
            }
        });
    }
    cluster.axis = glm::normalize(middle);
    return cluster;
}

bool Finder::isCompact(const Cluster& cluster) const {
    return std::ranges::all_of(cluster.texels, [&](Texel t) {
        const double half = 0.5 * std::sqrt(solidAngle(t.y));
        return glm::dot(direction(t), cluster.axis) >= std::cos(largestRadius - std::min(half, largestRadius));
    });
}

// Clusters with a lower threshold: larger, and more. One that would not be compact stays as it was. Returns whether any
// grew.
bool Finder::extend(double threshold) {
    std::vector<uint8_t> seen(luminance_.size(), 0);
    const uint32_t before = lastId_;
    for (uint32_t i = 0; i < luminance_.size(); ++i) {
        if (!(luminance_[i] > threshold) || seen[i] != 0) {
            continue;
        }
        Cluster cluster = grow({i % image_.width, i / image_.width}, threshold, seen);
        const bool grows = std::ranges::any_of(cluster.texels, [&](Texel t) { return owners_[indexOf(t)] == 0; });
        if (grows && isCompact(cluster)) {
            cluster.id = ++lastId_;
            for (const Texel t : cluster.texels) {
                uint32_t& owner = owners_[indexOf(t)];
                rest_ -= owner == 0 ? solidAngle(t.y) * double(luminance_[indexOf(t)]) : 0.0;
                owner = cluster.id;
            }
            clusters_.push_back(std::move(cluster));
        }
    }
    std::erase_if(clusters_, [&](const Cluster& c) { return owners_[indexOf(c.texels[0])] != c.id; });
    return lastId_ > before;
}

// Mean radiance of the texels next to the cluster.
dvec3 Finder::surroundings(const Cluster& cluster) const {
    dvec3 sum(0.0);
    double weight = 0.0;
    for (const Texel t : cluster.texels) {
        visitNeighbours(t, [&](Texel other) {
            if (owners_[indexOf(other)] == 0) {
                sum += solidAngle(other.y) * radiance(other);
                weight += solidAngle(other.y);
            }
        });
    }
    return weight > 0.0 ? sum / weight : dvec3(0.0);
}

ImageSun Finder::sunOf(const Cluster& cluster, const dvec3& around) const {
    dvec3 irradiance(0.0);
    dvec3 middle(0.0);
    double spread = 0.0;
    double total = 0.0;
    for (const Texel t : cluster.texels) {
        const dvec3 light = solidAngle(t.y) * glm::max(radiance(t) - around, dvec3(0.0));
        const double weight = light.x + light.y + light.z;
        const double angle = std::acos(std::clamp(glm::dot(direction(t), cluster.axis), -1.0, 1.0));
        irradiance += light;
        middle += weight * direction(t);
        // A square has a sixth of its area as mean square of the distance from its middle, a disk half the square of
        // its radius.
        spread += weight * (angle * angle + solidAngle(t.y) / 6.0);
        total += weight;
    }
    ImageSun sun;
    sun.irradiance = irradiance;
    sun.toSun = total > 0.0 ? glm::normalize(middle) : cluster.axis;
    sun.angularDiameter = total > 0.0 ? static_cast<float>(2.0 * std::sqrt(2.0 * spread / total)) : 0.0F;
    return sun;
}

ImageSuns Finder::find() {
    const double all = flux();
    rest_ = all;
    for (int round = 0; round < mostRounds && rest_ > 1e-9 * all; ++round) {
        if (!extend(contrast * rest_ / (4.0 * glm::pi<double>()))) {
            break;
        }
    }
    ImageSuns found;
    FloatImage without;
    for (const Cluster& cluster : clusters_) {
        const dvec3 around = surroundings(cluster);
        const ImageSun sun = sunOf(cluster, around);
        if (luminance(sun.irradiance) < leastShare * all) {
            continue;
        }
        found.suns.push_back(sun);
        if (without.data.empty()) {
            without = image_;
        }
        for (const Texel t : cluster.texels) {
            const vec3 replaced(glm::min(radiance(t), around));
            std::copy_n(&replaced.x, 3, &without.data[3 * indexOf(t)]);
        }
    }
    std::ranges::stable_sort(found.suns, std::greater<>(), [](const ImageSun& s) { return luminance(s.irradiance); });
    if (!found.suns.empty()) {
        found.image = std::make_shared<FloatImage>(std::move(without));
    }
    return found;
}

// About +Y, as Environment::rotation turns.
vec3 turned(const vec3& direction, float rotation) {
    return environmentDirection(environmentUv(direction, 0.0F), rotation);
}

Lamp directionalLamp(const Sun& sun) {
    Lamp lamp;
    lamp.type = Lamp::Type::directional;
    lamp.direction = sun.direction;
    lamp.intensity = sun.irradiance;
    lamp.radius = std::tan(0.5F * sun.angularDiameter);
    return lamp;
}

}  // namespace

ImageSuns findImageSuns(const FloatImage& image) {
    return Finder(image).find();
}

View withImageSuns(View view, const ImageSuns& found, std::vector<Lamp>& others) {
    if (!found.image) {
        return view;
    }
    std::vector<Sun> suns;
    if (view.sun.irradiance != vec3(0.0F)) {
        suns.push_back(view.sun);
    }
    for (const ImageSun& sun : found.suns) {
        suns.push_back({.direction = -turned(sun.toSun, view.environment.rotation),
                        .irradiance = view.environment.intensity * sun.irradiance,
                        .angularDiameter = sun.angularDiameter});
    }
    const auto strongest =
        std::ranges::max_element(suns, std::less<>(), [](const Sun& s) { return luminance(s.irradiance); });
    view.sun = *strongest;
    suns.erase(strongest);
    std::ranges::transform(suns, std::back_inserter(others), directionalLamp);
    view.environment.image = found.image;
    return view;
}

}  // namespace reflet
