// Captures probes: a G-buffer and direct light for each face of each cube map. Shared by C++ and GLSL.
#ifndef REFLET_RENDER_CAPTURE_PROBE_H
#define REFLET_RENDER_CAPTURE_PROBE_H

#include "base/shared.h"
#include "render/probe/probes.h"
#include "render/view.h"

SHARED_BEGIN

struct CaptureProbeParams {
    ViewParams view;
    uint face;    // 6 · probe + its number
    float blend;  // ProbesSettings
    ProbeBlock probes;
};

SHARED_END

#ifdef __cplusplus

#include "gpu/frame.h"
#include "render/cube_map/cube_map.h"
#include "render/direct_view.h"
#include "scene/scene.h"

#include <cstddef>
#include <span>
#include <vector>

namespace reflet {

/// A camera at a place that sees one face of a cube, 0 to 5: +X -X +Y -Y +Z -Z. Its picture is that face mirrored left
/// to right: cube maps have left-handed axes.
Camera cubeFaceCamera(const vec3& position, uint32_t face);

/// Owns the cube maps, and captures them when that is needed.
class Probes {
public:
    explicit Probes(gpu::Device& device) : device_(device) {}

    /// Maps of these probes (at most maxProbes) in the lights of `in`. refresh=once and moving: captures all of them,
    /// within frames of its own, unless that has been done for the same probes, lights and settings; nothing of `f` may
    /// have been recorded before. refresh=face: records the capture of one face into `f`; a probe's map changes with
    /// its sixth.
    ProbeMaps update(gpu::Frame& f, const ViewInputs& in, std::span<const Probe> probes, const Settings& settings);

    /// With refresh=face captures begin anew. What was captured at once stays, as it is the same whenever that is done,
    /// unless the scene moves.
    void restart(bool sceneMoves);

private:
    struct Capture {
        const ViewInputs& in;
        const Settings& settings;
        bool furtherLight;  ///< add what the maps so far light the surfaces with
    };
    void makeMaps(uint32_t resolution);
    void captureAll(const ViewInputs& in, const Settings& settings);
    void captureNextFace(gpu::Frame& f, const ViewInputs& in, const Settings& settings);
    /// face: 6 · probe + its number. Returns the map of the lamps' shadows, which serves other faces of the frame.
    gpu::Image captureFace(gpu::Frame& f, const Capture& capture, uint32_t face, gpu::Image lampShadowMap = {});

    gpu::Device& device_;
    CubeMap map_;
    gpu::Texture distance_;
    gpu::Texture atlas_;
    ProbeBlock block_{};
    std::vector<std::byte> key_;  ///< all that the maps depend on, as they were captured
    bool byFace_ = false;         ///< the maps are those of refresh=face
    uint32_t facesCaptured_ = 0;  ///< with refresh=face, since it began
};

}  // namespace reflet
#endif

#endif
