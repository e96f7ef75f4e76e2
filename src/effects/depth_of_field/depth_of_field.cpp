// Records depth of field.
#include "effects/depth_of_field/depth_of_field.h"

#include "effects/levels.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

namespace reflet {

namespace {

// The layers at half resolution.
struct Layers {
    gpu::Image ground, groundBlur, front, frontBlur;
};

constexpr std::array layerFormats{VK_FORMAT_R16G16B16A16_SFLOAT, VK_FORMAT_R16G16_SFLOAT,
                                  VK_FORMAT_R16G16B16A16_SFLOAT, VK_FORMAT_R32_SFLOAT};

Layers makeLayers(gpu::Scratch& scratch, uvec2 size) {
    return {scratch.storage(layerFormats[0], size), scratch.storage(layerFormats[1], size),
            scratch.storage(layerFormats[2], size), scratch.storage(layerFormats[3], size)};
}

// Distance from the centre to the edge of a regular polygon inside the unit circle, with a corner at the angle 0.
float edgeOf(uint32_t corners, float angle) {
    if (corners < 3) {
        return 1.0F;
    }
    const float side = 2.0F * glm::pi<float>() / static_cast<float>(corners);
    const float within = angle - side * std::floor(angle / side);
    return std::cos(0.5F * side) / std::cos(within - 0.5F * side);
}

// A spiral with the golden angle: the first ones of any number of samples have equal areas (H. Vogel, A Better Way to
// Construct the Sunflower Head, 1979). In the aperture's shape, or in the circle around it where that is not the same
// turned by half a turn, as disks in front of the plane of focus are.
std::array<vec4, dofMostSamples> samplesOf(const Lens& lens) {
    const float golden = glm::pi<float>() * (3.0F - std::sqrt(5.0F));
    const bool symmetric = lens.blades < 3 || lens.blades % 2 == 0;
    std::array<vec4, dofMostSamples> samples{};
    for (size_t i = 0; i < samples.size(); ++i) {
        const float angle = golden * static_cast<float>(i);
        const vec2 direction(std::cos(angle), std::sin(angle));
        // Rows of pixels go down; a sample at `direction` has the pixel on its other side.
        const float turn = std::atan2(-direction.y, direction.x) - lens.bladeRotation;
        const float nearEdge = edgeOf(lens.blades, turn);
        const float farEdge = edgeOf(lens.blades, turn + glm::pi<float>());
        const float radius = std::sqrt(static_cast<float>(i) + 0.5F) * (symmetric ? nearEdge : 1.0F);
        samples.at(i) = vec4(radius * direction, radius / nearEdge, radius / farEdge);
    }
    return samples;
}

// Area of the circle over that of the aperture, as far as samples fill the circle.
float unusedArea(const Lens& lens) {
    if (lens.blades < 3 || lens.blades % 2 == 0) {
        return 1.0F;
    }
    const auto n = static_cast<float>(lens.blades);
    return 2.0F * glm::pi<float>() / (n * std::sin(2.0F * glm::pi<float>() / n));
}

gpu::Image circleOfConfusion(gpu::Recorder& f, gpu::KeptImage& own, const DofInputs& in, float height) {
    const uvec2 size = in.depth.size;
    const gpu::Image coc = own.storage(f, VK_FORMAT_R32_SFLOAT, size);
    const bool orthographic = in.view.eye.w == 0.0F;
    const float pixelAngle = in.view.pixelAngle * in.view.size.y / height;  // of the picture
    const float atInfinity = in.lens.apertureRadius / (pixelAngle * (orthographic ? 1.0F : in.lens.focusDistance));
    const vec4 lens(atInfinity, 1.0F / in.lens.focusDistance, orthographic ? 1.0F : 0.0F,
                    in.settings.maxRadius * height);
    f.compute("coc", "dof_coc.comp")
        .read("depth", in.depth)
        .write("coc", coc)
        .params(DofCocParams{in.view.depthToDistance, lens, size})
        .dispatch(size);
    return coc;
}

gpu::Pass& readLayers(gpu::Pass& pass, const Layers& layers) {
    return pass.read("ground", layers.ground)
        .read("groundBlur", layers.groundBlur)
        .read("front", layers.front)
        .read("frontBlur", layers.frontBlur);
}

void makeMips(gpu::Recorder& f, const Layers& layers, const Layers& mips, DofSizes sizes) {
    for (sizes.level = 1; sizes.level < dofLevels; ++sizes.level) {
        gpu::Pass pass = f.compute("mips." + std::to_string(sizes.level), "dof_mips.comp");
        readLayers(pass, layers)
            .write("groundMips", mips.ground)
            .write("groundBlurMips", mips.groundBlur)
            .write("frontMips", mips.front)
            .write("frontBlurMips", mips.frontBlur)
            .params(sizes)
            .dispatch(levelSize(sizes.half2, sizes.level));
    }
}

// How far the disks of each tile reach. largest: radius, in pixels of half resolution.
gpu::Image makeReach(gpu::Recorder& f, gpu::Scratch& scratch, const Layers& layers, const DofSizes& sizes,
                     float largest) {
    const uvec2 tileCount = (sizes.half2 + dofTile - 1U) / dofTile;
    const gpu::Image tiles = scratch.storage(VK_FORMAT_R16G16_SFLOAT, tileCount);
    const gpu::Image reach = scratch.storage(VK_FORMAT_R16G16_SFLOAT, tileCount);
    f.compute("tiles", "dof_tiles.comp")
        .read("groundBlur", layers.groundBlur)
        .read("frontBlur", layers.frontBlur)
        .write("tiles", tiles)
        .params(sizes)
        .dispatch(tileCount);
    f.compute("reach", "dof_reach.comp")
        .constant("around", 1U + static_cast<uint32_t>(std::ceil(largest / static_cast<float>(dofTile))))
        .read("tiles", tiles)
        .write("reach", reach)
        .dispatch(tileCount);
    return reach;
}

}  // namespace

bool blurs(const Lens& lens, const DofSettings& settings) {
    return settings.enabled != 0 && lens.apertureRadius > 0.0F;
}

DofImages depthOfField(gpu::Recorder& f, DofStore& own, const DofInputs& in) {
    if (!blurs(in.lens, in.settings)) {
        return {in.radiance, {}};
    }
    const auto scope = f.scope("dof");
    const uvec2 size = in.radiance.size;
    const auto height = static_cast<float>(size.y);
    const gpu::Image coc = circleOfConfusion(f, own.coc, in, height);
    const DofSizes sizes{size, (size + 1U) / 2U, vec2(coc.size) / vec2(size), 0};
    gpu::Scratch scratch(f);
    const Layers layers = makeLayers(scratch, sizes.half2);
    f.compute("split", "dof_split.comp")
        .read("radiance", in.radiance)
        .read("coc", coc)
        .write("ground", layers.ground)
        .write("groundBlur", layers.groundBlur)
        .write("front", layers.front)
        .write("frontBlur", layers.frontBlur)
        .params(sizes)
        .dispatch(sizes.half2);
    const Layers mips = makeLayers(scratch, levelsImageSize(sizes.half2, dofLevels));
    makeMips(f, layers, mips, sizes);
    const float largest = std::max(0.5F * in.settings.maxRadius * height, 1.0F);
    const gpu::Image reach = makeReach(f, scratch, layers, sizes, largest);
    const gpu::Image groundOut = scratch.storage(layerFormats[0], sizes.half2);
    const gpu::Image frontOut = scratch.storage(layerFormats[2], sizes.half2);
    gpu::Pass gather = f.compute("gather", "dof_gather.comp");
    readLayers(gather, layers)
        .read("groundMips", mips.ground)
        .read("groundBlurMips", mips.groundBlur)
        .read("frontMips", mips.front)
        .read("frontBlurMips", mips.frontBlur)
        .read("reach", reach)
        .write("groundOut", groundOut)
        .write("frontOut", frontOut)
        .params(samplesOf(in.lens), "taps")
        .params(DofGatherParams{sizes.half2, in.settings.samples, largest, unusedArea(in.lens)})
        .dispatch(sizes.half2);
    const gpu::Image result = own.result.storage(f, layerFormats[0], size);
    f.compute("composite", "dof_composite.comp")
        .read("radiance", in.radiance)
        .read("coc", coc)
        .read("groundOut", groundOut)
        .read("frontOut", frontOut)
        .write("result", result)
        .params(sizes)
        .dispatch(size);
    return {result, coc};
}

}  // namespace reflet
