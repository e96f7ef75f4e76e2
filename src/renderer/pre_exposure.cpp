// Estimates how bright a scene is from its lights, without shadows.
#include "renderer/pre_exposure.h"

#include "base/color.h"
#include "base/exposure.h"
#include "scene/sky.h"

#include <algorithm>
#include <cmath>
#include <span>

namespace reflet {

namespace {

// What is brightest is not farther above the estimate than that.
constexpr float contrast = 1.0F / 512.0F;
constexpr float lightShare = 0.5F;  // of the places are darker than what counts as lit
constexpr size_t mostPlaces = 256;

struct MeshArea {
    std::vector<float> until;  ///< sums of the triangles' areas
    [[nodiscard]] float all() const { return until.empty() ? 0.0F : until.back(); }
};

MeshArea areaOf(const Mesh& mesh) {
    MeshArea area;
    float sum = 0.0F;
    for (size_t k = 0; k + 2 < mesh.indices.size(); k += 3) {
        const vec3& a = mesh.positions[mesh.indices[k]];
        sum += 0.5F * glm::length(
                          glm::cross(mesh.positions[mesh.indices[k + 1]] - a, mesh.positions[mesh.indices[k + 2]] - a));
        area.until.push_back(sum);
    }
    return area;
}

vec3 centerOfTriangle(const Mesh& mesh, size_t triangle) {
    const uint32_t* corner = &mesh.indices[3 * triangle];
    return (mesh.positions[corner[0]] + mesh.positions[corner[1]] + mesh.positions[corner[2]]) / 3.0F;
}

float emissionOf(const Material& m) {
    return luminance(m.unlit ? vec3(m.baseColor) : m.emissive);
}

// On a surface that faces the lamp.
float irradianceFrom(const LampParams& lamp, const vec3& at) {
    const float intensity = luminance(lamp.intensity);
    if (lamp.type == lampDirectional) {
        return intensity;
    }
    if (lamp.type == lampReflected) {
        return 0.0F;  // less than the sun itself brings
    }
    const vec3 away = lamp.position - at;
    const float distance = glm::length(away);
    const bool outside = distance * lamp.inverseRange >= 1.0F ||
                         (lamp.type == lampSpot && glm::dot(away, lamp.toLamp) < lamp.cosOuter * distance);
    return outside || distance == 0.0F ? 0.0F : intensity / (distance * distance);
}

}  // namespace

PreExposure::PreExposure(const Scene& scene) {
    std::vector<MeshArea> areas;
    std::ranges::transform(scene.meshes, std::back_inserter(areas), areaOf);
    const size_t each = std::max<size_t>(mostPlaces / std::max<size_t>(scene.instances.size(), 1), 1);
    const size_t step = std::max<size_t>(scene.instances.size() / mostPlaces, 1);
    double area = 0.0;
    double power = 0.0;
    float brightest = 0.0F;
    for (size_t i = 0; i < scene.instances.size(); ++i) {
        const Instance& instance = scene.instances[i];
        const Mesh& mesh = scene.meshes.at(instance.mesh);
        const MeshArea& own = areas[instance.mesh];
        const float scale = std::cbrt(std::abs(glm::determinant(mat3(instance.objectToWorld))));
        const float emission = emissionOf(scene.materials.at(mesh.material));
        area += double(own.all()) * scale * scale;
        power += double(own.all()) * scale * scale * emission;
        brightest = std::max(brightest, emission);
        // What shines is close to a lamp of its own, such as a bulb, and tells nothing of what others receive.
        const bool receives = emission == 0.0F && own.all() > 0.0F && i % step == 0;
        for (size_t n = 0; n < each && receives; ++n) {
            const float place = own.all() * (static_cast<float>(n) + 0.5F) / static_cast<float>(each);
            const auto found = std::ranges::upper_bound(own.until, place) - own.until.begin();
            const auto triangle = std::min<size_t>(static_cast<size_t>(found), own.until.size() - 1);
            places_.emplace_back(instance.objectToWorld * vec4(centerOfTriangle(mesh, triangle), 1.0F));
        }
    }
    // As in a closed white room, where what is emitted spreads over all surfaces.
    emitted_ = area > 0.0 ? std::max(static_cast<float>(power / area), brightest * contrast) : 0.0F;
}

float PreExposure::reflectedFrom(const LampBlock& lamps) const {
    std::vector<float> lit;
    for (const vec3& place : places_) {
        float sum = 0.0F;
        for (const LampParams& lamp : std::span(lamps.lamps, lamps.count)) {
            sum += irradianceFrom(lamp, place);
        }
        lit.push_back(sum / pi);
    }
    if (lit.empty()) {
        return 0.0F;
    }
    std::ranges::sort(lit);
    const auto counted = static_cast<size_t>(lightShare * static_cast<float>(lit.size() - 1));
    return std::max(lit[counted], lit.back() * contrast);
}

float PreExposure::meanOf(const Environment& environment) {
    if (!environment.image) {
        return luminance(environment.radiance);
    }
    if (image_ != environment.image) {
        image_ = environment.image;
        imageMean_ = luminance(meanRadiance(*image_));
    }
    return environment.intensity * imageMean_;
}

float PreExposure::update(const LampBlock& lamps, const View& view) {
    const float radiance = luminance(view.sun.irradiance) / pi + (lamps.count > 0 ? reflectedFrom(lamps) : 0.0F) +
                           meanOf(view.environment) + emitted_;
    value_ = preExposureFor(radiance, value_);
    return value_;
}

}  // namespace reflet
