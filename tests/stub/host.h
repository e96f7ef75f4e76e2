// A host of the C API without a device: everything that a frame can be given, complete and right.
#pragma once

#include "stub/driver.h"

#include <array>

namespace reflet::stub {

/// An image of the host that is not there. number: equal ones have the same handles.
RefletImage hostImage(uint64_t number, VkFormat format, uint32_t width, uint32_t height);

/// All that a host passes to the effects of one frame. Tests spoil it. Structs point to one another.
struct HostFrame {
    /// Images are of this size. first: number of the first of its images.
    HostFrame(uint32_t width, uint32_t height, uint64_t first = 0);
    HostFrame(const HostFrame&) = delete;
    HostFrame& operator=(const HostFrame&) = delete;

    /// Turns the camera.
    void look(float angle);

    RefletGBuffer gbuffer{};
    RefletFrameInfo frame{};  ///< without command buffer
    RefletSunShadow sun{};
    std::array<RefletLampShadow, 3> lamps{};  ///< a spot, a cube map of distances, six tiles
    RefletContactLight contact{};
    RefletEnvironment environment{};
    std::array<float, 27> harmonics{};
    std::array<RefletProbe, 2> probes{};
    std::array<RefletPlanarView, 1> planarViews{};
    RefletIndirectLight light{};
    RefletImage color{};   ///< of the frame's size, four channels
    RefletImage output{};  ///< that a tone map may write
    RefletImage exposure{};
    RefletLens lens{};
    RefletToneMapInfo toneMap{};  ///< into an image of the library's
    RefletRayAnswers answers{};
    RefletPrepareInfo prepare{};  ///< of all effects
};

}  // namespace reflet::stub
