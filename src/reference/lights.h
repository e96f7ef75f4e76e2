// What shines, and how a surface point draws a place on it.
#pragma once

#include "reference/bsdf.h"
#include "reference/ray_scene.h"

namespace reflet {

/// Light from one drawn place, were nothing in the way.
struct LightSample {
    vec3 toLight{0.0F};  ///< unit
    float distance = std::numeric_limits<float>::infinity();
    vec3 light{
        0.0F};  ///< radiance / pdf; of the sun and of lamps irradiance / chance: times BRDF · cosine is reflected
    float pdf = 0.0F;  ///< per solid angle; 0 for what scattered rays do not meet (sun, lamps)
    Hit hit;           ///< of a glowing surface
    /// Of lamps: from the centre to the place of the disk that shadow rays go to, across the way to the centre [m].
    vec3 aside{0.0F};
    float clearance = 0.0F;  ///< what is nearer to the lamp's centre casts no shadow [m]
    bool onSurface = false;
};

/// A table of weights from which indices are drawn with chances in proportion.
class Distribution {
public:
    Distribution() = default;
    explicit Distribution(const std::vector<double>& weights);

    [[nodiscard]] bool empty() const { return !(total_ > 0.0); }
    /// u in [0, 1); on return it is the place within the index's own share, as good as new.
    [[nodiscard]] size_t draw(float& u) const;
    [[nodiscard]] float chance(size_t index) const {
        return static_cast<float>((sums_[index] - (index > 0 ? sums_[index - 1] : 0.0)) / total_);
    }

private:
    std::vector<double> sums_;  ///< running
    double total_ = 0.0;
};

class Lights {
public:
    Lights(const RayScene& rays, const View& view);

    [[nodiscard]] bool hasSun() const { return sunIrradiance_ != vec3(0.0F); }
    [[nodiscard]] bool hasLamps() const { return !lamps_.empty(); }
    [[nodiscard]] bool hasSampledEmitters() const { return !triangles_.empty() || environmentChance_ > 0.0F; }

    /// A place on the sun's disk. Irradiance is that of a surface that faces the drawn place, such that one that faces
    /// the sun's centre gets the sun's irradiance from the whole disk.
    [[nodiscard]] LightSample drawSun(const vec2& u) const;
    /// One of the lamps, with a chance in proportion to the light that it sends to the point, and a place on its disk:
    /// light and direction are those of the centre.
    [[nodiscard]] LightSample drawLamp(const SurfacePoint& point, float choice, const vec2& u) const;
    /// A place on a glowing surface or in the environment's image; light 0 where nothing of it arrives.
    [[nodiscard]] LightSample drawEmitter(const SurfacePoint& point, float choice, const vec2& u) const;

    [[nodiscard]] vec3 environment(const vec3& direction) const;
    /// Densities with which drawEmitter finds what a scattered ray has met.
    [[nodiscard]] float environmentPdf(const vec3& direction) const;
    [[nodiscard]] float emitterPdf(const vec3& from, const SurfacePoint& emitter) const;

private:
    void collectTriangles();
    void prepareEnvironment();
    [[nodiscard]] LightSample drawTriangle(const SurfacePoint& point, float choice, const vec2& u) const;
    [[nodiscard]] LightSample drawEnvironment(float choice, const vec2& u) const;

    const RayScene& rays_;
    mat3 sunFrame_{1.0F};  ///< the last column points to the sun's centre
    vec3 sunIrradiance_;
    float sunSine_;            ///< of half its angular diameter
    std::vector<Lamp> lamps_;  ///< with the radius that the view gives them
    Environment environment_;

    struct GlowingTriangle {
        uint32_t instance = 0;
        uint32_t triangle = 0;
        float area = 0.0F;
    };
    std::vector<GlowingTriangle> glowing_;
    std::vector<std::vector<uint32_t>> glowingIndex_;  ///< by instance (empty: does not glow) and triangle
    Distribution triangles_;
    Distribution texels_;             ///< of the environment's image
    float environmentChance_ = 0.0F;  ///< of drawEmitter to choose the environment's image
};

}  // namespace reflet
