// Emulates the precision of other depth buffer formats: fixed point with the near plane at 0 loses precision that
// reversed floats keep. For demonstration. Shared by C++ and GLSL.
#ifndef REFLET_EFFECTS_KEPT_DEPTH_H
#define REFLET_EFFECTS_KEPT_DEPTH_H

#include "base/shared.h"

SHARED_BEGIN

struct KeptDepthParams {
    float farDepth;  // reversed depth at the far plane
    float steps;     // highest integer value
    uvec2 size;
};

SHARED_END

#ifdef __cplusplus

#include "effects/view.h"
#include "gpu/pass_list.h"

namespace reflet {

// Not visible to shaders, where `buffer` is a reserved word.
#define DEPTH_BUFFERS(OPTION)             \
    OPTION(DepthBuffer, reversedFloat, 0) \
    OPTION(DepthBuffer, standard24, 1)    \
    OPTION(DepthBuffer, standard16, 2)
CHOICES(DepthBuffer, DEPTH_BUFFERS)

#define DEPTH_SETTINGS(VALUE, SWITCH, CHOICE)                                                                         \
    CHOICE(DepthBuffer, format, reversedFloat,                                                                        \
           "Depth buffer format, to show what its precision costs. reversed_float: 32-bit float, 1 at the near "      \
           "plane, 0 at infinity. standard24, standard16: unsigned integers of that many bits, 0 at the near plane, " \
           "maximum at 1000 m (orthographic: at the far plane).")
SETTINGS(DepthSettings, DEPTH_SETTINGS)

/// `depth` (reversed, 0: sky) after rounding to such a format, reversed again: R32F. With reversed_float:
/// `depth` itself, without a pass.
gpu::Image keptDepth(gpu::PassList& f, gpu::Image depth, const ViewParams& view, const DepthSettings& settings);

/// Parameters for a fixed-point format and the view.
KeptDepthParams keptDepthParams(const ViewParams& view, DepthBuffer buffer);

}  // namespace reflet
#endif

#endif
