// Hardware ray tracing (GL_EXT_ray_query, which the includer requires). Bindings 24
// and 25 of set 0: SceneRays::bind.
// The includer defines testEveryHit and acceptHit (renderer/trace_scene/bvh.glsl), after scene_triangles.glsl, before this.
#ifndef REFLET_SCENE_RAYS_QUERY_GLSL
#define REFLET_SCENE_RAYS_QUERY_GLSL

#include "renderer/trace_scene/scene_triangles.glsl"

uniform accelerationStructureEXT sceneHierarchy;

// If some triangles are alpha-tested, the structure reports all triangles as candidates.
bool acceptCandidate(uint triangle, vec2 barycentrics, vec3 direction, bool first) {
    bool tests = testEveryHit || (loadSceneTriangle(triangle).flags & triangleCutOut) != 0u;
    return !tests || acceptHit(triangle, barycentrics, direction, first);
}

bool queryScene(vec3 origin, vec3 direction, float nearest, float farthest, uint flags, out SceneHit hit) {
    hit = SceneHit(farthest, vec2(0.0), 0u);
    if (!(nearest <= farthest)) {
        return false;
    }
    bool first = flags != 0u;
    rayQueryEXT query;
    rayQueryInitializeEXT(query, sceneHierarchy, flags | (testEveryHit ? gl_RayFlagsNoOpaqueEXT : gl_RayFlagsNoneEXT),
                          0xFFu, origin, nearest, direction, farthest);
    while (rayQueryProceedEXT(query)) {
        uint triangle = uint(rayQueryGetIntersectionPrimitiveIndexEXT(query, false));
        if (acceptCandidate(triangle, rayQueryGetIntersectionBarycentricsEXT(query, false), direction, first)) {
            rayQueryConfirmIntersectionEXT(query);
        }
    }
    if (rayQueryGetIntersectionTypeEXT(query, true) == gl_RayQueryCommittedIntersectionNoneEXT) {
        return false;
    }
    hit.distance = rayQueryGetIntersectionTEXT(query, true);
    hit.barycentrics = rayQueryGetIntersectionBarycentricsEXT(query, true);
    hit.triangle = uint(rayQueryGetIntersectionPrimitiveIndexEXT(query, true));
    return true;
}

// The closest hit between the two distances.
bool closestHit(vec3 origin, vec3 direction, float nearest, float farthest, out SceneHit hit) {
    return queryScene(origin, direction, nearest, farthest, 0u, hit);
}

// Whether there is any hit between the two distances.
bool anyHit(vec3 origin, vec3 direction, float nearest, float farthest) {
    SceneHit hit;
    return queryScene(origin, direction, nearest, farthest, gl_RayFlagsTerminateOnFirstHitEXT, hit);
}

#endif
