// Direct light of sun and lamps with shadow rays, emission and background. Included by direct_rays.comp and
// direct_rays_query.comp after their traversal. In: G-buffer, GGX table, lamps. Out: direct radiance, the sun's
// visibility.
#include "effects/environment/environment.glsl"
#include "effects/gbuffer/gbuffer_surface.glsl"
#include "effects/lamps.h"
#include "renderer/trace_scene/direct_rays.h"
#include "shaders/half_float.glsl"
#include "shaders/projection.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
layout(scalar) uniform ParamsBlock { DirectRaysParams params; };
layout(scalar) uniform LampUniforms { LampBlock lampBlock; };
uniform sampler2D depth;
uniform usampler2D normal;
uniform usampler2D geometricNormal;
uniform sampler2D baseColor;
uniform sampler2D material;
uniform sampler2D emissive;
uniform sampler2D ggxTable;
layout(rgba16f) uniform writeonly image2D direct;
layout(r8) uniform writeonly image2D sunVisibility;

SceneLights sceneLights() { return params.lights; }
LampParams loadLamp(uint index) { return lampBlock.lamps[index]; }
uint lampCount() { return lampBlock.count; }
float sunMapVisibility(vec3 p, vec3 n) { return -1.0; }
#include "renderer/trace_scene/scene_light.glsl"

const uint directStream = 0xd14e;  // of the noise

LitPoint pointAt(ivec2 pixel, float d) {
    LitPoint at;
    at.position = uvToWorld(pixelToUv(pixel, params.view.pixel), d, params.view.clipToWorld);
    at.geometricNormal = unpackUnitVector(texelFetch(geometricNormal, pixel, 0).r);
    at.normal = unpackUnitVector(texelFetch(normal, pixel, 0).r);
    at.toViewer = directionToEye(at.position, params.view.eye);
    at.clearance =
        clearanceOfPixel(at.position, depthToViewDistance(d, params.view.depthToDistance), params.view.depthToDistance,
                         pixelWidth(at.position, params.view.viewPlane, params.view.eye, params.view.pixelAngle));
    MaterialTexel m = unpackMaterial(texelFetch(material, pixel, 0));
    at.surface = surfaceAt(pixel, texelFetch(baseColor, pixel, 0).rgb, m, dot(at.normal, at.toViewer), ggxTable,
                           isLambert(m));
    return at;
}

vec3 emissionOf(ivec2 pixel) {
    return emissionAt(texelFetch(emissive, pixel, 0).rgb, texelFetch(baseColor, pixel, 0).rgb,
                      unpackMaterial(texelFetch(material, pixel, 0)), params.view.preExposure);
}

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(pixel, ivec2(params.view.size)))) {
        return;
    }
    float d = texelFetch(depth, pixel, 0).r;
    vec3 radiance = vec3(0.0);
    float visible = 1.0;
    if (d > 0.0) {
        LitPoint at = pointAt(pixel, d);
        uint random = hashPixel(uvec2(pixel), directStream + hashPcg(params.view.seed), params.view.frame);
        vec3 sum = vec3(0.0);
        visible = 0.0;
        for (uint i = 0u; i < params.rays; ++i) {
            float sunVisible;
            sum += sunAndLamps(at, random, sunVisible);
            visible += sunVisible;
        }
        radiance = emissionOf(pixel) + sum / float(params.rays);
        visible /= float(params.rays);
    } else {
        radiance = environmentRadiance(viewDirection(pixelToUv(pixel, params.view.pixel), params.view.clipToWorld, params.view.eye));
    }
    imageStore(direct, pixel, vec4(clampToHalf(radiance), 1.0));
    imageStore(sunVisibility, pixel, vec4(visible));
}
