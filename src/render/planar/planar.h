// Planar views as a source of the chain: what a flat mirror shows, drawn once more from behind it. Also the forms that
// this had before rays were traced. Shared by C++ and GLSL.
#ifndef REFLET_RENDER_PLANAR_H
#define REFLET_RENDER_PLANAR_H

#include "base/shared.h"

SHARED_BEGIN

#define PLANAR_FORMS(OPTION)         \
    OPTION(PlanarForm, traced, 0)    \
    OPTION(PlanarForm, lookup, 1)    \
    OPTION(PlanarForm, duplicate, 2) \
    OPTION(PlanarForm, camera, 3)
CHOICES(PlanarForm, PLANAR_FORMS)

#define PLANAR_SETTINGS(VALUE, SWITCH, CHOICE)                                                                    \
    SWITCH(enabled, 0, "Draw flat mirrors' views, and ask them what the screen could not answer.")                \
    CHOICE(PlanarForm, form, traced,                                                                              \
           "traced: rays go through the mirrored camera's depth; lookup: its picture at the pixel itself; "       \
           "duplicate: the room once more behind the mirror, as through a hole in the wall; camera: the picture " \
           "of one fixed camera at the mirror's centre.")                                                         \
    VALUE(uint, count, 1, 0, 4, "Views in a frame: of the mirrors that are largest on the screen.")               \
    SWITCH(beforeScreen, 1, "Ask mirrors' views before the screen; off: after it.")                               \
    SWITCH(autoDetect, 1, "Take flat, smooth surfaces for mirrors where the view file names none.")               \
    VALUE(float, maxRoughness, 0.2, 0.0, 1.0, "Mean roughness of what is found, at most.")                        \
    VALUE(float, scale, 1.0, 0.25, 1.0, "Pixels of a view along each side, of those that the screen has for it.") \
    VALUE(float, margin, 0.05, 0.0, 1.0,                                                                          \
          "How far a view goes beyond its mirror, in heights of the screen: rays of uneven mirrors end there.")   \
    SWITCH(diffuse, 1, "Light the views diffusely, too, where trace_screen.light is not direct.")                 \
    SWITCH(specular, 1, "And with reflections of the screen and the environment: mirrors in mirrors.")            \
    VALUE(uint, cameraSize, 128, 8, 1024, "Form camera: height of its picture in pixels.")                        \
    VALUE(float, cameraFov, 75.0, 10.0, 150.0, "Form camera: its field of view from bottom to top, in degrees.")  \
    VALUE(float, cameraBlur, 3.0, 1.0, 64.0, "Form camera: pixels of its picture that are blurred into one.")
SETTINGS(PlanarSettings, PLANAR_SETTINGS)

// A mirror as rays see it that start on it.
struct MirrorParams {
    vec4 plane;   // dot(plane, (p, 1)): metres in front of it
    vec3 center;  // of the rectangle around it
    vec3 right;   // unit, as seen from its front
    vec3 up;
    vec2 halfSize;    // metres
    float tolerance;  // metres from the plane that still lie on it
    float blur;       // form camera: pixels
};

SHARED_END

#endif
