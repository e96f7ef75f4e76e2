// Traces one path through a position in the image: next-event estimation at every vertex, and multiple importance
// sampling of light and BSDF samples. (Veach, Robust Monte Carlo Methods for Light Transport Simulation, 1997)
#pragma once

#include "reference/camera_rays.h"
#include "reference/lights.h"
#include "reference/reference.h"
#include "reference/sampler.h"
#include "reference/sun_mirrors.h"

namespace reflet {

/// An estimate of each layer from one path.
struct PathSample {
    vec3 direct{0.0F};
    vec3 indirectDiffuse{0.0F};
    vec3 indirectSpecular{0.0F};
    vec3 albedo{0.0F};
    float sunVisibility = 1.0F;
    float ambientVisibility = 1.0F;  ///< visibility along one cosine-distributed ray; 1 unless it is traced
    bool background = false;         ///< the camera sees no surface
    uint32_t rays = 0;               ///< rays traced

    void attenuate(const vec3& share) {
        direct *= share;
        indirectDiffuse *= share;
        indirectSpecular *= share;
    }
};

class PathTracer {
public:
    PathTracer(const RayScene& rays, const View& view, uvec2 size, const ReferenceOptions& options);

    /// place: position in the image, in pixels.
    [[nodiscard]] PathSample trace(const vec2& place, const PixelSampler& random) const;

    /// The surface that the camera sees there through a pinhole; nullopt: the background.
    [[nodiscard]] std::optional<SurfacePoint> firstSurface(const vec2& place) const;
    [[nodiscard]] float depth(const SurfacePoint& point) const { return camera_.depth(point.position); }

private:
    struct Walk;

    [[nodiscard]] std::optional<SurfacePoint> firstSurface(const Ray& ray) const;
    void addLamps(Walk& walk, const Bsdf& bsdf) const;
    void addSunInMirrors(Walk& walk, const Bsdf& bsdf) const;
    void addEmitters(Walk& walk, const Bsdf& bsdf) const;
    /// Returns false if the path ends here. spent: out of bounces, so the path may only continue through glass.
    [[nodiscard]] bool step(Walk& walk, const Bsdf& bsdf, bool spent) const;
    [[nodiscard]] float ambientVisibility(Walk& walk) const;
    [[nodiscard]] bool cameraSees(Walk& walk, const SurfacePoint& point) const;
    /// Share of the sample's light that arrives; only light of the sun and lamps passes through glass.
    [[nodiscard]] vec3 lit(Walk& walk, const SurfacePoint& point, const LightSample& light) const;

    const RayScene& rays_;
    CameraRays camera_;
    Lights lights_;
    SunMirrors mirrors_;
    Environment behind_;  ///< background that the camera sees where there is no surface
    ReferenceOptions options_;
    bool glass_;   ///< any surface of the scene is transmissive
    Media media_;  ///< media that the camera is in
};

}  // namespace reflet
