// Visible fraction of the sun's disk per pixel, by shadow map (hard, PCF, PCSS). In: depth, geometric normal, shadow
// maps and their ranges, blue noise.
// Out: visibility, 1 lit; with soft filters also the penumbra width and the mean height of the blockers; with cascades,
// the cascade used.
// shadow_depth.glsl says what the map is.
#include "effects/shadow/shadow.h"
#include "shaders/cascades.glsl"
#include "shaders/octahedral.glsl"
#include "shaders/projection.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
layout(constant_id = 0) const uint filterKind = ShadowFilter_pcss;
layout(constant_id = 1) const uint hasRanges = 1;
layout(constant_id = 2) const uint cascades = 1;
layout(constant_id = 3) const uint biasKind = ShadowBias_slope;
layout(scalar) uniform ParamsBlock { ShadowVisibilityParams params; };
uniform sampler2D depth;
uniform usampler2D geometricNormal;
#include "effects/shadow/shadow_depth.glsl"
uniform sampler2D range;
layout(scalar) readonly buffer BlueNoise { uint texels[]; } blueNoise;
layout(r8) uniform writeonly image2D visibility;
layout(rg16f) uniform writeonly image2D penumbra;
layout(r8) uniform writeonly image2D cascadeIndex;

uint loadBlueNoise(uint texel) { return blueNoise.texels[texel]; }
float loadShadowDepth(ivec2 texel) { return shadowDepth(texel); }
vec2 loadShadowRange(ivec2 cell) { return texelFetch(range, cell, 0).rg; }
#include "shaders/shadow_noise.glsl"
#include "shaders/shadow_range.glsl"

const uint sunStream = 0x5ad0u;        // of the noise

#include "effects/shadow/sun_shadow.glsl"

Result resultAt(vec3 p, Cascade cascade, ivec2 pixel) {
    vec3 normal = unpackUnitVector(texelFetch(geometricNormal, pixel, 0).r);
    float share = biasKind == ShadowBias_constant ? 1.0 : shareOfNormal(normal, params.sun.maps[0].toSun);
    if (filterKind == ShadowFilter_none || share <= 0.0) {
        return Result(filterKind == ShadowFilter_none ? 1.0 : 0.0, 0.0, 0.0);
    }
    bool rings = params.settings.pattern == ShadowPattern_rings;
    vec4 noise = filterKind == ShadowFilter_hard ? vec4(0.0) : shadowNoise(pixel, params.view, rings, sunStream);
    Result r = resultIn(cascade.index, p, normal, noise);
    if (cascades > 1u && cascade.next > 0.0) {
        r = mixed(r, resultIn(cascade.index + 1u, p, normal, noise), cascade.next);
    }
    r.visibility *= share;
    return r;
}

void look(ivec2 pixel) {
    float d = texelFetch(depth, pixel, 0).r;
    Result r = Result(1.0, 0.0, 0.0);                 // for the sky
    Cascade c = Cascade(cascades - 1u, 0.0);
    if (d > 0.0) {
        vec3 p = uvToWorld(pixelToUv(pixel, params.view.pixel), d, params.view.clipToWorld);
        if (cascades > 1u) {  // with a non-constant index CPU devices process lanes one by one
            c = selectCascade(dot(params.view.viewPlane, vec4(p, 1.0)), params.sun);
        }
        r = resultAt(p, c, pixel);
    }
    imageStore(visibility, pixel, vec4(r.visibility));
    if (filterKind == ShadowFilter_pcf || filterKind == ShadowFilter_pcss) {
        imageStore(penumbra, pixel, vec4(clamp(vec2(r.width, r.height), -60000.0, 60000.0), 0.0, 0.0));
    }
    if (cascades > 1u) {
        imageStore(cascadeIndex, pixel, vec4((float(c.index) + c.next) / float(maxCascades - 1u)));
    }
}

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (all(lessThan(pixel, ivec2(params.view.size)))) {
        look(pixel);
    }
}
