// What a ray hits, through a bounding volume hierarchy (scene/bvh.h) with a short stack, nearer child first.
// S. Woop, C. Benthin, I. Wald, "Watertight Ray/Triangle Intersection", 2013: rays do not slip between triangles.
// T. Ize, "Robust BVH Ray Traversal", 2013: nor between boxes.
//
// The includer defines, before it includes this:
//     BvhNode loadBvhNode(uint node)
//     SceneTriangle loadSceneTriangle(uint triangle)
//     const bool askEveryHit: false: acceptHit is asked of triangles with triangleCutOut alone; true: of all
//     bool acceptHit(uint triangle, vec2 barycentrics, vec3 direction): false: the ray goes on through it
// Rays of light are stopped by both sides of every surface, as in the reference; only what is cut out lets them pass.
// Distances are in lengths of the direction; nearest is not negative. Barycentrics weigh the second and third corner.
#ifndef REFLET_BVH_GLSL
#define REFLET_BVH_GLSL

#include "shaders/scene_hit.glsl"

// A ray as the tests want it.
struct BvhRay {
    vec3 origin;
    vec3 direction;
    vec3 inverse;  // 1 / direction, finite
    int axis;      // along which the direction is longest
    vec2 shear;    // takes the direction to that axis
};

// x, y and the ray's longest axis, as z.
vec3 axisLast(vec3 v, int axis) { return axis == 0 ? v.yzx : axis == 1 ? v.zxy : v; }

BvhRay makeBvhRay(vec3 origin, vec3 direction) {
    vec3 size = abs(direction);
    int axis = size.x > size.y ? (size.x > size.z ? 0 : 2) : (size.y > size.z ? 1 : 2);
    vec3 last = axisLast(direction, axis);
    // A component near 0 is as good as a very small one: 1 / it stays finite.
    vec3 safe = mix(direction, mix(vec3(1e-18), vec3(-1e-18), lessThan(direction, vec3(0.0))),
                    lessThan(size, vec3(1e-18)));
    return BvhRay(origin, direction, 1.0 / safe, axis, last.xy / last.z);
}

// Where the ray enters a box; beyond `farthest`: it does not.
float enterBox(BvhRay ray, vec3 low, vec3 high, float nearest, float farthest) {
    vec3 a = (low - ray.origin) * ray.inverse;
    vec3 b = (high - ray.origin) * ray.inverse;
    vec3 first = min(a, b);
    vec3 last = max(a, b);
    float enter = max(max(first.x, first.y), max(first.z, nearest));
    // Rounding: 1 + 2 gamma(3), so that no box is missed whose triangle is hit.
    float leave = min(min(last.x, last.y), min(last.z, farthest)) * 1.0000004;
    return enter <= leave ? enter : 1.0 / 0.0;
}

// Rounded alike for both triangles of an edge: `precise` keeps it from being fused. A product that is larger is never
// rounded to one that is smaller, so the sign of an edge may become 0, which both sides count as theirs, but not wrong.
bool hitTriangle(BvhRay ray, SceneTriangle t, float nearest, float farthest, out vec3 hit) {
    precise vec3 a = axisLast(t.a - ray.origin, ray.axis);
    precise vec3 b = axisLast(t.b - ray.origin, ray.axis);
    precise vec3 c = axisLast(t.c - ray.origin, ray.axis);
    precise vec2 as = a.xy - ray.shear * a.z;
    precise vec2 bs = b.xy - ray.shear * b.z;
    precise vec2 cs = c.xy - ray.shear * c.z;
    precise float u = cs.x * bs.y - cs.y * bs.x;
    precise float v = as.x * cs.y - as.y * cs.x;
    precise float w = bs.x * as.y - bs.y * as.x;
    float sum = u + v + w;
    bool inside = (min(u, min(v, w)) >= 0.0 || max(u, max(v, w)) <= 0.0) && sum != 0.0;
    // Where the triangle's plane is: for thin triangles far more exact than the corners' weighted depths.
    vec3 normal = cross(t.b - t.a, t.c - t.a);
    float distance = dot(normal, t.a - ray.origin) / dot(normal, ray.direction);
    hit = vec3(distance, vec2(v, w) / sum);
    return inside && hit.x >= nearest && hit.x <= farthest;
}

bool hitLeaf(BvhRay ray, uint leaf, float nearest, inout SceneHit hit) {
    uint first = leaf & bvhFirstMask;
    uint end = first + ((leaf & ~bvhLeaf) >> bvhCountShift) + 1u;
    bool any = false;
    for (uint i = first; i < end; ++i) {
        SceneTriangle t = loadSceneTriangle(i);
        vec3 at;
        if (hitTriangle(ray, t, nearest, hit.distance, at)) {
            bool asks = askEveryHit || (t.flags & triangleCutOut) != 0u;
            if (!asks || acceptHit(i, at.yz, ray.direction)) {
                hit = SceneHit(at.x, at.yz, i);
                any = true;
            }
        }
    }
    return any;
}

bool traverseBvh(vec3 origin, vec3 direction, float nearest, float farthest, bool first, out SceneHit hit) {
    BvhRay ray = makeBvhRay(origin, direction);
    hit = SceneHit(farthest, vec2(0.0), 0u);
    bool any = false;
    uint stack[bvhMaxDepth];
    uint waiting = 0u;
    uint at = 0u;
    for (;;) {
        if ((at & bvhLeaf) != 0u) {
            any = hitLeaf(ray, at, nearest, hit) || any;
        } else {
            BvhNode node = loadBvhNode(at);
            float left = enterBox(ray, node.leftMin, node.leftMax, nearest, hit.distance);
            float right = enterBox(ray, node.rightMin, node.rightMax, nearest, hit.distance);
            bool hitsLeft = left < 1.0 / 0.0;
            bool hitsRight = right < 1.0 / 0.0;
            if (hitsLeft || hitsRight) {
                bool leftFirst = hitsLeft && (left <= right || !hitsRight);
                at = leftFirst ? node.left : node.right;
                if (hitsLeft && hitsRight) {
                    stack[waiting++] = leftFirst ? node.right : node.left;
                }
                continue;
            }
        }
        if (waiting == 0u || (first && any)) {
            return any;
        }
        at = stack[--waiting];
    }
}

// The nearest triangle between the two distances, both included.
bool closestHit(vec3 origin, vec3 direction, float nearest, float farthest, out SceneHit hit) {
    return traverseBvh(origin, direction, nearest, farthest, false, hit);
}

// Whether there is one.
bool anyHit(vec3 origin, vec3 direction, float nearest, float farthest) {
    SceneHit hit;
    return traverseBvh(origin, direction, nearest, farthest, true, hit);
}

#endif
