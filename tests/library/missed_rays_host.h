// A host's own source of rays for the tests: planes behind the camera of the room and above it, in a compute shader.
#pragma once

#include "library/library_host.h"

namespace reflet::test {

/// What the room does not show.
struct HiddenPlanes {
    vec4 wall{3.0F, 2.0F, 1.0F, 5.0F};     ///< radiance; z [m]
    vec4 ceiling{0.5F, 4.0F, 2.0F, 6.0F};  ///< radiance; y [m]
    float confidence = 1.0F;
    float missDistance = -1.0F;  ///< told of rays that hit neither
    float tells = 0.0F;          ///< 1: radiance is what the ray tells about itself (answer_rays_test.comp)
};

/// Answers rays on a host's device.
class RayHost {
public:
    explicit RayHost(const LibraryHost& host);
    ~RayHost();
    RayHost(const RayHost&) = delete;
    RayHost& operator=(const RayHost&) = delete;

    /// Records the barriers, the dispatch and what refletAnswerRays is to be told.
    RefletRayAnswers answer(VkCommandBuffer commands, const RefletMissedRays& missed, const HiddenPlanes& planes);
    /// Writes a number into everything that answers consist of.
    static RefletRayAnswers fill(VkCommandBuffer commands, const RefletMissedRays& missed, float value);

private:
    VkDescriptorSet setOf(const RefletMissedRays& missed);

    VkDevice device_;
    VkDescriptorSetLayout setLayout_ = VK_NULL_HANDLE;
    VkPipelineLayout layout_ = VK_NULL_HANDLE;
    VkPipeline pipeline_ = VK_NULL_HANDLE;
    VkDescriptorPool pool_ = VK_NULL_HANDLE;
};

}  // namespace reflet::test
