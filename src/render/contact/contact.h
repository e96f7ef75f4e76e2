// Contact shadows: a short march through the depth buffer toward the sun, for casters too small, or too near to what
// they shadow, for the shadow map's texels. Shared by C++ and GLSL.
#ifndef REFLET_RENDER_CONTACT_H
#define REFLET_RENDER_CONTACT_H

#include "base/shared.h"
#include "render/view.h"

SHARED_BEGIN

// `distance`, and not `length`: glslc takes a member of that name for the built-in function.
#define CONTACT_SETTINGS(VALUE, SWITCH, CHOICE)                                                                        \
    VALUE(float, distance, 0.0, 0.0, 10.0,                                                                             \
          "How far toward the sun the screen is searched for casters that the shadow map misses, in metres, whatever " \
          "shadow.filter is; 0: not at all.")                                                                          \
    VALUE(float, thickness, 0.02, 0.001, 1000.0, "How thick casters are taken to be, in metres along the view.")       \
    VALUE(uint, maxSteps, 64, 1, 4096, "Steps of the search; one that has taken them all has found nothing.")
SETTINGS(ContactSettings, CONTACT_SETTINGS)

struct ContactParams {
    ViewParams view;
    ContactSettings settings;
    vec3 toSun;  // world space, unit
};

SHARED_END

#ifdef __cplusplus

#include "gpu/frame.h"
#include "render/gbuffer/gbuffer.h"

namespace reflet {

/// R8, 1: lit: the lesser of `sunVisibility`, by the shadow map, and of what a march toward the sun finds. pyramid: of
/// makePyramid.
gpu::Image contactShadow(gpu::Frame& f, const GBuffer& g, gpu::Image pyramid, gpu::Image sunVisibility,
                         const ContactParams& params);

}  // namespace reflet
#endif

#endif
