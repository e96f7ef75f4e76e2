// The rule for shading normals that reflect below the surface, as steep normal maps and smooth normals of coarse meshes
// do at grazing views: the normal bends toward the geometric one until its mirror direction leaves the surface. The idea
// is that of A. Keller et al., The Iray Light Transport Simulation and Rendering System, 2017 (appendix A.3).
// src/reference/surface.cpp has the same rule.
#ifndef REFLET_SHADING_NORMAL_GLSL
#define REFLET_SHADING_NORMAL_GLSL

const float lowestMirror = 0.01;  // sine of the angle between surface and mirror direction; less for lower viewers

// n: shading normal; geometric: of the triangle, on the viewer's side. All unit.
vec3 consistentNormal(vec3 n, vec3 geometric, vec3 toViewer) {
    float height = max(dot(toViewer, geometric), 1e-4);  // 0 where triangles are seen edge-on
    float least = min(0.9 * height, lowestMirror);
    float upright = dot(n, geometric);
    if (upright > 0.0 && 2.0 * dot(n, toViewer) * upright - height >= least) {
        return n;
    }
    // In the plane of both normals the wanted one is halfway between the viewer and the lowest mirror direction.
    vec3 aside = n - upright * geometric;
    aside *= inversesqrt(max(dot(aside, aside), 1e-12));
    float x = dot(toViewer, aside);
    float mirrored = sqrt(max(x * x + height * height - least * least, 0.0));
    return normalize((x + mirrored) * aside + (height + least) * geometric);
}

#endif
