// Depth and motion of what a pixel shows: its surface, or the image that it reflects. One group per tile of the list. In:
// G-buffer, lit radiance, reflected light with its hit distance, the image's own motion, the list. Out: depth and motion
// where an image is shown.
#version 460
#extension GL_EXT_scalar_block_layout : require
#include "effects/gbuffer/gbuffer_surface.glsl"
#include "effects/lobe/ray_tiles.glsl"
#include "effects/reflected_images/reflected_images.h"
#include "shaders/luminance.glsl"
#include "shaders/projection.glsl"

layout(constant_id = 2) const uint lambertOnly = 0u;
layout(constant_id = 3) const uint moves = 0u;
layout(constant_id = 4) const uint hasImageMotion = 0u;
layout(constant_id = 5) const uint upscaled = 0u;

layout(local_size_x = 8, local_size_y = 8) in;
layout(scalar) uniform ParamsBlock { ReflectedImagesParams params; };
uniform sampler2D depth;
uniform sampler2D frontDepth;  // ShownImages::depth
uniform sampler2D motion;
layout(rg16f) uniform readonly image2D imageMotion;
uniform usampler2D normal;
uniform usampler2D geometricNormal;
uniform sampler2D baseColor;
uniform sampler2D material;
uniform sampler2D ggxTable;
uniform sampler2D lit;
layout(r32f) uniform writeonly image2D shownDepth;
layout(rg16f) uniform writeonly image2D shownMotion;
layout(scalar) readonly buffer ListBlock {
    uint groups[3];
    uint count;
    uint items[];
} list;

#include "effects/lobe/upsample_specular.glsl"

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

// Luminance of the light that a pixel of this reflectance reflects, as a share of all of its light.
float shareOf(vec3 reflected, float reflectance, ivec2 at) {
    return reflectance * luminance(reflected) / max(luminance(texelFetch(lit, at, 0).rgb), 1e-6);
}

// What a pixel reflects.
struct ReflectedImage {
    float hit;    // distance from the surface [m]
    float share;  // of the pixel's light
    vec2 moved;   // uv: by the reflected thing's own motion
};

// The nearest image around a pixel of the surface. At edges of what is reflected, the mean over frames is nearly that of what is
// farther, as distances of the sky are large: a lens would blur a sharp edge. What moves carries its edge along, as
// surfaces do in antialiasing.
ReflectedImage nearestImage(Shown shown, ReflectedImage image, float reflectance) {
    int scale = max(int(specularScale), 1);
    ivec2 end = imageSize(specular) - 1;
    ivec2 middle = shown.pixel / scale;
    for (int i = 0; i < 9; ++i) {
        ivec2 block = clamp(middle + ivec2(i % 3, i / 3) - 1, ivec2(0), end);
        ivec2 at = min(block * scale + int(params.specularBlockOffset), last);
        float d = texelFetch(depth, at, 0).r;
        vec4 light = imageLoad(specular, block);
        bool counts = light.a > 0.0 && onSameSurface(shown, vec2(at - shown.pixel), d) > 0.9;
        bool nearer = counts && light.a <= image.hit;
        image.hit = nearer ? light.a : image.hit;
        if (hasImageMotion != 0u) {
            vec2 moved = imageLoad(imageMotion, block).rg;
            float share = shareOf(light.rgb, reflectance, at);
            image.share = nearer && moved != vec2(0.0) ? max(image.share, share) : image.share;
            image.moved = nearer ? moved : image.moved;
        }
    }
    return image;
}

// From the surface to the image: shares of reflected light, and roughness, as rough surfaces show no image.
const vec2 shareRange = vec2(0.35, 0.65);
const vec2 roughnessRange = vec2(roughestImage, 0.2);
// From how many pixels on a surface moves itself, and per pixel of all its motion, as that is stored as halfs. Few, as what
// a turning mirror shows moves near its axis, too.
const vec2 own = vec2(0.03, 0.001);
// Motion of the image in a surface that moves itself: how it turns is not known, so that nothing of the last frame stands
// for it. Without upscaling, clipping to what a pixel and its neighbours show now does better than to start anew.
const vec2 outside = vec2(4.0);

// Where something at rest was in the last frame.
vec2 uvBefore(vec2 uv, float d) {
    vec4 before = params.toPrevious * vec4(uvToNdc(uv), d, 1.0);
    return ndcToUv(before.xy / max(before.w, 1e-9));
}

void showImage(ivec2 pixel, float d, vec3 p, vec3 n, float nv, float reflectance, float roughness) {
    vec3 geometric = unpackUnitVector(texelFetch(geometricNormal, pixel, 0).r);
    Shown shown =
        Shown(pixel, d, n, screenPlane(p, geometric, params.view.clipToWorld, params.view.pixel, params.view.pixelAngle));
    vec4 reflected = specularLight(shown, params.specularBlockOffset, vec2(0.0));
    ReflectedImage image = ReflectedImage(reflected.a, shareOf(reflected.rgb, reflectance, pixel), vec2(0.0));
    image = nearestImage(shown, image, reflectance);
    float z = max(depthToViewDistance(d, params.view.depthToDistance), 1e-6);
    float away = params.view.eye.w > 0.0 ? distance(p, params.view.eye.xyz) : z;
    float curvature = 0.5 * (curvatureAlong(ivec2(1, 0), pixel, d, p, n) + curvatureAlong(ivec2(0, 1), pixel, d, p, n));
    float vergence = imageVergence(away, image.hit, curvature, max(nv, 0.05)) * away / z;
    float polish = clamp((roughness - roughnessRange.x) / (roughnessRange.y - roughnessRange.x), 0.0, 1.0);
    float shows = polish * smoothstep(shareRange.x, shareRange.y, image.share);
    vec2 uv = pixelToUv(pixel, params.view.pixel);
    if (moves != 0u) {
        vec2 way = texelFetch(motion, pixel, 0).rg;
        vec2 itself = way - (uv - uvBefore(uv, d));
        bool turns = length(itself * params.view.size) >= own.x + own.y * length(way * params.view.size);
        if (upscaled != 0u && shows >= 0.5 && turns) {
            imageStore(shownMotion, pixel, vec4(outside, 0.0, 0.0));
        }
        shows = shows >= 0.5 && !turns ? 1.0 : 0.0;
    }
    if (shows <= 0.0) {
        return;
    }
    float imageZ = 1.0 / max(mix(1.0 / z, vergence, shows), 1e-6);
    vec4 k = params.view.depthToDistance;
    float depthOfImage = (k.x - imageZ * k.z) / (imageZ * k.w - k.y);
    imageStore(shownDepth, pixel, vec4(depthOfImage));
    if (moves != 0u) {
        imageStore(shownMotion, pixel, vec4(uv - uvBefore(uv, depthOfImage) + image.moved, 0.0, 0.0));
    }
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
    if (d <= 0.0 || m.roughness >= roughestImage || texelFetch(frontDepth, pixel, 0).r != d) {
        return;
    }
    vec3 p = positionAt(pixel, d);
    vec3 n = normalAt(pixel);
    float nv = dot(n, directionToEye(p, params.view.eye));
    Surface s = surfaceAt(pixel, texelFetch(baseColor, pixel, 0).rgb, m, nv, ggxTable, lambertOnly != 0u);
    showImage(pixel, d, p, n, nv, luminance(s.specular), m.roughness);
}
