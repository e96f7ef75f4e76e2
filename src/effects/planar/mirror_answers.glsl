// Radiance from planar reflection images. The includer is trace_screen.comp, which declares params, the planar view's
// images and functions that read its light.
#ifndef REFLET_MIRROR_ANSWERS_GLSL
#define REFLET_MIRROR_ANSWERS_GLSL

const float mirrorSlack = 2e-4;   // metres off the plane per metre from the camera: limit of the depth buffer's precision
const float mirrorCosine = 0.999;  // between the plane's normal and the surface's

bool liesOnMirror(vec3 p, vec3 n) {
    vec4 plane = params.mirror.plane;
    float away = dot(params.own.viewPlane, vec4(p, 1.0));
    return abs(dot(plane, vec4(p, 1.0))) < params.mirror.tolerance + mirrorSlack * max(away, 1.0) &&
           abs(dot(plane.xyz, n)) > mirrorCosine;
}

vec2 uvOf(vec4 pointW) {
    vec4 clip = params.view.worldToClip * pointW;
    return ndcToUv(clip.xy / max(clip.w, 1e-12));
}

bool isInside(vec2 uv) { return all(greaterThanEqual(uv, vec2(0.0))) && all(lessThan(uv, vec2(1.0))); }

// Planar images of lower resolution than the screen are interpolated, others are read by nearest pixel.
vec3 lightOfMirror(vec2 uv, float width) {
    if (width > 1.0 || params.view.pixelAngle > 1.01 * params.own.pixelAngle) {
        return blurredLight(uv * params.view.size, cones != 0u ? width : 1.0, ivec2(params.view.size));
    }
    return loadLight(ivec2(uv * params.view.size), 0);
}

// Radiance of a hit; or of the sky, if the ray reached its end without a hit and the planar image shows the sky there
// (the image contains the environment as its background).
RayAnswer shadeMirrorHit(MarchResult hit, vec3 p, Ray ray) {
    if (hit.outcome == marchHit) {
        vec2 uv = uvOf(vec4(p + ray.direction * hit.distance, 1.0));
        uv = clamp(uv, vec2(hit.pixel) * params.view.pixel, (vec2(hit.pixel) + 0.999) * params.view.pixel);
        return RayAnswer(lightOfMirror(uv, widthOfHit(ray.spread, hit)), 1.0, hit.distance);
    }
    vec2 uv = uvOf(vec4(ray.direction, 0.0));
    bool sky = hit.outcome == marchLimitReached && !hit.occluded && hit.distance > 0.99 * params.longest &&
               isInside(uv) &&
               loadDepth(ivec2(uv * params.view.size)) <= 0.0;
    if (!sky) {
        return noAnswer;
    }
    float angle = coneWidth * ggxConeTangent(ray.spread * ray.spread) / params.view.pixelAngle;
    return RayAnswer(lightOfMirror(uv, ray.spread > 0.0 ? angle : 1.0), 1.0, environmentDistance);
}

// Metres from a point to the surface that the planar image shows at uv.
float distanceTo(vec2 uv, vec3 from) {
    float d = loadDepth(ivec2(uv * params.view.size));
    return d > 0.0 ? distance(from, uvToWorld(uv, d, params.view.clipToWorld)) : environmentDistance;
}

// Form lookup: the planar image at the pixel itself, regardless of its normal and roughness.
RayAnswer lookUpMirror(vec3 p) {
    vec2 uv = uvOf(vec4(p, 1.0));
    return isInside(uv) ? RayAnswer(lightOfMirror(uv, 1.0), 1.0, distanceTo(uv, p)) : noAnswer;
}

// Form camera: an image stretched over the mirror's rectangle, flipped left to right.
RayAnswer lookUpCamera(vec3 p) {
    vec3 fromCenter = p - params.mirror.center;
    vec2 across = vec2(dot(fromCenter, params.mirror.right), dot(fromCenter, params.mirror.up));
    vec2 uv = 0.5 - 0.5 * across / params.mirror.halfSize;
    if (!isInside(uv)) {
        return noAnswer;
    }
    vec3 radiance = blurredLight(uv * params.view.size, params.mirror.blur, ivec2(params.view.size));
    return RayAnswer(radiance, 1.0, distanceTo(uv, params.mirror.center));
}

#endif
