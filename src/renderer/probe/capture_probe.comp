// Stores one face of a probe's cube map, mirrored (see cubeFaceCamera): what relight_probes.comp lights.
// In: G-buffer and direct light of the face's camera. Out: direct light without what lamps stand for, 0 for the sky, with alpha;
// the surfaces
// (probe_surface.glsl); reciprocal distance, which is linear enough to interpolate.
#version 460
#extension GL_EXT_scalar_block_layout : require
#include "effects/gbuffer/gbuffer_surface.glsl"
#include "renderer/probe/capture_probe.h"
#include "renderer/probe/probe_surface.glsl"
#include "shaders/half_float.glsl"
#include "shaders/octahedral.glsl"
#include "shaders/projection.glsl"

layout(constant_id = 0) const uint splits = 0u;

layout(local_size_x = 8, local_size_y = 8) in;
layout(scalar) uniform ParamsBlock { CaptureProbeParams params; };
uniform sampler2D depth;
uniform usampler2D normal;
uniform sampler2D baseColor;
uniform sampler2D material;
uniform sampler2D emissive;
uniform sampler2D ggxTable;
layout(rgba16f) uniform readonly image2D direct;
layout(rgba16f) uniform writeonly image2DArray lit;
layout(rgba32ui) uniform writeonly uimage2DArray surface;
layout(r32f) uniform writeonly image2DArray distance;

ProbeSurface surfaceOf(ivec2 pixel, vec3 p) {
    MaterialTexel m = unpackMaterial(texelFetch(material, pixel, 0));
    vec3 n = unpackUnitVector(texelFetch(normal, pixel, 0).r);
    vec3 v = directionToEye(p, params.view.eye);
    Surface s = surfaceAt(pixel, texelFetch(baseColor, pixel, 0).rgb, m, dot(n, v), ggxTable, isLambert(m));
    bool emits = splits != 0u && (m.flags & materialFlagEmitter) != 0u;
    vec3 byLamps = emits ? texelFetch(emissive, pixel, 0).rgb : vec3(0.0);
    return ProbeSurface(n, m.roughness, (s.diffuse + s.sheenAlbedo) * m.occlusion, s.specular, byLamps);
}

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    ivec2 size = ivec2(params.view.size);
    if (any(greaterThanEqual(pixel, size))) {
        return;
    }
    float d = texelFetch(depth, pixel, 0).r;
    vec4 radiance = vec4(0.0);
    uvec4 packed = uvec4(0u);
    float nearness = 0.0;
    if (d > 0.0) {
        vec3 p = uvToWorld(pixelToUv(pixel, params.view.pixel), d, params.view.clipToWorld);
        nearness = 1.0 / max(length(p - params.view.eye.xyz), 1e-6);
        ProbeSurface s = surfaceOf(pixel, p);
        radiance = roundToHalf(vec4(clampToHalf(imageLoad(direct, pixel).rgb - s.byLamps), 1.0));
        packed = packProbeSurface(s);
    }
    ivec3 texel = ivec3(size.x - 1 - pixel.x, pixel.y, params.face);
    imageStore(lit, texel, radiance);
    imageStore(surface, texel, packed);
    imageStore(distance, texel, vec4(nearness));
}
