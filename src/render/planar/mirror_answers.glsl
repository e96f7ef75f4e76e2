// What a mirror's picture answers. The includer has what trace_screen.comp has: params, the picture's images, and
// functions to read its light.
#ifndef REFLET_MIRROR_ANSWERS_GLSL
#define REFLET_MIRROR_ANSWERS_GLSL

const float mirrorSlack = 2e-4;   // metres off the plane per metre from the camera: what depth cannot tell
const float mirrorCosine = 0.999; // between the plane's normal and the surface's

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

// Smaller pictures than the screen are read between their pixels; one as large pixel by pixel.
vec3 lightOfMirror(vec2 uv, float width) {
    if (width > 1.0 || params.view.pixelAngle > 1.01 * params.own.pixelAngle) {
        return blurredLight(uv * params.view.size, cones != 0u ? width : 1.0, ivec2(params.view.size));
    }
    return loadLight(ivec2(uv * params.view.size), 0);
}

// A hit; or the sky, if the ray has come to its end without meeting anything and sees it there. The picture has the
// environment behind everything.
RayAnswer shadeMirrorHit(MarchResult hit, vec3 p, Ray ray) {
    if (hit.outcome == marchHit) {
        vec2 uv = uvOf(vec4(p + ray.direction * hit.distance, 1.0));
        uv = clamp(uv, vec2(hit.pixel) * params.view.pixel, (vec2(hit.pixel) + 0.999) * params.view.pixel);
        return RayAnswer(lightOfMirror(uv, widthOfHit(ray.spread, hit)), 1.0, hit.distance);
    }
    vec2 uv = uvOf(vec4(ray.direction, 0.0));
    bool sky = hit.outcome == marchSpent && !hit.lost && hit.distance > 0.99 * params.longest && isInside(uv) &&
               loadDepth(ivec2(uv * params.view.size)) <= 0.0;
    if (!sky) {
        return noAnswer;
    }
    float angle = coneWidth * ggxHalfTangent(ray.spread * ray.spread) / params.view.pixelAngle;
    return RayAnswer(lightOfMirror(uv, ray.spread > 0.0 ? angle : 1.0), 1.0, environmentDistance);
}

// Metres from a point to what the picture shows there.
float distanceTo(vec2 uv, vec3 from) {
    float d = loadDepth(ivec2(uv * params.view.size));
    return d > 0.0 ? distance(from, uvToWorld(uv, d, params.view.clipToWorld)) : environmentDistance;
}

// The picture at the pixel itself, whatever the normal and the roughness there.
RayAnswer lookUpMirror(vec3 p) {
    vec2 uv = uvOf(vec4(p, 1.0));
    return isInside(uv) ? RayAnswer(lightOfMirror(uv, 1.0), 1.0, distanceTo(uv, p)) : noAnswer;
}

// A picture that is stretched over the mirror's rectangle, turned left to right.
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
