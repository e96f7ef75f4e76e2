// Finds the mirrors that reflect the sun.
#include "renderer/reflected_suns.h"

#include "base/color.h"
#include "base/octahedral.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <functional>

namespace reflet {

namespace {

constexpr float leastReflectance = 0.1F;
constexpr float leastFilled = 0.95F;  // of the bounding rectangle
constexpr float leastFacing = 0.02F;  // cosine

vec3 reflectanceAt(const vec3& f0, float cosine) {
    const float m = 1.0F - cosine;
    return f0 + (1.0F - f0) * (m * m * m * m * m);
}

float areaOf(const FlatPiece& piece) {
    return (piece.high.x - piece.low.x) * (piece.high.y - piece.low.y);
}

// Whether both together are a rectangle, too.
bool adjoins(const FlatPiece& a, const FlatPiece& b) {
    const vec2 together = glm::max(a.high, b.high) - glm::min(a.low, b.low);
    return glm::distance(a.plane, b.plane) < 1e-3F + a.tolerance + b.tolerance && a.f0 == b.f0 &&
           a.roughness == b.roughness && areaOf(a) + areaOf(b) > 0.99F * together.x * together.y;
}

void add(std::vector<FlatPiece>& pieces, FlatPiece piece) {
    const auto other = std::ranges::find_if(pieces, [&](const FlatPiece& p) { return adjoins(p, piece); });
    if (other == pieces.end()) {
        pieces.push_back(std::move(piece));
        return;
    }
    other->low = glm::min(other->low, piece.low);
    other->high = glm::max(other->high, piece.high);
}

LampParams lampOf(const FlatPiece& piece, const vec3& toSun, const vec3& irradiance, float angularDiameter) {
    const vec3 n(piece.plane);
    const vec2 half = 0.5F * (piece.high - piece.low);
    const vec2 middle = 0.5F * (piece.high + piece.low);
    const vec3 centre = n * -piece.plane.w + piece.right * middle.x + piece.up * middle.y;
    const float away = reflectedSunFar * 2.0F * glm::length(half);
    LampParams lamp{};
    lamp.type = lampReflected;
    lamp.toLamp = glm::reflect(toSun, n);
    lamp.position = centre + away * lamp.toLamp;
    lamp.inverseRange = -1.0F / away;
    lamp.intensity = irradiance * reflectanceAt(piece.f0, glm::dot(toSun, n));
    lamp.spotScale = std::bit_cast<float>(glm::packHalf2x16(half));
    lamp.spotOffset = std::bit_cast<float>(packUnitVector(n));
    // A rough mirror widens the sun's image by its lobe.
    lamp.radius = away * (std::tan(0.5F * angularDiameter) + 2.0F * piece.roughness * piece.roughness);
    lamp.cosOuter = std::cos(std::atan((1.1F * glm::length(half) + lamp.radius) / away));
    lamp.shadow = noLampShadow;
    return lamp;
}

}  // namespace

std::vector<LampParams> reflectedSuns(std::span<const FlatPiece> pieces, const vec3& toSun, const vec3& irradiance,
                                      float angularDiameter, uint32_t count) {
    std::vector<FlatPiece> mirrors;
    for (const FlatPiece& piece : pieces) {
        const float facing = glm::dot(vec3(piece.plane), toSun);
        const FlatPiece lit = facing < 0.0F && piece.doubleSided ? turnedOver(piece) : piece;
        const float cosine = glm::dot(vec3(lit.plane), toSun);
        if (piece.roughness <= smoothestMirror && !piece.bumpy && cosine > leastFacing &&
            piece.area >= leastFilled * areaOf(piece) &&
            luminance(reflectanceAt(piece.f0, cosine)) >= leastReflectance) {
            add(mirrors, lit);
        }
    }
    const auto reflected = [&](const FlatPiece& piece) {
        const float cosine = glm::dot(vec3(piece.plane), toSun);
        return areaOf(piece) * cosine * luminance(reflectanceAt(piece.f0, cosine));
    };
    std::ranges::stable_sort(mirrors, std::greater<>(), reflected);
    mirrors.resize(std::min<size_t>(mirrors.size(), count));
    std::vector<LampParams> lamps;
    if (irradiance != vec3(0.0F)) {
        std::ranges::transform(mirrors, std::back_inserter(lamps), [&](const FlatPiece& piece) {
            return lampOf(piece, toSun, irradiance, angularDiameter);
        });
    }
    return lamps;
}

}  // namespace reflet
