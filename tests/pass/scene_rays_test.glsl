// Traces rays: the body of both variants.
layout(local_size_x = 64) in;
layout(scalar) readonly buffer RayBlock { TestRay items[]; } rays;
layout(scalar) writeonly buffer HitBlock { TestHit items[]; } hits;

void main() {
    uint i = gl_GlobalInvocationID.x;
    if (i >= rays.items.length()) {
        return;
    }
    TestRay ray = rays.items[i];
    SceneHit hit = SceneHit(0.0, vec2(0.0), 0u);
    bool found = closestHit(ray.origin, ray.direction, ray.nearest, ray.farthest, hit);
    bool any = anyHit(ray.origin, ray.direction, ray.nearest, ray.farthest);
    SceneTriangle t = loadSceneTriangle(hit.triangle);
    hits.items[i] = TestHit(hit.distance, hit.barycentrics, t.instance, t.firstIndex, uint(found), uint(any));
}
