// Probes of a host: its cube maps, of any size, resampled into the maps that answerProbes reads. Shared by C++ and
// GLSL.
#ifndef REFLET_EFFECTS_IMPORT_PROBES_H
#define REFLET_EFFECTS_IMPORT_PROBES_H

#include "base/shared.h"
#include "effects/cube_map/cube_map.h"
#include "effects/probe/probes.h"

SHARED_BEGIN

struct ImportProbeParams {
    uint firstFace;  // of the cube array: 6 · probe
    float level;     // of the host's cube map
    uint places;     // samples per texel along each side
    uint coverage;   // 1: alpha says what share of a texel is known
};

// Spherical harmonics of irradiance / pi, in the order of sphericalHarmonics().
struct ImportHarmonicsParams {
    vec4 coefficients[irradianceCoefficients];
    uint cube;
};

SHARED_END

#ifdef __cplusplus

#include "gpu/pass_list.h"

#include <array>
#include <optional>
#include <span>

namespace reflet {

/// One probe of a host. Cube maps: views of cubes, in Vulkan's order of faces.
struct HostProbe {
    ProbeParams params;
    gpu::Image radiance;  ///< premultiplied by its alpha if that is coverage
    uint32_t levels = 1;  ///< of `radiance`; several: level l is filtered by the GGX lobe of roughness l / (levels - 1)
    bool hasCoverage = false;  ///< alpha of `radiance`: 1 surface, 0 sky; else all is known
    gpu::Image distance;       ///< metres from the probe; 0, infinity: sky. Needed by ProbeParallax::depth
    gpu::Image irradiance;     ///< irradiance · irradianceScale is irradiance / pi; none: from `radiance`
    float irradianceScale = 1;
    std::optional<std::array<vec4, irradianceCoefficients>> harmonics;  ///< instead, of irradiance / pi
};

/// The maps of a host's probes.
struct HostProbeStore {
    CubeMap map;
    CubeMap irradiance;  ///< of those that have cube maps of irradiance
    gpu::Texture distance;
};

/// Side of the faces of the maps, by the largest of the host's: a power of two, 16 to 256.
uint32_t probeSide(std::span<const HostProbe> probes);

/// At most maxProbes. write: lists passes that make the maps of all probes; else `own` holds them already.
ProbeMaps importProbes(gpu::PassList& f, HostProbeStore& own, std::span<const HostProbe> probes, bool write);

}  // namespace reflet
#endif

#endif
