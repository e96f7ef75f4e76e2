// Contact shadows: a short march through the depth buffer toward the sun, for casters too small, or too near to what
// they shadow, for the shadow map's texels. Shared by C++ and GLSL.
#ifndef REFLET_RENDER_CONTACT_H
#define REFLET_RENDER_CONTACT_H

#include "base/shared.h"
#include "render/view.h"

SHARED_BEGIN

// `distance`, and not `length`: glslc takes a member of that name for the built-in function.
#define CONTACT_SETTINGS(VALUE, SWITCH, CHOICE)                                                                      \
    VALUE(float, distance, 0.0, 0.0, 10.0,                                                                           \
          "Length of contact shadow rays in metres: a screen-space ray march toward the sun, for casters too small " \
          "for the shadow map. Works with any shadow.filter. 0: off.")                                               \
    VALUE(float, thickness, 0.02, 0.001, 1000.0,                                                                     \
          "Assumed thickness of casters in metres along the view. Too small: gaps in contact shadows; too large: "   \
          "false shadows.")                                                                                          \
    VALUE(uint, maxSteps, 64, 1, 4096,                                                                               \
          "Maximum steps of a contact shadow ray; a ray that runs out of steps leaves the pixel lit.")
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
