// Light sampling: the sun, lamps, emissive surfaces and the environment.
#pragma once

#include "reference/bsdf.h"
#include "reference/light_tree.h"
#include "reference/ray_scene.h"

namespace reflet {

/// A sample on a light, without visibility.
struct LightSample {
    vec3 toLight{0.0F};  ///< unit
    float distance = std::numeric_limits<float>::infinity();
    /// Radiance / pdf; sun and lamps: irradiance / probability. To be multiplied by BRDF · cosine.
    vec3 light{0.0F};
    float pdf = 0.0F;  ///< per solid angle; 0 for lights that scattered rays cannot hit (sun, lamps)
    Hit hit;           ///< on an emissive surface
    /// Lamps: offset from the lamp's centre to the point of its disk that shadow rays aim at, perpendicular to toLight
    /// [m].
    vec3 aside{0.0F};
    float clearance = 0.0F;  ///< occluders closer to the lamp's centre cast no shadow [m]
    bool onSurface = false;
};

/// Discrete distribution: samples indices in proportion to their weights.
class Distribution {
public:
    Distribution() = default;
    explicit Distribution(const std::vector<double>& weights);

    [[nodiscard]] bool empty() const { return !(total_ > 0.0); }
    /// u in [0, 1); on return it is remapped to [0, 1) within the index's interval, and can be reused.
    [[nodiscard]] size_t draw(float& u) const;
    [[nodiscard]] float chance(size_t index) const {
        return static_cast<float>((sums_[index] - (index > 0 ? sums_[index - 1] : 0.0)) / total_);
    }

private:
    std::vector<double> sums_;  ///< running sums of the weights
    double total_ = 0.0;
};

class Lights {
public:
    Lights(const RayScene& rays, const View& view);

    [[nodiscard]] bool hasSun() const { return sunIrradiance_ != vec3(0.0F); }
    [[nodiscard]] bool hasLamps() const { return !lamps_.empty(); }
    [[nodiscard]] bool hasSampledEmitters() const { return !tree_.empty() || environmentChance_ > 0.0F; }

    /// Samples the sun's disk. The irradiance is that of a surface that faces the sampled point, scaled so that a
    /// surface that faces the sun's centre receives the sun's irradiance from the whole disk.
    [[nodiscard]] LightSample drawSun(const vec2& u) const;
    /// Selects a lamp in proportion to its light at the point, and samples its disk for the shadow ray; light and
    /// direction are those of the centre.
    [[nodiscard]] LightSample drawLamp(const SurfacePoint& point, float choice, const vec2& u) const;
    /// Samples an emissive surface or the environment image; light 0 if none of it arrives.
    [[nodiscard]] LightSample drawEmitter(const SurfacePoint& point, float choice, const vec2& u) const;

    [[nodiscard]] vec3 environment(const vec3& direction) const;
    /// Pdfs of drawEmitter for hits of scattered rays, for multiple importance sampling.
    [[nodiscard]] float environmentPdf(const vec3& direction) const;
    [[nodiscard]] float emitterPdf(const LightReceiver& from, const SurfacePoint& emitter) const;

    /// The receiver that drawEmitter samples for.
    [[nodiscard]] static LightReceiver receiver(const SurfacePoint& point);

private:
    void collectTriangles();
    void prepareEnvironment();
    [[nodiscard]] LightSample drawTriangle(const SurfacePoint& point, float choice, const vec2& u) const;
    // chance: probability of the triangle.
    [[nodiscard]] float trianglePdf(const vec3& from, const SurfacePoint& emitter, float chance) const;
    [[nodiscard]] LightSample drawEnvironment(float choice, const vec2& u) const;

    const RayScene& rays_;
    mat3 sunFrame_{1.0F};  ///< the last column points to the sun's centre
    vec3 sunIrradiance_;
    float sunSine_;            ///< sine of the sun's angular radius
    std::vector<Lamp> lamps_;  ///< with the view's radius
    Environment environment_;

    struct EmissiveTriangle {
        uint32_t instance = 0;
        uint32_t triangle = 0;
        float area = 0.0F;
    };
    std::vector<EmissiveTriangle> emissive_;
    std::vector<std::vector<uint32_t>> emissiveIndex_;  ///< by instance (empty: not emissive) and triangle
    LightTree tree_;                                    ///< over emissive_
    Distribution texels_;                               ///< over the texels of the environment's image
    float environmentChance_ = 0.0F;                    ///< probability that drawEmitter chooses the environment image
};

}  // namespace reflet
