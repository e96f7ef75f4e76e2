// The reference (ground truth): a path tracer on the CPU (Embree). It shares the scene and the surface model with the
// GPU renderer, but no shading code, so that each validates the other.
//
// Light is split into the same layers as in the renderer. `direct`: light of sun and lamps at the visible surface, its
// emission, and the background. indirect_diffuse, indirect_specular: all light that reaches the surface by a scattered
// ray (from other surfaces, including emissive ones, and from the environment).
#pragma once

#include "base/image_file.h"
#include "scene/scene.h"

#include <cstdint>
#include <functional>
#include <vector>

namespace reflet {

class RayScene;

enum class PixelFilter : uint8_t {
    box,     ///< samples over the whole pixel
    center,  ///< all samples through the pixel's centre, as in rasterization
};

/// Sampling of diffuse directions: it affects noise, but not the expected result.
enum class DiffuseSampling : uint8_t { cosine, uniform };

struct ReferenceOptions {
    static constexpr uint32_t unlimited = 0xFFFFFFFF;

    uint32_t bounces = unlimited;  ///< scattered rays per path, except those through glass; 0: direct light only
    uint32_t samples = 64;         ///< samples per pixel, at least 1
    uint32_t firstSample = 0;  ///< start in the pixels' sample sequences; to add independent samples by further calls
    float noise = 0.0F;        ///< stops early once the noise (see ReferencePicture) is below this; 0: never
    PixelFilter filter = PixelFilter::box;
    DiffuseSampling diffuse = DiffuseSampling::cosine;
    bool visibleOnly = false;       ///< scattered rays carry light only from points that the camera sees
    bool lambertOnly = false;       ///< replaces every material by Lambert diffuse with its base colour
    bool lampShadows = true;        ///< false: lamps are not occluded
    bool ambientOcclusion = false;  ///< traces a ray per sample for ReferencePicture::ambientOcclusion
    float aoRadius = 1.0F;          ///< metres; occluders farther away do not count
    float aoFalloff = 0.0F;         ///< outer share of the radius over which occluders fade out, 0 to 1
    bool pinhole = false;           ///< ignores the camera's lens
    /// Maximum luminance of a sample's indirect light [W/(m² sr)]; brighter samples are scaled down to it. Removes
    /// fireflies, and darkens the image where they would contribute. 0: off.
    float clamp = 0.0F;
    uint32_t seed = 0;
    unsigned threads = 0;  ///< 0: one per core; does not affect the result
};

struct ReferenceProgress {
    uint64_t done = 0;   ///< samples so far, over all pixels
    uint64_t total = 0;  ///< samples if it does not stop early
    double noise = 0.0;  ///< current estimate; 0 if unknown
};

/// The final image and its layers (AOVs), all of the same size. Radiance in W/(m² sr).
struct ReferencePicture {
    FloatImage final;             ///< RGB: direct + indirectDiffuse + indirectSpecular
    FloatImage direct;            ///< RGB
    FloatImage indirectDiffuse;   ///< RGB
    FloatImage indirectSpecular;  ///< RGB
    FloatImage albedo;            ///< RGB: base colour, linear, 0 in the background
    FloatImage normal;            ///< XYZ: world-space shading normal at the pixel's centre, 0 in the background
    FloatImage depth;             ///< Y: metres in front of the camera at the pixel's centre, 0 in the background
    FloatImage sunVisibility;     ///< Y: visible fraction of the sun's disk, 1 in the background
    FloatImage ambientOcclusion;  ///< Y: cosine-weighted share of unoccluded directions; with visibleOnly, only
                                  ///< surfaces that the camera sees occlude; 1 in the background; empty unless traced
    FloatImage coverage;          ///< Y: share of the pixel's samples that see a surface; not in layers()
    uint32_t samples = 0;         ///< samples per pixel (the minimum)
    double noise = 0.0;           ///< root of the mean over pixels of variance of the mean / (luminance² + floor): its
                                  ///< square estimates the relative MSE of this image against a converged one. 0 with
                                  ///< less than two samples
    uint64_t rays = 0;            ///< number of traced rays, including shadow rays
    double seconds = 0.0;         ///< tracing time, without building the BVH
    bool complete = true;         ///< false: stopped by `proceed`

    /// Named as by `reflet render --aov`; preceded by an unnamed copy of `final`, which every viewer shows.
    [[nodiscard]] std::vector<ImageLayer> layers() const;
};

/// `proceed` is called periodically, from one thread at a time; when it returns false, rendering stops as soon as every
/// pixel has a sample. The result is deterministic for the same scene, view, size, samples and seed.
ReferencePicture traceReference(const Scene& scene, const View& view, uvec2 size, const ReferenceOptions& options,
                                const std::function<bool(const ReferenceProgress&)>& proceed = {});

/// The same with a BVH that the caller has built, to render several images of a scene at one time. view: posed.
ReferencePicture traceReference(const RayScene& rays, const View& view, uvec2 size, const ReferenceOptions& options,
                                const std::function<bool(const ReferenceProgress&)>& proceed = {});

}  // namespace reflet
