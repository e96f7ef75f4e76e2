// Captures probes: a G-buffer and direct light for each face of each cube map. Shared by C++ and GLSL.
#ifndef REFLET_RENDERER_CAPTURE_PROBE_H
#define REFLET_RENDERER_CAPTURE_PROBE_H

#include "base/shared.h"
#include "effects/probe/probes.h"
#include "effects/view.h"

SHARED_BEGIN

struct CaptureProbeParams {
    ViewParams view;
    uint face;  // 6 · probe + face
};

struct RelightProbesParams {
    uint firstFace;
    ProbeBlock probes;
};

SHARED_END

#ifdef __cplusplus

#include "effects/cube_map/cube_map.h"
#include "gpu/pass_list.h"
#include "renderer/direct_view.h"
#include "scene/scene.h"

#include <cstddef>
#include <span>
#include <vector>

namespace reflet {

/// The camera at a probe for one cube face, 0 to 5: +X -X +Y -Y +Z -Z. Its image is the face flipped left to right,
/// because cube maps are left-handed.
Camera cubeFaceCamera(const Probe& probe, uint32_t face);

/// Owns the cube maps and captures them when needed.
class Probes {
public:
    /// Maps of these probes (at most maxProbes) in the lighting of `in`. refresh once and moving: records the capture
    /// of all of them, unless they are up to date for the same probes, lights and settings. refresh face: records the
    /// capture of one face; a probe's map is updated after its sixth face.
    ProbeMaps update(gpu::PassList& f, const ViewInputs& in, std::span<const Probe> probes, const Settings& settings);

    /// With refresh face, captures start over. Maps captured all at once are kept, because they do not depend on time,
    /// unless the scene moves.
    void restart(bool sceneMoves);

private:
    /// Captured faces of all probes, in this frame only.
    struct Captured {
        gpu::Image lit;      ///< RGBA16F: direct light, without emission that lamps replace
        gpu::Image surface;  ///< RGBA32UI, see probe_surface.glsl
    };
    struct Capture {
        const ViewInputs& in;
        const Settings& settings;
        Captured out;
    };
    void makeMaps(gpu::Context& context, uint32_t resolution);
    /// Prefilters the captured faces.
    void filter(gpu::PassList& f, uint32_t firstCube, uint32_t count, CubeLobeSamples samples);
    [[nodiscard]] const CubeMap& forDiffuse() const { return splits_ ? matte_ : map_; }
    void captureAll(gpu::PassList& f, const ViewInputs& in, const Settings& settings);
    void captureNextFace(gpu::PassList& f, const ViewInputs& in, const Settings& settings);
    [[nodiscard]] Captured makeCaptured(gpu::PassList& f) const;
    /// face: 6 · probe + face. Returns the lamps' shadow map, to be shared with other faces of the frame.
    gpu::Image captureFace(gpu::PassList& f, const Capture& capture, uint32_t face, gpu::Image lampShadowMap = {});

    /// furtherLight: adds indirect light from the existing maps.
    void relight(gpu::PassList& f, const Capture& capture, const CubeFaces& faces, bool furtherLight);

    DirectViewStore faces_;  ///< of the face being captured
    CubeMap map_;
    CubeMap matte_;        ///< without emission that lamps replace; only its mips and irradiance are used
    bool splits_ = false;  ///< whether there is such emission
    gpu::Texture distance_;
    gpu::Texture atlas_;
    ProbeBlock block_{};
    std::vector<std::byte> key_;  ///< all inputs of the captured maps
    bool byFace_ = false;         ///< the maps were captured with refresh face
    uint32_t facesCaptured_ = 0;  ///< number of faces captured since the start of refresh face
};

}  // namespace reflet
#endif

#endif
