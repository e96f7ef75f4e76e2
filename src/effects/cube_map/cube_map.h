// Prefiltered cube maps of radiance for image-based lighting: GGX lobes (mips of one map) and irradiance (spherical
// harmonics). Shared by environment and probes. Shared by C++ and GLSL.
//
// Faces are in Vulkan's order: +X, -X, +Y, -Y, +Z, -Z, in world space; maps are arrays, even with one cube.
#ifndef REFLET_EFFECTS_CUBE_MAP_H
#define REFLET_EFFECTS_CUBE_MAP_H

#include "base/shared.h"

SHARED_BEGIN

// Coefficients of a cube's irradiance: all spherical harmonics of degree 0 to 2.
const uint irradianceCoefficients = 9;

struct CubeMipParams {
    uint firstFace;  // of the array: 6 · cube + face
};

struct CubeLobesParams {
    float roughness;  // perceptual
    uint firstFace;
    uint samples;
};

struct CubeIrradianceParams {
    uint firstCube;  // cube of the first thread group
    uint convolved;  // 1: `sharp` is irradiance already
    float scale;     // of the result
};

SHARED_END

#ifdef __cplusplus

#include "gpu/pass_list.h"

#include <string>

namespace reflet {

/// Cubes of one size. Alpha is filtered like the colours: the known share of a texel. To fill them, write level 0 of
/// `sharp` (`sharp.mip(0)`, a 2D array of faces).
struct CubeMap {
    CubeMap() = default;
    /// side: of a face [pixels], a power of 2.
    CubeMap(gpu::Context& context, uint32_t side, uint32_t cubes, const std::string& name);

    gpu::Texture sharp;       ///< RGBA16F cube array: radiance; mips are means over solid angle
    gpu::Texture lobes;       ///< RGBA16F cube array: level l is radiance prefiltered by the normalised GGX lobe of
                              ///< perceptual roughness l / (levels - 1); level 0: unfiltered
    gpu::Texture irradiance;  ///< RGBA32F, 9 texels in a row for each cube: irradiance / pi, see cube_map.glsl
};

/// Layers of a cube array: face f of cube c is 6 c + f.
struct CubeFaces {
    uint32_t first = 0;
    uint32_t count = 6;
};

/// Makes the mips of `sharp`, for these faces only.
void makeCubeMips(gpu::PassList& f, const CubeMap& map, const CubeFaces& faces);

/// Samples per texel of a lobe. `few` is for maps that only light other maps: with mips matched to the sample count,
/// lobes are smooth with few samples, too, but wider.
enum class CubeLobeSamples : uint8_t { all, few };

/// Makes all levels of `lobes`, for these faces only. Reads the mips of `sharp` of all faces of their cubes. Costs 1
/// sample per texel on level 0, 64 on level 1, doubling with each level up to 512: 3 million samples for a cube of 128
/// pixels a side, half of them for level 1. With few: 16 on each level.
void filterCubeLobes(gpu::PassList& f, const CubeMap& map, const CubeFaces& faces,
                     CubeLobeSamples samples = CubeLobeSamples::all);

/// Makes the irradiance coefficients of `count` cubes, from the mips of `sharp`.
void projectCubeIrradiance(gpu::PassList& f, const CubeMap& map, uint32_t firstCube, uint32_t count);

/// Cube maps of irradiance, to be projected to coefficients.
struct CubeProjection {
    gpu::Image faces;  ///< a 2D array of faces
    gpu::Image irradiance;
    uint32_t firstCube = 0;
    uint32_t count = 1;
    float scale = 1.0F;  ///< of the values of `faces` to irradiance / pi
};
void projectCube(gpu::PassList& f, const CubeProjection& in);

/// All three, for whole cubes.
void filterCubeMap(gpu::PassList& f, const CubeMap& map, uint32_t firstCube, uint32_t count,
                   CubeLobeSamples samples = CubeLobeSamples::all);

}  // namespace reflet
#endif

#endif
