// Records the downsampling of the surfaces that rays start from.
#include "effects/lobe/ray_surfaces.h"

namespace reflet {

ViewParams viewOfBlocks(const ViewParams& view, uint32_t scale) {
    const auto s = static_cast<float>(scale);
    const vec2 size = glm::ceil(view.size / s);
    // full-resolution uv to uv of the coarse grid: a · uv + b
    const vec2 a = view.size / (s * size);
    const vec2 b = (0.5F - (static_cast<float>(blockPixelOffset(scale)) + 0.5F) / s) / size;
    const vec2 shift = a + 2.0F * b - 1.0F;  // in clip space, for w = 1
    mat4 toBlocks(1.0F);
    mat4 fromBlocks(1.0F);
    for (int i = 0; i < 2; ++i) {
        toBlocks[i][i] = a[i];
        toBlocks[3][i] = shift[i];
        fromBlocks[i][i] = 1.0F / a[i];
        fromBlocks[3][i] = -shift[i] / a[i];
    }
    ViewParams v = view;
    v.worldToClip = toBlocks * view.worldToClip;
    v.clipToWorld = view.clipToWorld * fromBlocks;
    v.previousWorldToClip = toBlocks * view.previousWorldToClip;
    v.size = size;
    v.pixel = 1.0F / size;
    v.jitter = view.jitter / s;
    return v;
}

RaySurfaces pickSurfaces(gpu::PassList& f, const GBuffer& g, const ViewParams& view, uint32_t scale) {
    if (scale == 1) {
        return {.g = g, .view = view, .scale = scale};
    }
    const ViewParams blocks = viewOfBlocks(view, scale);
    const uvec2 size(blocks.size);
    const GBuffer picked{.depth = f.image("surfaces.depth", VK_FORMAT_R32_SFLOAT, size),
                         .normal = f.image("surfaces.normal", VK_FORMAT_R32_UINT, size),
                         .geometricNormal = f.image("surfaces.geometric_normal", VK_FORMAT_R32_UINT, size),
                         .baseColor = f.image("surfaces.base_color", VK_FORMAT_R8G8B8A8_UNORM, size),
                         .material = f.image("surfaces.material", VK_FORMAT_R8G8B8A8_UNORM, size),
                         .emissive = {},
                         .motion = f.image("surfaces.motion", VK_FORMAT_R16G16_SFLOAT, size),
                         .reflectance = g.reflectance
                                            ? f.image("surfaces.reflectance", VK_FORMAT_R16G16B16A16_SFLOAT, size)
                                            : gpu::Image{},
                         .layers = g.layers ? f.image("surfaces.layers", VK_FORMAT_R32G32_UINT, size) : gpu::Image{},
                         .features = g.features};
    gpu::ComputePass pass = f.compute("pick_surfaces", "pick_surfaces.comp");
    bindSurfaces(f, pass, g)
        .read("depth", g.depth)
        .read("normal", g.normal)
        .read("geometricNormal", g.geometricNormal)
        .read("baseColor", g.baseColor)
        .read("material", g.material)
        .read("motion", g.motion)
        .write("pickedDepth", picked.depth)
        .write("pickedNormal", picked.normal)
        .write("pickedGeometricNormal", picked.geometricNormal)
        .write("pickedBaseColor", picked.baseColor)
        .write("pickedMaterial", picked.material)
        .write("pickedMotion", picked.motion)
        .write("pickedReflectance",
               picked.reflectance ? picked.reflectance : f.placeholder(VK_FORMAT_R16G16B16A16_SFLOAT))
        .write("pickedLayers", picked.layers ? picked.layers : f.placeholder(VK_FORMAT_R32G32_UINT))
        .params(PickSurfacesParams{uvec2(view.size), size, scale, blockPixelOffset(scale)})
        .dispatch(size);
    return {.g = picked, .view = blocks, .scale = scale};
}

}  // namespace reflet
