// An image of a host's own light as a ray source: at each pixel the light of its lobe for rays that miss. Shared by C++
// and GLSL.
#ifndef REFLET_EFFECTS_ANSWER_IMAGE_H
#define REFLET_EFFECTS_ANSWER_IMAGE_H

#include "base/shared.h"

SHARED_BEGIN

struct AnswerImageParams {
    uint scale;        // of RaySurfaces
    uint blockOffset;  // of the picked pixel within its block, along each side
    float factor;      // from the image's unit to radiance
    float distance;    // told as hit distance [m]
};

SHARED_END

#ifdef __cplusplus

#include "effects/lobe/rays.h"
#include "gpu/pass_list.h"

namespace reflet {

/// Light of a lobe at each pixel of the full resolution: RGB: radiance / factor; alpha: confidence, 0 to 1.
struct LobeImage {
    gpu::Image light;
    float factor = 1.0F;
};

/// Gives every waiting ray the light of its pixel, by its confidence; the rest stays in rays.waiting. Rays that are
/// known to hit nothing are left to the environment.
void answerFromImage(gpu::PassList& f, Rays& rays, const LobeImage& image);

}  // namespace reflet
#endif

#endif
