// Order of the thread groups of full-screen passes whose threads read far around their pixel: in strips, from top to
// bottom, so that what neighbouring groups read stays in the cache. In rows across the whole image, a core with 1 MB of
// cache would read a depth buffer of 1280x720 pixels from memory again and again. Shared by C++ and GLSL.
#ifndef REFLET_BASE_STRIPS_H
#define REFLET_BASE_STRIPS_H

#include "base/shared.h"

SHARED_BEGIN

const uint stripWidth = 64;  // pixels

SHARED_END

#ifndef __cplusplus
// The pixel of a thread of a pass that is recorded by Pass::dispatchStrips.
ivec2 pixelInStrips() {
    return ivec2(gl_GlobalInvocationID.xy) + ivec2(gl_WorkGroupID.z * stripWidth, 0);
}
#endif

#endif
