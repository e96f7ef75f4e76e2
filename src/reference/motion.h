// Motion vectors of the camera's view, found by ray casting.
#pragma once

#include "base/image_file.h"
#include "reference/ray_scene.h"

namespace reflet {

/// Both images are sampled through a pinhole at pixel centres.
struct MotionImages {
    FloatImage motion;         ///< "X" "Y": uv minus uv in the frame before, like the renderer's motion vectors; in the
                               ///< background, motion by camera rotation
    FloatImage previousDepth;  ///< "Y": metres in front of the previous camera, of the same surface point; 0 in the
                               ///< background
};

/// now, before: one scene at two times, with the same instances and triangles; may be the same object. Both views are
/// posed. A surface that was behind the previous camera has a motion of 0 and a depth that is not positive.
MotionImages traceMotion(const RayScene& now, const View& seen, const RayScene& before, const View& seenBefore,
                         uvec2 size);

}  // namespace reflet
