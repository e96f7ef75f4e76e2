// Ray traversal of a bounding volume hierarchy (scene/bvh.h) with a short stack, nearer child first.
// S. Woop, C. Benthin, I. Wald, "Watertight Ray/Triangle Intersection", 2013: no misses at edges shared by triangles.
// T. Ize, "Robust BVH Ray Traversal", 2013: no misses at the bounds of boxes.
//
// The includer defines, before it includes this:
//     BvhNode loadBvhNode(uint node)
//     SceneTriangle loadSceneTriangle(uint triangle)
//     const bool testEveryHit: call acceptHit for every triangle; if false, only for those with triangleCutOut
//     bool acceptHit(uint triangle, vec2 barycentrics, vec3 direction): false: the ray continues
// Surfaces block light from both sides, as in the reference; only alpha cutouts let it pass. Distances are in units of
// the direction's length; `nearest` must not be negative. Barycentrics are the weights of the second and third vertex.
#ifndef REFLET_BVH_GLSL
#define REFLET_BVH_GLSL

#include "renderer/trace_scene/scene_hit.glsl"

// A ray with the values that the intersection tests need.
struct BvhRay {
    vec3 origin;
    vec3 direction;
    vec3 inverse;  // 1 / direction, finite
    int axis;      // largest component of the direction
    vec2 shear;    // maps the direction onto that axis
};

// Permutes components so that the ray's dominant axis becomes z.
vec3 longestAxisAsZ(vec3 v, int axis) { return axis == 0 ? v.yzx : axis == 1 ? v.zxy : v; }

BvhRay makeBvhRay(vec3 origin, vec3 direction) {
    vec3 size = abs(direction);
    int axis = size.x > size.y ? (size.x > size.z ? 0 : 2) : (size.y > size.z ? 1 : 2);
    vec3 last = longestAxisAsZ(direction, axis);
    // Components near 0 are replaced by tiny ones, so that the inverse stays finite.
    vec3 safe = mix(direction, mix(vec3(1e-18), vec3(-1e-18), lessThan(direction, vec3(0.0))),
                    lessThan(size, vec3(1e-18)));
    return BvhRay(origin, direction, 1.0 / safe, axis, last.xy / last.z);
}

// Distance at which the ray enters a box, or infinity.
float intersectBox(BvhRay ray, vec3 low, vec3 high, float nearest, float farthest) {
    vec3 a = (low - ray.origin) * ray.inverse;
    vec3 b = (high - ray.origin) * ray.inverse;
    vec3 first = min(a, b);
    vec3 last = max(a, b);
    float enter = max(max(first.x, first.y), max(first.z, nearest));
    // Rounding margin 1 + 2 gamma(3): no box is missed if a triangle inside it is hit.
    float leave = min(min(last.x, last.y), min(last.z, farthest)) * 1.0000004;
    return enter <= leave ? enter : 1.0 / 0.0;
}

// `precise` forbids fused operations, so both triangles of a shared edge round the same way. Rounding is monotonic: an
// edge function can become 0, which counts as inside for both triangles, but never gets the wrong sign.
bool intersectTriangle(BvhRay ray, SceneTriangle t, float nearest, float farthest, out vec3 hit) {
    precise vec3 a = longestAxisAsZ(t.a - ray.origin, ray.axis);
    precise vec3 b = longestAxisAsZ(t.b - ray.origin, ray.axis);
    precise vec3 c = longestAxisAsZ(t.c - ray.origin, ray.axis);
    precise vec2 as = a.xy - ray.shear * a.z;
    precise vec2 bs = b.xy - ray.shear * b.z;
    precise vec2 cs = c.xy - ray.shear * c.z;
    precise float u = cs.x * bs.y - cs.y * bs.x;
    precise float v = as.x * cs.y - as.y * cs.x;
    precise float w = bs.x * as.y - bs.y * as.x;
    float sum = u + v + w;
    bool inside = (min(u, min(v, w)) >= 0.0 || max(u, max(v, w)) <= 0.0) && sum != 0.0;
    // Distance to the triangle's plane: for thin triangles far more accurate than interpolated vertex depths.
    vec3 normal = cross(t.b - t.a, t.c - t.a);
    float distance = dot(normal, t.a - ray.origin) / dot(normal, ray.direction);
    hit = vec3(distance, vec2(v, w) / sum);
    return inside && hit.x >= nearest && hit.x <= farthest;
}

bool intersectLeaf(BvhRay ray, uint leaf, float nearest, bool first, inout SceneHit hit) {
    uint begin = leaf & bvhFirstMask;
    uint end = begin + ((leaf & ~bvhLeaf) >> bvhCountShift) + 1u;
    bool any = false;
    for (uint i = begin; i < end; ++i) {
        SceneTriangle t = loadSceneTriangle(i);
        vec3 at;
        if (intersectTriangle(ray, t, nearest, hit.distance, at)) {
            bool tests = testEveryHit || (t.flags & triangleCutOut) != 0u;
            if (!tests || acceptHit(i, at.yz, ray.direction, first)) {
                hit = SceneHit(at.x, at.yz, i);
                any = true;
            }
        }
    }
    return any;
}

const uint bvhNothing = 0xFFFFFFFFu;  // no child has this number

// Down to the next leaf before any triangle is tested: rays of a group, which run in step, reach their leaves together.
// (T. Aila and S. Laine, "Understanding the Efficiency of Ray Traversal on GPUs", 2009.)
bool traverseBvh(vec3 origin, vec3 direction, float nearest, float farthest, bool first, out SceneHit hit) {
    BvhRay ray = makeBvhRay(origin, direction);
    hit = SceneHit(farthest, vec2(0.0), 0u);
    bool any = false;
    uint stack[bvhMaxDepth];
    uint waiting = 0u;
    uint at = 0u;
    for (;;) {
        while ((at & bvhLeaf) == 0u) {
            BvhNode node = loadBvhNode(at);
            float left = intersectBox(ray, node.leftMin, node.leftMax, nearest, hit.distance);
            float right = intersectBox(ray, node.rightMin, node.rightMax, nearest, hit.distance);
            bool hitsLeft = left < 1.0 / 0.0;
            bool hitsRight = right < 1.0 / 0.0;
            bool leftFirst = hitsLeft && (left <= right || !hitsRight);
            if (hitsLeft || hitsRight) {
                at = leftFirst ? node.left : node.right;
                if (hitsLeft && hitsRight) {
                    stack[waiting++] = leftFirst ? node.right : node.left;
                }
            } else {
                at = waiting > 0u ? stack[--waiting] : bvhNothing;
            }
        }
        if (at == bvhNothing) {
            return any;
        }
        any = intersectLeaf(ray, at, nearest, first, hit) || any;
        if (waiting == 0u || (first && any)) {
            return any;
        }
        at = stack[--waiting];
    }
}

// The nearest hit in [nearest, farthest].
bool closestHit(vec3 origin, vec3 direction, float nearest, float farthest, out SceneHit hit) {
    return traverseBvh(origin, direction, nearest, farthest, false, hit);
}

// Whether there is any hit in [nearest, farthest].
bool anyHit(vec3 origin, vec3 direction, float nearest, float farthest) {
    SceneHit hit;
    return traverseBvh(origin, direction, nearest, farthest, true, hit);
}

#endif
