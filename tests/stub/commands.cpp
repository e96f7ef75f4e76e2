// Commands of the driver without a device: nothing is recorded, but what they use is in use.
#include "stub/functions.h"
#include "stub/objects.h"

namespace reflet::stub {

namespace {

void use(VkCommandBuffer handle, Object& object, const char* call) {
    auto* const commands = reinterpret_cast<Commands*>(handle);
    if (commands->finished == commands->begun) {
        misuse("a command buffer that is not recording", call);
    }
    if (object.alive != Object::mark) {
        misuse("an object that has been destroyed", call);
    }
    object.user = commands;
    object.use = commands->begun;
}

void useImage(VkCommandBuffer commands, VkImage image, const char* call) {
    if (isOwn(image)) {
        use(commands, known<Object>(image, Kind::image, call), call);
    }
}

void useBuffer(VkCommandBuffer commands, VkBuffer buffer, const char* call) {
    if (isOwn(buffer)) {
        use(commands, known<Object>(buffer, Kind::buffer, call), call);
    }
}

VKAPI_ATTR void VKAPI_CALL barrier(VkCommandBuffer commands, const VkDependencyInfo* info) {
    constexpr const char* call = "vkCmdPipelineBarrier2";
    for (uint32_t i = 0; i < info->imageMemoryBarrierCount; ++i) {
        useImage(commands, info->pImageMemoryBarriers[i].image, call);
    }
    for (uint32_t i = 0; i < info->bufferMemoryBarrierCount; ++i) {
        useBuffer(commands, info->pBufferMemoryBarriers[i].buffer, call);
    }
}

VKAPI_ATTR void VKAPI_CALL bindSets(VkCommandBuffer commands, VkPipelineBindPoint /*point*/, VkPipelineLayout layout,
                                    uint32_t /*first*/, uint32_t count, const VkDescriptorSet* sets,
                                    uint32_t /*offsetCount*/, const uint32_t* /*offsets*/) {
    constexpr const char* call = "vkCmdBindDescriptorSets";
    (void)known<Object>(layout, Kind::layout, call);
    for (uint32_t i = 0; i < count; ++i) {
        auto& set = known<Set>(sets[i], Kind::set, call);
        use(commands, set, call);
        for (const auto& [binding, object] : set.bound) {
            if (object != nullptr) {
                use(commands, *object, call);
                if (object->kind == Kind::imageView) {
                    use(commands, *static_cast<ImageView*>(object)->image, call);
                }
            }
        }
    }
}

VKAPI_ATTR void VKAPI_CALL bindPipeline(VkCommandBuffer /*commands*/, VkPipelineBindPoint /*point*/,
                                        VkPipeline pipeline) {
    (void)known<Object>(pipeline, Kind::pipeline, "vkCmdBindPipeline");
}

VKAPI_ATTR void VKAPI_CALL dispatchIndirect(VkCommandBuffer commands, VkBuffer buffer, VkDeviceSize /*offset*/) {
    useBuffer(commands, buffer, "vkCmdDispatchIndirect");
}

VKAPI_ATTR void VKAPI_CALL copyImage(VkCommandBuffer commands, VkImage from, VkImageLayout /*fromLayout*/, VkImage to,
                                     VkImageLayout /*toLayout*/, uint32_t /*count*/, const VkImageCopy* /*regions*/) {
    useImage(commands, from, "vkCmdCopyImage");
    useImage(commands, to, "vkCmdCopyImage");
}

VKAPI_ATTR void VKAPI_CALL clear(VkCommandBuffer commands, VkImage image, VkImageLayout /*layout*/,
                                 const VkClearColorValue* /*color*/, uint32_t /*count*/,
                                 const VkImageSubresourceRange* /*ranges*/) {
    useImage(commands, image, "vkCmdClearColorImage");
}

VKAPI_ATTR void VKAPI_CALL fill(VkCommandBuffer commands, VkBuffer buffer, VkDeviceSize /*offset*/,
                                VkDeviceSize /*size*/, uint32_t /*value*/) {
    useBuffer(commands, buffer, "vkCmdFillBuffer");
}

VKAPI_ATTR void VKAPI_CALL update(VkCommandBuffer commands, VkBuffer buffer, VkDeviceSize /*offset*/,
                                  VkDeviceSize /*size*/, const void* /*data*/) {
    useBuffer(commands, buffer, "vkCmdUpdateBuffer");
}

VKAPI_ATTR void VKAPI_CALL timestamp(VkCommandBuffer commands, VkPipelineStageFlags2 /*stage*/, VkQueryPool pool,
                                     uint32_t /*query*/) {
    use(commands, known<Object>(pool, Kind::queryPool, "vkCmdWriteTimestamp2"), "vkCmdWriteTimestamp2");
}

VKAPI_ATTR VkResult VKAPI_CALL setName(VkDevice /*device*/, const VkDebugUtilsObjectNameInfoEXT* info) {
    if (info->pObjectName == nullptr) {
        misuse("a name that is NULL", "vkSetDebugUtilsObjectNameEXT");
    }
    return VK_SUCCESS;
}

VKAPI_ATTR VkResult VKAPI_CALL createGraphics(VkDevice /*device*/, VkPipelineCache /*cache*/, uint32_t /*count*/,
                                              const VkGraphicsPipelineCreateInfo* /*infos*/,
                                              const VkAllocationCallbacks* /*host*/, VkPipeline* /*pipelines*/) {
    misuse("effects draw nothing", "vkCreateGraphicsPipelines");
}

}  // namespace

void addCommandFunctions(Functions& to) {
    REFLET_STUB(vkCmdPipelineBarrier2, barrier)
    REFLET_STUB(vkCmdBindDescriptorSets, bindSets)
    REFLET_STUB(vkCmdBindPipeline, bindPipeline)
    REFLET_STUB(vkCmdDispatchIndirect, dispatchIndirect)
    REFLET_STUB(vkCmdCopyImage, copyImage)
    REFLET_STUB(vkCmdClearColorImage, clear)
    REFLET_STUB(vkCmdFillBuffer, fill)
    REFLET_STUB(vkCmdUpdateBuffer, update)
    REFLET_STUB(vkCmdWriteTimestamp2, timestamp)
    REFLET_STUB(vkSetDebugUtilsObjectNameEXT, setName)
    REFLET_STUB(vkCreateGraphicsPipelines, createGraphics)
    REFLET_STUB_NOTHING(vkCmdBeginDebugUtilsLabelEXT)
    REFLET_STUB_NOTHING(vkCmdEndDebugUtilsLabelEXT)
    REFLET_STUB_NOTHING(vkCmdBindIndexBuffer)
    REFLET_STUB_NOTHING(vkCmdBindVertexBuffers)
    REFLET_STUB_NOTHING(vkCmdBlitImage)
    REFLET_STUB_NOTHING(vkCmdCopyBuffer)
    REFLET_STUB_NOTHING(vkCmdCopyBufferToImage)
    REFLET_STUB_NOTHING(vkCmdCopyImageToBuffer)
    REFLET_STUB_NOTHING(vkCmdDispatch)
    REFLET_STUB_NOTHING(vkCmdDrawIndexed)
    REFLET_STUB_NOTHING(vkCmdPushConstants)
    REFLET_STUB_NOTHING(vkCmdResetQueryPool)
    REFLET_STUB_NOTHING(vkCmdSetScissor)
    REFLET_STUB_NOTHING(vkCmdSetViewport)
}

}  // namespace reflet::stub
