// Contact shadows: a short screen-space ray march toward a light, for casters too small, or too close to the receiver,
// for the shadow map's resolution. Shared by C++ and GLSL.
#ifndef REFLET_EFFECTS_CONTACT_H
#define REFLET_EFFECTS_CONTACT_H

#include "base/shared.h"
#include "effects/view.h"

SHARED_BEGIN

// `distance`, not `length`: glslc confuses a member of that name with the built-in function.
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
    vec4 light;  // world space: unit direction toward the light and 0, or its position [m] and 1
};

SHARED_END

#ifdef __cplusplus

#include "effects/gbuffer/gbuffer.h"
#include "gpu/pass_list.h"

namespace reflet {

/// R8, 1: lit: the minimum of `byMap` (visibility by the shadow map) and the contact shadow. pyramid: from makePyramid.
gpu::Image contactShadow(gpu::PassList& f, const GBuffer& g, gpu::Image pyramid, gpu::Image byMap,
                         const ContactParams& params);

}  // namespace reflet
#endif

#endif
