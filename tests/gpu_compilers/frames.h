// Frames that the GPU's compiler is asked about: the presets, and what no preset turns on.
#pragma once

#include "gpu_compilers/recorder.h"

#include <string>
#include <vector>

namespace reflet::gpu_compilers {

struct FrameCase {
    const char* name;
    const char* preset;
    uvec2 size;    ///< of the frame, pixels
    uvec2 output;  ///< of the picture, pixels
    std::vector<std::pair<const char*, const char*>> settings;
    uint32_t cascades = 1;
};

/// At 1920x1080. `fast`, `balanced` and `quality` have depth of field; "options" has ambient occlusion, slices, three
/// cascades, PCF, contact shadows and soft shadows without history.
const std::vector<FrameCase>& frameCases();

/// A steady frame: history is there, and every pipeline has been made. Throws Error.
RecordedFrame recordSteadyFrame(RefletContext context, const FrameCase& wanted);

}  // namespace reflet::gpu_compilers
