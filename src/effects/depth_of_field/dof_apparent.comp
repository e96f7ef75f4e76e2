// The distance at which a pixel's light comes into focus: of its surface, or of the image that it reflects. One group per tile of
// the list. In: G-buffer, lit radiance, reflected light with its hit distance, the list. Out: depth where an image is reflected.
//
// A mirror shows an image at the hit distance behind it, a curved one nearer (mirror equation; E. Hecht, Optics, 5.4). Where
// reflected light is the larger share of the pixel's, the pixel takes that image's distance.
#version 460
#extension GL_EXT_scalar_block_layout : require
#include "effects/depth_of_field/depth_of_field.h"
#include "effects/gbuffer/gbuffer_surface.glsl"
#include "effects/lobe/ray_tiles.glsl"
#include "effects/lobe/upsample_specular.glsl"
#include "shaders/luminance.glsl"
#include "shaders/projection.glsl"

layout(constant_id = 2) const uint lambertOnly = 0u;

layout(local_size_x = 8, local_size_y = 8) in;
layout(scalar) uniform ParamsBlock { DofApparentParams params; };
uniform sampler2D depth;
uniform usampler2D normal;
uniform usampler2D geometricNormal;
uniform sampler2D baseColor;
uniform sampler2D material;
uniform sampler2D ggxTable;
uniform sampler2D lit;
layout(r32f) uniform writeonly image2D apparentDepth;
layout(scalar) readonly buffer ListBlock {
    uint groups[3];
    uint count;
    uint items[];
} list;

ivec2 last = ivec2(params.view.size) - 1;

vec3 normalAt(ivec2 pixel) { return unpackUnitVector(texelFetch(normal, pixel, 0).r); }

vec3 positionAt(ivec2 pixel, float d) {
    return uvToWorld(pixelToUv(pixel, params.view.pixel), d, params.view.clipToWorld);
}

// Curvature of the surface along one axis of the picture [1/m], positive if convex: from the neighbour whose depth is closer.
float curvatureAlong(ivec2 axis, ivec2 pixel, float d, vec3 p, vec3 n) {
    ivec2 before = max(pixel - axis, ivec2(0));
    ivec2 after = min(pixel + axis, last);
    float depthBefore = texelFetch(depth, before, 0).r;
    float depthAfter = texelFetch(depth, after, 0).r;
    bool useAfter = before == pixel || (after != pixel && abs(depthAfter - d) <= abs(depthBefore - d));
    ivec2 neighbour = useAfter ? after : before;
    vec3 step = positionAt(neighbour, max(useAfter ? depthAfter : depthBefore, 1e-9)) - p;
    return dot(normalAt(neighbour) - n, step) / max(dot(step, step), 1e-12);
}

// 1 over the distance of the reflected image from the eye [1/m].
float imageVergence(float toSurface, float hitDistance, float curvature, float nv) {
    // A sphere has two focal lines, along and across the plane of incidence: the mean of their powers.
    float power = 1.0 / max(hitDistance, 1e-3) + curvature * (nv + 1.0 / nv);
    float denominator = 1.0 + toSurface * power;
    float vergence = power / (abs(denominator) < 1e-3 ? 1e-3 : denominator);
    return clamp(vergence, 0.0, 4.0 / toSurface);
}

// The least hit distance around a pixel of the surface. At edges of what is reflected, the mean over frames is nearly that of what
// is farther, as distances of the sky are large; a sharp edge would get pixels that are blurred.
float hitDistanceAround(Shown shown, float own) {
    int scale = max(int(specularScale), 1);
    ivec2 end = imageSize(specular) - 1;
    ivec2 middle = shown.pixel / scale;
    for (int i = 0; i < 9; ++i) {
        ivec2 block = clamp(middle + ivec2(i % 3, i / 3) - 1, ivec2(0), end);
        ivec2 at = min(block * scale + int(params.specularBlockOffset), last);
        float d = texelFetch(depth, at, 0).r;
        float hit = imageLoad(specular, block).a;
        own = hit > 0.0 && onSameSurface(shown, vec2(at - shown.pixel), d) > 0.9 ? min(own, hit) : own;
    }
    return own;
}

const vec2 shareRange = vec2(0.35, 0.65);      // of reflected light: from the surface's distance to the image's
const vec2 roughnessRange = vec2(dofRoughestImage, 0.2);  // rough surfaces show no image that a lens could focus on

// The depth where the pixel shows a reflected image.
float depthOfImage(ivec2 pixel, float d, vec3 p, vec3 n, float nv, float reflectance, float roughness) {
    vec3 geometric = unpackUnitVector(texelFetch(geometricNormal, pixel, 0).r);
    Shown shown =
        Shown(pixel, d, n, screenPlane(p, geometric, params.view.clipToWorld, params.view.pixel, params.view.pixelAngle));
    vec4 reflected = specularLight(shown, params.specularBlockOffset);
    float share = reflectance * luminance(reflected.rgb) / max(luminance(texelFetch(lit, pixel, 0).rgb), 1e-6);
    float z = max(depthToViewDistance(d, params.view.depthToDistance), 1e-6);
    float away = params.view.eye.w > 0.0 ? distance(p, params.view.eye.xyz) : z;
    float curvature = 0.5 * (curvatureAlong(ivec2(1, 0), pixel, d, p, n) + curvatureAlong(ivec2(0, 1), pixel, d, p, n));
    float hit = hitDistanceAround(shown, reflected.a);
    float vergence = imageVergence(away, hit, curvature, max(nv, 0.05)) * away / z;
    float polish = clamp((roughness - roughnessRange.x) / (roughnessRange.y - roughnessRange.x), 0.0, 1.0);
    float shows = polish * smoothstep(shareRange.x, shareRange.y, share);
    float image = 1.0 / max(mix(1.0 / z, vergence, shows), 1e-6);
    vec4 k = params.view.depthToDistance;
    return shows > 0.0 ? (k.x - image * k.z) / (image * k.w - k.y) : d;
}

void main() {
    uint item = gl_WorkGroupID.y * tileListRow + gl_WorkGroupID.x;
    if (item >= list.count) {
        return;
    }
    ivec2 pixel = ivec2(unpackTilePlace(list.items[item]) * rayTileSide + gl_LocalInvocationID.xy);
    if (any(greaterThan(pixel, last))) {
        return;
    }
    float d = texelFetch(depth, pixel, 0).r;
    MaterialTexel m = unpackMaterial(texelFetch(material, pixel, 0));
    if (d <= 0.0 || m.roughness >= roughnessRange.x) {
        return;
    }
    vec3 p = positionAt(pixel, d);
    vec3 n = normalAt(pixel);
    float nv = dot(n, directionToEye(p, params.view.eye));
    Surface s = surfaceAt(pixel, texelFetch(baseColor, pixel, 0).rgb, m, nv, ggxTable, lambertOnly != 0u);
    imageStore(apparentDepth, pixel, vec4(depthOfImage(pixel, d, p, n, nv, luminance(s.specular), m.roughness)));
}
