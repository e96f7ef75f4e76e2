// Draws the G-buffer. Shared by C++ and GLSL.
#ifndef REFLET_RENDERER_DRAW_GBUFFER_H
#define REFLET_RENDERER_DRAW_GBUFFER_H

#include "base/shared.h"
#include "effects/gbuffer/gbuffer.h"
#include "effects/view.h"

SHARED_BEGIN

#define MATERIALS_SETTINGS(VALUE, SWITCH, CHOICE)                                                                     \
    SWITCH(lambertOnly, 0,                                                                                            \
           "Shade every material as Lambert diffuse with its base colour: no specular lobe, no metals.")              \
    SWITCH(coats, 1,                                                                                                  \
           "Draw clear coats (KHR_materials_clearcoat): highlights, a reflection ray per coated pixel and what the "  \
           "coat takes from the surface beneath. Off: without coats, faster where any is seen.")                      \
    SWITCH(                                                                                                           \
        mips, 1,                                                                                                      \
        "Use texture mipmaps. Off: always the finest level, as the reference renders; needs many samples per pixel.") \
    VALUE(                                                                                                            \
        uint, anisotropy, 8, 1, 16,                                                                                   \
        "Maximum samples of anisotropic texture filtering. 1: off, blurry at grazing angles. More: sharper, slower.") \
    VALUE(float, mipBias, 0, -2, 2,                                                                                   \
          "Added to the texture mip level. Below 0: sharper; -1 to -2 suits temporal antialiasing, which averages "   \
          "jittered frames; flickers without it. Above 0: blurrier.")
SETTINGS(MaterialsSettings, MATERIALS_SETTINGS)

// Which surfaces are drawn: values of the specialization constant `surfaces`.
const uint surfacesOpaque = 0;   // opaque ones, and blended ones from an alpha of blendedFrom on
const uint surfacesNearest = 1;  // the nearest translucent ones in front of the opaque ones
const uint surfacesBehind = 2;   // the next translucent ones, behind another layer

// Kind of these translucent surfaces: values of the specialization constant `translucent`.
const uint translucentBlended = 0;
const uint translucentGlass = 1;
const uint translucentCoat = 2;  // the clear coats of opaque surfaces
const uint translucentGlassCoat = 3;
const uint translucentBlendedCoat = 4;
const uint translucentOtherSide = 5;  // opaque surfaces that transmit diffuse light, as lit from behind

struct GBufferParams {
    ViewParams view;
    MaterialsSettings settings;
    vec4 clipPlane;     // world space: only geometry in front of it, dot(clipPlane, (p, 1)) > 0, is drawn
    float blendedFrom;  // alpha from which blended surfaces are drawn with the opaque ones
};

SHARED_END

#ifdef __cplusplus

#include "gpu/pass_list.h"
#include "renderer/draw_list.h"
#include "renderer/material.h"

#include <optional>

namespace reflet {

/// Which surfaces of the draw list a G-buffer holds.
struct GBufferContent {
    vec4 clipPlane{0.0F};             ///< as in GBufferParams; zero: none
    float blendedFrom = opaqueAlpha;  ///< alpha from which blended surfaces count as opaque
    gpu::Image opaqueDepth{};         ///< given: translucent surfaces in front of this depth; none: opaque surfaces
    gpu::Image nearerDepth{};         ///< given: the nearest translucent surfaces behind this depth; none: the nearest
    bool glass = false;               ///< translucent surfaces are transmissive ones, not blended ones
    /// The clear coats of those surfaces, or of the opaque ones: black dielectrics of the standard reflectance, with
    /// the coat's share in the motion's alpha. opaqueDepth: of the surfaces themselves.
    bool coat = false;
    bool blendedCoats = false;  ///< coats of a layer of blended surfaces, not of the opaque ones
    /// The other side of opaque surfaces that transmit diffuse light: Lambert, with normals away from the camera.
    /// opaqueDepth: as with coats.
    bool otherSide = false;
    bool withoutGlass = false;            ///< transmissive surfaces do not count as opaque
    std::optional<uint32_t> bothSides{};  ///< index of a draw whose back faces are drawn, too
    float levelScale = 1.0F;  ///< levels of detail are chosen as for a view with sides this many times longer
};

/// Draws the list, which must live until the frame has ended, for the view: reversed Z, back faces of single-sided
/// draws culled. Layers of blended surfaces are found by depth peeling (C. Everitt, Interactive Order-Independent
/// Transparency, 2001). Clipping is done per pixel, because an oblique near plane (Lengyel, Oblique View Frustum Depth
/// Projection and Clipping, 2005) would distort depth, and ray marching relies on distance = near / depth.
GBuffer drawGBuffer(gpu::PassList& f, const DrawList& list, const ViewParams& view, const MaterialsSettings& settings,
                    const GBufferContent& content = {});

}  // namespace reflet
#endif

#endif
