// Object motion from the motion vectors of the G-buffer: the world-space displacement of a surface, and the motion of
// its mirror image.
#ifndef REFLET_OBJECT_MOTION_GLSL
#define REFLET_OBJECT_MOTION_GLSL

#include "shaders/projection.glsl"

// Rounding error of half floats: relative to a motion, and absolute [uv].
const vec2 motionRounding = vec2(1.0 / 512.0, 1e-5);

// World-space displacement since the last frame of the point p that is seen at uv. motion: of the G-buffer; uv, and
// metres along `forward`, the camera's axis (unit). Exactly 0 for static objects.
vec3 objectDisplacement(vec3 p, vec2 uv, vec3 motion, mat4 previousWorldToClip, vec3 forward) {
    vec4 still = previousWorldToClip * vec4(p, 1.0);
    vec2 before = uvToNdc(uv - motion.xy);
    // (p - displacement) was seen at `before`, and motion.z metres nearer: the intersection of three planes.
    mat4 rows = transpose(previousWorldToClip);
    vec3 x = rows[0].xyz - before.x * rows[3].xyz;
    vec3 y = rows[1].xyz - before.y * rows[3].xyz;
    vec2 off = still.xy - before * still.w;
    vec2 least = 2.0 * (motionRounding.x * abs(motion.xy) + motionRounding.y) * abs(still.w);
    float volume = dot(x, cross(y, forward));
    if ((motion.z == 0.0 && all(lessThan(abs(off), least))) || volume == 0.0) {
        return vec3(0.0);
    }
    return (off.x * cross(y, forward) + off.y * cross(forward, x) + motion.z * cross(x, y)) / volume;
}

// Motion [uv] of an object's mirror image, beyond that of a static object. toEye, toThing: unit, from a point p of the
// mirror. displacement: of the object, which is `away` metres from p. The image of a flat mirror lies behind it and its
// motion is mirrored. Curved and rough mirrors are treated as flat.
vec2 mirroredMotion(vec3 p, vec3 toEye, vec3 toThing, float away, vec3 displacement, mat4 previousWorldToClip) {
    if (displacement == vec3(0.0)) {
        return vec2(0.0);
    }
    vec3 n = toEye + toThing;  // along the mirror's normal
    vec3 moved = displacement - n * (2.0 * dot(n, displacement) / max(dot(n, n), 1e-12));
    vec3 image = p - toEye * away;
    vec4 still = previousWorldToClip * vec4(image, 1.0);
    vec4 before = previousWorldToClip * vec4(image - moved, 1.0);
    if (still.w <= 0.0 || before.w <= 0.0) {
        return vec2(0.0);
    }
    return clamp(ndcToUv(still.xy / still.w) - ndcToUv(before.xy / before.w), -1.0, 1.0);
}

#endif
