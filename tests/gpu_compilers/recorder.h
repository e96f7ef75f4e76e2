// Records frames of the library on a Vulkan driver that compiles for a GPU which is not there. The driver makes
// pipelines; images, buffers, memory and commands are faked, and what is bound and dispatched is noted.
#pragma once

#include "gpu_compilers/isa.h"

#include "base/math.h"

#include "reflet/reflet.h"

#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace reflet::gpu_compilers {

/// What the compiler says of one pipeline.
struct Kernel {
    std::string name;  ///< file name of the shader and its specialization constants: "dof_gather.comp near=1"
    glm::uvec3 localSize{1};
    std::map<std::string, uint64_t> statistics;  ///< by the driver's names: "VGPRs", "Instructions"
    std::vector<Loop> loops;                     ///< by its assembly
};

struct BoundImage {
    std::string format;
    glm::uvec3 size{0};  ///< of the whole image; z: layers
    uint64_t bytes = 0;
    bool stored = false;  ///< bound as a storage image
};

/// One dispatch.
struct RecordedPass {
    std::string label;
    std::string kernel;
    glm::uvec3 groups{0};  ///< 0: indirect, only the device knows
    std::vector<BoundImage> images;
};

struct RecordedFrame {
    std::vector<RecordedPass> passes;
    uint32_t barriers = 0;
    uint64_t clearedBytes = 0;
};

/// As RefletContextInfo::getInstanceProcAddr: records what the library does on a NullDevice.
PFN_vkVoidFunction VKAPI_CALL lookUpRecorded(VkInstance instance, const char* name);
/// An image of the host, for the library to read. Nothing but its description is there.
RefletImage makeHostImage(VkFormat format, uvec2 size);
/// All pipelines that were created so far, by name.
const std::map<std::string, Kernel>& recordedKernels();
/// What was recorded since the last call.
RecordedFrame takeRecordedFrame();

}  // namespace reflet::gpu_compilers
