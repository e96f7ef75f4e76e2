// The radiance that probes show: direct light, and indirect light from all probes' maps as they are. Another bounce each
// time. In: captured faces (capture_probe.comp), all probes' maps. Out: radiance, 0 for the sky, with alpha; the same
// without what lamps stand for; the same radiance in an atlas of all faces.
#version 460
#extension GL_EXT_scalar_block_layout : require
#include "effects/environment/environment_lobes.glsl"
#include "renderer/probe/capture_probe.h"
#include "renderer/probe/probe_surface.glsl"
#include "shaders/half_float.glsl"

layout(constant_id = 0) const uint furtherLight = 0u;
layout(constant_id = 1) const uint splits = 0u;

layout(local_size_x = 8, local_size_y = 8) in;
layout(scalar) uniform ParamsBlock { RelightProbesParams params; };
layout(rgba16f) uniform readonly image2DArray lit;
layout(rgba32ui) uniform readonly uimage2DArray surface;
uniform samplerCubeArray probeLobes;
uniform sampler2D probeIrradiance;
uniform samplerCubeArray probeDistance;
layout(rgba16f) uniform writeonly image2DArray sharp;
layout(rgba16f) uniform writeonly image2DArray matte;
layout(rgba16f) uniform writeonly image2D atlas;

uint probeCount() { return params.probes.count; }
ProbeParams loadProbe(uint index) { return params.probes.probes[index]; }
#include "effects/probe/probes.glsl"

vec3 probesOrSky(ProbeQuery q, vec3 sky) {
    vec4 seen = sampleProbes(q).seen;
    return seen.rgb + (1.0 - seen.a) * sky;
}

// direction: from the probe, unit.
vec3 indirectAt(ProbeSurface s, vec3 p, vec3 direction) {
    vec3 r = reflect(direction, s.normal);
    ProbeQuery around = ProbeQuery(p, s.normal, 0.0, true, ProbeParallax_depth, 0.0, -1.0);
    ProbeQuery mirrored = ProbeQuery(p, r, s.roughness, false, ProbeParallax_box, 0.0, -1.0);
    vec3 radiance = s.diffuse * probesOrSky(around, environmentIrradianceOverPi(s.normal));
    return radiance + s.specular * probesOrSky(mirrored, environmentLobe(r, s.roughness));
}

void main() {
    ivec2 texel = ivec2(gl_GlobalInvocationID.xy);
    int side = imageSize(sharp).x;
    if (any(greaterThanEqual(texel, ivec2(side)))) {
        return;
    }
    uint face = params.firstFace + gl_GlobalInvocationID.z;
    uint probe = face / probeFaces;
    vec4 radiance = imageLoad(lit, ivec3(texel, face));
    ProbeSurface s = unpackProbeSurface(imageLoad(surface, ivec3(texel, face)));
    if (radiance.a > 0.0 && furtherLight != 0u) {
        vec3 direction = normalize(cubeFaceDirection(cubeTexelCenter(texel, side), face % probeFaces));
        float nearness = textureLod(probeDistance, vec4(direction, float(probe)), 0.0).r;
        vec3 p = loadProbe(probe).position + direction / max(nearness, 1e-9);
        radiance = roundToHalf(vec4(clampToHalf(radiance.rgb + indirectAt(s, p, direction)), 1.0));
    }
    if (splits != 0u) {
        imageStore(matte, ivec3(texel, face), radiance);
        radiance = roundToHalf(vec4(clampToHalf(radiance.rgb + s.byLamps), radiance.a));
    }
    imageStore(sharp, ivec3(texel, face), radiance);
    imageStore(atlas, texel + side * ivec2(face % probeFaces, probe), radiance);
}
