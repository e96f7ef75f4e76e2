// Draws the G-buffer.
#include "renderer/draw_gbuffer/draw_gbuffer.h"

#include "renderer/material.h"

namespace reflet {

namespace {

bool isInFront(const Aabb& box, const vec4& plane) {
    const vec3 farthest = glm::mix(box.min, box.max, glm::greaterThan(vec3(plane), vec3(0.0F)));
    return glm::dot(plane, vec4(farthest, 1.0F)) > 0.0F;
}

uint32_t translucentOf(const GBufferContent& content) {
    if (content.coat) {
        return content.blendedCoats ? translucentBlendedCoat : content.glass ? translucentGlassCoat : translucentCoat;
    }
    if (content.otherSide) {
        return translucentOtherSide;
    }
    return content.glass ? translucentGlass : translucentBlended;
}

// What every material fills.
GBuffer targets(gpu::PassList& f, uvec2 size) {
    return {
        .depth = f.target("depth", VK_FORMAT_D32_SFLOAT, size),
        .normal = f.target("normal", VK_FORMAT_R32_UINT, size),
        .geometricNormal = f.target("geometric_normal", VK_FORMAT_R32_UINT, size),
        .baseColor = f.target("base_color", VK_FORMAT_A2B10G10R10_UNORM_PACK32, size),
        .material = f.target("material", VK_FORMAT_R8G8B8A8_UNORM, size),
        .emissive = f.target("emissive", VK_FORMAT_B10G11R11_UFLOAT_PACK32, size),
        .motion = f.target("motion", VK_FORMAT_R16G16B16A16_SFLOAT, size),
    };
}

}  // namespace

GBuffer drawGBuffer(gpu::PassList& f, const DrawList& list, const ViewParams& view, const MaterialsSettings& settings,
                    const GBufferContent& content) {
    const vec4 clipPlane = content.clipPlane;
    const bool blended = bool(content.opaqueDepth);
    const uint32_t surfaces = !blended ? surfacesOpaque : content.nearerDepth ? surfacesBehind : surfacesNearest;
    const bool clipped = clipPlane != vec4(0.0F);
    const uint32_t features = content.coat || content.otherSide ? 0 : list.materialFeatures;
    const bool layers = (features & (materialFeatureSheen | materialFeatureAnisotropy)) != 0;
    const bool reflectance = layers || (features & materialFeatureReflectance) != 0;
    GBuffer g = targets(f, uvec2(view.size));
    g.reflectance = reflectance ? f.target("reflectance", VK_FORMAT_R16G16B16A16_SFLOAT, g.depth.size) : gpu::Image{};
    g.layers = layers ? f.target("layers", VK_FORMAT_R32G32_UINT, g.depth.size) : gpu::Image{};
    g.features = features;
    const VkClearColorValue zero{};
    const char* const fragment = layers        ? "gbuffer_layers.frag"
                                 : reflectance ? "gbuffer_reflectance.frag"
                                               : "gbuffer.frag";
    gpu::RasterPass pass = f.raster("gbuffer", {"gbuffer.vert", fragment});
    for (const gpu::Image picture : list.livePictures) {
        pass.read(picture);
    }
    // Always bound, but not read where not needed.
    const auto depthOr = [&](gpu::Image given) { return given ? given : f.placeholder(VK_FORMAT_R32_SFLOAT); };
    pass.read("opaqueDepth", depthOr(content.opaqueDepth)).read("nearerDepth", depthOr(content.nearerDepth));
    pass.constant("clipped", clipped ? 1U : 0U)
        .constant("usedSlots", list.textureSlots)
        .constant("surfaces", surfaces)
        .constant("translucent", translucentOf(content))
        .constant("materialFeatures", list.materialFeatures)
        .constant("bent", list.previousPositions != VK_NULL_HANDLE ? 1U : 0U)
        .color("outBaseColor", g.baseColor, zero)
        .color("outNormal", g.normal, zero)
        .color("outGeometricNormal", g.geometricNormal, zero)
        .color("outMaterial", g.material, zero)
        .color("outEmissive", g.emissive, zero)
        .color("outMotion", g.motion, zero)
        .depth(g.depth, 0.0F)
        .vertices(vertexLayout(), list.materialLayout)
        .params(GBufferParams{view, settings, clipPlane, content.blendedFrom});
    if (reflectance) {
        pass.color("outReflectance", g.reflectance, zero);
    }
    if (layers) {
        pass.color("outLayers", g.layers, zero);
    }
    pass.draw([=, &list](const gpu::DrawCommands& to) {
        const auto keep = [&](const Draw& draw) {
            const bool opaque = draw.alpha >= content.blendedFrom && !(content.withoutGlass && draw.glass);
            const bool ofOpaque = (content.coat && !content.blendedCoats) || content.otherSide;
            const bool layer = content.glass ? draw.glass : ofOpaque ? opaque : draw.blended;
            const bool drawn = (blended ? layer : opaque) && (draw.coated || !content.coat) &&
                               (draw.diffuseTransmission || !content.otherSide);
            return drawn && (!clipped || isInFront(draw.boundsW, clipPlane));
        };
        const vec2 pixels = content.levelScale * vec2(view.size);
        recordDraws(to, list, {keep, Cull::back, true, view.worldToClip, pixels, 0, content.bothSides}, true);
    });
    return g;
}

}  // namespace reflet
