// Stores one face of a probe's cube map, mirrored (see cubeFaceCamera), and adds indirect light from earlier captures.
// In: G-buffer and direct light of the face's camera, all probes' maps. Out: radiance, 0 for the sky, with alpha;
// the same without what lamps stand for;
// reciprocal distance, which is linear enough to interpolate; the same radiance in an atlas of all faces.
#version 460
#extension GL_EXT_scalar_block_layout : require
#include "effects/environment/environment_lobes.glsl"
#include "effects/gbuffer/gbuffer_surface.glsl"
#include "renderer/probe/capture_probe.h"
#include "shaders/half_float.glsl"
#include "shaders/projection.glsl"

layout(constant_id = 0) const uint furtherLight = 0u;
layout(constant_id = 1) const uint splits = 0u;

layout(local_size_x = 8, local_size_y = 8) in;
layout(scalar) uniform ParamsBlock { CaptureProbeParams params; };
uniform sampler2D depth;
uniform usampler2D normal;
uniform sampler2D baseColor;
uniform sampler2D material;
uniform sampler2D emissive;
uniform sampler2D ggxTable;
layout(rgba16f) uniform readonly image2D direct;
uniform samplerCubeArray probeLobes;
uniform sampler2D probeIrradiance;
uniform samplerCubeArray probeDistance;
layout(rgba16f) uniform writeonly image2DArray sharp;
layout(rgba16f) uniform writeonly image2DArray matte;
layout(r32f) uniform writeonly image2DArray distance;
layout(rgba16f) uniform writeonly image2D atlas;

uint probeCount() { return params.probes.count; }
ProbeParams loadProbe(uint index) { return params.probes.probes[index]; }
#include "effects/probe/probes.glsl"

vec3 probesOrSky(ProbeQuery q, vec3 sky) {
    float hitDistance;
    vec4 seen = sampleProbes(q, hitDistance);
    return seen.rgb + (1.0 - seen.a) * sky;
}

vec3 indirectAt(ivec2 pixel, vec3 p) {
    vec3 n = unpackUnitVector(texelFetch(normal, pixel, 0).r);
    vec3 v = directionToEye(p, params.view.eye);
    MaterialTexel m = unpackMaterial(texelFetch(material, pixel, 0));
    Surface s = surfaceAt(pixel, texelFetch(baseColor, pixel, 0).rgb, m, dot(n, v), ggxTable, isLambert(m));
    vec3 r = reflect(-v, n);
    ProbeQuery around = ProbeQuery(p, n, 0.0, true, ProbeParallax_box, 0.0, -1.0);
    ProbeQuery mirrored = ProbeQuery(p, r, m.roughness, false, ProbeParallax_box, 0.0, -1.0);
    vec3 radiance = (s.diffuse + s.sheenAlbedo) * m.occlusion * probesOrSky(around, environmentIrradianceOverPi(n));
    return radiance + s.specular * probesOrSky(mirrored, environmentLobe(r, m.roughness));
}

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    ivec2 size = ivec2(params.view.size);
    if (any(greaterThanEqual(pixel, size))) {
        return;
    }
    float d = texelFetch(depth, pixel, 0).r;
    vec4 radiance = vec4(0.0);
    vec3 byLamps = vec3(0.0);
    float nearness = 0.0;
    if (d > 0.0) {
        vec3 p = uvToWorld(pixelToUv(pixel, params.view.pixel), d, params.view.clipToWorld);
        nearness = 1.0 / max(length(p - params.view.eye.xyz), 1e-6);
        radiance = vec4(imageLoad(direct, pixel).rgb, 1.0);
        bool emits = (unpackMaterial(texelFetch(material, pixel, 0)).flags & materialFlagEmitter) != 0u;
        byLamps = emits ? texelFetch(emissive, pixel, 0).rgb : vec3(0.0);
        if (furtherLight != 0u) {
            radiance.rgb += indirectAt(pixel, p);
        }
        radiance = roundToHalf(vec4(clampToHalf(radiance.rgb), 1.0));
    }
    ivec2 texel = ivec2(size.x - 1 - pixel.x, pixel.y);
    imageStore(sharp, ivec3(texel, params.face), radiance);
    if (splits != 0u) {
        imageStore(matte, ivec3(texel, params.face), vec4(max(radiance.rgb - byLamps, vec3(0.0)), radiance.a));
    }
    imageStore(distance, ivec3(texel, params.face), vec4(nearness));
    imageStore(atlas, texel + size * ivec2(params.face % probeFaces, params.face / probeFaces), radiance);
}
