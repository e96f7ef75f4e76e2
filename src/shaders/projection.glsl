// Transforms between pixels, clip space and world space. Reversed depth: 1 near, 0 at infinity; uv (0,0) is the top
// left corner.
#ifndef REFLET_PROJECTION_GLSL
#define REFLET_PROJECTION_GLSL

vec2 uvToNdc(vec2 uv) { return 2.0 * uv - 1.0; }
vec2 ndcToUv(vec2 ndc) { return 0.5 * ndc + 0.5; }

vec2 pixelToUv(ivec2 pixel, vec2 pixelSize) { return (vec2(pixel) + 0.5) * pixelSize; }

// World position at this uv with the depth of the depth buffer. Requires depth > 0: the sky has no position.
vec3 uvToWorld(vec2 uv, float depth, mat4 clipToWorld) {
    vec4 p = clipToWorld * vec4(uvToNdc(uv), depth, 1.0);
    return p.xyz * (1.0 / p.w);
}

// Distance in front of the camera, along its axis [m]; very large for the sky.
float depthToViewDistance(float depth, vec4 depthToDistance) {
    float denominator = depthToDistance.z + depthToDistance.w * depth;
    return (depthToDistance.x + depthToDistance.y * depth) / max(denominator, 1e-20);
}

// Width of a pixel at the world position p [m]. viewPlane, eye, pixelAngle: of the view (effects/view.h).
float pixelWidth(vec3 p, vec4 viewPlane, vec4 eye, float pixelAngle) {
    return pixelAngle * (eye.w > 0.0 ? dot(viewPlane, vec4(p, 1.0)) : 1.0);
}

// The plane through p with normal n as coefficients f of (uv.x, uv.y, depth, 1): dot(f, …) > 0 on the side of n. The
// value is the height above the plane per metre from the camera (orthographic: the height).
vec4 planeOnScreen(vec3 p, vec3 n, mat4 clipToWorld) {
    vec4 onClip = vec4(n, -dot(n, p)) * clipToWorld;
    return vec4(2.0 * onClip.xy, onClip.z, onClip.w - onClip.x - onClip.y);
}

// Unit view direction through this uv. Computed from a point at infinity, where the camera's position cancels out; the
// difference to nearby points would lose precision.
vec3 viewDirection(vec2 uv, mat4 clipToWorld, vec4 eye) {
    vec4 p = clipToWorld * vec4(uvToNdc(uv), 0.0, 1.0);
    return eye.w > 0.0 ? normalize(p.xyz - eye.xyz * p.w) : -eye.xyz;
}

// Unit direction from the point toward the camera. eye: position with w = 1, or direction with w = 0.
vec3 directionToEye(vec3 positionW, vec4 eye) { return normalize(eye.xyz - positionW * eye.w); }

#endif
