// Names of formats.
#include "gpu/listing.h"

namespace reflet::gpu {

std::string formatName(VkFormat format) {
    switch (format) {
#define REFLET_FORMAT(name) \
    case VK_FORMAT_##name:  \
        return #name;
        REFLET_FORMAT(R8_UNORM)
        REFLET_FORMAT(R8G8B8A8_UNORM)
        REFLET_FORMAT(R8G8B8A8_SRGB)
        REFLET_FORMAT(A2B10G10R10_UNORM_PACK32)
        REFLET_FORMAT(B10G11R11_UFLOAT_PACK32)
        REFLET_FORMAT(R16G16_SFLOAT)
        REFLET_FORMAT(R16G16B16A16_SFLOAT)
        REFLET_FORMAT(R32_UINT)
        REFLET_FORMAT(R32_SFLOAT)
        REFLET_FORMAT(R32G32_UINT)
        REFLET_FORMAT(R32G32_SFLOAT)
        REFLET_FORMAT(R32G32B32A32_UINT)
        REFLET_FORMAT(R32G32B32A32_SFLOAT)
        REFLET_FORMAT(D32_SFLOAT)
#undef REFLET_FORMAT
        default:
            return "VkFormat " + std::to_string(static_cast<int>(format));
    }
}

}  // namespace reflet::gpu
