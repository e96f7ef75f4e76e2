// The scene's triangles, by the index that ray hits report. Binding 25 of set 0: SceneRays::bind.
#ifndef REFLET_SCENE_TRIANGLES_GLSL
#define REFLET_SCENE_TRIANGLES_GLSL

#include "renderer/trace_scene/scene_hit.glsl"

layout(scalar) readonly buffer SceneTriangleBlock { SceneTriangle items[]; } sceneTriangles;

SceneTriangle loadSceneTriangle(uint triangle) { return sceneTriangles.items[triangle]; }

#endif
