// The tests' own source of rays.
#include "library/missed_rays_host.h"

#include "gpu/shader.h"

#include <volk.h>

#include <bit>

std::span<const reflet::gpu::Shader> libraryTestShaders();

namespace reflet::test {

namespace {

constexpr uint32_t mostSets = 256;

}  // namespace

RayHost::RayHost(const LibraryHost& host) : device_(host.host.device().device) {
    VkDescriptorSetLayoutBinding bindings[2]{};
    for (uint32_t i = 0; i < 2; ++i) {
        bindings[i] = {i, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, 1, VK_SHADER_STAGE_COMPUTE_BIT, nullptr};
    }
    VkDescriptorSetLayoutCreateInfo set{VK_STRUCTURE_TYPE_DESCRIPTOR_SET_LAYOUT_CREATE_INFO};
    set.bindingCount = 2;
    set.pBindings = bindings;
    vkCreateDescriptorSetLayout(device_, &set, nullptr, &setLayout_);
    const VkPushConstantRange pushed{VK_SHADER_STAGE_COMPUTE_BIT, 0, sizeof(HiddenPlanes)};
    VkPipelineLayoutCreateInfo layout{VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO};
    layout.setLayoutCount = 1;
    layout.pSetLayouts = &setLayout_;
    layout.pushConstantRangeCount = 1;
    layout.pPushConstantRanges = &pushed;
    vkCreatePipelineLayout(device_, &layout, nullptr, &layout_);
    const gpu::Shader& shader = libraryTestShaders().front();
    VkShaderModuleCreateInfo code{VK_STRUCTURE_TYPE_SHADER_MODULE_CREATE_INFO};
    code.codeSize = shader.words.size_bytes();
    code.pCode = shader.words.data();
    VkShaderModule module = VK_NULL_HANDLE;
    vkCreateShaderModule(device_, &code, nullptr, &module);
    VkComputePipelineCreateInfo pipeline{VK_STRUCTURE_TYPE_COMPUTE_PIPELINE_CREATE_INFO};
    pipeline.stage = {VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO};
    pipeline.stage.stage = VK_SHADER_STAGE_COMPUTE_BIT;
    pipeline.stage.module = module;
    pipeline.stage.pName = "main";
    pipeline.layout = layout_;
    vkCreateComputePipelines(device_, VK_NULL_HANDLE, 1, &pipeline, nullptr, &pipeline_);
    vkDestroyShaderModule(device_, module, nullptr);
    const VkDescriptorPoolSize size{VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, 2 * mostSets};
    VkDescriptorPoolCreateInfo pool{VK_STRUCTURE_TYPE_DESCRIPTOR_POOL_CREATE_INFO};
    pool.maxSets = mostSets;
    pool.poolSizeCount = 1;
    pool.pPoolSizes = &size;
    vkCreateDescriptorPool(device_, &pool, nullptr, &pool_);
}

RayHost::~RayHost() {
    vkDeviceWaitIdle(device_);
    vkDestroyDescriptorPool(device_, pool_, nullptr);
    vkDestroyPipeline(device_, pipeline_, nullptr);
    vkDestroyPipelineLayout(device_, layout_, nullptr);
    vkDestroyDescriptorSetLayout(device_, setLayout_, nullptr);
}

VkDescriptorSet RayHost::setOf(const RefletMissedRays& missed) {
    VkDescriptorSetAllocateInfo allocate{VK_STRUCTURE_TYPE_DESCRIPTOR_SET_ALLOCATE_INFO};
    allocate.descriptorPool = pool_;
    allocate.descriptorSetCount = 1;
    allocate.pSetLayouts = &setLayout_;
    VkDescriptorSet set = VK_NULL_HANDLE;
    EXPECT_EQ(vkAllocateDescriptorSets(device_, &allocate, &set), VK_SUCCESS);
    const VkDescriptorBufferInfo buffers[] = {{missed.rays.buffer, missed.rays.offset, missed.rays.size},
                                              {missed.answers.buffer, missed.answers.offset, missed.answers.size}};
    VkWriteDescriptorSet writes[2]{};
    for (uint32_t i = 0; i < 2; ++i) {
        writes[i].sType = VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET;
        writes[i].dstSet = set;
        writes[i].dstBinding = i;
        writes[i].descriptorCount = 1;
        writes[i].descriptorType = VK_DESCRIPTOR_TYPE_STORAGE_BUFFER;
        writes[i].pBufferInfo = &buffers[i];
    }
    vkUpdateDescriptorSets(device_, 2, writes, 0, nullptr);
    return set;
}

RefletRayAnswers RayHost::answer(VkCommandBuffer commands, const RefletMissedRays& missed, const HiddenPlanes& planes) {
    constexpr VkPipelineStageFlags2 compute = VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT;
    waitFor(commands, missed.rays, compute | VK_PIPELINE_STAGE_2_DRAW_INDIRECT_BIT,
            VK_ACCESS_2_SHADER_STORAGE_READ_BIT | VK_ACCESS_2_INDIRECT_COMMAND_READ_BIT);
    waitFor(commands, missed.answers, compute, VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT);
    const VkDescriptorSet set = setOf(missed);
    vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_COMPUTE, pipeline_);
    vkCmdBindDescriptorSets(commands, VK_PIPELINE_BIND_POINT_COMPUTE, layout_, 0, 1, &set, 0, nullptr);
    vkCmdPushConstants(commands, layout_, VK_SHADER_STAGE_COMPUTE_BIT, 0, sizeof planes, &planes);
    vkCmdDispatchIndirect(commands, missed.rays.buffer, missed.rays.offset);
    return {sizeof(RefletRayAnswers), compute, VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT};
}

RefletRayAnswers RayHost::fill(VkCommandBuffer commands, const RefletMissedRays& missed, float value) {
    waitFor(commands, missed.answers, VK_PIPELINE_STAGE_2_ALL_TRANSFER_BIT, VK_ACCESS_2_TRANSFER_WRITE_BIT);
    vkCmdFillBuffer(commands, missed.answers.buffer, missed.answers.offset, missed.answers.size,
                    std::bit_cast<uint32_t>(value));
    return {sizeof(RefletRayAnswers), VK_PIPELINE_STAGE_2_ALL_TRANSFER_BIT, VK_ACCESS_2_TRANSFER_WRITE_BIT};
}

}  // namespace reflet::test
