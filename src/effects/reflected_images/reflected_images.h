// Virtual images in smooth surfaces: the depth and the motion of the reflected image, in place of the surface's, where
// most of a pixel's light is reflected. A lens focuses on that image, and temporal reprojection follows it. Shared by
// C++ and GLSL.
//
// A mirror shows an image at the hit distance behind it, a curved one nearer (mirror equation; E. Hecht, Optics, 5.4).
// The image moves as if it were a thing there, plus what the reflected thing moved itself (LobeLight::imageMotion;
// after Stachowiak, Stochastic Screen-Space Reflections, SIGGRAPH 2015, who reprojects by hit distance). Surfaces that
// move themselves keep their own motion: what a turning mirror shows moves otherwise.
#ifndef REFLET_EFFECTS_REFLECTED_IMAGES_H
#define REFLET_EFFECTS_REFLECTED_IMAGES_H

#include "base/shared.h"
#include "effects/view.h"

SHARED_BEGIN

// Perceptual roughness from which a surface shows no image.
const float roughestImage = 0.4;

struct PolishedTilesParams {
    uvec2 size;  // of the depth buffer
};

struct ReflectedImagesParams {
    ViewParams view;
    mat4 toPrevious;           // clip space to the last frame's clip space, of what is at rest
    uint specularBlockOffset;  // blockPixelOffset of the lobe
};

SHARED_END

#ifdef __cplusplus

#include "effects/lobe/rays.h"
#include "gpu/pass_list.h"

namespace reflet {

/// Reflected light per pixel, of the size of the depth.
struct Reflections {
    GBuffer g;
    LobeLight specular;
    gpu::Image lit;  ///< RGBA16F: the sum of all light, not antialiased
    gpu::Image ggxTable;
    bool lambertOnly = false;  ///< MaterialsSettings
    bool upscaled = false;     ///< antialiasing has several pixels for one of these
};

/// Depth and motion of what a pixel shows: its surface, or a reflected image.
struct ShownImages {
    gpu::Image depth;   ///< reversed; of the picture without reflected images: where it is not that of the G-buffer,
                        ///< something is in front of the surface, and stays
    gpu::Image motion;  ///< red, green: uv now minus uv in the last frame, without jitter; may be none
};

/// `shown` with what is reflected; itself where nothing is. With motion, a pixel shows either its surface or the
/// nearest image on it; without, depth goes from one to the other with the share of reflected light. Depth: R32F,
/// motion: RG16F.
ShownImages withReflectedImages(gpu::PassList& f, const Reflections& in, const ViewParams& view,
                                const ShownImages& shown);

}  // namespace reflet
#endif

#endif
