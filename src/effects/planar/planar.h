// Planar reflections as a ray source: the scene rendered again from a camera mirrored in the plane of a flat mirror.
// Also three older forms that do not trace rays. Shared by C++ and GLSL.
#ifndef REFLET_EFFECTS_PLANAR_H
#define REFLET_EFFECTS_PLANAR_H

#include "base/shared.h"

SHARED_BEGIN

#define PLANAR_FORMS(OPTION)         \
    OPTION(PlanarForm, traced, 0)    \
    OPTION(PlanarForm, lookup, 1)    \
    OPTION(PlanarForm, duplicate, 2) \
    OPTION(PlanarForm, camera, 3)
CHOICES(PlanarForm, PLANAR_FORMS)

#define PLANAR_SETTINGS(VALUE, SWITCH, CHOICE)                                                                         \
    SWITCH(enabled, 0,                                                                                                 \
           "Planar reflections: render the scene again for flat mirrors and use these views for reflections.")         \
    CHOICE(PlanarForm, form, traced,                                                                                   \
           "Planar reflection technique. traced: rays are marched through the mirrored camera's depth buffer. "        \
           "lookup: the mirrored camera's image at the same pixel. duplicate: a mirrored copy of the scene behind "    \
           "the mirror, seen through it. camera: "                                                                     \
           "the image of one fixed camera at the mirror's centre.")                                                    \
    VALUE(uint, count, 1, 0, 4,                                                                                        \
          "Maximum number of planar reflections per frame; the mirrors largest on screen are chosen. Each renders "    \
          "the scene once more.")                                                                                      \
    SWITCH(beforeScreen, 1,                                                                                            \
           "Use planar reflections before screen-space reflections. Off: after them, only for misses.")                \
    SWITCH(autoDetect, 1, "Detect flat, smooth surfaces as mirrors if the view file lists none.")                      \
    VALUE(float, maxRoughness, 0.2, 0.0, 1.0, "Highest mean roughness of a surface that is detected as a mirror.")     \
    VALUE(float, scale, 1.0, 0.25, 1.0,                                                                                \
          "Resolution of planar reflections along each side, relative to the screen. Lower: blurrier, faster.")        \
    VALUE(float, margin, 0.05, 0.0, 1.0,                                                                               \
          "How far a planar view extends beyond its mirror, as a fraction of the screen's height. Rays of rough or "   \
          "bumpy mirrors need it.")                                                                                    \
    SWITCH(diffuse, 1, "Compute diffuse GI in planar views, unless trace_screen.light is direct.")                     \
    SWITCH(specular, 1,                                                                                                \
           "Compute reflections in planar views too (mirrors in mirrors), without further planar reflections. Not if " \
           "trace_screen.light is direct.")                                                                            \
    VALUE(uint, cameraSize, 128, 8, 1024, "Height of the camera's image in pixels (form camera).")                     \
    VALUE(float, cameraFov, 75.0, 10.0, 150.0, "Vertical field of view of the camera in degrees (form camera).")       \
    VALUE(float, cameraBlur, 3.0, 1.0, 64.0, "Width of the blur of the camera's image in pixels (form camera).")
SETTINGS(PlanarSettings, PLANAR_SETTINGS)

// A planar mirror, for rays that start on it.
struct MirrorParams {
    vec4 plane;   // dot(plane, (p, 1)): metres in front of it
    vec3 center;  // of the mirror's bounding rectangle
    vec3 right;   // unit, as seen from its front
    vec3 up;
    vec2 halfSize;    // metres
    float tolerance;  // metres from the plane within which points count as on it
    float blur;       // form camera: pixels
};

SHARED_END

#endif
