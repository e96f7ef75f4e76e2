// Splits what mirrors and clear glass show: light that the first hit that is no mirror reflects from other surfaces, diffusely or
// by a rough lobe, is kept apart from the hit's reflectance, to be smoothed (smooth_hits.comp). The hit's own light, its textures
// and sharp reflections stay as they are.
#ifndef REFLET_SPLIT_HIT_GLSL
#define REFLET_SPLIT_HIT_GLSL

layout(constant_id = 6) const uint splitsHits = 0u;
const float splitRoughness = 0.1;      // rougher lobes are smoothed by the denoiser
const float smoothedRoughness = 0.15;  // of hits whose reflections are smoothed, too

// What is kept apart.
struct SplitHit {
    bool known;     // whether there is such light
    vec3 factor;    // on it
    vec3 normal;
    float away;     // of the hit from the eye [m]
    bool followed;  // whether the path goes on to what it comes from; else it finds none
    vec3 radiance;  // of the path until there
};

SplitHit noSplit() { return SplitHit(false, vec3(0.0), vec3(0.0), 0.0, false, vec3(0.0)); }

float largest(vec3 v) { return max(v.r, max(v.g, v.b)); }

// After the path has been scattered by a hit. before: the path until there.
void splitPath(inout Path path, Path before, LitPoint at, inout SplitHit split) {
    bool rough = at.surface.roughness >= smoothedRoughness;
    vec3 factor = before.throughput * (at.surface.diffuse + (rough ? at.surface.specular : vec3(0.0)));
    bool scattered = path.bounces > before.bounces;
    if (splitsHits == 0u || split.known || !scattered || before.ray.roughness > splitRoughness ||
        largest(factor) <= 0.0) {
        return;
    }
    factor = max(factor, 1e-3 * largest(factor));
    split = SplitHit(true, factor, at.normal, distance(at.position, params.view.eye.xyz), rough || path.diffuse, path.radiance);
    if (split.followed) {
        path.throughput /= factor;
        path.radiance = vec3(0.0);
    }
}

#endif
