// Surfaces hit by camera rays through pixel centres.
#version 460
#extension GL_EXT_scalar_block_layout : require
#include "renderer/trace_scene/scene_surfaces.glsl"
#include "renderer/trace_scene/scene_rays.glsl"
#include "scene_surfaces_test.h"
#include "shaders/projection.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
layout(scalar) uniform ParamsBlock {
    SceneSurfacesTestParams params;
};
layout(scalar) buffer OutputBlock {
    SurfaceOfPixel items[];
}
outputs;

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(pixel, ivec2(params.view.size)))) {
        return;
    }
    vec3 ahead = uvToWorld(pixelToUv(pixel, params.view.pixel), 0.5, params.view.clipToWorld);
    vec3 direction = normalize(ahead - params.view.eye.xyz);
    SurfaceOfPixel result = SurfaceOfPixel(vec3(0.0), 0.0, vec3(0.0), 0.0, vec3(0.0), 0.0, 0.0);
    SceneHit hit;
    if (closestHit(params.view.eye.xyz, direction, 0.0, 1e30, hit)) {
        SceneSurface s = sceneSurface(hit, direction, params.widthPerPixel * params.view.pixelAngle * hit.distance);
        result = SurfaceOfPixel(s.baseColor, s.roughness, s.normal, s.metallic, s.emissive, s.occlusion,
                                dot(params.view.viewPlane, vec4(s.position, 1.0)));
    }
    outputs.items[uint(pixel.y) * uint(params.view.size.x) + uint(pixel.x)] = result;
}
