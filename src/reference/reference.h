// The truth: a path tracer on the CPU (Embree). It shares the scene and the surface model with the GPU renderer, but
// no line of shading code, so that each checks the other.
//
// Light is sorted into the same layers as the renderer's: sun and lamps at the surface that the camera sees, what it
// emits and the background are `direct`; everything that reaches it by way of a scattered ray (light of other
// surfaces, glowing ones and the environment included) is indirect_diffuse or indirect_specular.
#pragma once

#include "base/image_file.h"
#include "scene/scene.h"

#include <cstdint>
#include <functional>
#include <vector>

namespace reflet {

enum class PixelFilter : uint8_t {
    box,     ///< samples all over the pixel
    center,  ///< all samples through the pixel's centre, as a rasterizer sees it
};

/// How diffuse directions are drawn; the picture is the same, the noise is not.
enum class DiffuseSampling : uint8_t { cosine, uniform };

struct ReferenceOptions {
    static constexpr uint32_t unlimited = 0xFFFFFFFF;

    uint32_t bounces = unlimited;  ///< scattered rays of a path; 0: sun and lamps only, each followed to the surface
    uint32_t samples = 64;         ///< per pixel, at least 1
    float noise = 0.0F;            ///< ends earlier where the noise (see ReferencePicture) is under this; 0: never
    PixelFilter filter = PixelFilter::box;
    DiffuseSampling diffuse = DiffuseSampling::cosine;
    bool visibleOnly = false;  ///< a scattered ray brings light only from points that the camera sees
    bool lambertOnly = false;  ///< every material as Lambert of its base colour
    bool lampShadows = true;   ///< false: lamps shine through everything
    uint32_t seed = 0;
    unsigned threads = 0;  ///< 0: one per core. The picture does not depend on it
};

struct ReferenceProgress {
    uint64_t done = 0;   ///< samples of all pixels
    uint64_t total = 0;  ///< the same, if all are needed
    double noise = 0.0;  ///< estimated so far; 0 where nothing is known yet
};

/// All images have the same size. Radiance in W/(m² sr).
struct ReferencePicture {
    FloatImage final;             ///< RGB: direct + indirectDiffuse + indirectSpecular
    FloatImage direct;            ///< RGB
    FloatImage indirectDiffuse;   ///< RGB
    FloatImage indirectSpecular;  ///< RGB
    FloatImage albedo;            ///< RGB: base colour, linear, 0 where there is nothing
    FloatImage normal;            ///< XYZ: world-space shading normal at the pixel's centre, 0 where there is nothing
    FloatImage depth;             ///< Y: metres in front of the camera at the pixel's centre, 0 where there is nothing
    FloatImage sunVisibility;     ///< Y: share of the sun's disk that is not hidden, 1 where there is nothing
    uint32_t samples = 0;         ///< per pixel; of the pixel that has the fewest
    double noise = 0.0;           ///< root of the mean over the pixels of variance of the mean / (luminance² + 0.01):
                                  ///< its square is the relative MSE that another run of the same length would have
                                  ///< against the truth. 0 with less than two samples
    uint64_t rays = 0;            ///< all that were traced, shadow rays included
    double seconds = 0.0;         ///< of tracing, without building the hierarchy
    bool complete = true;         ///< false: `proceed` ended it

    /// Named as `reflet render --aov` names them; first `final` without a name, too, so that every viewer shows it.
    [[nodiscard]] std::vector<ImageLayer> layers() const;
};

/// `proceed` is called now and then from one thread at a time; false ends the work after the first sample of every
/// pixel, with what there is. The same scene, view, size, samples and seed give the same picture.
ReferencePicture traceReference(const Scene& scene, const View& view, uvec2 size, const ReferenceOptions& options,
                                const std::function<bool(const ReferenceProgress&)>& proceed = {});

}  // namespace reflet
