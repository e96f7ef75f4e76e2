// Cube maps of radiance, filtered for look-ups: by GGX lobes (mips of one map) and as irradiance (spherical harmonics).
// What environment and probes share. Shared by C++ and GLSL.
//
// Faces are Vulkan's: +X, -X, +Y, -Y, +Z, -Z, in world space; maps are arrays, also those of one cube.
#ifndef REFLET_RENDER_CUBE_MAP_H
#define REFLET_RENDER_CUBE_MAP_H

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
    uint firstCube;  // the groups count on from it
};

SHARED_END

#ifdef __cplusplus

#include "gpu/frame.h"

#include <string>

namespace reflet {

/// Cubes of one size. Alpha is filtered as the colours are: 1, or the share of a texel that is known. Whoever fills
/// them writes level 0 of `sharp` (`sharp.mip(0)`, a 2D array of faces).
struct CubeMap {
    CubeMap() = default;
    /// side: of a face [pixels], a power of 2.
    CubeMap(gpu::Device& device, uint32_t side, uint32_t cubes, const std::string& name);

    gpu::Texture sharp;       ///< RGBA16F cube array: radiance; the mips are means over the directions of each texel
    gpu::Texture lobes;       ///< RGBA16F cube array: level l is radiance weighted by the GGX lobe, normalised, of
                              ///< perceptual roughness l / (levels - 1); level 0: the sharp one
    gpu::Texture irradiance;  ///< RGBA32F, 9 texels in a row for each cube: irradiance / pi, see cube_map.glsl
};

/// Layers of a cube array: face f of cube c is 6 c + f.
struct CubeFaces {
    uint32_t first = 0;
    uint32_t count = 6;
};

/// The mips of `sharp`, of these faces alone.
void makeCubeMips(gpu::Frame& f, const CubeMap& map, const CubeFaces& faces);

/// All levels of `lobes`, of these faces alone. Reads the mips of `sharp` of all faces of their cubes. Costs at each
/// texel 1 sample on level 0, 64 on level 1, and twice as many on each further level, 512 at most: 3 million samples
/// for a cube of 128 pixels a side, half of them for level 1.
void filterCubeLobes(gpu::Frame& f, const CubeMap& map, const CubeFaces& faces);

/// The coefficients of `count` cubes, from the mips of `sharp`.
void projectCubeIrradiance(gpu::Frame& f, const CubeMap& map, uint32_t firstCube, uint32_t count);

/// All three for whole cubes.
void filterCubeMap(gpu::Frame& f, const CubeMap& map, uint32_t firstCube, uint32_t count);

}  // namespace reflet
#endif

#endif
