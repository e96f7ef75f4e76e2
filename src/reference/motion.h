// Motion vectors of what the camera sees, found by rays.
#pragma once

#include "base/image_file.h"
#include "reference/ray_scene.h"

namespace reflet {

/// Both through a pinhole at pixel centres.
struct MotionImages {
    FloatImage motion;         ///< "X" "Y": uv minus uv in the frame before, as the renderer's motion vectors; of the
                               ///< background as the camera turns
    FloatImage previousDepth;  ///< "Y": metres in front of the camera before that the same point of the surface had, 0
                               ///< in the background
};

/// now, before: one scene at two times, with the same instances and triangles; may be the same object. Both views
/// posed. A surface that was behind the camera before has a motion of 0 and a depth that is not positive.
MotionImages traceMotion(const RayScene& now, const View& seen, const RayScene& before, const View& seenBefore,
                         uvec2 size);

}  // namespace reflet
